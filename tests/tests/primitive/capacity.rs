//! Pools of every edge capacity: exact demands, no partial answers, bytes as the formula says, lists well
//! formed; and the check of lists notices every fault.

use rasray_ads::{BuildStatus, Check, Hit, Ray, Structure, TraceMode};
use rasray_ads_primitive::{
    Addressing, Builder, Config, Contents, Demand, Fault, PrimitiveLists, Storage, Views, formula_bytes,
    plan, well_formed,
};
use rasray_gpu::Timing;
use rasray_shaders_glsl::constants::ads::BRICK_EMPTY;
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::hard_cases::{self, Scale};
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box};
use rasray_tracer::build_until_complete;

const EYE: [f32; 3] = [0.0; 3];
const NEAR_TRIANGLES: u64 = 5;

/// Cells along each side of the scene where they are along the axes.
const GRID: u32 = 16;

/// Bricks along the axes.
fn along_axes() -> Config {
    Config { views: Views::Axes, grid: Some(GRID), ..Config::robust(32) }
}

/// Room for that many entries and near triangles, and for as many records and cells as may come with them.
fn room(entries: u64, near: u64, triangles: &[Triangle]) -> Demand {
    Demand {
        entries,
        near,
        records: 1 << 16,
        cells: 1 << 16,
        triangles: triangles.len() as u64,
        grid: [GRID; 3],
    }
}

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

fn trace(bench: &Bench, structure: &PrimitiveLists, rays: &[Ray]) -> Vec<Hit> {
    let (hits, counters) = trace_in_rounds(bench, structure, rays, TraceMode::Closest, 4);
    assert_eq!((counters.not_ready, counters.unfinished), (0, 0));
    hits
}

fn demand(status: &BuildStatus, name: &str) -> u64 {
    status.demand(name).expect("the pool is counted")
}

fn made(bench: &Bench, config: Config, triangles: &[Triangle]) -> PrimitiveLists {
    let geometry = bench.geometry(triangles);
    PrimitiveLists::new(bench.device(), config, &geometry, None).expect("the options are valid")
}

fn every_edge_capacity(storage: Storage, addressing: Addressing) {
    every_edge_capacity_of(Config { storage, addressing, buckets: 4, ..Config::robust(32) });
}

fn every_edge_capacity_of(config: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (scene(), rays());
    let mut structure = made(&bench, config, &triangles);

    // Ample room: what the demand and the hits are.
    structure
        .resize(bench.device(), &plan(&config, &room(1 << 20, 1 << 10, &triangles)).expect("in range"))
        .expect("it fits");
    let status = bench.build_once(&mut structure, EYE);
    assert!(status.complete);
    let (entries, near) = (demand(&status, "entries"), demand(&status, "near"));
    let expected_near = if config.views == Views::Axes { 0 } else { NEAR_TRIANGLES };
    assert!(entries > 1000 && near == expected_near, "{status:?}");
    let contents = structure.download(bench.device()).expect("the device works");
    well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
    let expected = trace(&bench, &structure, &rays);

    let full = [0, 1, entries / 2, entries - 1, entries].map(|capacity| (capacity, near));
    let near_full = [0, 1, near / 2, near.saturating_sub(1)].map(|capacity| (entries, capacity.min(near)));
    for (room, near_room) in full.into_iter().chain(near_full).chain([(0, 0)]) {
        let sizes = plan(&config, &self::room(room, near_room, &triangles)).expect("in range");
        structure.resize(bench.device(), &sizes).expect("it fits");
        let status = bench.build_once(&mut structure, EYE);
        let fits = room >= entries && near_room >= near;
        assert_eq!(status.complete, fits, "room for {room} and {near_room}");
        assert_eq!((demand(&status, "entries"), demand(&status, "near")), (entries, near), "room for {room}");
        if fits {
            assert_eq!(structure.check(&status, 0).expect("sizes that do"), Check::Complete);
            assert_eq!(trace(&bench, &structure, &rays), expected);
            continue;
        }
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, mode, 4);
            assert_eq!(counters.not_ready as usize, rays.len(), "room for {room} and {near_room}, {mode:?}");
            assert!(hits.iter().all(|hit| !hit.is_hit()), "a partial answer with room for {room}");
        }
        let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
            panic!("room for {room} does not grow")
        };
        assert_eq!((sizes.elements("entries"), sizes.elements("near")), (entries, near));
        structure.resize(bench.device(), &sizes).expect("it fits");
        assert!(bench.build_once(&mut structure, EYE).complete, "a build completes with its exact demand");
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

/// Those that are not the usual ones of their storages.
#[test]
fn every_edge_capacity_of_either_builder() {
    let lists = Config { buckets: 4, builder: Some(Builder::Binning), pyramid: true, ..Config::robust(32) };
    every_edge_capacity_of(Config { storage: Storage::Contiguous, ..lists });
    every_edge_capacity_of(Config { builder: Some(Builder::Raster), ..Config::robust(32) });
}

#[test]
fn every_edge_capacity_by_address() {
    every_edge_capacity(Storage::Contiguous, Addressing::Address);
    every_edge_capacity(Storage::Linked, Addressing::Address);
    every_edge_capacity(Storage::Bricks, Addressing::Address);
}

#[test]
fn every_edge_capacity_of_bricks() {
    every_edge_capacity(Storage::Bricks, Addressing::Descriptor);
    every_edge_capacity_of(along_axes());
}

/// Records and lists of bricks at every edge: whatever there is room for, the next build completes, with the same hits.
#[test]
fn bricks_grow_from_any_room_to_what_they_need() {
    for config in [Config::robust(32), along_axes()] {
        bricks_grow(config);
    }
}

fn bricks_grow(config: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (scene(), rays());
    let mut structure = made(&bench, config, &triangles);
    let ample = room(1 << 20, 1 << 10, &triangles);
    structure.resize(bench.device(), &plan(&config, &ample).expect("in range")).expect("it fits");
    let status = bench.build_once(&mut structure, EYE);
    assert!(status.complete);
    let (records, cells) = (demand(&status, "records"), demand(&status, "lists"));
    assert!(cells > 500 && records > cells / 2 && records < demand(&status, "entries"), "{status:?}");
    let expected = trace(&bench, &structure, &rays);
    let edges = |exact: u64| [0, 1, exact / 2, exact - 1, exact];
    for (records_room, cells_room) in edges(records)
        .into_iter()
        .map(|room| (room, cells))
        .chain(edges(cells).map(|room| (records, room)))
        .chain([(0, 0)])
    {
        let sizes =
            plan(&config, &Demand { records: records_room, cells: cells_room, ..ample }).expect("in range");
        structure.resize(bench.device(), &sizes).expect("it fits");
        let mut status = bench.build_once(&mut structure, EYE);
        let fits = records_room >= records && cells_room >= cells;
        assert_eq!(status.complete, fits, "room for {records_room} records and {cells_room} lists");
        assert_eq!(demand(&status, "records"), records);
        if !fits {
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 4);
            assert_eq!(counters.not_ready as usize, rays.len());
            assert!(hits.iter().all(|hit| !hit.is_hit()), "a partial answer");
            let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
                panic!("{status:?} does not grow")
            };
            structure.resize(bench.device(), &sizes).expect("it fits");
            status = bench.build_once(&mut structure, EYE);
            assert!(status.complete, "grown from room for {records_room} records and {cells_room} lists");
        }
        assert_eq!((demand(&status, "records"), demand(&status, "lists")), (records, cells));
        let contents = structure.download(bench.device()).expect("the device works");
        well_formed(&contents, triangles.len() as u32).expect("bricks are well formed");
        assert_eq!(trace(&bench, &structure, &rays), expected);
    }
}

/// Pools for fewer triangles than there are make no half structure.
#[test]
fn missing_room_for_triangles_is_noticed() {
    let lists = Config { storage: Storage::Linked, builder: Some(Builder::Binning), ..Config::robust(64) };
    for config in [Config::robust(32), along_axes(), lists] {
        missing_room_for_triangles(config);
    }
}

fn missing_room_for_triangles(config: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (scene(), rays());
    let mut structure = made(&bench, config, &triangles);
    let few = Demand { triangles: 3, ..room(1 << 20, 1 << 10, &triangles) };
    structure.resize(bench.device(), &plan(&config, &few).expect("in range")).expect("it fits");
    let status = bench.build_once(&mut structure, EYE);
    assert!(!status.complete, "{status:?}");
    let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
        panic!("{status:?} does not grow")
    };
    structure.resize(bench.device(), &sizes).expect("it fits");
    assert!(bench.build_once(&mut structure, EYE).complete);
    assert!(trace(&bench, &structure, &rays).iter().all(Hit::is_hit));
}

/// More triangles than there was room for when the structure was made.
#[test]
fn bricks_take_another_geometry() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(), rays());
    let config = Config { storage: Storage::Bricks, ..Config::robust(32) };
    let mut structure = made(&bench, config, &triangles[..3]);
    let geometry = bench.geometry(&triangles);
    structure.set_geometry(bench.device(), &geometry).expect("it fits");
    build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("the build completes");
    let mut expected = made(&bench, config, &triangles);
    build_until_complete(bench.device(), &mut expected, EYE, Timing::None).expect("the build completes");
    assert_eq!(trace(&bench, &structure, &rays), trace(&bench, &expected, &rays));
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
        (50, 2, 1, Storage::Bricks),
        // Along the axes.
        (GRID, 1, 1, Storage::Bricks),
    ] {
        let builder = (resolution == 33).then_some(Builder::Binning);
        let own = Config { entries: Some(0), pyramid: resolution == 50, ..Config::robust(resolution) };
        let config = Config { tile, buckets, storage, builder, ..own };
        let axes = resolution == GRID && storage == Storage::Bricks;
        let config = if axes { Config { entries: Some(0), ..along_axes() } } else { config };
        let mut structure = made(&bench, config, &triangles);
        let bricks = storage == Storage::Bricks;
        let nothing = Demand { triangles: triangles.len() as u64, grid: [GRID; 3], ..Demand::default() };
        // Lists of bricks are known once all records fit: their room is exact in the second round.
        let mut sizes = plan(&config, &nothing).expect("in range");
        for _ in 0..if bricks { 2 } else { 1 } {
            structure.resize(bench.device(), &sizes).expect("it fits");
            let status = bench.build_once(&mut structure, EYE);
            sizes = match structure.check(&status, 0).expect("sizes that do") {
                Check::Grow(sizes) => sizes,
                Check::Complete => {
                    let (records, cells) = (demand(&status, "records"), demand(&status, "lists"));
                    let (entries, near) = (demand(&status, "entries"), demand(&status, "near"));
                    plan(&config, &Demand { entries, near, records, cells, ..nothing }).expect("in range")
                }
            };
        }
        structure.resize(bench.device(), &sizes).expect("it fits");
        let status = bench.build_once(&mut structure, EYE);
        assert!(status.complete);
        let report = structure.report().expect("the header is readable");
        let of_bricks = |name| if bricks { demand(&status, name) } else { 0 };
        let counted = Demand {
            entries: demand(&status, "entries"),
            near: demand(&status, "near"),
            records: of_bricks("records"),
            cells: of_bricks("lists"),
            ..nothing
        };
        let formula = formula_bytes(&config, &counted);
        assert_eq!(report.bytes(), formula.total(), "{config:?}");
        assert_eq!(report.formula_bytes, formula.total());
        assert_eq!(structure.sizes().bytes(), formula.total());
        assert_eq!(report.stored, Some(demand(&status, "entries")));
        let more = Demand { entries: counted.entries + 1, ..counted };
        assert_ne!(formula.total(), formula_bytes(&config, &more).total());
    }
}

#[test]
fn every_fault_of_a_list_is_noticed() {
    let bench = Bench::new();
    let triangles = scene();
    let count = triangles.len() as u32;
    for storage in [Storage::Linked, Storage::Contiguous, Storage::Bricks] {
        let config = Config { storage, buckets: 2, ..Config::robust(16) };
        let mut structure = made(&bench, config, &triangles);
        let sizes = plan(&config, &room(1 << 20, 64, &triangles)).expect("in range");
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
        let twice = broken(|c| {
            // The first list with two entries names its first triangle twice.
            let (step, place) = match c.config.storage {
                Storage::Contiguous | Storage::Bricks => {
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
        if storage == Storage::Bricks {
            // A cell more, a word of another brick, and an empty brick below a full one with the largest distances.
            assert!(matches!(broken(|c| c.bounds[1] ^= 1), Fault::Word { .. }));
            assert!(matches!(
                broken(|c| {
                    let full = c.bounds.iter().step_by(3).position(|&word| word & BRICK_EMPTY == 0);
                    c.bounds[3 * full.expect("a brick that lists something")] += 1;
                }),
                Fault::Word { .. }
            ));
            assert!(matches!(
                broken(|c| {
                    let deep = c.config.slices() as usize / 4;
                    let empty = |brick: usize| c.bounds[3 * brick] & BRICK_EMPTY != 0;
                    let below = (0..c.bounds.len() / 3 - 1)
                        .find(|&brick| brick % deep + 1 < deep && empty(brick) && !empty(brick + 1));
                    c.bounds[3 * below.expect("an empty brick below a full one")] = u32::MAX;
                }),
                Fault::Distance { .. }
            ));
        }
    }
}
