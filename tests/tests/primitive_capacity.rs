//! Pools of every edge capacity: exact demands, no partial answers, bytes as the formula says, lists well
//! formed; and the check of lists notices every fault.

use rasray_ads::{BuildStatus, Check, Hit, Ray, Structure, TraceMode};
use rasray_ads_primitive::{
    Addressing, Config, Contents, Fault, PrimitiveLists, Storage, formula_bytes, plan, well_formed,
};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::hard_cases::{self, Scale};
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box};

const EYE: [f32; 3] = [0.0; 3];
const NEAR_TRIANGLES: u64 = 5;

/// Layers, a room, and triangles around the eye for the near list.
fn scene() -> Vec<Triangle> {
    let mut triangles = hard_cases::case("C4", Scale::QUICK).expect("the case exists").triangles;
    triangles.extend(closed_box([-10.0; 3], [10.0; 3]));
    for k in 0..NEAR_TRIANGLES {
        let z = 1.0e-5 * (k as f32 - 2.0) + 1.0e-6;
        triangles.push([[-0.02, -0.02, z], [0.02, -0.02, z], [0.0, 0.03, z]]);
    }
    triangles
}

fn rays() -> Vec<Ray> {
    let mut random = Random::new(3);
    (0..500).map(|_| Ray::new(random.point(-0.5, 0.5), random.direction())).collect()
}

/// Builds once, with the pools as they are.
fn build(bench: &Bench, structure: &mut PrimitiveLists) -> BuildStatus {
    bench
        .device()
        .submit(|recorder| structure.record_build(recorder, EYE))
        .expect("the device works")
        .value
        .expect("the header is written");
    structure.status().expect("the header is readable")
}

fn trace(bench: &Bench, structure: &PrimitiveLists, rays: &[Ray]) -> Vec<Hit> {
    let (hits, counters) = trace_in_rounds(bench, structure, rays, TraceMode::Closest, 4);
    assert_eq!((counters.not_ready, counters.unfinished), (0, 0));
    hits
}

fn demand(status: &BuildStatus, name: &str) -> u64 {
    status.pools.iter().find(|pool| pool.name == name).expect("the pool is counted").demand
}

fn made(bench: &Bench, config: Config, triangles: &[Triangle]) -> PrimitiveLists {
    let geometry = bench.geometry(triangles);
    PrimitiveLists::new(bench.device(), config, &geometry, None).expect("the options are valid")
}

fn every_edge_capacity(storage: Storage, addressing: Addressing) {
    let bench = Bench::new();
    let (triangles, rays) = (scene(), rays());
    let config = Config { storage, addressing, buckets: 4, ..Config::robust(32) };
    let mut structure = made(&bench, config, &triangles);

    // Ample room: what the demand and the hits are.
    structure.resize(bench.device(), &plan(&config, 1 << 20, 1 << 10).expect("in range")).expect("it fits");
    let status = build(&bench, &mut structure);
    assert!(status.complete);
    let (entries, near) = (demand(&status, "entries"), demand(&status, "near"));
    assert!(entries > 1000 && near == NEAR_TRIANGLES, "{status:?}");
    let contents = structure.download(bench.device()).expect("the device works");
    well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
    let expected = trace(&bench, &structure, &rays);

    let full = [0, 1, entries / 2, entries - 1, entries].map(|capacity| (capacity, near));
    let near_full = [0, 1, near - 1].map(|capacity| (entries, capacity));
    for (room, near_room) in full.into_iter().chain(near_full).chain([(0, 0)]) {
        let sizes = plan(&config, room, near_room).expect("in range");
        structure.resize(bench.device(), &sizes).expect("it fits");
        let status = build(&bench, &mut structure);
        let fits = room >= entries && near_room >= near;
        assert_eq!(status.complete, fits, "room for {room} and {near_room}");
        assert_eq!((demand(&status, "entries"), demand(&status, "near")), (entries, near), "room for {room}");
        if fits {
            assert_eq!(structure.check(&status), Check::Complete);
            assert_eq!(trace(&bench, &structure, &rays), expected);
            continue;
        }
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, mode, 4);
            assert_eq!(counters.not_ready as usize, rays.len(), "room for {room} and {near_room}, {mode:?}");
            assert!(hits.iter().all(|hit| !hit.is_hit()), "a partial answer with room for {room}");
        }
        let Check::Grow(sizes) = structure.check(&status) else { panic!("room for {room} does not grow") };
        assert_eq!((sizes.elements("entries"), sizes.elements("near")), (entries, near));
        structure.resize(bench.device(), &sizes).expect("it fits");
        assert!(build(&bench, &mut structure).complete, "a build completes with its exact demand");
        let contents = structure.download(bench.device()).expect("the device works");
        well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
        assert_eq!(trace(&bench, &structure, &rays), expected, "grown from {room} and {near_room}");
    }
}

#[test]
fn every_edge_capacity_of_contiguous_lists() {
    every_edge_capacity(Storage::Contiguous, Addressing::Descriptor);
}

#[test]
fn every_edge_capacity_of_linked_lists() {
    every_edge_capacity(Storage::Linked, Addressing::Descriptor);
}

#[test]
fn every_edge_capacity_by_address() {
    every_edge_capacity(Storage::Contiguous, Addressing::Address);
    every_edge_capacity(Storage::Linked, Addressing::Address);
}

/// What is allocated after the exact demand has been met is what the formula says.
#[test]
fn bytes_are_those_of_the_formula() {
    let bench = Bench::new();
    let triangles = scene();
    for (resolution, tile, buckets, storage) in [
        (16, 1, 1, Storage::Linked),
        (64, 2, 16, Storage::Contiguous),
        (50, 4, 8, Storage::Linked),
        (33, 1, 1, Storage::Contiguous),
    ] {
        let config = Config { tile, buckets, storage, entries: Some(0), ..Config::robust(resolution) };
        let mut structure = made(&bench, config, &triangles);
        structure.resize(bench.device(), &plan(&config, 0, 0).expect("in range")).expect("it fits");
        let status = build(&bench, &mut structure);
        let Check::Grow(sizes) = structure.check(&status) else { panic!("there is no room for anything") };
        structure.resize(bench.device(), &sizes).expect("it fits");
        let status = build(&bench, &mut structure);
        assert!(status.complete);
        let report = structure.report().expect("the header is readable");
        let formula = formula_bytes(&config, demand(&status, "entries"), demand(&status, "near"));
        assert_eq!(report.bytes(), formula.total(), "{config:?}");
        assert_eq!(report.formula_bytes, formula.total());
        assert_eq!(structure.sizes().bytes(), formula.total());
        assert_eq!(report.stored, Some(demand(&status, "entries")));
        assert_ne!(formula.total(), formula_bytes(&config, demand(&status, "entries") + 1, 5).total());
    }
}

#[test]
fn every_fault_of_a_list_is_noticed() {
    let bench = Bench::new();
    let triangles = scene();
    let count = triangles.len() as u32;
    for storage in [Storage::Linked, Storage::Contiguous] {
        let config = Config { storage, buckets: 2, ..Config::robust(16) };
        let mut structure = made(&bench, config, &triangles);
        structure.resize(bench.device(), &plan(&config, 1 << 20, 64).expect("in range")).expect("it fits");
        assert!(build(&bench, &mut structure).complete);
        let good = structure.download(bench.device()).expect("the device works");
        well_formed(&good, count).expect("lists are well formed");
        let broken = |change: fn(&mut Contents)| {
            let mut contents = good.clone();
            change(&mut contents);
            well_formed(&contents, count).expect_err("the fault is noticed")
        };
        assert!(matches!(broken(|c| c.lists[20] = u32::MAX), Fault::Dangling { .. }));
        assert!(matches!(broken(|c| c.entries[0] = u32::MAX), Fault::Primitive { .. }));
        assert!(matches!(broken(|c| c.header.demand += 1), Fault::Count { .. }));
        let twice = broken(|c| {
            // The first list with two entries names its first triangle twice.
            let (step, place) = match c.config.storage {
                Storage::Contiguous => {
                    let lists = &c.lists;
                    let list = (1..lists.len()).find(|&k| lists[k] >= lists[k - 1] + 2).expect("a list");
                    (1, lists[list - 1] as usize)
                }
                Storage::Linked => {
                    let entries = &c.entries;
                    let long = |head: &&u32| **head != 0 && entries[2 * **head as usize - 1] != 0;
                    let head = *c.lists.iter().find(long).expect("a list") as usize - 1;
                    c.entries[2 * head] = c.entries[2 * (c.entries[2 * head + 1] as usize - 1)];
                    (0, 0)
                }
            };
            if step == 1 {
                c.entries[place] = c.entries[place + 1];
            }
        });
        assert!(matches!(twice, Fault::Twice { .. }), "{twice:?}");
    }
}
