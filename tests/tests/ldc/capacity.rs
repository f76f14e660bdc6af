//! Pools of every edge capacity: exact demands, no partial answers, bytes as the formula says, lists well
//! formed; and the check of lists notices every fault.

use rasray_ads::{BuildStatus, Check, Hit, Ray, Structure, TraceMode};
use rasray_gpu::Timing;
use rasray_ldc::{
    Accept, Addressing, Config, Contents, Coverage, Demand, Depth, Fault, LayeredDepthCube, Making,
    Occupancy, Payload, formula_bytes, plan, well_formed,
};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;
use rasray_tracer::build_until_complete;

use crate::ldc::{layers_between_views, planes};

const EYE: [f32; 3] = [0.0; 3];

fn trace(bench: &Bench, structure: &LayeredDepthCube, rays: &[Ray]) -> Vec<Hit> {
    let (hits, counters) = trace_in_rounds(bench, structure, rays, TraceMode::Closest, 4);
    assert_eq!((counters.not_ready, counters.unfinished), (0, 0));
    hits
}

/// Capacity for that many fragments and triangles of conservative lists.
fn capacity(fragments: u64, conservative: u64) -> Demand {
    Demand { fragments, conservative, layers: 64, ..Demand::default() }
}

fn demand(status: &BuildStatus, name: &str) -> u64 {
    status.demand(name).expect("the pool is counted")
}

fn made(bench: &Bench, config: Config, triangles: &[Triangle]) -> LayeredDepthCube {
    let geometry = bench.geometry(triangles);
    LayeredDepthCube::new(bench.device(), config, &geometry, None).expect("the options are valid")
}

fn check_well_formed(bench: &Bench, structure: &LayeredDepthCube, triangles: &[Triangle]) {
    let contents = structure.download(bench.device()).expect("the device works");
    well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
}

fn every_edge_capacity(config: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (layers_between_views(), Random::new(3).rays(500, -5.0, 5.0));
    let mut structure = made(&bench, config, &triangles);

    // Ample capacity: what the demand and the hits are.
    structure
        .resize(bench.device(), &plan(&config, capacity(1 << 16, 1 << 14)).expect("in range"))
        .expect("it fits");
    let status = bench.build_once(&mut structure, EYE);
    assert!(status.complete);
    let (fragments, conservative) = (demand(&status, "fragments"), demand(&status, "conservative"));
    let kept = config.coverage == Coverage::Conservative && config.accept != Accept::Triangle;
    assert!(fragments > 1000 && (conservative > 100) == kept, "{status:?}");
    check_well_formed(&bench, &structure, &triangles);
    let expected = trace(&bench, &structure, &rays);

    let capacities = [0, 1, fragments / 2, fragments - 1, fragments].map(|capacity| (capacity, conservative));
    let conservative_capacities =
        [0, 1, conservative / 2, conservative.saturating_sub(1)].map(|capacity| (fragments, capacity));
    for (fragment_capacity, conservative_capacity) in
        capacities.into_iter().chain(conservative_capacities).chain([(0, 0)])
    {
        let sizes = plan(&config, capacity(fragment_capacity, conservative_capacity)).expect("in range");
        structure.resize(bench.device(), &sizes).expect("it fits");
        let mut status = bench.build_once(&mut structure, EYE);
        let fits = fragment_capacity >= fragments && conservative_capacity >= conservative;
        assert_eq!(status.complete, fits, "capacity for {fragment_capacity} and {conservative_capacity}");
        assert_eq!(demand(&status, "fragments"), fragments, "capacity for {fragment_capacity}");
        // The fragments that represent a triangle are known only where all fragments fit.
        let counted = if fragment_capacity >= fragments { conservative } else { 0 };
        assert_eq!(
            demand(&status, "conservative"),
            counted,
            "capacity for {fragment_capacity} and {conservative_capacity}"
        );
        if !fits {
            for mode in [TraceMode::Closest, TraceMode::Occluded] {
                let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, mode, 4);
                assert_eq!(
                    counters.not_ready as usize,
                    rays.len(),
                    "capacity for {fragment_capacity} and {conservative_capacity}"
                );
                assert!(
                    hits.iter().all(|hit| !hit.is_hit()),
                    "a partial answer with capacity for {fragment_capacity}"
                );
            }
        }
        let mut regrows = 0;
        while let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") {
            regrows += 1;
            assert!(regrows <= 2, "fragments grow first, then the conservative list");
            structure.resize(bench.device(), &sizes).expect("it fits");
            status = bench.build_once(&mut structure, EYE);
        }
        assert_eq!(regrows > 0, !fits);
        assert!(status.complete, "grown from {fragment_capacity} and {conservative_capacity}");
        assert_eq!(
            (demand(&status, "fragments"), demand(&status, "conservative")),
            (fragments, conservative)
        );
        check_well_formed(&bench, &structure, &triangles);
        assert_eq!(
            trace(&bench, &structure, &rays),
            expected,
            "grown from {fragment_capacity} and {conservative_capacity}"
        );
    }
}

#[test]
fn every_edge_capacity_of_robust_cubes() {
    every_edge_capacity(Config::robust(32));
}

#[test]
fn every_edge_capacity_of_cubes_of_planes() {
    every_edge_capacity(planes(32));
}

#[test]
fn every_edge_capacity_of_published_cubes() {
    // Attributes need a scene; they come when all lists are made.
    every_edge_capacity(Config { payload: Payload::Index, ..Config::published(32) });
}

#[test]
fn every_edge_capacity_of_peeled_cubes() {
    every_edge_capacity(Config { making: Making::Peel, ..planes(32) });
}

#[test]
fn every_edge_capacity_by_address_with_short_depths() {
    every_edge_capacity(Config {
        addressing: Addressing::Address,
        depth: Depth::Bits16,
        block: [4, 2],
        ..Config::robust(31)
    });
}

/// Bytes allocated after the exact demand has been met are those of the formula.
#[test]
fn bytes_are_those_of_the_formula() {
    let bench = Bench::new();
    let triangles = layers_between_views();
    for (resolution, block, levels, occupancy, depth, coverage) in [
        (16, [8; 2], 2, Occupancy::Slices, Depth::Bits32, Coverage::Conservative),
        (50, [16, 4], 1, Occupancy::Slices, Depth::Bits16, Coverage::Exact),
        (33, [1, 2], 2, Occupancy::Bounds, Depth::Bits16, Coverage::Conservative),
        (64, [64; 2], 1, Occupancy::Bounds, Depth::Bits32, Coverage::Hardware),
    ] {
        let config =
            Config { block, levels, occupancy, depth, coverage, fragments: Some(0), ..planes(resolution) };
        let mut structure = made(&bench, config, &triangles);
        structure.resize(bench.device(), &plan(&config, capacity(0, 0)).expect("in range")).expect("it fits");
        build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("the build completes");
        let status = structure.status(0).expect("the header is readable");
        let report = structure.report().expect("the header is readable");
        let (fragments, conservative) = (demand(&status, "fragments"), demand(&status, "conservative"));
        let formula = formula_bytes(&config, capacity(fragments, conservative));
        assert_eq!(report.bytes(), formula.total(), "{config:?}");
        assert_eq!(report.formula_bytes, formula.total());
        assert_eq!(structure.sizes().bytes(), formula.total());
        assert_eq!(report.stored, Some(fragments + conservative));
        assert_ne!(formula.total(), formula_bytes(&config, capacity(fragments + 1, conservative)).total());
    }
}

#[test]
fn every_fault_of_a_list_is_noticed() {
    let bench = Bench::new();
    let triangles = layers_between_views();
    let count = triangles.len() as u32;
    for depth in [Depth::Bits32, Depth::Bits16] {
        let config = Config { depth, ..planes(16) };
        let mut structure = made(&bench, config, &triangles);
        structure
            .resize(bench.device(), &plan(&config, capacity(1 << 16, 1 << 14)).expect("in range"))
            .expect("it fits");
        assert!(bench.build_once(&mut structure, EYE).complete);
        let good = structure.download(bench.device()).expect("the device works");
        well_formed(&good, count).expect("lists are well formed");
        let broken = |change: &dyn Fn(&mut Contents)| {
            let mut contents = good.clone();
            change(&mut contents);
            well_formed(&contents, count).expect_err("the fault is noticed")
        };
        // A list of two fragments of different depth.
        let long = (0..good.lists.len())
            .filter_map(|cell| good.list(cell).ok())
            .find(|list| list.len() > 1 && good.depth_bits(list.start) != good.depth_bits(list.start + 1))
            .expect("there are layers");
        let place = long.start as usize;
        let head = good.heads.iter().position(|&head| head != 0).expect("there is a conservative list");
        assert!(matches!(broken(&|c| c.lists[20] = u32::MAX), Fault::Range { .. }));
        assert!(matches!(broken(&|c| c.payload[place] = u32::MAX), Fault::Primitive { .. }));
        assert!(matches!(broken(&|c| c.header.demand += 2), Fault::Count { .. }));
        assert!(matches!(broken(&|c| c.header.conservative_demand += 1), Fault::Count { .. }));
        assert!(matches!(broken(&|c| c.heads[head] = 0), Fault::Count { .. }));
        assert!(matches!(broken(&|c| c.heads[head] = u32::MAX), Fault::Dangling { .. }));
        let ring = broken(&|c| {
            let node = c.heads[head] as usize - 1;
            c.conservative[3 * node + 1] = c.heads[head];
        });
        assert!(matches!(ring, Fault::Dangling { .. }), "{ring:?}");
        let exchanged = broken(&|c| match depth {
            Depth::Bits32 => c.depths.swap(place, place + 1),
            Depth::Bits16 => c.depths[place / 2] = c.depths[place / 2].rotate_left(16),
        });
        assert!(matches!(exchanged, Fault::Order { .. }), "{exchanged:?}");
        let lost = broken(&|c| match depth {
            Depth::Bits32 => c.depths[place] = f32::NAN.to_bits(),
            Depth::Bits16 => c.depths[place / 2] = 0x7E00_7E00,
        });
        assert!(matches!(lost, Fault::Depth { .. }), "{lost:?}");
        // A slice that is missing in a block of either level: the last word of the first level, and the very
        // last.
        let blocks = good.blocks.len();
        for words in [0..4, blocks - 12..blocks] {
            let missing =
                broken(&|c| c.blocks[words.clone()].iter_mut().skip(2).step_by(4).for_each(|word| *word = 0));
            assert!(matches!(missing, Fault::Depth { .. }), "{missing:?}");
        }
    }
}
