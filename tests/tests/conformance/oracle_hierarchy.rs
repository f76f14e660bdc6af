//! The oracle's hierarchy against the oracle that tests every triangle, on all hard cases and on random
//! scenes; and the exact cells of views against the ones that marches are held to.

use rasray_ads::Ray;
use rasray_hard_cases::{Scale, cases};
use rasray_reference::oracle::{self, Oracle, Verdict};
use rasray_reference::views::{CellChord, cells_along};
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, sphere};
use rasray_tests::tier::is_full;
use rasray_tests::visits::{exact_face_chords, unresolved};

/// Rays per case: every ray tests every triangle once.
fn rays_per_case(triangles: usize) -> usize {
    let tests = if is_full() { 200_000_000 } else { 4_000_000 };
    (tests / triangles.max(1)).clamp(20, if is_full() { 20_000 } else { 1000 })
}

fn both(triangles: &[Triangle], rays: &[oracle::Ray]) -> [Vec<Verdict>; 2] {
    let positions = triangles.as_flattened();
    let indices: Vec<u32> = (0..positions.len() as u32).collect();
    let fast = Oracle::new(positions, &indices, None).expect("well formed");
    let slow = Oracle::brute_force(positions, &indices, None).expect("well formed");
    [fast.closest_batch(rays), slow.closest_batch(rays)]
}

/// The first ray on which the two differ.
fn first_difference([fast, slow]: &[Vec<Verdict>; 2]) -> Option<usize> {
    assert_eq!(fast.len(), slow.len());
    fast.iter().zip(slow).position(|(fast, slow)| fast != slow)
}

#[test]
fn the_hierarchy_changes_no_verdict_of_any_hard_case() {
    let (mut compared, mut hits, mut with_hierarchy) = (0_usize, 0_usize, 0_usize);
    for case in cases(Scale::QUICK) {
        let mut rays = case.rays;
        rays.truncate(rays_per_case(case.triangles.len()));
        let answers = both(&case.triangles, &rays);
        if let Some(index) = first_difference(&answers) {
            panic!("{} ray {index}: {:?} or {:?}", case.id, answers[0][index], answers[1][index]);
        }
        compared += rays.len();
        with_hierarchy += usize::from(case.triangles.len() > 64);
        hits += answers[0].iter().filter(|verdict| verdict.outcome.hit().is_some()).count();
    }
    println!("{compared} rays, {hits} hits, {with_hierarchy} cases with a hierarchy");
    assert!(hits > compared / 4 && with_hierarchy > 10, "{hits} of {compared}, {with_hierarchy}");
}

#[test]
fn the_hierarchy_changes_no_verdict_of_random_scenes() {
    let mut random = Random::new(0x6F72_6163_6C65);
    for round in 0..6 {
        let center = random.point(-100.0, 100.0);
        let mut triangles = sphere(center, 3.0, 12 + 4 * round);
        for _ in 0..500 {
            // From slivers to triangles larger than the sphere.
            let size = 10.0_f32.powf(random.between(-5.0, 1.0));
            let middle = random.near(center, 4.0);
            triangles.push(random.triangle(middle, size));
        }
        let rays: Vec<oracle::Ray> = (0..1500)
            .map(|index| {
                let origin = random.near(center, 6.0);
                let target = triangles[random.bits() as usize % triangles.len()][index % 3];
                match index % 3 {
                    0 => oracle::Ray::towards(origin, target),
                    _ => oracle::Ray::new(origin, random.direction()),
                }
            })
            .filter(|ray| ray.is_valid())
            .collect();
        let mut answers = both(&triangles, &rays);
        assert_eq!(first_difference(&answers), None);
        // A hit taken away from one side is noticed, and so is a t that is off.
        let hit = answers[0].iter().position(|v| v.outcome.hit().is_some()).expect("something is hit");
        answers[0][hit].t_range[1] += 1.0e-9;
        assert_eq!(first_difference(&answers), Some(hit));
    }
}

/// Every cell that marches are held to is among the exact cells, over the same interval.
fn missing(ray: &Ray, exact: &[CellChord], resolution: u32) -> usize {
    let required = exact_face_chords(ray, resolution, 0.0);
    let found = |face: u32, x: i32, y: i32, t: f64| {
        exact.iter().any(|chord| {
            chord.view == face
                && (i64::from(chord.cell[0]), i64::from(chord.cell[1])) == (i64::from(x), i64::from(y))
                && chord.t[0] <= t
                && t <= chord.t[1]
        })
    };
    // Where a ray runs along a boundary both cells are required of a march; the exact traversal names one.
    let mut places: Vec<f64> = required.iter().map(|chord| chord.middle()).collect();
    places.dedup();
    places
        .into_iter()
        .filter(|&t| {
            !required
                .iter()
                .any(|chord| chord.middle() == t && found(chord.cell.0, chord.cell.1, chord.cell.2, t))
        })
        .count()
}

#[test]
fn exact_cells_are_those_that_marches_are_held_to() {
    let mut random = Random::new(0x6365_6C6C);
    let mut checked = 0;
    for resolution in [1, 8, 64] {
        for _ in 0..200 {
            let mut ray = random.ray(-2.0, 2.0);
            ray.t_max = 50.0;
            let (origin, direction) = (ray.origin.map(f64::from), ray.direction.map(f64::from));
            let exact = cells_along(origin, direction, [0.0, 50.0], resolution);
            assert_eq!(missing(&ray, &exact, resolution), 0, "{ray:?}");
            checked += exact.len();
            // A traversal that leaves out its longest chord is noticed.
            let length = |chord: &CellChord| chord.t[1] - chord.t[0];
            let mut short = exact.clone();
            let longest = (0..short.len())
                .max_by(|&a, &b| length(&short[a]).total_cmp(&length(&short[b])))
                .expect("a ray crosses cells");
            if length(&short[longest]) > 4.0 * unresolved(&ray, 50.0) {
                short.remove(longest);
                assert!(missing(&ray, &short, resolution) > 0);
            }
        }
    }
    assert!(checked > 10_000, "{checked}");
}
