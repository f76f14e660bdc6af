//! Triangles for tests.

use crate::hard_cases::{self, Scale};
use crate::random::Random;

/// A triangle.
pub type Triangle = [[f32; 3]; 3];

/// The closed box between two corners: 12 triangles.
pub fn closed_box(low: [f32; 3], high: [f32; 3]) -> Vec<Triangle> {
    let corner =
        |i: usize| std::array::from_fn(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let quads = [[0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6], [0, 1, 3, 2], [4, 6, 7, 5]];
    quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).map(|t| t.map(corner)).collect()
}

/// A sphere of rows and columns of quads, closed, with shared vertices bit-equal.
pub fn sphere(center: [f32; 3], radius: f32, rows: usize) -> Vec<Triangle> {
    let columns = 2 * rows;
    let vertex = |row: usize, column: usize| {
        let polar = std::f64::consts::PI * row as f64 / rows as f64;
        let azimuth = std::f64::consts::TAU * (column % columns) as f64 / columns as f64;
        let ring = if row == 0 || row == rows { 0.0 } else { polar.sin() };
        let unit = [ring * azimuth.cos(), polar.cos(), ring * azimuth.sin()];
        std::array::from_fn(|axis| (f64::from(center[axis]) + f64::from(radius) * unit[axis]) as f32)
    };
    let mut triangles = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let (a, b) = (vertex(row, column), vertex(row, column + 1));
            let (c, d) = (vertex(row + 1, column), vertex(row + 1, column + 1));
            if row > 0 {
                triangles.push([a, b, d]);
            }
            if row + 1 < rows {
                triangles.push([a, d, c]);
            }
        }
    }
    triangles
}

/// Triangles of all sizes within 10 of the origin: scattered layers, spheres of small and of tiny triangles, slivers
/// that are long and thin and often pass close to the eye, and a room around them.
pub fn all_sizes() -> Vec<Triangle> {
    let mut triangles = hard_cases::case("C4", Scale::QUICK).expect("the case exists").triangles;
    triangles.extend(sphere([-3.0, 0.5, -2.0], 1.5, 10));
    triangles.extend(sphere([1.0, 0.25, 0.5], 0.03, 8));
    triangles.extend(closed_box([-10.0; 3], [10.0; 3]));
    let mut random = Random::new(7);
    for _ in 0..100 {
        let (from, to) = (random.point(-9.0, 9.0), random.point(-9.0, 9.0));
        let nearby = std::array::from_fn(|axis| from[axis] + random.between(-1.0e-3, 1.0e-3));
        triangles.push([from, to, nearby]);
    }
    triangles
}

/// Needles of any direction within 12 of the origin, so thin that rounding turns the planes of many, and a few as wide as
/// cells.
pub fn needles() -> Vec<Triangle> {
    let mut random = Random::new(77);
    (0..400)
        .map(|index| {
            let (from, along, aside) = (random.point(-4.0, 4.0), random.direction(), random.direction());
            let length = random.between(1.0, 8.0);
            let width = 10.0_f32.powi(-(index % 8));
            let to = std::array::from_fn(|axis| from[axis] + length * along[axis]);
            [from, to, std::array::from_fn(|axis| from[axis] + width * aside[axis])]
        })
        .collect()
}
