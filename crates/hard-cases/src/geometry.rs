//! Triangles and points that several cases use.

use super::case::Triangle;
use rasray_reference::oracle::Ray;

/// Makes two triangles that share the diagonal from a to c.
pub(super) fn quad(a: [f32; 3], b: [f32; 3], c: [f32; 3], d: [f32; 3]) -> [Triangle; 2] {
    [[a, b, c], [a, c, d]]
}

/// Makes a square across the z axis.
pub(super) fn plate(z: f32, half: f32) -> [Triangle; 2] {
    quad([-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z])
}

/// Makes a closed box of 12 triangles with shared corners.
pub(super) fn cuboid(low: [f32; 3], high: [f32; 3]) -> Vec<Triangle> {
    let corner =
        |bits: usize| std::array::from_fn(|axis| if bits >> axis & 1 == 1 { high[axis] } else { low[axis] });
    let mut triangles = Vec::with_capacity(12);
    for axis in 0..3 {
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let back = quad(corner(0), corner(v), corner(u | v), corner(u));
        let side = 1 << axis;
        let front = quad(corner(side), corner(side | u), corner(side | u | v), corner(side | v));
        triangles.extend(back.into_iter().chain(front));
    }
    triangles
}

/// Makes a closed cube around a point.
pub(super) fn cube(center: [f32; 3], half: f32) -> Vec<Triangle> {
    cuboid(center.map(|x| x - half), center.map(|x| x + half))
}

/// Makes a closed sphere of `rows` by `rows` cells with its poles on the z axis. Corners are computed in
/// double precision and rounded once, so that neighbours share them.
pub(super) fn sphere(center: [f32; 3], radius: f64, rows: usize) -> Vec<Triangle> {
    uv_sphere(center, radius, rows, rows)
}

/// Makes a sphere like [`sphere`], of `rows` by `columns` cells.
pub(super) fn uv_sphere(center: [f32; 3], radius: f64, rows: usize, columns: usize) -> Vec<Triangle> {
    use std::f64::consts::{PI, TAU};
    let corner = |row: usize, column: usize| -> [f32; 3] {
        let polar = if row == rows { PI } else { PI * row as f64 / rows as f64 };
        let ring = if row == 0 || row == rows { 0.0 } else { polar.sin() };
        let azimuth = TAU * (column % columns) as f64 / columns as f64;
        let direction = [ring * azimuth.cos(), ring * azimuth.sin(), polar.cos()];
        std::array::from_fn(|axis| (f64::from(center[axis]) + radius * direction[axis]) as f32)
    };
    let mut triangles = Vec::with_capacity(2 * columns * rows.saturating_sub(1));
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [corner(row, column), corner(row + 1, column)];
            let [c, d] = [corner(row + 1, column + 1), corner(row, column + 1)];
            if row + 1 < rows {
                triangles.push([a, b, c]);
            }
            if row > 0 {
                triangles.push([a, c, d]);
            }
        }
    }
    triangles
}

/// Returns the centre of an edge, rounded once.
pub(super) fn midpoint(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|axis| (0.5 * (f64::from(a[axis]) + f64::from(b[axis]))) as f32)
}

/// Returns the point of a triangle with these weights, rounded once.
pub(super) fn point_on(triangle: &Triangle, weights: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|axis| {
        triangle.iter().zip(weights).map(|(v, w)| f64::from(v[axis]) * f64::from(w)).sum::<f64>() as f32
    })
}

/// Returns `a + b * s`.
pub(super) fn along(a: [f32; 3], b: [f32; 3], s: f32) -> [f32; 3] {
    std::array::from_fn(|axis| a[axis] + b[axis] * s)
}

/// Makes a ray from one point to another, which it reaches at t = 1.
pub(super) fn aim(origin: [f32; 3], target: [f32; 3]) -> Ray {
    Ray::towards(origin, target)
}
