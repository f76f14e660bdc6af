//! Pools of every edge capacity: exact demands, no partial answers, bytes as the formula says, lists well
//! formed; and the check of lists notices every fault.

use rasray_ads::kit::VARYING_SHARE;
use rasray_ads::{Check, Hit, Ray, Structure, TraceMode};
use rasray_tests::capacity::{complete_grown, spread_of_pages};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, layers_in_a_room};
use rasray_tests::tier::in_turn;
use rasray_tests::voxels::{hu, made, selective};
use rasray_voxel::{
    Accept, Addressing, Axes, Config, Contents, Coverage, Demand, Fault, March, Storage, Voxels,
    formula_bytes, plan, well_formed,
};

fn trace(bench: &Bench, structure: &Voxels, rays: &[Ray]) -> Vec<Hit> {
    let (hits, counters) = trace_in_rounds(bench, structure, rays, TraceMode::Closest, 4);
    assert_eq!((counters.not_ready, counters.unfinished), (0, 0));
    hits
}

/// Capacity for that many fragments.
fn capacity(entries: u64) -> Demand {
    Demand { entries, ..Demand::default() }
}

fn every_edge_capacity(config: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (layers_in_a_room([-10.0; 3], [10.0; 3]), Random::new(3).rays(400, -5.0, 5.0));
    let mut structure = made(&bench, config, &triangles);

    // Ample capacity: what the demand and the hits are.
    structure.resize(bench.device(), &plan(&config, capacity(1 << 20)).expect("in range")).expect("it fits");
    let status = bench.build_once(&mut structure, [0.0; 3]);
    assert!(status.complete, "{status:?}");
    let demand = status.pools[0].demand;
    assert!(demand > 500, "{status:?}");
    let contents = structure.download(bench.device()).expect("the device works");
    well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
    let expected = trace(&bench, &structure, &rays);
    assert!(expected.iter().filter(|hit| hit.is_hit()).count() > rays.len() / 2);

    // Pages come with a little more capacity: the number of begun pages depends on which threads collide.
    let pages = config.storage == Storage::Paged;
    let spread = if pages { spread_of_pages(bench.device(), demand) } else { 0 };
    for entries in [0, 1, demand / 2, demand - spread - 1, demand + spread] {
        structure
            .resize(bench.device(), &plan(&config, capacity(entries)).expect("in range"))
            .expect("it fits");
        let status = bench.build_once(&mut structure, [0.0; 3]);
        assert_eq!(status.complete, entries >= demand, "capacity for {entries}");
        assert_eq!(status.pools[0].capacity, entries);
        let found = status.pools[0].demand;
        assert!(found.abs_diff(demand) <= spread, "capacity for {entries}: {found} for {demand}");
        if entries >= demand {
            assert_eq!(structure.check(&status, 0).expect("sizes that do"), Check::Complete);
            assert_eq!(trace(&bench, &structure, &rays), expected);
            continue;
        }
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, mode, 4);
            assert_eq!(counters.not_ready as usize, rays.len(), "capacity for {entries}, {mode:?}");
            assert!(hits.iter().all(|hit| !hit.is_hit()), "a partial answer with capacity for {entries}");
        }
        let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
            panic!("capacity for {entries} does not grow")
        };
        let more = if pages { found / VARYING_SHARE } else { 0 };
        assert_eq!(sizes.elements("fragments"), Some(found + more));
        structure.resize(bench.device(), &sizes).expect("it fits");
        complete_grown(&bench, &mut structure, [0.0; 3].into(), spread > 0);
        let contents = structure.download(bench.device()).expect("the device works");
        well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
        assert_eq!(trace(&bench, &structure, &rays), expected, "grown from {entries}");
    }
}

#[test]
fn every_edge_capacity_of_one_view_a_triangle() {
    every_edge_capacity(Config::at_centres(32));
}

#[test]
fn every_edge_capacity_of_all_views() {
    every_edge_capacity(hu(32));
}

#[test]
fn every_edge_capacity_of_one_view_a_voxel() {
    every_edge_capacity(selective(32));
}

#[test]
fn every_edge_capacity_of_every_storage() {
    for (index, storage) in Storage::ALL.into_iter().enumerate() {
        let tried = [
            Config { storage, ..Config::at_centres(32) },
            Config { storage, march: March::Exact, ..hu(24) },
            Config { storage, page: 3, coverage: Coverage::Conservative, ..Config::at_centres(20) },
        ];
        for &config in in_turn(&tried, index) {
            every_edge_capacity(config);
        }
    }
}

#[test]
fn every_edge_capacity_by_address() {
    for (index, storage) in Storage::ALL.into_iter().enumerate() {
        let tried = [Config::at_centres(32), selective(32)];
        for &config in in_turn(&tried, index) {
            every_edge_capacity(Config { storage, addressing: Addressing::Address, ..config });
        }
    }
}

/// Bytes allocated after the exact demand has been met are those of the formula.
#[test]
fn bytes_are_those_of_the_formula() {
    let bench = Bench::new();
    let triangles = layers_in_a_room([-10.0; 3], [10.0; 3]);
    for config in [
        Config { sort: false, ..Config::at_centres(16) },
        Config { grid: Some(9), ..hu(33) },
        selective(50),
        Config { storage: Storage::Paged, page: 8, ..Config::at_centres(40) },
        Config { storage: Storage::Linked, ..Config::at_centres(40) },
        Config { storage: Storage::Contiguous, ..selective(40) },
    ] {
        let mut structure = made(&bench, config, &triangles);
        structure.resize(bench.device(), &plan(&config, capacity(0)).expect("in range")).expect("it fits");
        let status = bench.build_once(&mut structure, [0.0; 3]);
        assert!(
            matches!(structure.check(&status, 0).expect("sizes that do"), Check::Grow(_)),
            "there is no capacity for anything"
        );
        let found = status.pools[0].demand;
        let pages = config.storage == Storage::Paged;
        let spread = if pages { spread_of_pages(bench.device(), found) } else { 0 };
        let given = capacity(found + spread);
        structure.resize(bench.device(), &plan(&config, given).expect("in range")).expect("it fits");
        let status = bench.build_once(&mut structure, [0.0; 3]);
        assert!(status.complete);
        let report = structure.report().expect("the header is readable");
        let demand = status.pools[0].demand;
        assert!(demand.abs_diff(found) <= spread, "{config:?}: {demand} for {found}");
        let formula = formula_bytes(&config, capacity(demand));
        assert_eq!(report.bytes(), formula_bytes(&config, given).total(), "{config:?}");
        assert_eq!(report.formula_bytes, formula.total());
        assert_eq!(structure.sizes().bytes(), report.bytes());
        assert_ne!(formula.total(), formula_bytes(&config, capacity(demand + 1)).total());
        let stored = report.stored.expect("fragments are counted");
        match config.storage {
            Storage::Contiguous | Storage::Linked => assert_eq!(stored, demand),
            Storage::Paged => {
                assert!(demand < stored && stored < demand * u64::from(config.page), "{stored} in {demand}")
            }
        }
    }
}

/// Ten thousand fragments in a cell are sorted in part per dispatch, once there is capacity for such
/// lists, or stay as they are; planes find each layer, and parities the same whatever the order.
#[test]
fn lists_of_ten_thousand_are_searched() {
    const LAYERS: usize = 10_000;
    let bench = Bench::new();
    // Two cells along a side: one plate covers one centre. From far to near, and not in order.
    let depth = |layer: usize| layer as f32 * 1.0e-4;
    let plate = |z: f32| [[0.0, 0.0, z], [1.4, 0.0, z], [0.0, 1.4, z]];
    let mut triangles: Vec<Triangle> = (0..LAYERS).map(|k| plate(depth(k * 7919 % LAYERS))).collect();
    triangles.push([[1.9, 1.9, 0.0], [2.0, 1.9, 0.0], [1.9, 2.0, 0.0]]);
    let rays: Vec<Ray> = (0..64)
        .map(|k| {
            let (behind, direction) = (k * 155 + 1, if k % 2 == 0 { 1.0 } else { -1.0 });
            Ray::new([0.4, 0.3, depth(behind) + 5.0e-5], [0.0, 0.0, direction])
        })
        .collect();
    let base = Config { fragments: Some(1 << 16), ..Config::at_centres(2) };
    let published = Config { fragments: Some(1 << 16), storage: Storage::Contiguous, ..hu(2) };
    let marched = Config { march: March::Exact, axes: Axes::Triangle, ..published };
    let mut parities = [None, None];
    for config in [base, published, marched].into_iter().flat_map(|config| {
        let others = [Storage::Linked, Storage::Paged].map(|storage| Config { storage, ..config });
        [config, Config { sort: false, ..config }, others[0], others[1]]
    }) {
        let mut structure = made(&bench, config, &triangles);
        let mut status = bench.build_once(&mut structure, [0.0; 3]);
        if config.sorts() {
            let long = status.demand("long").expect("the pool is counted");
            assert!(!status.complete && long > 0 && status.unsorted == 0, "{status:?}");
            let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
                panic!("there is no capacity for long lists")
            };
            structure.resize(bench.device(), &sizes).expect("it fits");
            status = bench.build_once(&mut structure, [0.0; 3]);
        }
        assert!(status.complete && status.unsorted == 0, "{status:?}");
        let contents = structure.download(bench.device()).expect("the device works");
        well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
        assert!(
            (0..contents.lists.len()).any(|list| contents.list(list).expect("well formed").len() == LAYERS)
        );
        let hits = bench.trace(&structure, &rays).hits;
        if config.accept == Accept::Plane {
            for (k, hit) in hits.iter().enumerate() {
                let layer = if k % 2 == 0 { k * 155 + 2 } else { k * 155 + 1 };
                assert_eq!(hit.primitive as usize * 7919 % LAYERS, layer, "{hit:?}");
            }
            continue;
        }
        // The first is that of sorted lists.
        let expected =
            parities[usize::from(config.march == March::Exact)].get_or_insert_with(|| hits.clone());
        assert_eq!(hits, *expected, "{config:?}");
        assert!(hits.iter().filter(|hit| hit.is_hit()).count() > rays.len() / 4, "{config:?}");
    }
}

#[test]
fn every_fault_of_a_list_is_noticed() {
    let bench = Bench::new();
    let triangles = layers_in_a_room([-10.0; 3], [10.0; 3]);
    let count = triangles.len() as u32;
    for config in [Config::at_centres(16), selective(16), hu(16)] {
        let storage = config.storage;
        let mut structure = made(&bench, Config { fragments: Some(1 << 16), ..config }, &triangles);
        assert!(bench.build_once(&mut structure, [0.0; 3]).complete);
        let good = structure.download(bench.device()).expect("the device works");
        well_formed(&good, count).expect("lists are well formed");
        // The first list with more fragments than a page has capacity for, at different depths.
        let is_long = |list: &usize| {
            let fragments = good.list(*list).expect("well formed");
            fragments.len() > config.page as usize && fragments[0].z != fragments[1].z
        };
        let long = (0..good.lists.len()).find(is_long).expect("a long list");
        let other = (long + 1..good.lists.len()).find(is_long).expect("another one");
        let places = good.places(long).expect("well formed");
        // A fragment is two words; a link is another one behind them, and in front of the four of a page.
        let word = |place: u32| match storage {
            Storage::Contiguous => 2 * place as usize,
            Storage::Linked => 3 * place as usize,
            Storage::Paged => (place / 4 * 9 + 1 + place % 4 * 2) as usize,
        };
        let first = word(places[0]);
        let broken = |change: &dyn Fn(&mut Contents)| {
            let mut contents = good.clone();
            change(&mut contents);
            well_formed(&contents, count).expect_err("the fault is noticed")
        };
        assert!(matches!(broken(&|c| c.lists[20] = u32::MAX), Fault::Dangling { .. }));
        assert!(matches!(broken(&|c| c.fragments[first + 1] = count), Fault::Primitive { .. }));
        assert!(matches!(broken(&|c| c.fragments[first] = f32::NAN.to_bits()), Fault::Depth { .. }));
        assert!(matches!(broken(&|c| c.fragments[first] = (-1.0_f32).to_bits()), Fault::Depth { .. }));
        assert!(matches!(broken(&|c| c.header.fragments += 1), Fault::Count { .. }));
        let marked = good.voxels.iter().position(|word| word & 15 != 0).expect("something lies in a voxel");
        assert!(matches!(broken(&|c| c.voxels[marked] &= !7), Fault::Voxel { .. }));
        match storage {
            Storage::Contiguous => {
                assert!(matches!(broken(&|c| c.fragments.swap(first, first + 2)), Fault::Order { .. }));
            }
            Storage::Linked => {
                assert!(matches!(broken(&|c| c.fragments[first + 2] = places[0] + 1), Fault::Circle { .. }));
                let last = word(*places.last().expect("it is long"));
                assert!(matches!(broken(&|c| c.fragments[last + 2] = c.lists[long]), Fault::Circle { .. }));
                let past = good.header.demand + 1;
                assert!(matches!(broken(&|c| c.fragments[last + 2] = past), Fault::Dangling { .. }));
                assert!(matches!(broken(&|c| c.lists[other] = c.lists[long]), Fault::Shared { .. }));
                assert!(matches!(broken(&|c| c.fragments[first + 2] = 0), Fault::Count { .. }));
            }
            Storage::Paged => {
                let page = places[0] as usize / 4 * 9;
                assert!(matches!(broken(&|c| c.fragments[page] = c.lists[long]), Fault::Circle { .. }));
                let past = (good.header.demand + 1) << 4 | 1;
                assert!(matches!(broken(&|c| c.fragments[page] = past), Fault::Dangling { .. }));
                assert!(matches!(broken(&|c| c.lists[long] &= !15), Fault::Page { used: 0, .. }));
                assert!(matches!(
                    broken(&|c| c.lists[long] = c.lists[long] & !15 | 5),
                    Fault::Page { used: 5, .. }
                ));
                assert!(matches!(broken(&|c| c.lists[other] = c.lists[long]), Fault::Shared { .. }));
                assert!(matches!(broken(&|c| c.fragments[page] = 0), Fault::Count { .. }));
            }
        }
    }
}
