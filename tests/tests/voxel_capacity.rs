//! Pools of every edge capacity: exact demands, no partial answers, bytes as the formula says, lists well
//! formed; and the check of lists notices every fault.

use rasray_ads::{BuildStatus, Check, Hit, Ray, Structure, TraceMode};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::hard_cases::{self, Scale};
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box};
use rasray_voxel::{Addressing, Config, Contents, Fault, Storage, Voxels, formula_bytes, plan, well_formed};

/// Layers, and a room around them.
fn scene() -> Vec<Triangle> {
    let mut triangles = hard_cases::case("C4", Scale::QUICK).expect("the case exists").triangles;
    triangles.extend(closed_box([-10.0; 3], [10.0; 3]));
    triangles
}

fn rays() -> Vec<Ray> {
    let mut random = Random::new(3);
    (0..400).map(|_| Ray::new(random.point(-5.0, 5.0), random.direction())).collect()
}

/// Builds once, with the pools as they are.
fn build(bench: &Bench, structure: &mut Voxels) -> BuildStatus {
    bench
        .device()
        .submit(|recorder| structure.record_build(recorder, [0.0; 3].into()))
        .expect("the device works")
        .value
        .expect("the header is written");
    structure.status().expect("the header is readable")
}

fn trace(bench: &Bench, structure: &Voxels, rays: &[Ray]) -> Vec<Hit> {
    let (hits, counters) = trace_in_rounds(bench, structure, rays, TraceMode::Closest, 4);
    assert_eq!((counters.not_ready, counters.unfinished), (0, 0));
    hits
}

fn made(bench: &Bench, config: Config, triangles: &[Triangle]) -> Voxels {
    let geometry = bench.geometry(triangles);
    Voxels::new(bench.device(), config, &geometry, None).expect("the options are valid")
}

fn every_edge_capacity(config: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (scene(), rays());
    let mut structure = made(&bench, config, &triangles);

    // Ample room: what the demand and the hits are.
    structure.resize(bench.device(), &plan(&config, 1 << 20).expect("in range")).expect("it fits");
    let status = build(&bench, &mut structure);
    assert!(status.complete, "{status:?}");
    let demand = status.pools[0].demand;
    assert!(demand > 1000, "{status:?}");
    let contents = structure.download(bench.device()).expect("the device works");
    well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
    let expected = trace(&bench, &structure, &rays);
    assert!(expected.iter().filter(|hit| hit.is_hit()).count() > rays.len() / 2);

    for room in [0, 1, demand / 2, demand - 1, demand] {
        structure.resize(bench.device(), &plan(&config, room).expect("in range")).expect("it fits");
        let status = build(&bench, &mut structure);
        assert_eq!(status.complete, room == demand, "room for {room}");
        assert_eq!((status.pools[0].demand, status.pools[0].capacity), (demand, room));
        if room == demand {
            assert_eq!(structure.check(&status), Check::Complete);
            assert_eq!(trace(&bench, &structure, &rays), expected);
            continue;
        }
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, mode, 4);
            assert_eq!(counters.not_ready as usize, rays.len(), "room for {room}, {mode:?}");
            assert!(hits.iter().all(|hit| !hit.is_hit()), "a partial answer with room for {room}");
        }
        let Check::Grow(sizes) = structure.check(&status) else { panic!("room for {room} does not grow") };
        assert_eq!(sizes.elements("fragments"), demand);
        structure.resize(bench.device(), &sizes).expect("it fits");
        assert!(build(&bench, &mut structure).complete, "a build completes with its exact demand");
        let contents = structure.download(bench.device()).expect("the device works");
        well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
        assert_eq!(trace(&bench, &structure, &rays), expected, "grown from {room}");
    }
}

#[test]
fn every_edge_capacity_of_one_view_a_triangle() {
    every_edge_capacity(Config::robust(32));
}

#[test]
fn every_edge_capacity_of_all_views() {
    every_edge_capacity(Config::published_hu(32));
}

#[test]
fn every_edge_capacity_of_pages() {
    every_edge_capacity(Config::published_selective(32));
}

#[test]
fn every_edge_capacity_by_address() {
    every_edge_capacity(Config { addressing: Addressing::Address, ..Config::robust(32) });
    every_edge_capacity(Config { addressing: Addressing::Address, ..Config::published_selective(32) });
}

/// What is allocated after the exact demand has been met is what the formula says.
#[test]
fn bytes_are_those_of_the_formula() {
    let bench = Bench::new();
    let triangles = scene();
    for config in [
        Config { sort: false, ..Config::robust(16) },
        Config { grid: Some(9), ..Config::published_hu(33) },
        Config::published_selective(50),
        Config { storage: Storage::Paged, page: 8, ..Config::robust(40) },
    ] {
        let mut structure = made(&bench, config, &triangles);
        structure.resize(bench.device(), &plan(&config, 0).expect("in range")).expect("it fits");
        let status = build(&bench, &mut structure);
        let Check::Grow(sizes) = structure.check(&status) else { panic!("there is no room for anything") };
        structure.resize(bench.device(), &sizes).expect("it fits");
        let status = build(&bench, &mut structure);
        assert!(status.complete);
        let report = structure.report().expect("the header is readable");
        let demand = status.pools[0].demand;
        let formula = formula_bytes(&config, demand);
        assert_eq!(report.bytes(), formula.total(), "{config:?}");
        assert_eq!(report.formula_bytes, formula.total());
        assert_eq!(structure.sizes().bytes(), formula.total());
        assert_ne!(formula.total(), formula_bytes(&config, demand + 1).total());
        let stored = report.stored.expect("fragments are counted");
        match config.storage {
            Storage::Contiguous => assert_eq!(stored, demand),
            Storage::Paged => {
                assert!(stored < demand && demand < stored * u64::from(config.page), "{stored} of {demand}")
            }
        }
    }
}

/// Lists longer than what is sorted are searched in full with planes, and refused with parities.
#[test]
fn lists_too_long_to_sort_are_counted() {
    let bench = Bench::new();
    let plate = |z: f32| [[-1.0, -1.0, z], [1.0, -1.0, z], [0.0, 1.0, z]];
    let triangles: Vec<Triangle> = (0..2100).map(|k| plate(k as f32 * 1e-3)).collect();
    let mut structure = made(&bench, Config { fragments: Some(1 << 16), ..Config::robust(4) }, &triangles);
    let status = build(&bench, &mut structure);
    assert!(status.complete && status.unsorted > 0, "{status:?}");
    let rays: Vec<Ray> = (0..50)
        .map(|k| Ray::new([0.01 * k as f32 - 0.2, -0.1, 0.04 * k as f32 + 5e-4], [0.0, 0.0, 1.0]))
        .collect();
    for (k, hit) in bench.trace(&structure, &rays).hits.iter().enumerate() {
        assert_eq!(hit.primitive as usize, 40 * k + 1, "{hit:?}");
    }
    let mut structure =
        made(&bench, Config { fragments: Some(1 << 16), ..Config::published_hu(4) }, &triangles);
    let status = build(&bench, &mut structure);
    assert!(!status.complete && status.unsorted > 0, "{status:?}");
    assert_eq!(structure.check(&status), Check::Complete, "more room does not help");
}

#[test]
fn every_fault_of_a_list_is_noticed() {
    let bench = Bench::new();
    let triangles = scene();
    let count = triangles.len() as u32;
    for config in [Config::robust(16), Config::published_selective(16)] {
        let mut structure = made(&bench, Config { fragments: Some(1 << 16), ..config }, &triangles);
        assert!(build(&bench, &mut structure).complete);
        let good = structure.download(bench.device()).expect("the device works");
        well_formed(&good, count).expect("lists are well formed");
        // The first list with two fragments at different depths.
        let is_long = |list: &usize| {
            let fragments = good.list(*list).expect("well formed");
            fragments.len() > 1 && fragments[0].z < fragments[1].z
        };
        let long = (0..good.lists.len()).find(is_long).expect("a long list");
        let first = good.lists[long] as usize - good.list(long).expect("well formed").len();
        let broken = |change: &dyn Fn(&mut Contents)| {
            let mut contents = good.clone();
            change(&mut contents);
            well_formed(&contents, count).expect_err("the fault is noticed")
        };
        assert!(matches!(broken(&|c| c.lists[20] = u32::MAX), Fault::Dangling { .. }));
        assert!(matches!(broken(&|c| c.fragments[2 * first + 1] = count), Fault::Primitive { .. }));
        assert!(matches!(broken(&|c| c.fragments[2 * first] = f32::NAN.to_bits()), Fault::Depth { .. }));
        assert!(matches!(broken(&|c| c.fragments[2 * first] = (-1.0_f32).to_bits()), Fault::Depth { .. }));
        assert!(matches!(broken(&|c| c.fragments.swap(2 * first, 2 * first + 2)), Fault::Order { .. }));
        assert!(matches!(broken(&|c| c.header.fragments += 1), Fault::Count { .. }));
        let marked = good.voxels.iter().position(|word| word & 15 != 0).expect("something lies in a voxel");
        assert!(matches!(broken(&|c| c.voxels[marked] &= !7), Fault::Voxel { .. }));
    }
}
