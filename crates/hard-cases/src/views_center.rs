//! Rays through the common centre of the views, their seams and their corners.

use super::case::{Answer, Content, Context, Entry, Expectation};
use super::geometry::{aim, cube, point_on, sphere};
use super::random::Stream;
use rasray_reference::oracle::Ray;

pub(super) const CASES: &[Entry] = &[
    Entry { id: "V5", title: "rays in the planes between cube faces", parameter: 0.0, build: seams },
    Entry { id: "V6", title: "rays through the corners of the cube map", parameter: 0.0, build: corners },
    Entry { id: "V7", title: "triangle that spans three cube faces", parameter: 0.0, build: spanning_corner },
    Entry {
        id: "V8",
        title: "rays that start exactly between two faces",
        parameter: 0.0,
        build: starts_on_seam,
    },
    Entry { id: "V9", title: "rays through the centre of the views", parameter: 0.0, build: through_center },
    Entry { id: "V10-3", title: "rays that pass the centre at 1e-3", parameter: 1e-3, build: past_center },
    Entry { id: "V10-6", title: "rays that pass the centre at 1e-6", parameter: 1e-6, build: past_center },
    Entry {
        id: "V10-24",
        title: "rays that pass the centre at 2^-24",
        parameter: 1.0 / 16_777_216.0,
        build: past_center,
    },
    Entry {
        id: "V10-120",
        title: "rays that pass the centre at 2^-120",
        parameter: f32::from_bits(7 << 23),
        build: past_center,
    },
];

fn closed(context: &Context, radius: f64, ray: impl Fn(&mut Stream, usize) -> Ray) -> Content {
    Content::new(sphere([0.0; 3], radius, 64), context.rays(ray), Expectation::All(Answer::Hit))
}

fn seams(context: &Context) -> Content {
    closed(context, 4.0, |random, index| {
        // The ray concerns one of 12 edges, given by the axis that runs along it and the signs of the other
        // two.
        let edge = index % 12;
        let free = edge % 3;
        let [u, v] = [(free + 1) % 3, (free + 2) % 3];
        let signs = [if edge / 3 % 2 == 0 { 1.0 } else { -1.0 }, if edge / 6 == 0 { 1.0 } else { -1.0 }];
        let on_seam = |size: f32, rest: f32| {
            let mut point = [0.0; 3];
            point[free] = rest;
            point[u] = signs[0] * size;
            point[v] = signs[1] * size;
            point
        };
        if index / 12 % 2 == 0 {
            let size = 1.0 + (index / 24 % 64) as f32 / 64.0;
            // Every fourth ray runs along the line where three faces touch.
            let rest = [0.0, size, random.between(-1.0, 1.0), random.between(-0.1, 0.1)][index / 24 % 4];
            return Ray::new([0.0; 3], on_seam(size, rest));
        }
        let origin = on_seam(random.between(-1.5, 1.5), random.between(-1.0, 1.0));
        Ray::new(origin, on_seam(random.between(0.1, 1.0) * random.sign(), random.between(-1.0, 1.0)))
    })
}

fn corners(context: &Context) -> Content {
    closed(context, 4.0, |random, index| {
        let scale = 10.0_f32.powi((index / 216 % 7) as i32 - 3);
        let (corner, variant) = (index % 8, index / 8 % 27);
        let point: [f32; 3] = std::array::from_fn(|axis| {
            // Each component is one unit in the last place lower, unchanged, or higher.
            let nudged = match variant / 3_usize.pow(axis as u32) % 3 {
                0 => scale.next_down(),
                1 => scale,
                _ => scale.next_up(),
            };
            if corner >> axis & 1 == 1 { nudged } else { -nudged }
        });
        if index / 8 % 2 == 0 { Ray::new([0.0; 3], point) } else { aim(random.near([0.0; 3], 0.5), point) }
    })
}

fn spanning_corner(context: &Context) -> Content {
    let triangle = [[3.0, 3.0, 2.9], [3.0, 2.9, 3.0], [2.9, 3.0, 3.0]];
    let rays = context
        .rays(|random, _| aim(random.near([1.0, 0.5, 1.5], 1.0), point_on(&triangle, random.weights(0.05))));
    Content::new(vec![triangle], rays, Expectation::All(Answer::HitAt { t: 1.0, tolerance: 1e-5 }))
}

fn starts_on_seam(context: &Context) -> Content {
    const TARGETS: [[f32; 3]; 4] = [[2.0, 0.0, -5.0], [-5.0, 0.0, 2.0], [5.0, 0.0, 5.0], [2.0, 3.0, 2.0]];
    let mut triangles = sphere([0.0; 3], 8.0, 32);
    triangles.extend(cube([0.0; 3], 1.0));
    let rays = context.rays(|random, index| {
        if let Some(target) = TARGETS.get(index) {
            return aim([2.0, 0.0, 2.0], *target);
        }
        let size = random.between(1.1, 4.0);
        let mut origin = [random.between(-size, size); 3];
        let free = index % 3;
        origin[(free + 1) % 3] = size * random.sign();
        origin[(free + 2) % 3] = size * random.sign();
        Ray::new(origin, random.direction())
    });
    Content::new(triangles, rays, Expectation::All(Answer::Hit))
}

fn through_center(context: &Context) -> Content {
    passing(context, 0.0)
}

fn past_center(context: &Context) -> Content {
    passing(context, context.parameter)
}

/// Makes rays towards the centre; the origin is moved aside by `distance` along x, y and z.
fn passing(context: &Context, distance: f32) -> Content {
    closed(context, 8.0, |random, index| {
        let origin = match index {
            0 => [-3.0, -1.0, -2.0],
            1..7 => {
                let mut origin = [0.0; 3];
                origin[(index - 1) % 3] = if index < 4 { -3.0 } else { 3.0 };
                origin
            }
            _ => {
                let mut origin = random.near([0.0; 3], 4.0);
                // If rounding would lose the distance in all three coordinates, one of them is set to zero.
                if distance > 0.0 && origin.map(|x: f32| x + distance) == origin {
                    origin[index % 3] = 0.0;
                }
                origin
            }
        };
        let direction = origin.map(|x: f32| -x);
        Ray::new(origin.map(|x| x + distance), direction)
    })
}
