//! Layers that are peeled are those that one pass makes, to the bit; those beyond the maximum are counted and
//! refused.

use rasray_ads::{Check, Geometry, Hit, Ray, Structure, TraceMode, Viewpoint};
use rasray_gpu::Timing;
use rasray_ldc::{
    Accept, Addressing, Config, Contents, Coverage, Depth, LayeredDepthCube, Making, well_formed,
};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;
use rasray_tracer::build_until_complete;

use crate::ldc::{layers_between_views, planes};

/// Layers, a room, and a stack of plates in which every third is there three times.
fn scene() -> Vec<Triangle> {
    let mut triangles = layers_between_views();
    for k in 0..24 {
        let z = 1.0 + 0.3 * k as f32;
        let plate = [[-4.0, -4.0, z], [4.0, -4.0, z], [0.0, 4.0, z + 0.1]];
        triangles.extend(std::iter::repeat_n(plate, if k % 3 == 0 { 3 } else { 1 }));
    }
    triangles
}

fn made(bench: &Bench, geometry: &Geometry, config: Config) -> LayeredDepthCube {
    let mut structure =
        LayeredDepthCube::new(bench.device(), config, geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None)
        .expect("the build completes");
    structure
}

/// Contents that are equal however layers are made.
struct Layers {
    /// Depth and triangle of each fragment of each cell.
    lists: Vec<Vec<(u32, u32)>>,
    blocks: Vec<u32>,
    /// Triangles of each cell's conservative list, whatever the order of links.
    conservative: Vec<Vec<u32>>,
}

fn layers(contents: &Contents) -> Layers {
    let cells = 0..contents.lists.len();
    let list = |cell| {
        let places = contents.list(cell).expect("well formed");
        places.map(|place| (contents.depth_bits(place), contents.payload[place as usize])).collect()
    };
    let conservative = |cell| {
        let mut found = contents.conservative_list_of(cell).expect("well formed");
        found.sort_unstable();
        found
    };
    Layers {
        lists: cells.clone().map(list).collect(),
        blocks: contents.blocks.clone(),
        conservative: cells.map(conservative).collect(),
    }
}

#[test]
fn peeled_layers_are_those_of_a_single_pass() {
    let bench = Bench::new();
    let triangles = scene();
    let geometry = bench.geometry(&triangles);
    let rays = Random::new(5).rays(400, -5.0, 5.0);
    for (depth, coverage, accept, addressing) in [
        (Depth::Bits32, Coverage::Conservative, Accept::Plane, Addressing::Descriptor),
        (Depth::Bits32, Coverage::Conservative, Accept::Triangle, Addressing::Descriptor),
        (Depth::Bits16, Coverage::Conservative, Accept::Triangle, Addressing::Descriptor),
        (Depth::Bits16, Coverage::Hardware, Accept::Plane, Addressing::Descriptor),
        (Depth::Bits16, Coverage::Exact, Accept::Plane, Addressing::Address),
    ] {
        let single = Config { depth, coverage, accept, addressing, ..Config::robust(24) };
        let peel = Config { making: Making::Peel, ..single };
        let [single, peel] = [single, peel].map(|config| {
            let structure = made(&bench, &geometry, config);
            let contents = structure.download(bench.device()).expect("the device works");
            well_formed(&contents, triangles.len() as u32).expect("lists are in order");
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 4);
            assert_eq!((counters.not_ready, counters.unfinished), (0, 0));
            let report = structure.report().expect("the header is readable");
            let slack =
                report.bytes_by_part.iter().find(|part| part.0 == "slack").expect("the part exists").1;
            assert_eq!(report.formula_bytes, report.bytes() - slack);
            (contents, hits)
        });
        let (expected, peeled) = (layers(&single.0), layers(&peel.0));
        let deepest = expected.lists.iter().map(Vec::len).max().expect("there are cells");
        assert!(deepest > 30, "{deepest} layers");
        assert_eq!(peel.0.header.layer_demand as usize, deepest);
        assert_eq!(expected.lists, peeled.lists, "{depth:?}, {coverage:?}, {accept:?}");
        assert_eq!(expected.blocks, peeled.blocks, "{depth:?}, {coverage:?}, {accept:?}");
        assert_eq!(expected.conservative, peeled.conservative, "{depth:?}, {coverage:?}, {accept:?}");
        let key = |hit: &Hit| (hit.t.to_bits(), hit.primitive);
        assert!(single.1.iter().map(key).eq(peel.1.iter().map(key)), "{depth:?}, {coverage:?}, {accept:?}");
    }
}

/// Vertices that one build is told to draw, and how often it draws.
fn drawn(bench: &Bench, structure: &mut LayeredDepthCube) -> (u64, u32) {
    structure.prepare_build(bench.device()).expect("the device works");
    let recorded = bench.device().submit(|recorder| {
        structure.record_build(recorder, 0, Viewpoint::from([0.0; 3])).expect("the header is written");
        recorder.passes().to_vec()
    });
    let passes = recorded.expect("the device works").value;
    (passes.iter().map(|pass| pass.vertices).sum(), passes.iter().map(|pass| pass.draws).sum())
}

#[test]
fn three_passes_draw_three_times_the_triangles_and_store_the_same() {
    let bench = Bench::new();
    let triangles = scene();
    let geometry = bench.geometry(&triangles);
    let rays = Random::new(6).rays(400, -5.0, 5.0);
    for (making, depth, coverage) in [
        (Making::Single, Depth::Bits32, Coverage::Conservative),
        (Making::Single, Depth::Bits16, Coverage::Hardware),
        (Making::Peel, Depth::Bits32, Coverage::Exact),
    ] {
        let one = Config { making, depth, coverage, ..planes(24) };
        let [one, three] = [one, Config { passes: 3, ..one }].map(|config| {
            let mut structure = made(&bench, &geometry, config);
            let drawn = drawn(&bench, &mut structure);
            let contents = structure.download(bench.device()).expect("the device works");
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 4);
            assert_eq!((counters.not_ready, counters.unfinished), (0, 0));
            (drawn, contents, hits)
        });
        let (((vertices, draws), contents, hits), ((tripled, same_draws), others, other_hits)) = (one, three);
        let fragments = contents.header.demand;
        println!(
            "{making:?}, {coverage:?}: {draws} draws, {vertices} and {tripled} vertices, {fragments} fragments"
        );
        assert_eq!((tripled, same_draws), (3 * vertices, draws));
        assert_eq!(fragments, others.header.demand);
        let (expected, found) = (layers(&contents), layers(&others));
        assert!(expected.lists == found.lists && expected.blocks == found.blocks, "{making:?}, {coverage:?}");
        assert_eq!(expected.conservative, found.conservative, "{making:?}, {coverage:?}");
        let key = |hit: &Hit| (hit.t.to_bits(), hit.primitive);
        assert!(hits.iter().map(key).eq(other_hits.iter().map(key)), "{making:?}, {coverage:?}");
    }
}

#[test]
fn layers_beyond_the_maximum_are_counted_and_refused() {
    let bench = Bench::new();
    let geometry = bench.geometry(&scene());
    let base = Config { fragments: Some(1 << 16), ..Config::robust(16) };
    let single = made(&bench, &geometry, base).download(bench.device()).expect("the device works");
    let lists = layers(&single).lists;
    let deepest = lists.iter().map(Vec::len).max().expect("there are cells");
    let config = Config { making: Making::Peel, layers: 8, ..base };
    let mut structure =
        LayeredDepthCube::new(bench.device(), config, &geometry, None).expect("the options are valid");
    let status = bench.build_once(&mut structure, [0.0; 3]);
    assert!(!status.complete);
    assert_eq!(status.demand("layers"), Some(deepest as u64));
    let beyond: usize = lists.iter().map(|list| list.len().saturating_sub(8)).sum();
    assert_eq!(structure.header().expect("the header is readable").beyond as usize, beyond);
    let rays = [Ray::new([0.1, 0.2, 0.3], [0.3, -0.5, 0.8])];
    let (_, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 2);
    assert_eq!(counters.not_ready, 1, "no partial answer");
    let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
        panic!("more layers are requested")
    };
    let refused = structure.resize(bench.device(), &sizes).expect_err("more layers than may be").to_string();
    assert!(
        refused.contains(&format!("{deepest} fragments")) && refused.contains("build=single"),
        "{refused}"
    );
}
