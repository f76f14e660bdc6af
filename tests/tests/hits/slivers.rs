//! Needles, whose planes rounding turns, through structures whose cells keep depths of triangles: hits are
//! those of brute force, bit for bit.

use rasray_ads::{BruteForce, Ray, StructureKind};
use rasray_gpu::Timing;
use rasray_systems::Spec;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::shapes::needles;
use rasray_tracer::build_until_complete;

/// Structures with fragments and lists, and options with which they find every hit.
const EXACT: &[(&str, &[(&str, &str)])] = &[
    ("mmrt", &[("resolution", "64")]),
    ("mmrt", &[("resolution", "24"), ("storage", "sb"), ("builder", "binning")]),
    ("hu", &[("resolution", "64")]),
    ("hu", &[("resolution", "512")]),
    ("hu", &[("resolution", "21"), ("grid", "7"), ("storage", "ll")]),
    ("selective", &[("resolution", "64")]),
    ("selective", &[("resolution", "64"), ("storage", "paged")]),
    ("ldc", &[("resolution", "64")]),
    ("ldc", &[("resolution", "256"), ("depth", "16")]),
    ("ldc", &[("resolution", "21"), ("build", "peel")]),
];

#[test]
fn needles_are_hit_as_by_brute_force() {
    let bench = Bench::new();
    let triangles = needles();
    let mut random = Random::new(78);
    let rays: Vec<Ray> = (0..8000)
        .map(|index| {
            let [a, b, c] = triangles[index % triangles.len()];
            let (u, v) = (random.between(0.0, 0.9), random.between(0.0, 0.1));
            let origin = random.point(-9.0, 9.0);
            let at = |axis: usize| a[axis] + u * (b[axis] - a[axis]) + v * (c[axis] - a[axis]);
            Ray::new(origin, std::array::from_fn(|axis| at(axis) - origin[axis]))
        })
        .collect();
    let geometry = bench.geometry(&triangles);
    let brute = BruteForce::new(bench.device(), &geometry, None, false).expect("pipelines can be made");
    let (expected, occluded) = (bench.trace(&brute, &rays).hits, bench.occluded(&brute, &rays));
    let hit = expected.iter().filter(|hit| hit.is_hit()).count();
    assert!(hit > rays.len() / 4, "{hit} rays hit a needle");
    for (system, options) in EXACT {
        let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        let spec = Spec::new(system, "robust", given).expect("the options are valid");
        let mut structure = spec.create(bench.device(), &geometry, None).expect("it is made");
        assert_eq!(structure.description().kind, StructureKind::Primitive, "{system} {options:?}");
        build_until_complete(bench.device(), &mut *structure, [0.0; 3], Timing::None)
            .expect("the build completes");
        let found = bench.trace(&*structure, &rays).hits;
        let wrong = found.iter().zip(&expected).filter(|(hit, expected)| bits(hit) != bits(expected)).count();
        let dark = bench.occluded(&*structure, &rays);
        let other = dark.iter().zip(&occluded).filter(|(a, b)| a != b).count();
        println!("{system} {options:?}: {wrong} hits and {other} shadows differ");
        assert_eq!((wrong, other), (0, 0), "{system} {options:?}");
    }
}
