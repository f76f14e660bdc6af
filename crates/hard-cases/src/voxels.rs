//! Rays that step through a grid of voxels: ties, planes between cells, signs of zero, ends of the grid.

use super::case::{AIMED, Answer, Content, Context, Entry, Expectation, Triangle};
use super::geometry::{aim, along, cuboid, point_on, quad};
use super::grid::Grid;
use super::random::Stream;
use rasray_reference::oracle::Ray;

pub(super) const CASES: &[Entry] = &[
    Entry { id: "X1", title: "space diagonal of the grid: three steps tie", parameter: 3.0, build: diagonal },
    Entry { id: "X2", title: "diagonal of a layer of cells: two steps tie", parameter: 2.0, build: diagonal },
    Entry { id: "X3", title: "rays in a plane between cells", parameter: 0.0, build: between_cells },
    Entry {
        id: "X4",
        title: "rays along axes with zeros of both signs",
        parameter: 0.0,
        build: signed_zeros,
    },
    Entry { id: "X5", title: "rays without direction", parameter: 0.0, build: no_direction },
    Entry {
        id: "X6",
        title: "origins outside, on faces and at the far corner; rays along the grid's edges",
        parameter: 0.0,
        build: ends_of_grid,
    },
    Entry {
        id: "X7",
        title: "published ray whose traversal did not end",
        parameter: 0.0,
        build: endless_traversal,
    },
    Entry { id: "X8", title: "rays without end through an empty grid", parameter: 0.0, build: empty_grid },
];

/// Returns components that are each one unit in the last place lower, unchanged, or higher: 27 variants.
fn nudged(point: [f32; 3], variant: usize) -> [f32; 3] {
    std::array::from_fn(|axis| match variant / 3_usize.pow(axis as u32) % 3 {
        0 => point[axis],
        1 => point[axis].next_down(),
        _ => point[axis].next_up(),
    })
}

fn diagonal(context: &Context) -> Content {
    const STEP: usize = 8;
    let in_space = context.parameter > 2.0;
    // The point is the middle of the k-th cell of the diagonal.
    let middle = |k: usize| {
        let s = k as f32 + 0.5;
        [s, s, if in_space { s } else { 0.5 }]
    };
    // The triangles lie across the diagonal, in every eighth cell.
    let across = |k: usize| -> Triangle {
        let v = if in_space { [0.3, 0.3, -0.6] } else { [0.0, 0.0, 0.6] };
        let base = along(middle(k), v, -0.5);
        let side = [0.6, -0.6, 0.0];
        [along(base, side, 1.0), along(base, side, -1.0), along(middle(k), v, 1.0)]
    };
    let mut triangles: Vec<Triangle> = (1..=8).map(|plate| across(STEP * plate - 1)).collect();
    triangles.extend(Grid::UNIT_64.markers());
    let (rays, expect) = context.answered(|_, index| {
        if index == 0 {
            let t = 7.0 / 63.0;
            return (aim(middle(0), middle(63)), Answer::HitOn { primitive: 0, t, tolerance: 1e-5 });
        }
        // Rays run from every cell between two of them, there and back.
        let plate = index % 8;
        let inside = index / 8 % (STEP - 1);
        let forth = index / 56 % 2 == 0 || plate == 0;
        let goal = if forth { plate } else { plate - 1 };
        let origin = nudged(middle(STEP * plate + inside), index / 112 % 27);
        let answer = Answer::HitOn { primitive: goal as u32, t: 1.0, tolerance: 1e-4 };
        (aim(origin, middle(STEP * (goal + 1) - 1)), answer)
    });
    let eye = if in_space { [40.2, 20.3, 12.1] } else { [40.2, 20.3, 8.1] };
    Content::new(triangles, rays, expect).seen_from(eye).on(Grid::UNIT_64)
}

fn between_cells(context: &Context) -> Content {
    const PLANE: f32 = 32.0;
    let at = |k: usize| 4.0 * (k + 1) as f32;
    let mut triangles: Vec<Triangle> = Vec::new();
    for k in 0..15 {
        let x = at(k);
        if k % 2 == 0 {
            // The triangle reaches into the cells of both sides.
            triangles.push([[x, 31.5, 0.0], [x, 31.5, 1.0], [x, 33.0, 0.5]]);
        } else {
            // The triangle has an edge in the plane: half of it is in the cells of either side.
            let half =
                |low: f32, high: f32| quad([x, low, 0.1], [x, low, 0.9], [x, high, 0.9], [x, high, 0.1]);
            triangles.extend(half(31.5, PLANE));
            triangles.extend(half(PLANE, 32.5));
        }
    }
    triangles.extend(Grid::UNIT_64.markers());
    let (rays, expect) = context.answered(|random, index| {
        if index == 0 {
            let first = Answer::HitAt { t: at(0) / 64.0, tolerance: 1e-6 };
            return (aim([0.0, PLANE, 0.5], [64.0, PLANE, 0.5]), first);
        }
        let k = index % 15;
        let side = if index / 15 % 2 == 0 { -1.0 } else { 1.0 };
        let z = random.between(0.4, 0.6);
        let from = at(k) + side * random.between(0.5, 3.5);
        (aim([from, PLANE, z], [at(k), PLANE, z]), AIMED)
    });
    Content::new(triangles, rays, expect).seen_from([2.0, 40.0, 9.0]).on(Grid::UNIT_64)
}

fn signed_zeros(context: &Context) -> Content {
    let (rays, expect) = context.answered(|random, index| {
        let (axis, forth) = (index % 3, index / 3 % 2 == 0);
        let zero = |bit: usize| if (index / 6) >> bit & 1 == 0 { 0.0 } else { -0.0 };
        let mut direction = [zero(0), zero(1), zero(2)];
        direction[axis] = if forth { 1.0 } else { -1.0 };
        let mut origin = random.near([32.0; 3], 31.0);
        if index / 48 % 2 == 0 {
            // Origins are in planes between cells.
            origin = origin.map(f32::round);
        }
        let t = if forth { 64.0 - origin[axis] } else { origin[axis] };
        (Ray::new(origin, direction), Answer::HitAt { t, tolerance: 1e-6 })
    });
    let triangles = cuboid([0.0; 3], [64.0; 3]);
    Content::new(triangles, rays, expect).seen_from([32.3, 31.7, 32.1]).on(Grid::UNIT_64)
}

fn no_direction(context: &Context) -> Content {
    let rays = context.rays(|random, index| {
        let direction = std::array::from_fn(|axis| if index >> axis & 1 == 0 { 0.0 } else { -0.0 });
        Ray::new(random.near([32.0; 3], 31.0), direction)
    });
    let triangles = cuboid([0.0; 3], [64.0; 3]);
    Content::new(triangles, rays, Expectation::All(Answer::Miss))
        .seen_from([32.3, 31.7, 32.1])
        .on(Grid::UNIT_64)
}

fn ends_of_grid(context: &Context) -> Content {
    let mut triangles = cuboid([24.0; 3], [40.0; 3]);
    triangles.extend(Grid::UNIT_64.markers());
    let inside = |random: &mut Stream| random.near([32.0; 3], 7.0);
    let (rays, expect) = context.answered(|random, index| {
        let axis = index / 4 % 3;
        let end = if index / 12 % 2 == 0 { 0.0 } else { 64.0 };
        match index % 4 {
            0 => {
                let mut origin = random.near([32.0; 3], 60.0);
                origin[axis] = if end == 0.0 { -10.0 } else { 74.0 };
                (aim(origin, inside(random)), Answer::Hit)
            }
            1 => {
                let mut origin = random.near([32.0; 3], 12.0);
                origin[axis] = end;
                (aim(origin, inside(random)), Answer::Hit)
            }
            2 if index == 2 => (Ray::new([64.0; 3], [-1.0; 3]), Answer::HitAt { t: 24.0, tolerance: 1e-6 }),
            2 => (aim([64.0; 3], inside(random)), Answer::Hit),
            // Rays run along one of the twelve edges, from outside, from its end or from within.
            _ => {
                let mut origin = [end; 3];
                origin[(axis + 1) % 3] = if index / 24 % 2 == 0 { 0.0 } else { 64.0 };
                origin[axis] = [-8.0, 0.0, random.between(0.0, 64.0)][index / 48 % 3];
                let mut direction = [0.0; 3];
                direction[axis] = 1.0;
                (Ray::new(origin, direction), Answer::Miss)
            }
        }
    });
    Content::new(triangles, rays, expect).seen_from([20.3, 11.2, 8.1]).on(Grid::UNIT_64)
}

fn endless_traversal(context: &Context) -> Content {
    const FROM: [f32; 3] = [-668.0, -340.0, 77.0];
    const TO: [f32; 3] = [404.0, -64.0, -784.0];
    let grid = Grid { low: [-1024.0; 3], cell: 16.0, resolution: 128 };
    // The plate is across the ray, well inside the cell in which the traversal must end.
    let (u, v) = ([276.0 / 1107.0, -1072.0 / 1107.0, 0.0], [0.0, 861.0 / 904.0, 276.0 / 904.0]);
    let corner = |s: f32, t: f32| along(along(TO, u, s), v, t);
    let end = [corner(6.0, -3.0), corner(-6.0, -3.0), corner(0.0, 6.0)];
    let mut triangles = vec![end];
    triangles.extend(grid.markers());
    let rays = context.rays(|random, index| {
        if index == 0 {
            return aim(FROM, TO);
        }
        aim(random.near(FROM, 16.0), point_on(&end, random.weights(0.05)))
    });
    Content::new(triangles, rays, Expectation::All(AIMED)).seen_from([300.0, -50.0, -700.0]).on(grid)
}

fn empty_grid(context: &Context) -> Content {
    let rays = context.rays(|random, index| {
        let end = if index % 2 == 0 { f32::INFINITY } else { f32::MAX };
        let origin = if index % 4 < 2 { random.near([32.0; 3], 31.0) } else { random.near([32.0; 3], 200.0) };
        Ray { t_max: end, ..Ray::new(origin, random.direction()) }
    });
    let triangles = Grid::UNIT_64.markers().to_vec();
    Content::new(triangles, rays, Expectation::Oracle).seen_from([32.3, 31.7, 32.1]).on(Grid::UNIT_64)
}
