//! Walls and fittings of the room: stones, flags, beams, the forge.

use glam::{DVec2, DVec3};

use super::super::forms::{along, standing};
use super::super::shape::Icosphere;
use super::super::spheres::Random;
use super::{HEIGHT, Kit, Of, ROOM, at};

/// Seed of stones, boards and coals.
const SEED: u64 = 0x5EED_0006;
/// Centre of the top of the hearth, metres.
const HEARTH: DVec3 = DVec3::new(-2.65, 0.78, -1.85);

/// Opening of a wall: its start and end along the wall, its lower and upper height, metres.
type Opening = [f64; 4];

pub(super) fn add(kit: &mut Kit) {
    let mut random = Random::new(SEED);
    let (x, z) = ROOM;
    let door: Opening = [0.9, 2.5, 0.0, 2.2];
    let window: Opening = [4.2, 5.4, 1.25, 2.25];
    let none: Opening = [0.0; 4];
    // The order is from left to right as seen from inside.
    let sides = [
        (at(-x, 0.0, z), DVec3::NEG_Z, 2.0 * z, door),
        (at(-x, 0.0, -z), DVec3::X, 2.0 * x, window),
        (at(x, 0.0, -z), DVec3::Z, 2.0 * z, none),
        (at(x, 0.0, z), DVec3::NEG_X, 2.0 * x, none),
    ];
    for (start, direction, length, opening) in sides {
        wall(kit, &mut random, (start, direction, length), opening);
    }
    for ([from, to, low, high], (start, direction, _, _)) in [(door, sides[0]), (window, sides[1])] {
        let mut bar = |s: f64, y: f64, half_s: f64, half_y: f64| {
            let half = direction.abs() * half_s
                + DVec3::Y * half_y
                + (DVec3::ONE - direction.abs() - DVec3::Y) * 0.13;
            let place = standing(start + direction * s + DVec3::Y * y, 0.0);
            kit.of(Of::Timber).block_with_bevel(place, half, 0.012, 0.8);
        };
        bar(0.5 * (from + to), high + 0.07, 0.5 * (to - from) + 0.22, 0.07);
        for side in [from, to] {
            bar(side, 0.5 * (low + high), 0.06, 0.5 * (high - low));
        }
        if low > 0.0 {
            bar(0.5 * (from + to), low - 0.03, 0.5 * (to - from) + 0.12, 0.03);
            bar(0.5 * (from + to), 0.5 * (low + high), 0.02, 0.5 * (high - low));
            bar(0.5 * (from + to), 0.5 * (low + high), 0.5 * (to - from), 0.02);
        }
    }
    // The fronts of the screens face the room.
    let mut screen = |corners: [DVec3; 4]| kit.of(Of::Daylight).quad(corners, DVec2::ONE);
    let (left, back, top) = (-x - 0.9, -z - 0.5, HEIGHT + 0.285);
    screen([at(left, 0.0, 2.4), at(left, 0.0, -0.6), at(left, 2.7, -0.6), at(left, 2.7, 2.4)]);
    screen([at(0.4, 1.0, back), at(2.2, 1.0, back), at(2.2, 2.6, back), at(0.4, 2.6, back)]);
    for x in [-0.7, 0.7] {
        screen([
            at(x - 0.4, top, -0.5),
            at(x + 0.4, top, -0.5),
            at(x + 0.4, top, 0.6),
            at(x - 0.4, top, 0.6),
        ]);
    }
    floor(kit, &mut random);
    roof(kit);
    forge(kit, &mut random);
}

/// Adds courses of stones before mortar, bound so that joints do not stand above each other, around an
/// opening.
fn wall(
    kit: &mut Kit,
    random: &mut Random,
    (start, direction, length): (DVec3, DVec3, f64),
    opening: Opening,
) {
    let inward = DVec3::Y.cross(direction) * -1.0;
    let [from, to, low, high] = opening;
    let mut mortar = |s: [f64; 2], y: [f64; 2]| {
        if s[1] > s[0] && y[1] > y[0] {
            let corner = |s: f64, y: f64| start + direction * s + DVec3::Y * y;
            let corners = [corner(s[0], y[0]), corner(s[1], y[0]), corner(s[1], y[1]), corner(s[0], y[1])];
            kit.of(Of::Mortar).quad(corners, DVec2::ONE);
        }
    };
    let top = HEIGHT + 0.45;
    mortar([0.0, from], [0.0, top]);
    mortar([to, length], [0.0, top]);
    mortar([from, to], [0.0, low]);
    mortar([from, to], [high, top]);
    let courses = 15;
    let rise = top / f64::from(courses);
    for course in 0..courses {
        let y = (f64::from(course) + 0.5) * rise;
        let mut s = -0.3 * random.unit();
        while s < length {
            let long = 0.26 + 0.3 * random.unit();
            let out = 0.02 + 0.035 * random.unit();
            // Stones end where the wall and the opening do.
            let mut reach = [s.max(0.0), (s + long).min(length)];
            if y > low && y < high && from < to {
                if reach[0] < from {
                    reach[1] = reach[1].min(from);
                } else if reach[0] < to {
                    reach[0] = to.min(reach[1]);
                }
            }
            s += long;
            if reach[1] - reach[0] < 0.05 {
                continue;
            }
            let middle = start + direction * (0.5 * (reach[0] + reach[1])) + DVec3::Y * y;
            let half_long = 0.5 * (reach[1] - reach[0]) - 0.007;
            let half =
                direction.abs() * half_long + DVec3::Y * (0.5 * rise - 0.007) + inward.abs() * (0.04 + out);
            kit.of(Of::Stone).block_with_bevel(standing(middle, 0.002 * random.signed()), half, 0.014, 1.0);
        }
    }
}

/// Adds flags of several sizes, and the ground that they lie in, which continues outside.
fn floor(kit: &mut Kit, random: &mut Random) {
    let corner = |x: f64, z: f64| at(x, -0.012, z);
    let far = 4.6;
    kit.of(Of::Mortar)
        .quad([corner(-far, far), corner(far, far), corner(far, -far), corner(-far, -far)], DVec2::ONE);
    let rows = 11;
    let deep = 2.0 * ROOM.1 / f64::from(rows);
    for row in 0..rows {
        let z = (f64::from(row) + 0.5) * deep - ROOM.1;
        let mut x = -ROOM.0 - 0.4 * random.unit();
        while x < ROOM.0 {
            let long = 0.4 + 0.35 * random.unit();
            let half = DVec3::new(0.5 * long - 0.008, 0.03, 0.5 * deep - 0.008);
            let lift = -0.03 + 0.008 * random.signed();
            let place = standing(at(x + 0.5 * long, lift, z), 0.002 * random.signed());
            kit.of(Of::Flags).block_with_bevel(place, half, 0.01, 1.0);
            x += long;
        }
    }
}

/// Adds beams from wall to wall with braces, and boards on them.
fn roof(kit: &mut Kit) {
    let timber = kit.of(Of::Timber);
    for beam in 0..5 {
        let x = -2.8 + 1.4 * f64::from(beam);
        timber.block_with_bevel(standing(at(x, HEIGHT, 0.0), 0.0), at(0.09, 0.12, ROOM.1), 0.015, 0.8);
        for side in [-1.0, 1.0] {
            let (foot, head) =
                (at(x, 2.3, side * (ROOM.1 - 0.08)), at(x, HEIGHT - 0.08, side * (ROOM.1 - 0.75)));
            let mut place = along(head - foot, 0.5 * (foot + head));
            place.matrix3 = turned_up(head - foot);
            timber.block_with_bevel(place, at(0.06, 0.5 * foot.distance(head), 0.06), 0.012, 0.8);
        }
    }
    timber.block_with_bevel(standing(at(0.0, HEIGHT + 0.2, -0.9), 0.0), at(ROOM.0, 0.09, 0.07), 0.012, 0.8);
    timber.block_with_bevel(standing(at(0.0, HEIGHT + 0.2, 0.9), 0.0), at(ROOM.0, 0.09, 0.07), 0.012, 0.8);
    for board in 0..36 {
        let x = -ROOM.0 + 0.1 + 0.195 * f64::from(board);
        timber.block_with_bevel(
            standing(at(x, HEIGHT + 0.31, 0.0), 0.0),
            at(0.096, 0.015, ROOM.1 + 0.1),
            0.006,
            0.8,
        );
    }
}

/// Makes a rotation about x that takes the y axis along a direction in the plane of y and z.
fn turned_up(direction: DVec3) -> glam::DMat3 {
    let y = direction.normalize();
    glam::DMat3::from_cols(DVec3::X, y, DVec3::X.cross(y))
}

/// Adds a hearth of bricks with coals in it, a hood and a chimney above, bellows beside.
fn forge(kit: &mut Kit, random: &mut Random) {
    let (wide, deep) = (0.75, 0.62);
    let courses = 9;
    let rise = HEARTH.y / f64::from(courses);
    for course in 0..courses {
        let y = (f64::from(course) + 0.5) * rise;
        let shift = if course % 2 == 0 { 0.0 } else { 0.11 };
        for brick in 0..8 {
            let s = -wide + 0.22 * f64::from(brick) + shift;
            let half = [s.max(-wide), (s + 0.22).min(wide)];
            if half[1] - half[0] > 0.03 {
                let middle = at(HEARTH.x + 0.5 * (half[0] + half[1]), y, HEARTH.z + deep - 0.05);
                let half =
                    at(0.5 * (half[1] - half[0]) - 0.005, 0.5 * rise - 0.005, 0.055 + 0.004 * random.unit());
                kit.of(Of::Brick).block_with_bevel(standing(middle, 0.0), half, 0.006, 1.0);
            }
        }
        for brick in 0..6 {
            let z = HEARTH.z + deep - 0.1 - 0.22 * (f64::from(brick) + 0.5) + shift - 0.06;
            let middle = at(HEARTH.x + wide - 0.05, y, z);
            let half = at(0.055 + 0.004 * random.unit(), 0.5 * rise - 0.005, 0.105);
            kit.of(Of::Brick).block_with_bevel(standing(middle, 0.0), half, 0.006, 1.0);
        }
    }
    let bed = at(HEARTH.x - 0.05, HEARTH.y - 0.1, HEARTH.z - 0.05);
    kit.of(Of::Coal).block_with_bevel(standing(bed, 0.0), at(wide - 0.05, 0.05, deep - 0.05), 0.01, 1.0);
    let unit = Icosphere::new(1);
    for coal in 0..260 {
        let (across, back) = (random.signed(), random.signed());
        let heap = 0.12 * (1.0 - across * across) * (1.0 - back * back);
        let middle = at(
            HEARTH.x + 0.5 * across,
            HEARTH.y - 0.05 + heap * random.unit() + 0.02,
            HEARTH.z + 0.02 + 0.36 * back,
        );
        let glows = coal % 3 == 0 && across * across + back * back < 0.45;
        let radius = 0.022 + 0.022 * random.unit();
        kit.of(if glows { Of::Ember } else { Of::Coal }).sphere(&unit, middle, radius, false);
    }
    // The hood hangs from the wall: four slopes, and the chimney to the roof.
    let ring = |half_x: f64, front: f64, y: f64| {
        [
            at(HEARTH.x - half_x, y, front),
            at(HEARTH.x + half_x, y, front),
            at(HEARTH.x + half_x, y, -ROOM.1),
            at(HEARTH.x - half_x, y, -ROOM.1),
        ]
    };
    let rings =
        [ring(0.8, -1.3, 1.5), ring(0.8, -1.3, 1.62), ring(0.3, -2.0, 2.45), ring(0.3, -2.0, HEIGHT + 0.4)];
    for pair in rings.windows(2) {
        for side in 0..3 {
            let next = (side + 1) % 4;
            kit.of(Of::Mortar).quad([pair[0][side], pair[0][next], pair[1][next], pair[1][side]], DVec2::ONE);
        }
    }
    kit.of(Of::Timber).block_with_bevel(
        standing(at(HEARTH.x, 1.5, -1.3), 0.0),
        at(0.86, 0.07, 0.07),
        0.012,
        0.8,
    );
    bellows(kit);
}

/// Adds bellows: boards with pleats of leather between, on a trestle beside the forge.
fn bellows(kit: &mut Kit) {
    let middle = at(-1.28, 0.82, -2.05);
    for pleat in 0..9 {
        let y = 0.04 * f64::from(pleat) - 0.16;
        let width = if pleat % 2 == 0 { 0.26 } else { 0.21 };
        let board = pleat == 0 || pleat == 8;
        let place = standing(middle + DVec3::Y * y, 0.0);
        let half = at(if board { 0.34 } else { width + 0.06 }, if board { 0.018 } else { 0.022 }, width);
        kit.of(if board { Of::Timber } else { Of::Leather }).block_with_bevel(place, half, 0.014, 0.8);
    }
    for (x, z) in [(-0.28, -0.2), (0.28, -0.2), (-0.28, 0.2), (0.28, 0.2)] {
        kit.of(Of::Timber).block_with_bevel(
            standing(at(middle.x + x, 0.32, middle.z + z), 0.0),
            at(0.035, 0.32, 0.035),
            0.006,
            0.8,
        );
    }
    let nozzle =
        [middle + at(-0.3, -0.02, 0.0), middle + at(-0.48, -0.06, 0.02), middle + at(-0.7, -0.08, 0.05)];
    kit.of(Of::Iron).tube(&nozzle, 16, |share| 0.05 - 0.025 * share, DVec2::ONE);
}
