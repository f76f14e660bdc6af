//! Many layers, equal layers, and the order in which layers must be found.

use super::case::{AIMED, Answer, Content, Context, Entry, Expectation, Triangle};
use super::geometry::{aim, plate};
use rasray_reference::oracle::Ray;

pub(super) const CASES: &[Entry] = &[
    Entry {
        id: "Z4",
        title: "the same quad twice: the lower id, whatever the list order",
        parameter: 2.0,
        build: coincident,
    },
    Entry {
        id: "Z14",
        title: "three fragments at one depth: the lowest id",
        parameter: 3.0,
        build: coincident,
    },
    Entry {
        id: "C10",
        title: "64 copies of a mesh in one place: the lowest id",
        parameter: 64.0,
        build: coincident,
    },
    Entry {
        id: "Z6",
        title: "a thousand layers (ten thousand in full) in every pixel",
        parameter: 1.0,
        build: deep,
    },
    Entry {
        id: "Z6-pixel",
        title: "a thousand layers (ten thousand in full) in one pixel",
        parameter: 1e-3,
        build: deep,
    },
    Entry {
        id: "Z7",
        title: "a thousand layers in one bucket and one far away",
        parameter: 0.0,
        build: one_bucket,
    },
    Entry {
        id: "Z10",
        title: "a nearer hit in a later bucket than the first hit found",
        parameter: 0.0,
        build: early_break,
    },
];

fn coincident(context: &Context) -> Content {
    let copies = context.parameter as usize;
    let triangles = (0..copies).flat_map(|_| plate(5.0, 5.0)).collect();
    let (rays, expect) = context.answered(|random, _| {
        // Targets are off the diagonal, where two ids of one copy touch.
        let (x, y) = (random.between(-4.9, 4.9), random.between(-4.9, 4.9));
        let answer = if (x - y).abs() < 1e-3 {
            AIMED
        } else {
            Answer::HitOn { primitive: u32::from(y > x), t: 1.0, tolerance: 1e-5 }
        };
        (aim(random.near([0.0; 3], 2.0), [x, y, 5.0]), answer)
    });
    Content::new(triangles, rays, expect)
}

fn deep(context: &Context) -> Content {
    let layers = if context.scale.full { 10_000 } else { 1000 };
    let z = |k: usize| 1.0 + k as f32 * 1e-3;
    let half = |k: usize| z(k) * context.parameter;
    let triangles = (0..layers).flat_map(|k| plate(z(k), half(k))).collect();
    let (rays, expect) = context.answered(|random, index| {
        // Rays hit every layer in a scattered order, each from just before and from just behind.
        let k = index / 2 * 617 % layers;
        let side = if index % 2 == 0 { -0.4e-3 } else { 0.4e-3 };
        let reach = 0.9 * context.parameter;
        let (x, y) = (random.between(-reach, reach), random.between(-reach, reach));
        let lean = 1e-4 * context.parameter;
        let origin = [x + random.between(-lean, lean), y + random.between(-lean, lean), z(k) + side];
        let first = 2 * k as u32;
        let answer = if (x - y).abs() < 1e-3 * reach {
            Answer::Oracle
        } else {
            Answer::HitOn { primitive: first + u32::from(y > x), t: 1.0, tolerance: 5e-3 }
        };
        (aim(origin, [x, y, z(k)]), answer)
    });
    Content::new(triangles, rays, expect)
}

fn one_bucket(context: &Context) -> Content {
    let z = |k: usize| 1.0 + 1e-3 * k as f32 / 999.0;
    let mut triangles: Vec<Triangle> = (0..1000).flat_map(|k| plate(z(k), 1.2)).collect();
    triangles.extend(plate(1000.0, 1000.0));
    let rays = context.rays(|random, index| {
        let (x, y) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        match index % 3 {
            0 => aim([0.5 * x, 0.5 * y, 0.5], [x, y, 1.0]),
            1 => Ray::new([x, y, 0.5 * (z(index % 999) + z(index % 999 + 1))], [0.0, 0.0, random.sign()]),
            _ => aim([x, y, 1.5], [900.0 * x, 900.0 * y, 1000.0]),
        }
    });
    Content::new(triangles, rays, Expectation::Oracle)
}

fn early_break(context: &Context) -> Content {
    let spanning = [[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [0.0, 5.0 / 11.0, 9.0]];
    let nearer = [[-1.0, -1.0, 4.0], [1.0, -1.0, 4.0], [0.0, 1.0, 4.0]];
    let (rays, expect) = context.answered(|random, index| {
        let aside = if index == 0 { 0.0 } else { 0.05 };
        let [x, y] = [random.between(-aside, aside), random.between(-aside, aside)];
        let answer = Answer::HitOn { primitive: 1, t: 3.5, tolerance: 1e-6 };
        (Ray::new([x, y, 0.5], [0.0, 0.0, 1.0]), answer)
    });
    Content::new(vec![spanning, nearer], rays, expect)
}
