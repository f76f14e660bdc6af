//! Rays that cube traversals find hard; letters and numbers are those of the list of hard cases (view
//! geometry).

use rasray_ads::Ray;
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::visits::{cell_boundary, world_from_face};

fn until(ray: Ray, t_max: f32) -> Ray {
    Ray { t_max, ..ray }
}

/// Anywhere within radius 1: origins of all distances, on borders, at the eye; directions with zeros,
/// along diagonals, towards corners of cells, almost along boundaries.
pub fn random(random: &mut Random, count: usize, resolution: u32) -> Vec<Ray> {
    (0..count)
        .map(|_| {
            let pick = random.bits();
            let face = (pick >> 32) as u32 % 6;
            let edge = |random: &mut Random| {
                cell_boundary(random.between(0.0, resolution as f32 + 1.0) as i32, resolution)
            };
            let depth = 10.0_f32.powf(random.between(-4.0, 0.0));
            let corner = {
                let (x, y) = (edge(random), edge(random));
                world_from_face([x * depth, y * depth, depth], face)
            };
            let origin = match pick % 6 {
                0 => [0.0; 3],
                1 => corner,
                2 => {
                    let x = edge(random);
                    world_from_face([x * depth, random.between(-1.0, 1.0) * depth, depth], face)
                }
                3 => random.point(-1.0, 1.0).map(|x| x * depth),
                _ => random.point(-1.0, 1.0),
            };
            let mut direction = random.direction();
            match (pick >> 8) % 8 {
                0 => direction[(pick >> 16) as usize % 3] = 0.0,
                1 => {
                    direction = [0.0; 3];
                    direction[(pick >> 16) as usize % 3] = if pick >> 20 & 1 == 0 { 1.0 } else { -1.0 };
                }
                2 => direction = [1.0, -0.0, 1.0].map(|x| if pick >> 20 & 1 == 0 { x } else { -x }),
                3 => direction = towards(origin, corner).direction,
                4 => {
                    // Along a column of cells, and a little off it.
                    let x = edge(random) + if pick >> 20 & 1 == 0 { 0.0 } else { 1.0e-6 };
                    direction = world_from_face([x, random.between(-1.0, 1.0), 1.0], face);
                }
                _ => {}
            }
            if direction == [0.0; 3] {
                direction = [0.0, 0.0, 1.0];
            }
            let ray = Ray::new(origin, direction);
            match (pick >> 24) % 3 {
                0 => ray,
                1 => until(ray, random.between(0.01, 4.0)),
                _ => Ray { t_min: random.between(0.0, 0.5), t_max: random.between(0.5, 3.0), ..ray },
            }
        })
        .collect()
}

/// These rays about a scene of another size.
pub fn scaled(rays: &[Ray], factor: f32) -> Vec<Ray> {
    rays.iter().map(|ray| Ray { origin: ray.origin.map(|x| x * factor), ..*ray }).collect()
}

/// V3 and V4: parallel to the image plane, and across the view at slopes up and down.
pub fn across_the_view(resolution: u32) -> Vec<Ray> {
    let mut rays = vec![towards([-4.0, 0.01, 5.0], [4.0, 0.01, 5.0])];
    for face in 0..6 {
        for step in -4..=4 {
            let y = cell_boundary(step + 4, resolution);
            for slope in [-1.0, -0.5, 0.0, 0.5, 1.0_f32] {
                let [from, to] = [[-4.0, 5.0 * y, 5.0 - 0.9 * slope], [4.0, 5.0 * y, 5.0 + 0.9 * slope]]
                    .map(|p| world_from_face(p, face));
                rays.push(towards(from, to));
            }
        }
    }
    rays
}

/// V5: in the planes where two faces touch, from the eye, through it, and next to it.
pub fn seams() -> Vec<Ray> {
    let mut rays = Vec::new();
    for axis in 0..3 {
        for signs in 0..4 {
            let sign = |bit: i32| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
            for k in -64..=64 {
                let other = 1.0 + k as f32 / 64.0;
                let mut direction = [0.0; 3];
                direction[axis] = sign(0) * other;
                direction[(axis + 1) % 3] = sign(1) * other;
                direction[(axis + 2) % 3] = k as f32 / 200.0;
                if direction == [0.0; 3] {
                    continue;
                }
                for start in [0.0, 0.5, 2.5_f32] {
                    // In the plane, before and after the eye.
                    let mut origin = [0.0; 3];
                    origin[axis] = -start * sign(0);
                    origin[(axis + 1) % 3] = -start * sign(1);
                    rays.push(Ray::new(origin, direction));
                    origin[(axis + 2) % 3] = 0.75;
                    rays.push(until(Ray::new(origin, direction), 8.0));
                }
            }
        }
    }
    rays
}

/// V6: through the corners of the cube, one unit in the last place to either side.
pub fn corners(size: f32) -> Vec<Ray> {
    let mut rays = Vec::new();
    for corner in 0..8 {
        for variant in 0..27 {
            let target: [f32; 3] = std::array::from_fn(|axis| {
                let x = if corner >> axis & 1 == 0 { size } else { -size };
                let ulp = variant / [1, 3, 9][axis] % 3 - 1;
                f32::from_bits((x.to_bits() as i32 + ulp) as u32)
            });
            rays.push(Ray::new([0.0; 3], target));
            rays.push(towards([0.3 * size, -0.2 * size, 0.1 * size], target));
            rays.push(towards(target.map(|x| -x), target));
        }
    }
    rays
}

/// V8: from points that lie on a seam or a corner of the cube.
pub fn from_seams() -> Vec<Ray> {
    let mut rays = Vec::new();
    for target in [[2.0, 0.0, -5.0], [-5.0, 0.0, 2.0], [5.0, 0.0, 5.0], [2.0, 3.0, 2.0], [-1.0, -2.0, -3.0]] {
        for origin in
            [[2.0, 0.0, 2.0], [-2.0, 2.0, 0.5], [2.0, 2.0, 2.0], [-1.0, 1.0, -1.0], [0.0, -3.0, 3.0]]
        {
            if origin != target {
                rays.push(towards(origin, target));
                rays.push(until(towards(origin, target), 1.0));
            }
        }
    }
    rays
}

/// V9 and V10: through the eye along general lines and axes, and past it at small distances.
pub fn through_the_eye() -> Vec<Ray> {
    let mut rays = Vec::new();
    for offset in [0.0, 1.0e-3, 1.0e-6, 1.0 / (1 << 24) as f32, 2.0_f32.powi(-120)] {
        for axis in 0..3 {
            let moved = |p: [f32; 3]| {
                let mut p = p;
                p[axis] += offset;
                p
            };
            rays.push(towards(moved([-3.0, -1.0, -2.0]), moved([3.0, 1.0, 2.0])));
            for along in 0..3 {
                for sign in [1.0, -1.0] {
                    let mut origin = [0.0; 3];
                    origin[along] = -2.0 * sign;
                    let mut direction = [0.0; 3];
                    direction[along] = sign;
                    rays.push(Ray::new(moved(origin), direction));
                    rays.push(Ray::new(moved([0.0; 3]), direction));
                }
            }
        }
    }
    rays
}

/// V13: parallel to the axes from many points, and exactly along columns of cells.
pub fn axis_parallel(resolution: u32) -> Vec<Ray> {
    let mut random = Random::new(13);
    let mut rays = Vec::new();
    for _ in 0..200 {
        let origin = random.point(-4.0, 4.0);
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                // The other components are zeros of either sign.
                let mut direction = [0.0, -0.0, 0.0];
                direction[axis] = sign;
                rays.push(Ray::new(origin, direction));
            }
        }
    }
    for cell in 0..=resolution as i32 {
        let x = cell_boundary(cell, resolution);
        for face in 0..6 {
            rays.push(towards(
                world_from_face([x, 0.1, 1.0], face),
                world_from_face([100.0 * x, 7.0, 100.0], face),
            ));
            rays.push(towards(
                world_from_face([x, x, 1.0], face),
                world_from_face([64.0 * x, 64.0 * x, 64.0], face),
            ));
        }
    }
    rays
}

/// V14: towards every corner of the cells at several depths.
pub fn to_cell_corners(resolution: u32) -> Vec<Ray> {
    let mut random = Random::new(14);
    let mut rays = Vec::new();
    for z in [0.5, 1.0, 7.3, 100.0_f32] {
        for row in 0..=resolution as i32 {
            for column in 0..=resolution as i32 {
                let (x, y) = (cell_boundary(column, resolution), cell_boundary(row, resolution));
                let target = world_from_face([x * z, y * z, z], (row + column) as u32 % 6);
                rays.push(until(towards(random.point(-2.0, 2.0), target), 1.5));
            }
        }
    }
    rays
}

/// V15: from the eye itself and from within rounding of it, through cell centres, borders and anywhere.
pub fn from_the_eye(resolution: u32) -> Vec<Ray> {
    let mut random = Random::new(15);
    let mut rays = Vec::new();
    for step in 0..600 {
        let x = cell_boundary(step % (resolution as i32 + 1), resolution);
        let border = world_from_face([x, random.between(-1.0, 1.0), 1.0], step as u32 % 6);
        for direction in [border, random.direction()] {
            rays.push(Ray::new([0.0; 3], direction));
            rays.push(Ray::new([0.0, 0.0, 1.0e-7], direction));
            rays.push(until(Ray::new(random.point(-1.0e-6, 1.0e-6), direction), 2.0));
        }
    }
    rays
}
