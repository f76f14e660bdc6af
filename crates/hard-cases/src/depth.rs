//! Depth ranges, layers that lie close together or coincide, and shells.

use super::case::{AIMED, Answer, Content, Context, Entry, Expectation, Triangle};
use super::geometry::{aim, cube, cuboid, plate, sphere};
use rasray_reference::oracle::Ray;

pub(super) const CASES: &[Entry] = &[
    Entry {
        id: "Z1",
        title: "40 quads over eleven orders of depth, rays away from the eye",
        parameter: 1.0,
        build: depth_range,
    },
    Entry { id: "Z15", title: "Z1 with rays towards the eye", parameter: -1.0, build: depth_range },
    Entry { id: "Z2-4", title: "sphere at 1e4, eye in its middle", parameter: 1e4, build: offset_sphere },
    Entry { id: "Z2-5", title: "sphere at 1e5, eye in its middle", parameter: 1e5, build: offset_sphere },
    Entry { id: "Z2-6", title: "sphere at 1e6, eye in its middle", parameter: 1e6, build: offset_sphere },
    Entry { id: "Z3-3", title: "plates 0.01 apart in a room of 1e3", parameter: 1e3, build: stadium },
    Entry { id: "Z3-4", title: "plates 0.01 apart in a room of 1e4", parameter: 1e4, build: stadium },
    Entry { id: "Z3-5", title: "plates 0.01 apart in a room of 1e5", parameter: 1e5, build: stadium },
    Entry {
        id: "Z5",
        title: "quads one unit in the last place apart",
        parameter: 0.0,
        build: nearly_coplanar,
    },
    Entry {
        id: "Z8",
        title: "a single depth: least and greatest coincide",
        parameter: 0.0,
        build: single_depth,
    },
    Entry {
        id: "Z9",
        title: "fragments exactly at the greatest depth",
        parameter: 0.0,
        build: greatest_depth,
    },
    Entry { id: "Z11-0", title: "thin shell, thickness 1", parameter: 1.0, build: thin_shell },
    Entry { id: "Z11-1", title: "thin shell, thickness 1e-1", parameter: 1e-1, build: thin_shell },
    Entry { id: "Z11-2", title: "thin shell, thickness 1e-2", parameter: 1e-2, build: thin_shell },
    Entry { id: "Z11-3", title: "thin shell, thickness 1e-3", parameter: 1e-3, build: thin_shell },
    Entry { id: "Z11-4", title: "thin shell, thickness 1e-4", parameter: 1e-4, build: thin_shell },
    Entry { id: "Z11-5", title: "thin shell, thickness 1e-5", parameter: 1e-5, build: thin_shell },
    Entry { id: "Z11-6", title: "thin shell, thickness 1e-6", parameter: 1e-6, build: thin_shell },
    Entry {
        id: "Z11-7",
        title: "thin shell, thickness 1e-7: both sides coincide",
        parameter: 1e-7,
        build: thin_shell,
    },
    Entry { id: "Z12", title: "rays that pass behind a pole", parameter: 0.0, build: behind_pole },
    Entry {
        id: "Z13",
        title: "pairs 0.002 apart at depths where half precision cannot hold them apart",
        parameter: 0.0,
        build: half_spacing,
    },
];

fn depth_range(context: &Context) -> Content {
    let z = |k: usize| (1e-3 * 1e8_f64.powf(k as f64 / 39.0)) as f32;
    let triangles = (0..40).flat_map(|k| plate(z(k), z(k))).collect();
    let away = context.parameter > 0.0;
    let (rays, expect) = context.answered(|random, index| {
        // Rays run from between two quads to the one behind or before.
        let k = index % 39;
        let (front, back) = (z(k), z(k + 1));
        let goal = if away { back } else { front };
        let start = front + (back - front) * random.between(0.3, 0.7);
        let within = |random: &mut super::Stream, size: f32| {
            [random.between(-size, size), random.between(-size, size)]
        };
        let ([x, y], [u, v]) = (within(random, 0.5 * front), within(random, 0.9 * goal));
        (aim([x, y, start], [u, v, goal]), AIMED)
    });
    Content::new(triangles, rays, expect)
}

fn offset_sphere(context: &Context) -> Content {
    let center = [context.parameter / 3.0_f32.sqrt(); 3];
    let triangles = sphere(center, 2.0, 100);
    let rays = context.rays(|random, index| {
        let origin = if index % 2 == 0 { center } else { random.near(center, 0.8) };
        let corner = triangles[random.below(triangles.len())][random.below(3)];
        if index % 4 < 2 { aim(origin, corner) } else { Ray::new(origin, random.direction()) }
    });
    Content::new(triangles, rays, Expectation::All(Answer::Hit)).seen_from(center)
}

fn stadium(context: &Context) -> Content {
    let mut triangles = cube([0.0; 3], context.parameter);
    let depth = |k: usize| 2.0 + 0.01 * k as f32;
    triangles.extend((0..10).flat_map(|k| plate(depth(k), 0.5)));
    let rays = context.rays(|random, index| match index % 3 {
        0 => aim(random.near([0.0; 3], 1.0), random.near([0.0, 0.0, 2.05], 0.4)),
        1 => {
            let gap = depth(random.below(9)) + 0.005;
            Ray::new([random.between(-0.4, 0.4), random.between(-0.4, 0.4), gap], random.direction())
        }
        _ => Ray::new(random.near([0.0; 3], 0.5 * context.parameter), random.direction()),
    });
    Content::new(triangles, rays, Expectation::All(Answer::Hit))
}

fn nearly_coplanar(context: &Context) -> Content {
    let front = 5.0_f32;
    let back = front.next_up();
    let triangles = plate(back, 3.0).into_iter().chain(plate(front, 3.0)).collect();
    let (rays, expect) = context.answered(|random, index| {
        // Targets are off the diagonal, where one triangle of a quad is clearly meant; rays run straight
        // ahead, so that t is a difference of depths.
        let (x, y) = (random.between(-2.9, 2.9), random.between(-2.9, 2.9));
        let below_diagonal = y < x;
        let (first, t, start, direction) =
            if index % 2 == 0 { (2, front, 0.0, 1.0) } else { (0, 10.0 - back, 10.0, -1.0) };
        let ray = Ray::new([x, y, start], [0.0, 0.0, direction]);
        if (x - y).abs() < 1e-3 {
            return (ray, Answer::Hit);
        }
        // The unit in the last place at 5 is larger than half of the one at t.
        let primitive = if below_diagonal { first } else { first + 1 };
        (ray, Answer::HitOn { primitive, t, tolerance: 2.0_f32.powi(-23) })
    });
    Content::new(triangles, rays, expect)
}

fn single_depth(context: &Context) -> Content {
    let rays = context.rays(|random, index| {
        let target = [random.between(-4.9, 4.9), random.between(-4.9, 4.9), 5.0];
        aim(if index % 2 == 0 { [0.0; 3] } else { random.near([0.0; 3], 2.0) }, target)
    });
    Content::new(plate(5.0, 5.0).to_vec(), rays, Expectation::All(AIMED))
}

fn greatest_depth(context: &Context) -> Content {
    let mut triangles: Vec<Triangle> = plate(1.0, 0.3).to_vec();
    triangles.extend(plate(9.0, 9.0));
    let rays = context.rays(|random, index| {
        let origin = match index % 3 {
            // Rays start past the front quad, or behind it.
            0 => [0.0; 3],
            1 => [random.between(-1.0, 1.0), random.between(-1.0, 1.0), 5.0],
            _ => [random.between(-0.25, 0.25), random.between(-0.25, 0.25), 1.5],
        };
        let reach = if index % 3 == 0 { 3.0 } else { 0.0 };
        let x = random.sign() * random.between(reach, 8.9);
        aim(origin, [x, random.between(-8.9, 8.9), 9.0])
    });
    Content::new(triangles, rays, Expectation::All(AIMED))
}

fn thin_shell(context: &Context) -> Content {
    let front = 5.0_f32;
    let back = front + context.parameter;
    let middle = front + 0.5 * context.parameter;
    let triangles = plate(front, 3.0).into_iter().chain(plate(back, 3.0)).collect();
    let open = front < middle && middle < back;
    let (rays, expect) = context.answered(|random, index| {
        let place =
            |random: &mut super::Stream, z: f32| [random.between(-2.9, 2.9), random.between(-2.9, 2.9), z];
        let (from, to) = match index % 4 {
            0 => (place(random, 4.0), place(random, front)),
            1 => (place(random, back + 1.0), place(random, back)),
            2 if open => (place(random, middle), place(random, if index % 8 == 2 { front } else { back })),
            3 if open => {
                let y = random.between(-2.9, 2.9);
                return (aim([-2.9, y, middle], [2.9, y, middle]), Answer::Miss);
            }
            _ => (place(random, 0.0), place(random, front)),
        };
        (aim(from, to), Answer::Oracle)
    });
    Content::new(triangles, rays, expect)
}

fn behind_pole(context: &Context) -> Content {
    let pole = cuboid([-0.01, -1.0, 1.99], [0.01, 1.0, 2.01]);
    let rays = context.rays(|random, index| {
        let (y, z) = (random.between(-0.9, 0.9), 2.0 + 0.02 * (1 + index % 50) as f32);
        aim([-1.0, y, z], [1.0, y, z])
    });
    Content::new(pole, rays, Expectation::All(Answer::Miss))
}

fn half_spacing(context: &Context) -> Content {
    const DEPTHS: [f32; 4] = [1.0, 8.0, 64.0, 512.0];
    let triangles = DEPTHS.iter().flat_map(|z| [plate(*z, *z), plate(z + 0.002, *z)]).flatten().collect();
    let (rays, expect) = context.answered(|random, index| {
        let z = DEPTHS[index % 4];
        let place = |random: &mut super::Stream, z: f32| {
            [random.between(-0.4, 0.4) * z, random.between(-0.4, 0.4) * z, z]
        };
        let (start, goal) = match index / 4 % 4 {
            0 => (0.6 * z, z),
            1 => (1.4 * z, z + 0.002),
            2 => (z + 0.001, z),
            _ => (z + 0.001, z + 0.002),
        };
        let from = place(random, start);
        let mut to = place(random, goal);
        // Rays start between the pair, and are not too flat.
        if index / 4 % 4 >= 2 {
            to = [from[0] + random.between(-0.01, 0.01), from[1] + random.between(-0.01, 0.01), goal];
        }
        (aim(from, to), Answer::Oracle)
    });
    Content::new(triangles, rays, expect)
}
