//! Pools of primitive lists at every edge capacity: exact demands, no partial answers, bytes as the formula
//! says, lists well formed; and the check of lists notices every fault.

use rasray_ads::{Check, Structure};
use rasray_primitive::{
    Addressing, Builder, Config, Contents, Demand, Fault, Passes, PrimitiveLists, Storage, formula_bytes,
    plan, well_formed,
};
use rasray_tests::harness::Bench;
use rasray_tests::shapes::{NEAR_TRIANGLES, Triangle, layers_around_the_eye};

use crate::primitive::edges::{
    Capacity, EYE, demand, every_edge_capacity, made, missing_capacity_for_triangles,
};

impl Capacity for Demand {
    fn capacity(entries: u64, near: u64, triangles: &[Triangle]) -> Self {
        Self { entries, near, triangles: triangles.len() as u64 }
    }
}

fn edges_of(config: Config) {
    every_edge_capacity::<Passes>(config, NEAR_TRIANGLES, |contents, triangles| {
        well_formed(contents, triangles).expect("lists are well formed");
    });
}

fn lists(storage: Storage, addressing: Addressing) -> Config {
    Config { storage, addressing, buckets: 4, ..Config::robust(32) }
}

#[test]
fn every_edge_capacity_of_contiguous_lists() {
    edges_of(lists(Storage::Contiguous, Addressing::Descriptor));
}

#[test]
fn every_edge_capacity_of_linked_lists() {
    edges_of(lists(Storage::Linked, Addressing::Descriptor));
}

#[test]
fn every_edge_capacity_of_the_binning_builder() {
    let lists = lists(Storage::Contiguous, Addressing::Descriptor);
    edges_of(Config { builder: Builder::Binning, pyramid: false, ..lists });
}

#[test]
fn every_edge_capacity_by_address() {
    edges_of(lists(Storage::Contiguous, Addressing::Address));
    edges_of(lists(Storage::Linked, Addressing::Address));
}

#[test]
fn missing_capacity_for_triangles_is_noticed() {
    let lists = Config { storage: Storage::Linked, builder: Builder::Binning, ..Config::robust(64) };
    missing_capacity_for_triangles::<Passes>(lists);
}

/// Bytes allocated after the exact demand has been met are those of the formula.
#[test]
fn bytes_are_those_of_the_formula() {
    let bench = Bench::new();
    let triangles = layers_around_the_eye();
    let geometry = bench.geometry(&triangles);
    for (resolution, tile, buckets, storage) in [
        (16, 1, 1, Storage::Linked),
        (64, 2, 16, Storage::Contiguous),
        (50, 4, 8, Storage::Linked),
        (33, 1, 1, Storage::Contiguous),
    ] {
        let builder = if resolution == 33 { Builder::Binning } else { Builder::Raster };
        let own = Config { entries: Some(0), pyramid: resolution == 50, ..Config::robust(resolution) };
        let config = Config { tile, buckets, storage, builder, ..own };
        let mut structure: PrimitiveLists = made(&bench, config, &geometry);
        let status = bench.build_once(&mut structure, EYE);
        let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
            panic!("there is no capacity for entries")
        };
        structure.resize(bench.device(), &sizes).expect("it fits");
        let status = bench.build_once(&mut structure, EYE);
        assert!(status.complete);
        // The guess for the near-region list was larger.
        let counted = Demand {
            entries: demand(&status, "entries"),
            near: demand(&status, "near"),
            triangles: triangles.len() as u64,
        };
        structure.resize(bench.device(), &plan(&config, &counted).expect("in range")).expect("it fits");
        assert!(bench.build_once(&mut structure, EYE).complete);
        let report = structure.report().expect("the header is readable");
        let formula = formula_bytes(&config, &counted);
        assert_eq!(report.bytes(), formula.total(), "{config:?}");
        assert_eq!(report.formula_bytes, formula.total());
        assert_eq!(structure.sizes().bytes(), formula.total());
        assert_eq!(report.stored, Some(counted.entries));
        let more = Demand { entries: counted.entries + 1, ..counted };
        assert_ne!(formula.total(), formula_bytes(&config, &more).total());
    }
}

#[test]
fn every_fault_of_a_list_is_noticed() {
    let bench = Bench::new();
    let triangles = layers_around_the_eye();
    let geometry = bench.geometry(&triangles);
    let count = triangles.len() as u32;
    for storage in [Storage::Linked, Storage::Contiguous] {
        let config = Config { storage, buckets: 2, ..Config::robust(16) };
        let mut structure: PrimitiveLists = made(&bench, config, &geometry);
        let sizes = plan(&config, &Demand::capacity(1 << 20, 64, &triangles)).expect("in range");
        structure.resize(bench.device(), &sizes).expect("it fits");
        assert!(bench.build_once(&mut structure, EYE).complete);
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
        // The first list with two entries has its first triangle twice.
        let twice = broken(|c| match c.config.storage {
            Storage::Contiguous => {
                let lists = &c.lists;
                let list = (1..lists.len()).find(|&k| lists[k] >= lists[k - 1] + 2).expect("a list");
                let place = lists[list - 1] as usize;
                c.entries[place] = c.entries[place + 1];
            }
            Storage::Linked => {
                let entries = &c.entries;
                let long = |head: &&u32| **head != 0 && entries[2 * **head as usize - 1] != 0;
                let head = *c.lists.iter().find(long).expect("a list") as usize - 1;
                c.entries[2 * head] = c.entries[2 * (c.entries[2 * head + 1] as usize - 1)];
            }
        });
        assert!(matches!(twice, Fault::Twice { .. }), "{twice:?}");
    }
}
