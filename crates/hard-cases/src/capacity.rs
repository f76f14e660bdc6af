//! Empty and tiny scenes, scenes that overflow pools, and bad input.

use super::case::{AIMED, Answer, Content, Context, Entry, Expectation, Triangle};
use super::geometry::{aim, plate, point_on, sphere};
use super::random::Stream;
use rasray_reference::oracle::Ray;

pub(super) const CASES: &[Entry] = &[
    Entry { id: "C1", title: "no triangles", parameter: 0.0, build: empty },
    Entry { id: "C2", title: "one triangle", parameter: 0.0, build: single },
    Entry {
        id: "C3",
        title: "sphere of a hundred thousand triangles (ten million in full)",
        parameter: 0.0,
        build: fine_sphere,
    },
    Entry {
        id: "C3-random",
        title: "a hundred thousand tiny random triangles (ten million in full)",
        parameter: 0.0,
        build: dust,
    },
    Entry {
        id: "C4",
        title: "layers of random triangles, for pools of every capacity",
        parameter: 0.0,
        build: layers,
    },
    Entry {
        id: "C5",
        title: "45 triangles with NaN, infinity, 1e38, -0 or a subnormal among 1,000 good ones",
        parameter: 0.0,
        build: poisoned,
    },
    Entry {
        id: "C7",
        title: "coordinates of 1e18, and of 1e19 and 3e38, which must be dropped",
        parameter: 0.0,
        build: large_coordinates,
    },
    Entry {
        id: "C8",
        title: "rays with NaN, infinity, empty ranges, tiny and huge directions",
        parameter: 0.0,
        build: bad_rays,
    },
    Entry { id: "C9", title: "lists of 64 layers, for corrupting them", parameter: 64.0, build: long_lists },
];

/// Number of triangles of case C5 that loaders must drop: NaN, infinity and 1e38 at nine places each.
pub const POISONED_DROPPED: usize = 27;

fn empty(context: &Context) -> Content {
    let rays = context.rays(|random, _| Ray::new(random.near([0.0; 3], 1.0), random.direction()));
    Content::new(Vec::new(), rays, Expectation::All(Answer::Miss))
}

fn single(context: &Context) -> Content {
    let triangle = [[-1.0, -1.0, 4.0], [1.5, -0.5, 5.0], [0.0, 1.0, 6.0]];
    let rays = context.rays(|random, index| {
        let origin = random.near([0.0; 3], 1.0);
        if index % 2 == 0 {
            aim(origin, point_on(&triangle, random.weights(0.02)))
        } else {
            aim(origin, random.near([0.0, 0.0, 5.0], 2.0))
        }
    });
    Content::new(vec![triangle], rays, Expectation::Oracle)
}

/// Makes a random triangle: the `index`-th of a case is always the same.
fn scattered(id: &str, index: usize, size: f32) -> Triangle {
    let mut random = Stream::new(id, 0, index as u64);
    let center = [random.between(-3.0, 3.0), random.between(-3.0, 3.0), random.between(4.0, 8.0)];
    [(); 3].map(|()| random.near(center, size))
}

fn fine_sphere(context: &Context) -> Content {
    let triangles = sphere([0.0; 3], 2.0, if context.scale.full { 2236 } else { 224 });
    let rays = context.rays(|random, _| Ray::new(random.near([0.0; 3], 0.8), random.direction()));
    Content::new(triangles, rays, Expectation::All(Answer::Hit))
}

fn dust(context: &Context) -> Content {
    let count = if context.scale.full { 10_000_000 } else { 100_000 };
    let triangles = (0..count)
        .map(|index| {
            let mut random = Stream::new("C3-random", 0, index);
            let center = random.near([0.0; 3], 1.0);
            [(); 3].map(|()| random.near(center, 1e-3))
        })
        .collect();
    let rays = context.rays(|random, index| {
        let origin = if index % 2 == 0 { [0.0; 3] } else { random.near([0.0; 3], 1.0) };
        Ray::new(origin, random.direction())
    });
    Content::new(triangles, rays, Expectation::Oracle)
}

fn long_lists(context: &Context) -> Content {
    let z = |layer: usize| 2.0 + layer as f32 * 0.0625;
    let layers = context.parameter as usize;
    let triangles = (0..layers).flat_map(|layer| plate(z(layer), z(layer))).collect();
    let (rays, expect) = context.answered(|random, index| {
        // Rays start before each layer, so that lists are read to every depth.
        let layer = index % layers;
        let (x, y) = (random.between(-1.5, 1.5), random.between(-1.5, 1.5));
        let answer = if (x - y).abs() < 1e-3 {
            AIMED
        } else {
            Answer::HitOn { primitive: 2 * layer as u32 + u32::from(y > x), t: 1.0, tolerance: 1e-4 }
        };
        let start = z(layer) - 0.03125;
        (
            aim([x + random.between(-0.01, 0.01), y + random.between(-0.01, 0.01), start], [x, y, z(layer)]),
            answer,
        )
    });
    Content::new(triangles, rays, expect)
}

fn layers(context: &Context) -> Content {
    let mut triangles: Vec<Triangle> = (0..300).map(|index| scattered("C4", index, 0.8)).collect();
    triangles.extend(plate(9.0, 9.0));
    let rays = context.rays(|random, _| {
        aim(random.near([0.0; 3], 0.5), [random.between(-8.0, 8.0), random.between(-8.0, 8.0), 9.0])
    });
    Content::new(triangles, rays, Expectation::All(Answer::Hit))
}

fn poisoned(context: &Context) -> Content {
    let mut triangles: Vec<Triangle> = (0..1000).map(|index| scattered("C5", index, 0.3)).collect();
    for variant in 0..45 {
        let place = variant % 9;
        let bad = match variant / 9 {
            0 => f32::NAN,
            1 if place % 2 == 0 => f32::INFINITY,
            1 => f32::NEG_INFINITY,
            2 => 1e38,
            3 => -0.0,
            _ => 1e-40,
        };
        let mut triangle = scattered("C5", 1000 + variant, 0.3);
        triangle[place / 3][place % 3] = bad;
        // The poisoned triangles are spread among the good ones.
        triangles.insert(variant * 23, triangle);
    }
    let good: Vec<Triangle> = triangles
        .iter()
        .filter(|triangle| triangle.iter().flatten().all(|x| x.abs() < 1e18))
        .copied()
        .collect();
    let rays = context.rays(|random, index| {
        let target = good[random.below(good.len())];
        let origin = if index % 2 == 0 { [0.0; 3] } else { random.near([0.0; 3], 1.0) };
        aim(origin, point_on(&target, random.weights(0.0)))
    });
    Content::new(triangles, rays, Expectation::Oracle)
}

fn large_coordinates(context: &Context) -> Content {
    let triangle = |size: f32| [[-size, -size, size], [size, -size, size], [0.0, size, size]];
    let triangles = vec![triangle(1e19), triangle(3e38), triangle(1e18), triangle(1.0)];
    let rays = context.rays(|random, index| {
        let near = aim(random.near([0.0; 3], 0.5), point_on(&triangles[3], random.weights(0.02)));
        match index % 3 {
            0 => near,
            1 => Ray { t_min: 2.0, ..near },
            _ => Ray::new(random.near([0.0; 3], 0.5), random.direction()),
        }
    });
    Content::new(triangles, rays, Expectation::Oracle)
}

fn bad_rays(context: &Context) -> Content {
    let (rays, expect) = context.answered(|random, index| {
        let good = Ray::new(random.near([0.0; 3], 0.5), random.direction());
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY][index / 12 % 3];
        let axis = index / 36 % 3;
        let mut ray = good;
        let answer = match index % 12 {
            0 => {
                ray.origin[axis] = bad;
                Answer::Miss
            }
            1 => {
                ray.direction[axis] = bad;
                Answer::Miss
            }
            2 => {
                ray.t_min = f32::NAN;
                Answer::Miss
            }
            3 => {
                ray.t_max = f32::NAN;
                Answer::Miss
            }
            4 => {
                (ray.t_min, ray.t_max) = (5.0, 1.0);
                Answer::Miss
            }
            5 => {
                ray.t_max = 0.0;
                Answer::Miss
            }
            6 => {
                ray.direction = [0.0, -0.0, 0.0];
                Answer::Miss
            }
            7 => {
                ray.direction = ray.direction.map(|x| x * 1e-30);
                Answer::Anything { t: [0.0, 1e31] }
            }
            8 => {
                ray.direction = ray.direction.map(|x| x * 1e30);
                Answer::Anything { t: [0.0, 1e-29] }
            }
            9 => {
                ray.t_min = f32::INFINITY;
                Answer::Miss
            }
            _ => Answer::Hit,
        };
        (ray, answer)
    });
    Content::new(sphere([0.0; 3], 2.0, 16), rays, expect)
}
