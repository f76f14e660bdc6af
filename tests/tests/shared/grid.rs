//! The traversal through a regular grid: visited cells are a superset of the exact ones, in a bounded number.
//! Letters and numbers are those of the list of hard cases (voxel grid).

use std::collections::HashSet;

use rasray_ads::Ray;
use rasray_shaders_glsl::ADS_TEST_MARCH_GRID;
use rasray_shaders_glsl::records::test_kernels::GridMarchTestConstants;
use rasray_tests::hard_cases::{self, Scale};
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::rays::segment;
use rasray_tests::visits::{exact_grid_chords, point, run_kernel, runs, unresolved_length};

type Cell = [i32; 3];

/// At most 3 size + 1 steps, each with at most the 3 cells next to it and the same beyond the boundary.
fn visit_limit(size: u32) -> usize {
    7 * (3 * size as usize + 1) + 8
}

fn traverse(bench: &Bench, rays: &[Ray], size: u32) -> Vec<Vec<Cell>> {
    let limit = visit_limit(size);
    let mut all = Vec::with_capacity(rays.len());
    for chunk in rays.chunks((64 << 20) / (size_of::<Cell>() * limit)) {
        let (found, counts) = run_kernel::<Cell, _>(
            bench.device(),
            &ADS_TEST_MARCH_GRID,
            bytemuck::cast_slice(chunk),
            chunk.len() * limit,
            Some(chunk.len()),
            chunk.len(),
            &GridMarchTestConstants { ray_count: chunk.len() as u32, size, limit: limit as u32 },
        );
        for (ray, visits) in chunk.iter().zip(runs(&found, &counts, limit)) {
            all.push(visits.unwrap_or_else(|| panic!("{ray:?} visits more than {limit} cells")));
        }
    }
    all
}

/// Fault of the visits of a ray; `None` if there is none.
fn fault(ray: &Ray, visits: &[Cell], size: u32) -> Option<String> {
    let visited: HashSet<Cell> = visits.iter().copied().collect();
    if let Some(cell) = visits.iter().find(|cell| cell.iter().any(|i| !(0..size as i32).contains(i))) {
        return Some(format!("{cell:?} is outside of the grid"));
    }
    let chords = exact_grid_chords(ray, size);
    if let Some(chord) = chords.iter().find(|chord| !visited.contains(&chord.cell)) {
        return Some(format!("{chord:?} is not visited"));
    }
    // Nothing far from the ray is visited: every cell is within rounding of a point of the line.
    let first = chords.first().map_or(f64::from(ray.t_min), |chord| chord.t_in);
    let last = chords.last().map_or(f64::from(ray.t_min), |chord| chord.t_out);
    let slack = unresolved_length(ray, first.abs().max(last.abs()));
    if !chords.is_empty() && slack < 0.01 {
        let near = |cell: &Cell| {
            let mut range = [first - slack, last + slack];
            let (origin, end) = (point(ray, 0.0), point(ray, 1.0));
            for axis in 0..3 {
                let (o, d) = (origin[axis], end[axis] - origin[axis]);
                let (low, high) = (f64::from(cell[axis]) - slack, f64::from(cell[axis] + 1) + slack);
                if d == 0.0 {
                    if o < low || o > high {
                        return false;
                    }
                } else {
                    let (a, b) = ((low - o) / d, (high - o) / d);
                    range = [range[0].max(a.min(b)), range[1].min(a.max(b))];
                }
            }
            range[0] <= range[1] + slack
        };
        if let Some(cell) = visits.iter().find(|cell| !near(cell)) {
            return Some(format!("{cell:?} is not on the ray"));
        }
    }
    None
}

fn check(name: &str, rays: &[Ray], size: u32) -> Vec<Vec<Cell>> {
    let bench = Bench::new();
    let traversals = traverse(&bench, rays, size);
    let faults: Vec<String> = rays
        .iter()
        .zip(&traversals)
        .filter_map(|(ray, visits)| {
            let fault = fault(ray, visits, size)?;
            Some(format!("o {:?} d {:?} [{}, {}]: {fault}", ray.origin, ray.direction, ray.t_min, ray.t_max))
        })
        .collect();
    let shown = &faults[..faults.len().min(4)];
    assert!(faults.is_empty(), "{name}: {} of {} rays, first: {shown:#?}", faults.len(), rays.len());
    traversals
}

/// All sign and axis variants of a ray within a grid.
fn variants(ray: Ray, size: f32) -> Vec<Ray> {
    (0..48)
        .map(|variant| {
            let order = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]][variant / 8];
            let mirror = |axis: usize| (variant % 8) >> axis & 1 == 1;
            let origin = std::array::from_fn(|axis| {
                let x = ray.origin[order[axis]];
                if mirror(axis) { size - x } else { x }
            });
            let direction = std::array::from_fn(|axis| {
                let d = ray.direction[order[axis]];
                if mirror(axis) { -d } else { d }
            });
            Ray { origin, direction, ..ray }
        })
        .collect()
}

#[test]
fn random_rays() {
    let mut random = Random::new(21);
    for size in [1_u32, 7, 64] {
        let side = size as f32;
        let rays: Vec<Ray> = (0..12_000)
            .map(|_| {
                let pick = random.bits();
                let mut origin = match pick % 4 {
                    0 => random.point(0.0, side).map(f32::round),
                    1 => random.point(-3.0 * side, 4.0 * side),
                    _ => random.point(0.0, side),
                };
                if pick >> 4 & 3 == 0 {
                    origin[(pick >> 8) as usize % 3] = random.between(0.0, side + 0.99).floor();
                }
                let mut direction = match pick >> 16 & 3 {
                    0 => [1.0, -1.0, 1.0],
                    _ => random.direction(),
                };
                if pick >> 20 & 3 == 0 {
                    direction[(pick >> 24) as usize % 3] = if pick >> 28 & 1 == 0 { 0.0 } else { -0.0 };
                }
                let limited = Ray {
                    t_min: random.between(0.0, 1.0),
                    t_max: random.between(1.0, 2.0 * side),
                    ..Ray::new(origin, direction)
                };
                if pick >> 32 & 1 == 0 { limited } else { Ray::new(origin, direction) }
            })
            .collect();
        check("random", &rays, size);
    }
}

/// X1 and X2: ties of two and three axes at every step.
#[test]
fn diagonals_step_and_end() {
    let corner = segment([0.5; 3], [63.5; 3]);
    let edge = segment([0.5; 3], [63.5, 63.5, 0.5]);
    for (ray, name) in [(corner, "X1"), (edge, "X2")] {
        for visits in check(name, &variants(ray, 64.0), 64) {
            // Cells that only touch the ray are visited as well; each cell of the diagonal is.
            assert!(visits.len() <= visit_limit(64) && visits.len() >= 64, "{name}: {}", visits.len());
        }
    }
}

/// X3 and X13: in a plane between cells, both sides are visited.
#[test]
fn rays_in_a_plane_of_the_grid_visit_both_sides() {
    let in_plane = segment([0.0, 32.0, 0.5], [64.0, 32.0, 0.5]);
    let in_edge = segment([0.0, 32.0, 16.0], [64.0, 32.0, 16.0]);
    let skew = segment([0.0, 32.0, 0.25], [64.0, 32.0, 50.0]);
    for (name, ray) in [("X3", in_plane), ("X3 edge", in_edge), ("X3 skew", skew)] {
        check(name, &variants(ray, 64.0), 64);
    }
    let visits: HashSet<Cell> = check("X3", &[in_plane], 64).concat().into_iter().collect();
    for x in 0..64 {
        assert!(visits.contains(&[x, 31, 0]) && visits.contains(&[x, 32, 0]), "column {x}");
    }
    // X13: a wall at x = 32 is in the cells on either side; a ray that ends on it has visited both.
    for visits in check("X13", &variants(segment([3.5, 10.25, 20.5], [32.0, 10.25, 20.5]), 64.0), 64) {
        assert!(visits.len() >= 30);
    }
    let visits = check("X13", &[segment([3.5, 10.25, 20.5], [32.0, 10.25, 20.5])], 64).concat();
    assert!(visits.contains(&[31, 10, 20]) && visits.contains(&[32, 10, 20]), "{visits:?}");
}

/// X4: zeros of either sign.
#[test]
fn signed_zeros_traverse_along_an_axis() {
    for direction in [[1.0, -0.0, 0.0], [-1.0, 0.0, -0.0], [-0.0, 1.0, -0.0], [0.0, -0.0, -1.0]] {
        for origin in [[31.5, 20.25, 7.75], [32.0, 20.0, 7.0], [0.0; 3], [64.0; 3]] {
            let visits = check("X4", &[Ray::new(origin, direction)], 64).concat();
            assert!(visits.len() <= visit_limit(64));
        }
    }
    let visits = check("X4", &[Ray::new([0.5, 20.25, 7.75], [1.0, -0.0, 0.0])], 64).concat();
    assert_eq!(visits.len(), 64, "an axis traversal through the middle of cells touches no others");
}

/// X5: a direction that is zero is no ray.
#[test]
fn a_ray_without_direction_visits_nothing() {
    for origin in [[1.5; 3], [0.0; 3], [-5.0; 3]] {
        for zero in [0.0, -0.0] {
            assert!(check("X5", &[Ray::new(origin, [zero; 3])], 64)[0].is_empty());
        }
    }
}

/// X6: origins outside, on faces and corners, rays that graze.
#[test]
fn rays_from_outside_and_along_the_border() {
    let rays = [
        Ray::new([64.0; 3], [-1.0; 3]),
        Ray::new([0.0; 3], [1.0; 3]),
        Ray::new([-10.0, 5.5, 5.5], [1.0, 0.0, 0.0]),
        Ray::new([-10.0, 5.5, 5.5], [1.0, 0.1, 0.2]),
        Ray::new([0.0, 5.5, 5.5], [1.0, 0.0, 0.0]),
        Ray::new([64.0, 5.5, 5.5], [-1.0, 0.25, 0.0]),
        // Along an edge and along a face of the box.
        Ray::new([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        Ray::new([-1.0, 64.0, 64.0], [1.0, 0.0, 0.0]),
        Ray::new([-1.0, 64.0, 30.5], [1.0, 0.0, 0.0]),
    ];
    for ray in rays {
        for (variant, visits) in variants(ray, 64.0).iter().zip(check("X6", &variants(ray, 64.0), 64)) {
            assert!(!visits.is_empty(), "{variant:?}");
        }
    }
    for away in [Ray::new([-1.0; 3], [-1.0, 0.0, 0.0]), Ray::new([70.0, 5.0, 5.0], [0.0, 1.0, 0.0])] {
        assert!(check("X6", &[away], 64)[0].is_empty(), "{away:?}");
    }
}

/// X7: the published endless loop, in units of its cell of 16.
#[test]
fn the_published_endless_loop_ends() {
    let place = |p: [f32; 3]| p.map(|x| x / 16.0 + 50.0);
    let (from, to) = (place([-668.0, -340.0, 77.0]), place([404.0, -64.0, -784.0]));
    for ray in [segment(from, to), segment(to, from)] {
        let visits = check("X7", &[ray], 128).concat();
        let end: Cell = std::array::from_fn(|axis| (ray.origin[axis] + ray.direction[axis]).floor() as i32);
        assert!(visits.contains(&end), "{end:?} is not reached");
    }
}

/// X8: an endless ray ends with the grid.
#[test]
fn endless_rays_cost_no_more_than_the_grid() {
    let ray = Ray::new([-5.0, 3.0, 7.0], [1.0, 0.5, 0.25]);
    let cost = check("X8", &[Ray { t_max: 1.0e3, ..ray }], 64).concat().len();
    assert!(cost > 64 && cost <= visit_limit(64), "{cost} visits");
    for t_max in [1.0e20, f32::MAX, f32::INFINITY] {
        assert_eq!(check("X8", &[Ray { t_max, ..ray }], 64).concat().len(), cost, "t_max {t_max}");
    }
}

/// X12: a ray through a corner of the grid touches all eight cells around it.
#[test]
fn rays_through_a_corner_visit_all_cells_around_it() {
    for direction in [[1.0, 1.0, 1.0], [1.0, 0.5, 0.25], [1.0, 1.0, 0.5], [0.75, 0.5, 1.0]] {
        let origin: [f32; 3] = std::array::from_fn(|axis| 32.0 - 8.0 * direction[axis]);
        for (ray, visits) in variants(Ray::new(origin, direction), 64.0).iter().zip(check(
            "X12",
            &variants(Ray::new(origin, direction), 64.0),
            64,
        )) {
            for corner in 0..8 {
                let cell: Cell = std::array::from_fn(|axis| 31 + (corner >> axis & 1));
                assert!(visits.contains(&cell), "{ray:?} does not visit {cell:?}");
            }
        }
    }
}

/// The checker itself.
#[test]
fn a_lost_cell_and_a_stray_one_are_noticed() {
    let bench = Bench::new();
    let ray = segment([1.3, 2.2, 0.9], [6.6, 3.1, 5.2]);
    let visits = traverse(&bench, &[ray], 8).remove(0);
    assert_eq!(fault(&ray, &visits, 8), None);
    for chord in exact_grid_chords(&ray, 8) {
        let kept: Vec<Cell> = visits.iter().copied().filter(|cell| *cell != chord.cell).collect();
        assert!(fault(&ray, &kept, 8).is_some());
    }
    assert!(fault(&ray, &[visits.clone(), vec![[0, 7, 0]]].concat(), 8).is_some());
    assert!(fault(&ray, &[visits, vec![[8, 3, 5]]].concat(), 8).is_some());
}

/// The rays of every case that is made for voxels, in units of its grid.
#[test]
fn rays_of_cases_about_voxels() {
    let mut traversed = 0;
    for case in hard_cases::cases(Scale { rays: 300, ..Scale::QUICK }) {
        let Some(grid) = case.grid else { continue };
        // Where this rounds, the ray is another one, and as good.
        let rays: Vec<Ray> = case
            .rays
            .iter()
            .filter(|ray| ray.is_valid())
            .map(|ray| Ray {
                t_min: ray.t_min,
                t_max: ray.t_max,
                ..Ray::new(
                    std::array::from_fn(|axis| (ray.origin[axis] - grid.low[axis]) / grid.cell),
                    ray.direction.map(|d| d / grid.cell),
                )
            })
            .collect();
        // X5 has none that are valid.
        assert_eq!(rays.is_empty(), case.id == "X5", "{}", case.id);
        if !rays.is_empty() {
            let traversals = check(case.id, &rays, grid.resolution);
            assert!(traversals.iter().any(|traversal| traversal.len() > 1), "{}", case.id);
            traversed += 1;
        }
    }
    assert_eq!(traversed, 14);
}
