//! Surfaces that a voxel cannot distinguish: opposite normals, several plates in one, walls between two.

use super::case::{AIMED, Answer, Content, Context, Entry, Expectation, Triangle};
use super::geometry::{aim, cuboid, point_on, quad};
use super::grid::Grid;
use rasray_reference::oracle::Ray;

pub(super) const CASES: &[Entry] = &[
    Entry {
        id: "X9",
        title: "opposite normals in one voxel cancel",
        parameter: 0.0,
        build: opposite_normals,
    },
    Entry {
        id: "X10",
        title: "one large triangle and two tiny ones that outvote it in a voxel",
        parameter: 0.0,
        build: outvoted,
    },
    Entry { id: "X11", title: "three plates in each voxel", parameter: 0.0, build: plates },
    Entry {
        id: "X12",
        title: "triangle that touches a voxel with a corner only",
        parameter: 0.0,
        build: corner_touch,
    },
    Entry { id: "X13", title: "wall exactly between voxels", parameter: 0.0, build: wall_between },
    Entry { id: "X14", title: "open quad and nested closed boxes", parameter: 0.0, build: open_and_nested },
    Entry { id: "X15", title: "plane whose normal favours no axis", parameter: 0.0, build: axis_tie },
];

/// Makes a square across the z axis, with its corners in reverse order if it is `turned`.
fn square(low: f32, high: f32, z: f32, turned: bool) -> [Triangle; 2] {
    let [a, b, c, d] = [[low, low, z], [high, low, z], [high, high, z], [low, high, z]];
    if turned { quad(a, d, c, b) } else { quad(a, b, c, d) }
}

/// Makes a ray at a point inside a triangle of a plate across z, from a given distance along z.
fn at_plate(
    random: &mut super::Stream,
    triangles: &[Triangle],
    primitive: usize,
    height: f32,
    lean: f32,
) -> (Ray, Answer) {
    let target = point_on(&triangles[primitive], random.weights(0.05));
    let origin = [
        target[0] + random.between(-lean, lean),
        target[1] + random.between(-lean, lean),
        target[2] + height,
    ];
    (aim(origin, target), Answer::HitOn { primitive: primitive as u32, t: 1.0, tolerance: 1e-4 })
}

fn opposite_normals(context: &Context) -> Content {
    let mut triangles = square(32.1, 32.9, 32.3, true).to_vec();
    triangles.extend(square(32.1, 32.9, 32.7, false));
    let (rays, expect) = context.answered(|random, index| {
        let far = index % 2;
        let height = random.between(0.1, 8.0) * if far == 0 { -1.0 } else { 1.0 };
        at_plate(random, &triangles, 2 * far + index / 2 % 2, height, 0.05)
    });
    let mut content = Content::new(triangles, rays, expect).seen_from([30.2, 29.9, 26.3]).on(Grid::UNIT_64);
    content.triangles.extend(Grid::UNIT_64.markers());
    content
}

fn outvoted(context: &Context) -> Content {
    let mut triangles = vec![[[32.05, 32.05, 32.4], [32.95, 32.05, 32.45], [32.5, 32.95, 32.5]]];
    let tiny = |x: f32| [[x, 32.8, 32.8], [x, 32.85, 32.8], [x, 32.8, 32.85]];
    triangles.extend([tiny(32.1), tiny(32.9)]);
    triangles.extend(Grid::UNIT_64.markers());
    let rays = context.rays(|random, index| {
        let target = point_on(&triangles[0], random.weights(0.02));
        let height = random.between(0.5, 6.0) * if index % 2 == 0 { -1.0 } else { 1.0 };
        aim(
            [
                target[0] + random.between(-0.3, 0.3),
                target[1] + random.between(-0.3, 0.3),
                target[2] + height,
            ],
            target,
        )
    });
    Content::new(triangles, rays, Expectation::Oracle).seen_from([31.2, 31.4, 27.3]).on(Grid::UNIT_64)
}

fn plates(context: &Context) -> Content {
    const PLATES: usize = 12;
    let z = |k: usize| 32.1 + (k / 3) as f32 + 0.3 * (k % 3) as f32;
    let mut triangles: Vec<Triangle> = (0..PLATES).flat_map(|k| square(30.1, 34.2, z(k), false)).collect();
    triangles.extend(Grid::UNIT_64.markers());
    let (rays, expect) = context.answered(|random, index| {
        let k = index % PLATES;
        // Rays start within the gap before or behind, which is at least 0.3 wide.
        let height = random.between(0.05, 0.25) * if (index / PLATES).is_multiple_of(2) { -1.0 } else { 1.0 };
        at_plate(random, &triangles, 2 * k + index / (2 * PLATES) % 2, height, 0.1)
    });
    Content::new(triangles.clone(), rays, expect).seen_from([31.9, 32.3, 28.2]).on(Grid::UNIT_64)
}

fn corner_touch(context: &Context) -> Content {
    let touching = [[32.0, 32.0, 32.0], [34.0, 32.5, 33.0], [32.5, 34.0, 33.0]];
    let mut triangles = vec![touching];
    triangles.extend(Grid::UNIT_64.markers());
    let rays = context.rays(|random, index| {
        let [a, b, c] = random.weights(0.0);
        // Every other ray is close to the corner, through the voxel that only the corner touches.
        let weights = if index % 2 == 0 { [a, b, c] } else { [1.0 - 0.02 * (b + c), 0.02 * b, 0.02 * c] };
        aim(random.near([31.2, 31.3, 33.5], 0.6), point_on(&touching, weights))
    });
    Content::new(triangles, rays, Expectation::Oracle).seen_from([31.2, 31.3, 34.1]).on(Grid::UNIT_64)
}

fn wall_between(context: &Context) -> Content {
    let wall = quad([32.0, 16.0, 16.0], [32.0, 48.0, 16.0], [32.0, 48.0, 48.0], [32.0, 16.0, 48.0]);
    let mut triangles = wall.to_vec();
    triangles.extend(Grid::UNIT_64.markers());
    let rays = context.rays(|random, index| {
        let side = if index % 2 == 0 { -1.0 } else { 1.0 };
        let target = [32.0, random.between(16.5, 47.5), random.between(16.5, 47.5)];
        let aside = [32.0 + side * random.between(0.5, 20.0), target[1], target[2]];
        aim([aside[0], aside[1] + random.between(-2.0, 2.0), aside[2] + random.between(-2.0, 2.0)], target)
    });
    Content::new(triangles, rays, Expectation::All(AIMED)).seen_from([20.3, 31.2, 30.7]).on(Grid::UNIT_64)
}

fn open_and_nested(context: &Context) -> Content {
    let mut triangles = square(26.0, 38.0, 20.0, false).to_vec();
    triangles.extend(cuboid([28.0; 3], [36.0; 3]));
    triangles.extend(cuboid([30.0; 3], [34.0; 3]));
    triangles.extend(Grid::UNIT_64.markers());
    let (rays, expect) = context.answered(|random, index| match index % 4 {
        // Rays start within the inner box, between both, and at the open quad from both sides.
        0 => (Ray::new(random.near([32.0; 3], 1.9), random.direction()), Answer::Hit),
        1 => {
            let mut origin = random.near([32.0; 3], 3.5);
            origin[index / 4 % 3] = 32.0 + random.sign() * random.between(2.5, 3.5);
            (Ray::new(origin, random.direction()), Answer::Hit)
        }
        side => {
            let target = [random.between(26.5, 37.5), random.between(26.5, 37.5), 20.0];
            let z = if side == 2 { random.between(10.0, 19.0) } else { random.between(21.0, 27.0) };
            (aim([target[0] + random.between(-1.0, 1.0), target[1], z], target), AIMED)
        }
    });
    Content::new(triangles, rays, expect).seen_from([32.3, 31.8, 32.4]).on(Grid::UNIT_64)
}

fn axis_tie(context: &Context) -> Content {
    // The coordinates of each corner add up to 96, so that the normal is exactly (1, 1, 1).
    let plane = [[63.0, 17.0, 16.0], [16.0, 63.0, 17.0], [17.0, 16.0, 63.0]];
    let mut triangles = vec![plane];
    triangles.extend(Grid::UNIT_64.markers());
    let rays = context.rays(|random, index| {
        let side = if index % 2 == 0 { -1.0 } else { 1.0 };
        let target = point_on(&plane, random.weights(0.02));
        let distance = side * random.between(2.0, 6.0);
        aim(random.near(target.map(|x| x + distance), 1.0), target)
    });
    Content::new(triangles, rays, Expectation::All(AIMED)).seen_from([20.3, 21.1, 19.2]).on(Grid::UNIT_64)
}
