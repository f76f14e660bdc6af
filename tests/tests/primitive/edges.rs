//! Shared parts of tests of pools of either structure: the scene, the rays, and every edge capacity of
//! entries and of the near-region list.

use rasray_ads::kit::{Design, Pooled};
use rasray_ads::{BuildStatus, Check, Geometry, Hit, Ray, Structure, TraceMode};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::rays::around_the_eye;
use rasray_tests::shapes::{Triangle, layers_around_the_eye};

pub const EYE: [f32; 3] = [0.0; 3];

pub fn trace(bench: &Bench, structure: &dyn Structure, rays: &[Ray]) -> Vec<Hit> {
    let (hits, counters) = trace_in_rounds(bench, structure, rays, TraceMode::Closest, 4);
    assert_eq!((counters.not_ready, counters.unfinished), (0, 0));
    hits
}

pub fn demand(status: &BuildStatus, name: &str) -> u64 {
    status.demand(name).expect("the pool is counted")
}

/// A structure over triangles, not built.
pub fn made<D: Design>(bench: &Bench, config: D::Config, geometry: &Geometry) -> Pooled<D> {
    Pooled::new(bench.device(), config, geometry, None).expect("the options are valid")
}

/// Capacity for that many entries and near triangles, and ample capacity for all else.
pub trait Capacity: Sized {
    fn capacity(entries: u64, near: u64, triangles: &[Triangle]) -> Self;
}

/// Whatever capacity there is for entries and near triangles, demands are exact, no answer is partial, and
/// what was grown from there completes with the same hits. `check` holds lists well formed.
pub fn every_edge_capacity<D>(config: D::Config, near_triangles: u64, check: impl Fn(&D::Contents, u32))
where
    D: Design,
    D::Demand: Capacity,
{
    let bench = Bench::new();
    let (triangles, rays) = (layers_around_the_eye(), around_the_eye());
    let geometry = bench.geometry(&triangles);
    let mut structure = made::<D>(&bench, config, &geometry);
    let check = |structure: &Pooled<D>| {
        let contents = structure.download(bench.device()).expect("the device works");
        check(&contents, triangles.len() as u32);
    };
    let plan =
        |entries, near| D::plan(&config, &D::Demand::capacity(entries, near, &triangles)).expect("in range");

    // Ample capacity: what the demand and the hits are.
    structure.resize(bench.device(), &plan(1 << 20, 1 << 10)).expect("it fits");
    let status = bench.build_once(&mut structure, EYE);
    assert!(status.complete);
    let (entries, near) = (demand(&status, "entries"), demand(&status, "near"));
    assert!(entries > 1000 && near == near_triangles, "{status:?}");
    check(&structure);
    let expected = trace(&bench, &structure, &rays);

    let full = [0, 1, entries / 2, entries - 1, entries].map(|capacity| (capacity, near));
    let near_full = [0, 1, near / 2, near.saturating_sub(1)].map(|capacity| (entries, capacity.min(near)));
    for (capacity, near_capacity) in full.into_iter().chain(near_full).chain([(0, 0)]) {
        structure.resize(bench.device(), &plan(capacity, near_capacity)).expect("it fits");
        let status = bench.build_once(&mut structure, EYE);
        let fits = capacity >= entries && near_capacity >= near;
        assert_eq!(status.complete, fits, "capacity for {capacity} and {near_capacity}");
        assert_eq!(
            (demand(&status, "entries"), demand(&status, "near")),
            (entries, near),
            "capacity for {capacity}"
        );
        if fits {
            assert_eq!(structure.check(&status, 0).expect("sizes that do"), Check::Complete);
            assert_eq!(trace(&bench, &structure, &rays), expected);
            continue;
        }
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, mode, 4);
            assert_eq!(
                counters.not_ready as usize,
                rays.len(),
                "capacity for {capacity} and {near_capacity}, {mode:?}"
            );
            assert!(hits.iter().all(|hit| !hit.is_hit()), "a partial answer with capacity for {capacity}");
        }
        let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
            panic!("capacity for {capacity} does not grow")
        };
        assert_eq!((sizes.elements("entries"), sizes.elements("near")), (Some(entries), Some(near)));
        structure.resize(bench.device(), &sizes).expect("it fits");
        assert!(bench.build_once(&mut structure, EYE).complete, "a build completes with its exact demand");
        check(&structure);
        assert_eq!(trace(&bench, &structure, &rays), expected, "grown from {capacity} and {near_capacity}");
    }
}

/// With pools for fewer triangles than there are, no partial structure is built.
pub fn missing_capacity_for_triangles<D>(config: D::Config)
where
    D: Design,
    D::Demand: Capacity,
{
    let bench = Bench::new();
    let (triangles, rays) = (layers_around_the_eye(), around_the_eye());
    let geometry = bench.geometry(&triangles);
    let mut structure = made::<D>(&bench, config, &geometry);
    let few = D::Demand::capacity(1 << 20, 1 << 10, &triangles[..3]);
    structure.resize(bench.device(), &D::plan(&config, &few).expect("in range")).expect("it fits");
    let status = bench.build_once(&mut structure, EYE);
    assert!(!status.complete, "{status:?}");
    let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
        panic!("{status:?} does not grow")
    };
    structure.resize(bench.device(), &sizes).expect("it fits");
    assert!(bench.build_once(&mut structure, EYE).complete);
    assert!(trace(&bench, &structure, &rays).iter().all(Hit::is_hit));
}
