//! Triangles for tests.

use crate::hard_cases::{self, Scale};
use crate::random::Random;

/// Corners of a triangle.
pub type Triangle = [[f32; 3]; 3];

/// Makes a rectangle perpendicular to z.
pub fn quad(x: [f32; 2], y: [f32; 2], z: f32) -> [Triangle; 2] {
    let corner = |i: usize, j: usize| [x[i], y[j], z];
    [[corner(0, 0), corner(1, 0), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(0, 1)]]
}

/// Makes the closed box between two corners: 12 triangles.
pub fn closed_box(low: [f32; 3], high: [f32; 3]) -> Vec<Triangle> {
    let corner =
        |i: usize| std::array::from_fn(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let quads = [[0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6], [0, 1, 3, 2], [4, 6, 7, 5]];
    quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).map(|t| t.map(corner)).collect()
}

/// Makes a closed sphere of rows and columns of quads, with shared vertices equal in every bit.
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

/// Returns the lower and upper corner of the bounds of triangles.
pub fn bounds(triangles: &[Triangle]) -> [[f32; 3]; 2] {
    let corners = || triangles.as_flattened();
    let lower = std::array::from_fn(|axis| corners().iter().fold(f32::MAX, |m, p| m.min(p[axis])));
    let upper = std::array::from_fn(|axis| corners().iter().fold(f32::MIN, |m, p| m.max(p[axis])));
    [lower, upper]
}

/// Makes scattered layers within 10 of the origin.
pub fn layers() -> Vec<Triangle> {
    hard_cases::case("C4", Scale::QUICK).expect("the case exists").triangles
}

/// Makes [`layers`] and a room around them between two corners.
pub fn layers_in_a_room(low: [f32; 3], high: [f32; 3]) -> Vec<Triangle> {
    let mut triangles = layers();
    triangles.extend(closed_box(low, high));
    triangles
}

/// Number of triangles around the origin in [`layers_around_the_eye`].
pub const NEAR_TRIANGLES: u64 = 5;

/// Makes layers, a room, and triangles around the eye in the origin for the near-region list.
pub fn layers_around_the_eye() -> Vec<Triangle> {
    let mut triangles = layers_in_a_room([-10.0; 3], [10.0; 3]);
    for k in 0..NEAR_TRIANGLES {
        let z = 1.0e-5 * (k as f32 - 2.0) + 1.0e-6;
        triangles.push([[-0.02, -0.02, z], [0.02, -0.02, z], [0.0, 0.03, z]]);
    }
    triangles
}

/// Makes layers, a sphere of that many rows, and a room around them.
pub fn layers_and_sphere(rows: usize) -> Vec<Triangle> {
    let mut triangles = layers();
    triangles.extend(sphere([-3.0, 0.5, -2.0], 1.5, rows));
    triangles.extend(closed_box([-10.0; 3], [10.0; 3]));
    triangles
}

/// Adds every third of these triangles once more.
pub fn with_twins(mut triangles: Vec<Triangle>) -> Vec<Triangle> {
    triangles.extend(triangles.clone().into_iter().step_by(3));
    triangles
}

/// Makes a sphere in a room of 8 metres.
pub fn ball_in_a_room() -> Vec<Triangle> {
    let mut triangles = closed_box([-4.0; 3], [4.0; 3]);
    triangles.extend(sphere([1.0, 0.5, -1.5], 0.75, 24));
    triangles
}

/// Makes triangles of all sizes within 10 of the origin: scattered layers, spheres of small and of tiny
/// triangles, slivers that are long and thin and often pass close to the eye, and a room around them.
pub fn all_sizes() -> Vec<Triangle> {
    let mut triangles = layers();
    triangles.extend(sphere([-3.0, 0.5, -2.0], 1.5, 10));
    triangles.extend(sphere([1.0, 0.25, 0.5], 0.03, 8));
    triangles.extend(closed_box([-10.0; 3], [10.0; 3]));
    let mut random = Random::new(7);
    for _ in 0..100 {
        let (from, to) = (random.point(-9.0, 9.0), random.point(-9.0, 9.0));
        triangles.push([from, to, random.near(from, 1.0e-3)]);
    }
    triangles
}

/// Makes needles of any direction within 12 of the origin, so thin that rounding turns the planes of many,
/// and a few as wide as cells.
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
