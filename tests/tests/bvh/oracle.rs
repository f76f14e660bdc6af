//! Random rays through ten thousand triangles against exact arithmetic. RASRAY_FULL=1 traces ten million.

use rasray_bvh::{Builder, Bvh, Config};
use rasray_experiment::HIT_ROUNDING;
use rasray_reference::oracle;
use rasray_tests::conformance::{Prepared, measure};
use rasray_tests::hard_cases::{self, Expectation, HardCase, Scale, Triangle};
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::bounds;
use rasray_tests::tier::is_full;

use super::scenes::built_in;

/// Rays of one batch.
const BATCH: usize = 100_000;

fn batches() -> usize {
    if is_full() { 100 } else { 1 }
}

fn batch(triangles: &[Triangle], seed: u64) -> HardCase {
    let mut random = Random::new(seed);
    let bounds = bounds(triangles);
    let mut ray = || oracle::Ray::new(random.within(bounds), random.direction());
    HardCase {
        id: "spheres",
        title: "random rays through spheres in a box",
        triangles: triangles.to_vec(),
        rays: (0..BATCH).map(|_| ray()).collect(),
        eye: [0.0; 3],
        expect: Expectation::Oracle,
        ..hard_cases::case("E1", Scale::QUICK).expect("the case exists")
    }
}

#[test]
fn every_hit_is_the_one_of_exact_arithmetic() {
    let bench = Bench::new();
    let triangles = built_in("spheres:10k");
    assert!(triangles.len() > 9_000);
    let geometry = bench.geometry(&triangles);
    let mut trees = [Builder::Sah, Builder::Lbvh, Builder::Ploc, Builder::Trbvh].map(|builder| {
        Bvh::new(bench.device(), Config::new(builder), &geometry, None).expect("the options are valid")
    });
    for seed in 0..batches() as u64 {
        let mut prepared = Prepared::new(&bench, batch(&triangles, 100 + seed));
        for tree in &mut trees {
            let measured = measure(&bench, tree, &prepared, 0.0, HIT_ROUNDING);
            assert_eq!(measured.rejected, Vec::<usize>::new(), "batch {seed}: {:?}", measured.confusion);
            let unambiguous = measured.confusion.rays - measured.confusion.ambiguous;
            assert!(unambiguous * 1000 > measured.confusion.rays * 999, "{:?}", measured.confusion);
            println!("{:?}: {:?}", tree.config().builder, measured.confusion);
        }
        if seed == 0 {
            // Shows that a single wrong hit would be noticed: the triangle that a ray hits moves away.
            let hits = prepared.verdicts.iter().enumerate();
            let mut hits = hits.filter_map(|(ray, verdict)| Some((ray, verdict.outcome.hit()?.0)));
            let (ray, first) = hits.next().expect("a third of the rays hit");
            let mut moved = triangles.clone();
            moved[first as usize] = moved[first as usize].map(|p| p.map(|x| x + 0.5));
            prepared.geometry = bench.geometry(&moved);
            let measured = measure(&bench, &mut trees[0], &prepared, 0.0, HIT_ROUNDING);
            assert!(measured.rejected.contains(&ray), "{:?}", measured.rejected);
        }
    }
}
