//! The traversal through the six faces: visited cells are a superset of the exact ones, without gaps.

use std::collections::HashMap;

use rasray_ads::Ray;
use rasray_shaders_glsl::ADS_TEST_MARCH_CELLS;
use rasray_shaders_glsl::records::test_kernels::CellMarchTestConstants;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::visits::{
    FACE_NEAR, FaceCell, Visit, exact_face_chords, near_size, run_kernel, runs, unresolved, visit_holds,
};

use crate::shared::march_cases;

/// Maximum number of visits of one ray. A traversal is monotone in columns and rows, and a line crosses at
/// most three faces at length, so there are at most 4 (resolution + 2) steps and a few for the border. Each
/// visits at most the eight cells around it as well, which happens only where cells are as small as rounding.
fn visit_limit(resolution: u32) -> usize {
    9 * 4 * (resolution as usize + 2) + 64
}

fn traverse_within(
    bench: &Bench,
    rays: &[Ray],
    resolution: u32,
    near: f32,
    limit: usize,
) -> Vec<Option<Vec<Visit>>> {
    let mut all = Vec::with_capacity(rays.len());
    for chunk in rays.chunks(((32 << 20) / (size_of::<Visit>() * limit)).max(1)) {
        let constants = CellMarchTestConstants {
            ray_count: chunk.len() as u32,
            resolution,
            limit: limit as u32,
            near_size: near,
        };
        let (found, counts) = run_kernel::<Visit, _>(
            bench.device(),
            &ADS_TEST_MARCH_CELLS,
            bytemuck::cast_slice(chunk),
            chunk.len() * limit,
            Some(chunk.len()),
            chunk.len(),
            &constants,
        );
        all.extend(runs(&found, &counts, limit));
    }
    all
}

/// The visits of each ray. Few rays need capacity for more than they would without rounding; those are
/// traversed again.
fn traverse(bench: &Bench, rays: &[Ray], resolution: u32, near: f32) -> Vec<Vec<Visit>> {
    let first = traverse_within(bench, rays, resolution, near, 4 * (resolution as usize + 2) + 64);
    let long: Vec<Ray> =
        rays.iter().zip(&first).filter(|(_, visits)| visits.is_none()).map(|(ray, _)| *ray).collect();
    let mut again =
        traverse_within(bench, &long, resolution, near, visit_limit(resolution)).into_iter().zip(&long);
    let mut traversed_again = || {
        let (visits, ray) = again.next()?;
        Some(visits.unwrap_or_else(|| panic!("{ray:?} visits more than {} cells", visit_limit(resolution))))
    };
    first.into_iter().map(|visits| visits.or_else(&mut traversed_again).unwrap_or_default()).collect()
}

/// Fault of the visits of a ray; `None` if there is none.
fn fault(ray: &Ray, visits: &[Visit], resolution: u32, near: f32, random: &mut Random) -> Option<String> {
    if ray.t_min >= ray.t_max {
        return (!visits.is_empty()).then(|| "an empty range is traversed".to_owned());
    }
    let mut by_cell: HashMap<FaceCell, Vec<[f32; 2]>> = HashMap::new();
    let mut reached = ray.t_min;
    for visit in visits {
        if visit.t_low.is_nan() || visit.t_high.is_nan() {
            return Some(format!("{visit:?} has no t"));
        }
        if visit.t_low > reached {
            return Some(format!("a gap from {reached} to {}", visit.t_low));
        }
        reached = reached.max(visit.t_high);
        by_cell.entry((visit.face, visit.x, visit.y)).or_default().push([visit.t_low, visit.t_high]);
    }
    if reached < ray.t_max {
        return Some(format!("the traversal ends at {reached}"));
    }
    for chord in exact_face_chords(ray, resolution, near) {
        let spans = by_cell.get(&chord.cell).map_or(&[][..], Vec::as_slice);
        let t = chord.middle();
        // Within a cell of a seam a point is found in both faces, and visits may be to either.
        let beyond_seam = |visit: &&Visit| {
            visit.face != chord.cell.0
                && visit.face != FACE_NEAR
                && visit_holds(visit, ray, t, resolution, near)
        };
        let spans_beyond = visits.iter().filter(beyond_seam).map(|visit| [visit.t_low, visit.t_high]);
        let holds = |[low, high]: [f32; 2]| f64::from(low) <= t && t <= f64::from(high);
        if !spans.iter().copied().any(holds) && !spans_beyond.into_iter().any(holds) {
            return Some(format!("{chord:?} is visited at {spans:?} only"));
        }
    }
    // Seams included: wherever a ray is, a cell that holds the point is visited at that t.
    let end = if ray.t_max.is_finite() { ray.t_max } else { ray.t_min + 20.0 };
    for _ in 0..6 {
        let t = f64::from(random.between(ray.t_min, end));
        let holds = |v: &Visit| {
            f64::from(v.t_low) <= t && t <= f64::from(v.t_high) && visit_holds(v, ray, t, resolution, near)
        };
        if !visits.iter().any(holds) {
            let there: Vec<_> =
                visits.iter().filter(|v| f64::from(v.t_low) <= t && t <= f64::from(v.t_high)).collect();
            return Some(format!("no cell that is visited at t = {t} holds the point there: {there:?}"));
        }
    }
    None
}

fn check(name: &str, rays: &[Ray], resolution: u32, radius: f32) {
    let bench = Bench::new();
    let near = near_size(resolution, radius);
    let mut random = Random::new(7);
    let traversals = traverse(&bench, rays, resolution, near);
    let faults: Vec<String> = rays
        .iter()
        .zip(&traversals)
        .filter_map(|(ray, visits)| {
            let fault = fault(ray, visits, resolution, near, &mut random)?;
            Some(format!("o {:?} d {:?} [{}, {}]: {fault}", ray.origin, ray.direction, ray.t_min, ray.t_max))
        })
        .collect();
    let most = traversals.iter().map(Vec::len).max().unwrap_or(0);
    println!("{name}, resolution {resolution}: {} rays, at most {most} visits", rays.len());
    assert!(
        faults.is_empty(),
        "{name}, resolution {resolution}: {} of {} rays, first: {:#?}",
        faults.len(),
        rays.len(),
        &faults[..faults.len().min(4)]
    );
}

/// Powers of two, and sizes whose boundaries are rounded.
const RESOLUTIONS: [u32; 5] = [1, 16, 33, 64, 100];

#[test]
fn random_rays() {
    let mut random = Random::new(1);
    for (resolution, count) in [(16, 40_000), (33, 30_000), (64, 24_000), (255, 6_000)] {
        check("random", &march_cases::random(&mut random, count, resolution), resolution, 1.0);
    }
}

#[test]
fn rays_from_far_outside_and_of_every_scale() {
    let mut random = Random::new(2);
    for (resolution, radius) in [(33, 1.0e3), (64, 1.0e-3), (100, 1.0e6)] {
        let rays = march_cases::scaled(&march_cases::random(&mut random, 4_000, resolution), radius);
        check("scaled", &rays, resolution, radius);
    }
}

#[test]
fn rays_parallel_to_the_image_plane_and_walls_at_an_angle() {
    for resolution in RESOLUTIONS {
        check("V3, V4", &march_cases::across_the_view(resolution), resolution, 8.0);
    }
}

#[test]
fn rays_in_the_seams_between_faces() {
    for resolution in RESOLUTIONS {
        check("V5", &march_cases::seams(), resolution, 4.0);
    }
}

#[test]
fn rays_through_the_corners_between_three_faces() {
    for resolution in RESOLUTIONS {
        for size in [1.0e-3, 1.0, 1.0e3] {
            check("V6", &march_cases::corners(size), resolution, 3.0 * size);
        }
    }
}

#[test]
fn rays_that_begin_on_a_seam() {
    for resolution in RESOLUTIONS {
        check("V8", &march_cases::from_seams(), resolution, 7.0);
    }
}

#[test]
fn rays_through_the_eye_and_past_it() {
    for resolution in RESOLUTIONS {
        check("V9, V10", &march_cases::through_the_eye(), resolution, 4.0);
    }
}

#[test]
fn rays_parallel_to_axes_and_along_columns() {
    for resolution in RESOLUTIONS {
        check("V13", &march_cases::axis_parallel(resolution), resolution, 128.0);
    }
}

#[test]
fn rays_to_edges_and_corners_of_cells() {
    for resolution in [16, 33] {
        check("V14", &march_cases::to_cell_corners(resolution), resolution, 200.0);
    }
}

#[test]
fn rays_from_the_eye_and_close_to_it() {
    for resolution in RESOLUTIONS {
        check("V15", &march_cases::from_the_eye(resolution), resolution, 2.0);
    }
}

/// V9, V10, V12: what lies in the near region is on the traversal, with the t of the box.
#[test]
fn every_ray_that_crosses_the_near_region_visits_it() {
    let bench = Bench::new();
    let mut random = Random::new(3);
    let near = 0.125_f32;
    let rays: Vec<Ray> = (0..2_000)
        .map(|_| {
            let target = random.point(-0.2, 0.2);
            towards(random.point(-1.0, 1.0), target)
        })
        .collect();
    let mut inside = 0;
    for (ray, visits) in rays.iter().zip(traverse(&bench, &rays, 16, near)) {
        // Samples of the ray in double precision decide whether, and where, it is inside.
        for step in 0..400 {
            let t = f64::from(step) / 200.0;
            let p = rasray_tests::visits::point(ray, t);
            let depth = p.iter().map(|x| f64::from(near) - x.abs()).fold(f64::INFINITY, f64::min);
            let listed = visits
                .iter()
                .any(|v| v.face == FACE_NEAR && f64::from(v.t_low) <= t && t <= f64::from(v.t_high));
            assert!(depth <= 1.0e-5 || listed, "{ray:?} is in the box at t = {t}: {visits:?}");
            assert!(depth >= -1.0e-5 || !listed, "{ray:?} is outside of the box at t = {t}");
            inside += usize::from(listed);
        }
    }
    assert!(inside > 10_000, "only {inside} samples were inside: the test tests nothing");
}

/// The checker itself: a traversal that loses a cell, or claims too little of one, is found out.
#[test]
fn a_lost_cell_and_a_gap_are_noticed() {
    let bench = Bench::new();
    let ray = Ray { t_max: 4.0, ..Ray::new([0.3, 0.2, -0.9], [-0.31, 0.17, 0.83]) };
    let near = near_size(16, 4.0);
    let mut random = Random::new(4);
    let visits = traverse(&bench, &[ray], 16, near).remove(0);
    assert_eq!(fault(&ray, &visits, 16, near, &mut random), None);
    let required = exact_face_chords(&ray, 16, near);
    assert!(required.len() > 8 && required.iter().all(|c| c.t_out - c.t_in > unresolved(&ray, c.t_out)));
    for chord in &required {
        let kept: Vec<_> = visits.iter().copied().filter(|v| (v.face, v.x, v.y) != chord.cell).collect();
        assert!(fault(&ray, &kept, 16, near, &mut random).is_some(), "{chord:?} may be lost unnoticed");
    }
    let mut late = visits.clone();
    late[3].t_low += 0.01;
    let mut early = visits.clone();
    early.pop();
    assert!(fault(&ray, &late, 16, near, &mut random).is_some());
    assert!(fault(&ray, &early, 16, near, &mut random).is_some());
}
