//! Objects that stand, lie and hang in the room.

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::super::forms::{about_y, along, arc, curve, standing, turn};
use super::super::shape::Icosphere;
use super::super::solid::{RoundCone, smooth_max, smooth_min, surface};
use super::super::spheres::Random;
use super::{Kit, LANTERN, Of, ROOM, at};

/// Seed of the litter on the floor.
const SEED: u64 = 0x5EED_0007;

pub(super) fn add(kit: &mut Kit) {
    anvil(kit, standing(at(-0.55, 0.0, -0.35), 0.06));
    for (x, z, size) in [(2.95, -1.95, 1.0), (2.3, -2.1, 0.92), (2.98, -1.2, 0.8)] {
        barrel(kit, at(x, 0.0, z), size);
    }
    barrel(kit, at(-1.3, 0.0, 0.25), 0.62);
    bench(kit);
    tools(kit);
    crates(kit);
    wheel(kit, at(-3.24, 0.53, -0.45));
    chain(kit);
    lantern(kit, LANTERN);
    litter(kit);
}

/// Adds an anvil of iron on a stump: blocks with rounded edges and a horn, melted together.
fn anvil(kit: &mut Kit, place: DAffine3) {
    let block = |point: DVec3, middle: DVec3, half: DVec3| {
        let beyond = (point - middle).abs() - half + 0.012;
        beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0) - 0.012
    };
    let horn = RoundCone { ends: [(at(0.2, 0.252, 0.0), 0.058), (at(0.47, 0.288, 0.0), 0.012)] };
    let distance = |point: DVec3| {
        let top = block(point, at(-0.03, 0.265, 0.0), at(0.25, 0.055, 0.065));
        let waist = block(point, at(0.0, 0.13, 0.0), at(0.085, 0.13, 0.045));
        let foot = block(point, at(0.0, 0.035, 0.0), at(0.18, 0.035, 0.105));
        let body = smooth_min(smooth_min(top, waist, 0.09), foot, 0.08);
        let whole = smooth_min(body, horn.distance(point), 0.03);
        // The hole for tools in the face of the anvil.
        smooth_max(whole, -block(point, at(-0.21, 0.3, 0.0), at(0.016, 0.06, 0.016)), 0.006)
    };
    let mut net = surface(&distance, at(-0.33, -0.04, -0.15), at(0.52, 0.36, 0.15), 0.009);
    let stand = place * DAffine3::from_translation(DVec3::Y * 0.521);
    for (position, normal) in net.positions.iter_mut().zip(&mut net.normals) {
        *position = stand.transform_point3(*position);
        *normal = stand.matrix3 * *normal;
    }
    kit.of(Of::Iron).solid(net, 1.0);
    let stump = [(0.0, 0.0), (0.27, 0.0), (0.25, 0.06), (0.235, 0.3), (0.24, 0.5), (0.23, 0.52), (0.0, 0.52)];
    kit.of(Of::Timber).revolve(place, 36, &stump.map(DVec2::from), DVec2::new(1.0, 2.0));
    let band = [(0.236, 0.4), (0.245, 0.4), (0.245, 0.44), (0.236, 0.44), (0.236, 0.4)];
    kit.of(Of::Iron).revolve(place, 36, &band.map(DVec2::from), DVec2::ONE);
    hammer(kit, place * DAffine3::from_mat3_translation(lying(0.13), at(-0.05, 0.873, 0.01)), 0.3);
}

/// Makes a rotation that lays the y axis of a form level, towards a share of a turn from +x.
fn lying(share: f64) -> DMat3 {
    let (sin, cos) = turn(share);
    let y = at(cos, 0.0, sin);
    DMat3::from_cols(DVec3::Y, y, DVec3::Y.cross(y))
}

/// Adds a hammer around the centre of its head; the handle runs along +y.
fn hammer(kit: &mut Kit, place: DAffine3, length: f64) {
    kit.of(Of::Steel).block_with_bevel(place, at(0.028, 0.026, 0.062), 0.008, 1.0);
    let handle: Vec<DVec3> = (0..=6)
        .map(|step| place.transform_point3(at(0.0, -0.035 + (length + 0.035) * f64::from(step) / 6.0, 0.0)))
        .collect();
    kit.of(Of::Timber).tube(&handle, 12, |share| 0.0115 + 0.005 * turn(0.5 * share).0, DVec2::ONE);
}

/// Adds a barrel of twenty staves with hoops of iron, full to a hand below the rim.
fn barrel(kit: &mut Kit, foot: DVec3, size: f64) {
    let place =
        DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(size)), foot + DVec3::Y * 0.001);
    let belly = |y: f64| 0.27 + 0.06 * (1.0 - (y / 0.45 - 1.0) * (y / 0.45 - 1.0));
    let outside = (0..=12).map(|step| 0.9 * f64::from(step) / 12.0).map(|y| DVec2::new(belly(y), y));
    for stave in 0..20 {
        let middle = f64::from(stave) / 20.0;
        let edge = 0.0237;
        let column: Vec<DVec2> = outside.clone().collect();
        let point = |turned: f64, height: f64, inset: f64| {
            let exact = height * 12.0;
            let low = (exact as usize).min(11);
            let share = exact - low as f64;
            let at_height = column[low].lerp(column[low + 1], share);
            let (sin, cos) = turn(turned);
            let reach = at_height.x - inset;
            place.transform_point3(DVec3::new(reach * cos, at_height.y, -reach * sin))
        };
        let across = |u: f64| middle + edge * (2.0 * u - 1.0);
        let round = |u: f64| 0.004 * (2.0 * u - 1.0) * (2.0 * u - 1.0);
        kit.of(Of::Timber).between(
            4,
            12,
            DVec2::new(0.1, 1.0),
            |u, v| point(across(u), v, round(u)),
            |u, v| point(across(u), v, 0.03),
        );
    }
    for y in [0.05, 0.22, 0.68, 0.85] {
        let reach = belly(y) - 0.002;
        let hoop = [
            (reach, y - 0.022),
            (reach + 0.007, y - 0.022),
            (reach + 0.007, y + 0.022),
            (reach, y + 0.022),
            (reach, y - 0.022),
        ];
        kit.of(Of::Iron).revolve(place, 60, &hoop.map(DVec2::from), DVec2::ONE);
    }
    let inside = [(0.0, 0.02), (0.255, 0.02), (0.27, 0.8), (0.0, 0.8)];
    kit.of(Of::Water).revolve(place, 40, &inside.map(DVec2::from), DVec2::ONE);
}

/// Adds the bench below the window with a vice, jars, a pan and bars of iron.
fn bench(kit: &mut Kit) {
    for plank in 0..4 {
        let place = standing(at(0.95, 0.86, -2.38 + 0.165 * f64::from(plank)), 0.0);
        kit.of(Of::Timber).block_with_bevel(place, at(0.95, 0.03, 0.08), 0.006, 0.8);
    }
    for (x, z) in [(0.1, -2.36), (1.8, -2.36), (0.1, -1.93), (1.8, -1.93)] {
        kit.of(Of::Timber).block_with_bevel(
            standing(at(x, 0.415, z), 0.0),
            at(0.05, 0.415, 0.05),
            0.008,
            0.8,
        );
    }
    kit.of(Of::Timber).block_with_bevel(standing(at(0.95, 0.2, -2.15), 0.0), at(0.9, 0.02, 0.25), 0.006, 0.8);
    let jar = [
        (0.0, 0.0),
        (0.07, 0.0),
        (0.1, 0.06),
        (0.105, 0.13),
        (0.07, 0.2),
        (0.06, 0.22),
        (0.075, 0.245),
        (0.066, 0.246),
        (0.05, 0.22),
        (0.06, 0.195),
        (0.095, 0.13),
        (0.09, 0.06),
        (0.06, 0.012),
        (0.0, 0.012),
    ];
    let jar = curve(&jar.map(DVec2::from), 4);
    let jar: Vec<DVec2> = jar.iter().map(|point| DVec2::new(point.x.max(0.0), point.y)).collect();
    for (x, z, size) in [(0.2, -2.34, 1.0), (0.42, -2.38, 0.75), (1.72, -2.3, 1.15), (0.35, -2.2, 0.5)] {
        let place =
            DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(size)), at(x, 0.891, z));
        kit.of(Of::Clay).revolve(place, 40, &jar, DVec2::ONE);
    }
    for (x, z) in [(0.3, -2.2), (0.7, -2.1), (1.5, -2.15)] {
        let place =
            DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(1.25)), at(x, 0.222, z));
        kit.of(Of::Copper).revolve(place, 40, &jar, DVec2::ONE);
    }
    let iron = kit.of(Of::Iron);
    iron.block_with_bevel(standing(at(1.25, 0.93, -1.9), 0.0), at(0.07, 0.04, 0.05), 0.008, 1.0);
    iron.block_with_bevel(standing(at(1.25, 1.0, -1.93), 0.0), at(0.075, 0.05, 0.02), 0.008, 1.0);
    iron.block_with_bevel(standing(at(1.25, 1.0, -1.86), 0.0), at(0.075, 0.05, 0.02), 0.008, 1.0);
    iron.tube(&[at(1.25, 0.95, -1.95), at(1.25, 0.95, -1.7)], 16, |_| 0.014, DVec2::ONE);
    iron.tube(&[at(1.15, 0.95, -1.715), at(1.35, 0.95, -1.715)], 12, |_| 0.007, DVec2::ONE);
    for bar in 0..7 {
        let shift = 0.024 * f64::from(bar);
        let (from, to) = (at(0.55, 0.905, -2.33 + shift), at(1.1, 0.905, -2.28 + 1.1 * shift));
        iron.tube(&[from, to], 8, |_| 0.009, DVec2::ONE);
    }
}

/// Adds a rack with hammers and tongs beside the window, horseshoes above the bellows, blades on the right
/// wall.
fn tools(kit: &mut Kit) {
    let back = -ROOM.1 + 0.1;
    kit.of(Of::Timber).block_with_bevel(
        standing(at(-0.25, 1.95, back), 0.0),
        at(0.8, 0.05, 0.025),
        0.008,
        0.8,
    );
    for tool in 0..9 {
        let x = -0.95 + 0.175 * f64::from(tool);
        kit.of(Of::Iron).tube(&[at(x, 1.95, back), at(x, 1.965, back + 0.1)], 8, |_| 0.007, DVec2::ONE);
        if tool % 2 == 0 {
            let hanging = DMat3::from_cols(DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z) * about_y(0.25);
            hammer(
                kit,
                DAffine3::from_mat3_translation(hanging, at(x, 1.935, back + 0.06)),
                0.34 + 0.02 * f64::from(tool % 5),
            );
        } else {
            for side in [-1.0, 1.0] {
                let jaw = [(0.012, 0.06), (0.03, 0.02), (0.0, -0.05), (-0.025, -0.2), (-0.03, -0.55)];
                let jaw = jaw.map(|(out, down)| at(x + side * out, 1.93 + down, back + 0.06 + 0.008 * side));
                kit.of(Of::Iron).tube(&curve(&jaw, 6), 10, |share| 0.011 - 0.003 * share, DVec2::ONE);
            }
        }
    }
    for shoe in 0..10 {
        let (x, y) = (-1.75 + 0.19 * f64::from(shoe % 5), 2.35 + 0.24 * f64::from(shoe / 5));
        let bow: Vec<DVec3> = arc(DVec2::ZERO, 0.062, 0.78, 1.72, 24)
            .iter()
            .map(|point| at(x + point.x, y + 1.25 * point.y, back + 0.03))
            .collect();
        kit.of(Of::Iron).tube(&bow, 8, |_| 0.0115, DVec2::ONE);
    }
    let right = ROOM.0 - 0.14;
    for y in [1.35, 1.8] {
        kit.of(Of::Timber).block_with_bevel(
            standing(at(right, y, -0.6), 0.0),
            at(0.03, 0.035, 0.75),
            0.008,
            0.8,
        );
    }
    for blade in 0..6 {
        let z = -1.2 + 0.24 * f64::from(blade);
        let long = 0.75 + 0.05 * f64::from(blade % 3);
        let place = standing(at(right - 0.06, 1.4 + 0.3 * (long - 0.75), z), 0.0);
        kit.of(Of::Steel).block_with_bevel(place, at(0.004, 0.5 * long, 0.026), 0.0035, 1.0);
        let hilt = place * DAffine3::from_translation(DVec3::Y * (0.5 * long));
        kit.of(Of::Copper).block_with_bevel(hilt, at(0.012, 0.012, 0.085), 0.005, 1.0);
        let grip = [0.0, 0.15].map(|y| hilt.transform_point3(DVec3::Y * y));
        kit.of(Of::Leather).tube(&grip, 12, |_| 0.015, DVec2::ONE);
    }
}

/// Adds crates of slats in the right corner behind the blades.
fn crates(kit: &mut Kit) {
    for (middle, half, share) in [
        (at(2.85, 0.0, -0.35), 0.32, 0.02),
        (at(2.9, 0.645, -0.33), 0.24, -0.04),
        (at(2.05, 0.0, -1.35), 0.26, 0.09),
    ] {
        let place = standing(middle + DVec3::Y * (half + 0.002), share);
        let timber = kit.of(Of::Timber);
        for side in [-1.0, 1.0] {
            for slat in 0..4 {
                let along = (f64::from(slat) - 1.5) * 0.5 * half;
                let long = DVec3::new(half, 0.24 * half, 0.012);
                timber.block_with_bevel(
                    place * DAffine3::from_translation(at(0.0, along, side * half)),
                    long,
                    0.004,
                    0.8,
                );
                let turned =
                    place * DAffine3::from_mat3_translation(about_y(0.25), at(side * half, along, 0.0));
                timber.block_with_bevel(turned, long, 0.004, 0.8);
                let lid = DVec3::new(half, 0.012, 0.24 * half);
                timber.block_with_bevel(
                    place * DAffine3::from_translation(at(0.0, side * (half - 0.014), along)),
                    lid,
                    0.004,
                    0.8,
                );
            }
            for edge in [-1.0, 1.0] {
                let post =
                    place * DAffine3::from_translation(at(side * (half + 0.014), 0.0, edge * (half - 0.03)));
                timber.block_with_bevel(post, at(0.01, half, 0.035), 0.004, 0.8);
            }
        }
    }
}

/// Adds a cart wheel that leans against the left wall.
fn wheel(kit: &mut Kit, middle: DVec3) {
    let axis = at(1.0, 0.2, 0.05);
    let place = along(axis, middle);
    let rim = [(0.43, -0.035), (0.5, -0.035), (0.5, 0.035), (0.43, 0.035), (0.43, -0.035)];
    kit.of(Of::Timber).revolve(place, 56, &rim.map(DVec2::from), DVec2::ONE);
    let tyre = [(0.501, -0.032), (0.512, -0.032), (0.512, 0.032), (0.501, 0.032), (0.501, -0.032)];
    kit.of(Of::Iron).revolve(place, 56, &tyre.map(DVec2::from), DVec2::ONE);
    let hub = [(0.0, -0.11), (0.05, -0.11), (0.085, -0.05), (0.085, 0.05), (0.05, 0.11), (0.0, 0.11)];
    kit.of(Of::Timber).revolve(place, 32, &hub.map(DVec2::from), DVec2::ONE);
    for spoke in 0..12 {
        let (sin, cos) = turn(f64::from(spoke) / 12.0);
        let ends = [0.06, 0.25, 0.45].map(|reach| place.transform_point3(at(reach * cos, 0.0, reach * sin)));
        kit.of(Of::Timber).tube(&ends, 10, |share| 0.02 - 0.004 * turn(0.5 * share).0, DVec2::ONE);
    }
}

/// Adds a chain with a hook that hangs from a beam.
fn chain(kit: &mut Kit) {
    let mut ring: Vec<DVec2> = arc(DVec2::new(0.022, 0.0), 0.006, 0.0, 1.0, 10);
    ring[10] = ring[0];
    for link in 0..26 {
        let middle = at(0.0, 2.86 - 0.05 * f64::from(link), -0.35);
        // Links are longer than wide, and every other one lies across.
        let up = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y * 1.6);
        let place = DAffine3::from_mat3_translation(about_y(0.25 * f64::from(link % 2)) * up, middle);
        kit.of(Of::Iron).revolve(place, 24, &ring, DVec2::ONE);
    }
    let hook = [(0.0, 0.0), (0.0, -0.06), (0.04, -0.12), (0.1, -0.1), (0.11, -0.03)];
    let hook = hook.map(|(x, y)| at(x - 0.03, 1.58 + y, -0.35));
    kit.of(Of::Iron).tube(&curve(&hook, 8), 12, |share| 0.012 * (1.0 - 0.6 * share * share), DVec2::ONE);
}

/// Adds a lantern on a rod from a beam.
fn lantern(kit: &mut Kit, middle: DVec3) {
    kit.of(Of::Flame).sphere(&Icosphere::new(2), middle, 0.035, false);
    let iron = kit.of(Of::Iron);
    for y in [-0.11, 0.12] {
        iron.block_with_bevel(standing(middle + DVec3::Y * y, 0.0), at(0.085, 0.012, 0.085), 0.006, 1.0);
    }
    for (x, z) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
        let post = [-0.11, 0.12].map(|y| middle + at(0.075 * x, y, 0.075 * z));
        iron.tube(&post, 8, |_| 0.006, DVec2::ONE);
    }
    iron.tube(&[middle + DVec3::Y * 0.12, middle + DVec3::Y * 0.9], 8, |_| 0.006, DVec2::ONE);
}

/// Adds logs, scraps and nails on the floor.
fn litter(kit: &mut Kit) {
    let mut random = Random::new(SEED);
    for log in 0..14 {
        let (row, height) = match log {
            0..5 => (f64::from(log), 0.0),
            5..9 => (f64::from(log) - 4.5, 1.0),
            9..12 => (f64::from(log) - 8.0, 2.0),
            _ => (f64::from(log) - 10.5, 3.0),
        };
        let middle = at(-1.72 + 0.145 * row, 0.075 + 0.124 * height, -1.0 + 0.02 * random.signed());
        let ends = [-0.24, 0.24].map(|z| middle + at(0.0, 0.0, z + 0.02 * random.signed()));
        kit.of(Of::Timber).tube(&ends, 18, |_| 0.07, DVec2::ONE);
    }
    for _ in 0..60 {
        let middle = at(1.5 * random.signed() - 0.4, 0.02, 0.9 * random.signed() + 0.2);
        let share = random.unit();
        let (sin, cos) = turn(share);
        let half = (0.02 + 0.05 * random.unit()) * at(cos, 0.0, sin);
        kit.of(Of::Iron).tube(&[middle - half, middle + half], 6, |_| 0.005, DVec2::ONE);
    }
}
