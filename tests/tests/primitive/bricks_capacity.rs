//! Pools of bricks at every edge capacity: exact demands, no partial answers, bytes as the formula says,
//! bricks and lists well formed; and the check of both notices every fault.

use rasray_ads::{Check, Structure, TraceMode};
use rasray_bricks::{
    Addressing, Bricks, Builder, Config, Contents, Demand, Fault, Passes, Views, formula_bytes, plan,
    well_formed,
};
use rasray_gpu::Timing;
use rasray_shaders_glsl::constants::bricks::BRICKS_EMPTY;
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::rays::around_the_eye;
use rasray_tests::shapes::{NEAR_TRIANGLES, Triangle, layers_around_the_eye, sphere};
use rasray_tracer::build_until_complete;

use crate::primitive::edges::{
    Capacity, EYE, demand, every_edge_capacity, made, missing_capacity_for_triangles, trace,
};

/// Cells along each side of the scene, which is a cube.
const GRID: u32 = 16;

fn config(views: Views) -> Config {
    Config { grid: Some(GRID), slices: (views == Views::Cube).then_some(GRID), ..Config::new(views) }
}

/// Both views, and along the axes cells that are not divided.
fn configs() -> [Config; 3] {
    let [cube, axes] = [Views::Cube, Views::Axes].map(config);
    [cube, axes, Config { divisions: Some(0), ..axes }]
}

impl Capacity for Demand {
    fn capacity(entries: u64, near: u64, triangles: &[Triangle]) -> Self {
        let triangles = triangles.len() as u64;
        Self { entries, near, records: 1 << 16, bricks: 1 << 12, cells: 1 << 16, triangles, grid: [GRID; 3] }
    }
}

fn edges_of(config: Config) {
    let near = if config.views == Views::Axes { 0 } else { NEAR_TRIANGLES };
    every_edge_capacity::<Passes>(config, near, |contents, triangles| {
        well_formed(contents, triangles).expect("bricks are well formed");
    });
}

#[test]
fn every_edge_capacity_of_bricks() {
    configs().into_iter().for_each(edges_of);
}

#[test]
fn every_edge_capacity_of_bricks_that_are_drawn() {
    edges_of(Config { builder: Builder::Raster, ..config(Views::Cube) });
}

#[test]
fn every_edge_capacity_of_bricks_by_address() {
    edges_of(Config { addressing: Addressing::Address, ..config(Views::Cube) });
}

/// Records and lists of bricks at every edge: whatever there is capacity for, the next build completes, with
/// the same hits.
#[test]
fn bricks_grow_from_any_capacity_to_what_they_need() {
    configs().into_iter().for_each(bricks_grow);
}

fn bricks_grow(config: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (layers_around_the_eye(), around_the_eye());
    let mut structure: Bricks = made(&bench, config, &bench.geometry(&triangles));
    let ample = Demand::capacity(1 << 20, 1 << 10, &triangles);
    structure.resize(bench.device(), &plan(&config, &ample).expect("in range")).expect("it fits");
    let status = bench.build_once(&mut structure, EYE);
    assert!(status.complete);
    let (records, cells) = (demand(&status, "records"), demand(&status, "lists"));
    assert!(cells > 500 && records > cells / 2 && records < demand(&status, "entries"), "{status:?}");
    let expected = trace(&bench, &structure, &rays);
    let edges = |exact: u64| [0, 1, exact / 2, exact - 1, exact];
    for (records_capacity, cells_capacity) in edges(records)
        .into_iter()
        .map(|capacity| (capacity, cells))
        .chain(edges(cells).map(|capacity| (records, capacity)))
        .chain([(0, 0)])
    {
        let sizes = plan(&config, &Demand { records: records_capacity, cells: cells_capacity, ..ample })
            .expect("in range");
        structure.resize(bench.device(), &sizes).expect("it fits");
        let mut status = bench.build_once(&mut structure, EYE);
        let fits = records_capacity >= records && cells_capacity >= cells;
        assert_eq!(
            status.complete, fits,
            "capacity for {records_capacity} records and {cells_capacity} lists"
        );
        let divides = config.views == Views::Axes && config.divisions != Some(0);
        assert!(demand(&status, "records") == records || (divides && !fits), "{status:?}");
        if !fits {
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 4);
            assert_eq!(counters.not_ready as usize, rays.len());
            assert!(hits.iter().all(|hit| !hit.is_hit()), "a partial answer");
            let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
                panic!("{status:?} does not grow")
            };
            structure.resize(bench.device(), &sizes).expect("it fits");
            status = bench.build_once(&mut structure, EYE);
            // Cells of a level are counted where those of the level before fit.
            for _ in 0..3 {
                if let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") {
                    assert!(divides, "{status:?}");
                    structure.resize(bench.device(), &sizes).expect("it fits");
                    status = bench.build_once(&mut structure, EYE);
                }
            }
            assert!(
                status.complete,
                "grown from capacity for {records_capacity} records and {cells_capacity} lists"
            );
        }
        assert_eq!((demand(&status, "records"), demand(&status, "lists")), (records, cells));
        let contents = structure.download(bench.device()).expect("the device works");
        well_formed(&contents, triangles.len() as u32).expect("bricks are well formed");
        assert_eq!(trace(&bench, &structure, &rays), expected);
    }
}

#[test]
fn missing_capacity_for_triangles_is_noticed() {
    configs().into_iter().for_each(missing_capacity_for_triangles::<Passes>);
}

/// More triangles than there was capacity for when the structure was made, and with them more columns.
#[test]
fn bricks_take_another_geometry() {
    let bench = Bench::new();
    let (triangles, rays) = (layers_around_the_eye(), around_the_eye());
    let geometry = bench.geometry(&triangles);
    let config = Config::new(Views::Cube);
    let mut structure: Bricks = made(&bench, config, &bench.geometry(&triangles[..3]));
    structure.set_geometry(bench.device(), &geometry).expect("it fits");
    build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("the build completes");
    let mut expected: Bricks = made(&bench, config, &geometry);
    build_until_complete(bench.device(), &mut expected, EYE, Timing::None).expect("the build completes");
    assert_eq!(trace(&bench, &structure, &rays), trace(&bench, &expected, &rays));
}

/// Bytes allocated after the exact demand has been met are those of the formula.
#[test]
fn bytes_are_those_of_the_formula() {
    let bench = Bench::new();
    let triangles = layers_around_the_eye();
    let geometry = bench.geometry(&triangles);
    for config in configs() {
        let mut structure: Bricks = made(&bench, config, &geometry);
        let nothing = Demand { triangles: triangles.len() as u64, grid: [GRID; 3], ..Demand::default() };
        // Lists of bricks are known once all records fit, those of divided cells once their cells do.
        let mut sizes = plan(&config, &nothing).expect("in range");
        for _ in 0..5 {
            structure.resize(bench.device(), &sizes).expect("it fits");
            let status = bench.build_once(&mut structure, EYE);
            sizes = match structure.check(&status, 0).expect("sizes that do") {
                Check::Grow(sizes) => sizes,
                Check::Complete => {
                    let (records, cells) = (demand(&status, "records"), demand(&status, "lists"));
                    let (entries, near) = (demand(&status, "entries"), demand(&status, "near"));
                    let bricks = demand(&status, "bricks");
                    plan(&config, &Demand { entries, near, records, bricks, cells, ..nothing })
                        .expect("in range")
                }
            };
        }
        structure.resize(bench.device(), &sizes).expect("it fits");
        let status = bench.build_once(&mut structure, EYE);
        assert!(status.complete);
        let report = structure.report().expect("the header is readable");
        let counted = Demand {
            entries: demand(&status, "entries"),
            near: demand(&status, "near"),
            records: demand(&status, "records"),
            bricks: demand(&status, "bricks"),
            cells: demand(&status, "lists"),
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
fn every_fault_of_a_brick_is_noticed() {
    let bench = Bench::new();
    let triangles = layers_around_the_eye();
    let count = triangles.len() as u32;
    let config = config(Views::Cube);
    let mut structure: Bricks = made(&bench, config, &bench.geometry(&triangles));
    let sizes = plan(&config, &Demand::capacity(1 << 20, 64, &triangles)).expect("in range");
    structure.resize(bench.device(), &sizes).expect("it fits");
    assert!(bench.build_once(&mut structure, EYE).complete);
    let good = structure.download(bench.device()).expect("the device works");
    well_formed(&good, count).expect("bricks are well formed");
    let broken = |change: fn(&mut Contents)| {
        let mut contents = good.clone();
        change(&mut contents);
        well_formed(&contents, count).expect_err("the fault is noticed")
    };
    assert!(matches!(broken(|c| c.lists[20] = u32::MAX), Fault::Dangling { .. }));
    assert!(matches!(broken(|c| c.entries[0] = u32::MAX), Fault::Primitive { .. }));
    assert!(matches!(broken(|c| c.header.demand += 1), Fault::Count { .. }));
    // The first list with two entries has its first triangle twice.
    let twice = broken(|c| {
        let lists = &c.lists;
        let list = (1..lists.len()).find(|&k| lists[k] >= lists[k - 1] + 2).expect("a list");
        let place = lists[list - 1] as usize;
        c.entries[place] = c.entries[place + 1];
    });
    assert!(matches!(twice, Fault::Twice { .. }), "{twice:?}");
    // A cell more, a word of another brick, and an empty brick below a full one with the largest distances.
    assert!(matches!(broken(|c| c.bricks[1] ^= 1), Fault::Word { .. }));
    assert!(matches!(
        broken(|c| {
            let full = c.bricks.iter().step_by(3).position(|&word| word & BRICKS_EMPTY == 0);
            c.bricks[3 * full.expect("a brick that lists something")] += 1;
        }),
        Fault::Word { .. }
    ));
    assert!(matches!(
        broken(|c| {
            let below = below_a_full_one(c);
            c.bricks[3 * below] = u32::MAX;
        }),
        Fault::Distance { .. }
    ));
}

/// An empty brick of a view with one behind it, along slices, that is not.
fn below_a_full_one(contents: &Contents) -> usize {
    let (deep, words) = (contents.header.slices as usize / 4, contents.config.brick_words() as usize);
    let empty = |brick: usize| contents.bricks[words * brick] & BRICKS_EMPTY != 0;
    (0..contents.header.brick_first[1] as usize - 1)
        .find(|&brick| brick % deep + 1 < deep && empty(brick) && !empty(brick + 1))
        .expect("an empty brick below a full one")
}

/// Along the axes, with cells that are divided.
#[test]
fn every_fault_of_a_divided_cell_is_noticed() {
    let bench = Bench::new();
    let mut triangles = layers_around_the_eye();
    // More small ones than a cell may list undivided.
    triangles.extend(sphere([0.1, 0.3, 0.5], 0.2, 24));
    let count = triangles.len() as u32;
    let config = Config { grid: Some(4 * GRID), ..config(Views::Axes) };
    let mut structure: Bricks = made(&bench, config, &bench.geometry(&triangles));
    build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("the build completes");
    let good = structure.download(bench.device()).expect("the device works");
    well_formed(&good, count).expect("bricks are well formed");
    let parent = |c: &Contents| {
        (0..c.header.brick_demand as usize)
            .find(|brick| c.bricks[8 * brick + 3] | c.bricks[8 * brick + 4] != 0)
    };
    let parent = parent(&good).expect("a brick with a divided cell");
    let broken = |change: &dyn Fn(&mut Contents)| {
        let mut contents = good.clone();
        change(&mut contents);
        well_formed(&contents, count).expect_err("the fault is noticed")
    };
    // Bricks of no cell, of another, at another place; and a list for a cell that is divided.
    for change in [u32::MAX, 0, good.bricks[8 * parent + 5] + 1] {
        assert!(matches!(broken(&|c| c.bricks[8 * parent + 5] = change), Fault::Division { .. }), "{change}");
    }
    let child = good.bricks[8 * parent + 5] as usize;
    assert!(matches!(broken(&|c| c.bricks[8 * child + 6] ^= 1), Fault::Division { .. }));
    assert!(matches!(broken(&|c| c.bricks[8 * parent] += 1), Fault::Word { .. } | Fault::Division { .. }));
    assert!(matches!(
        broken(&|c| {
            let below = below_a_full_one(c);
            c.bricks[8 * below + 6] = 0xFFFF;
        }),
        Fault::Distance { .. }
    ));
}
