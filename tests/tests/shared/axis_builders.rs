//! Both builders of structures along axes store the same fragments: what is drawn and what is computed.

use rasray_ads::{Builder, Ray, Structure};
use rasray_gpu::Timing;
use rasray_ldc::LayeredDepthCube;
use rasray_tests::capacity::check_capacities_of;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::shapes::all_sizes;
use rasray_tracer::build_until_complete;
use rasray_voxel::Voxels;

const RAYS: usize = 2000;

fn rays() -> Vec<Ray> {
    Random::new(0x6178).rays(RAYS, -9.0, 9.0)
}

/// Builds, and checks that the bytes are those of the formula: hits, and the demand for the large-triangle
/// queue.
fn built(bench: &Bench, structure: &mut dyn Structure, name: &str) -> (Vec<[u32; 4]>, u64) {
    build_until_complete(bench.device(), structure, [0.0; 3], Timing::None).expect("the build completes");
    let report = structure.report().expect("the header is readable");
    assert_eq!(report.bytes() - report.slack(), report.formula_bytes, "{name}");
    let hits = bench.trace(structure, &rays()).hits.iter().map(bits).collect();
    let status = structure.status(0).expect("the header is readable");
    (hits, status.demand("large").expect("the pool has a status"))
}

/// Hits of both, after what has to hold of how each was built.
fn same_hits(name: &str, large: bool, [drawn, computed]: [(Vec<[u32; 4]>, u64); 2]) {
    assert_eq!((drawn.1, computed.1 > 0), (0, large), "{name}");
    assert!(drawn.0 == computed.0, "{name}: other hits");
    assert!(drawn.0.iter().any(|hit| hit[1] != u32::MAX), "{name}: nothing is hit");
}

#[test]
fn both_builders_of_layered_depth_cubes_store_the_same_fragments() {
    use rasray_ldc::{Accept, Config, Coverage, Depth, Payload};
    let bench = Bench::new();
    let geometry = bench.geometry(&all_sizes());
    let robust = Config::robust;
    let planes = |resolution| Config { accept: Accept::Plane, ..robust(resolution) };
    let exact = |resolution| Config { coverage: Coverage::Exact, ..planes(resolution) };
    let tolerance = Config { payload: Payload::Index, coverage: Coverage::Exact, ..Config::published(40) };
    for (config, large) in [
        (robust(37), true),
        (robust(1), false),
        (planes(37), true),
        (exact(64), true),
        (Config { depth: Depth::Bits16, ..tolerance }, true),
        (Config { addressing: rasray_ldc::Addressing::Address, ..robust(40) }, true),
    ] {
        let name = format!("{config:?}");
        let mut contents = Vec::new();
        let both = Builder::ALL.map(|builder| {
            let config = Config { builder, ..config };
            let mut structure = LayeredDepthCube::new(bench.device(), config, &geometry, None)
                .expect("the options are valid");
            let found = built(&bench, &mut structure, &name);
            contents.push(structure.download(bench.device()).expect("the device works"));
            found
        });
        same_hits(&name, large, both);
        let [drawn, computed] = [&contents[0], &contents[1]];
        assert!(drawn.lists == computed.lists && drawn.blocks == computed.blocks, "{name}");
        assert_eq!(drawn.header.conservative_demand, computed.header.conservative_demand, "{name}");
        // Lists are sorted, so that they have one order. Lists of 16-bit depths may have a place at their end
        // that holds nothing.
        if config.depth == Depth::Bits32 {
            let end = drawn.header.demand as usize;
            assert!(drawn.payload[..end] == computed.payload[..end], "{name}: other triangles");
            assert!(drawn.depths[..end] == computed.depths[..end], "{name}: other depths");
        }
    }
}

#[test]
fn both_builders_of_voxels_store_the_same_fragments() {
    use rasray_voxel::{Accept, Axes, Config, Coverage, March, Marking, Payload, Storage};
    let bench = Bench::new();
    let geometry = bench.geometry(&all_sizes());
    let robust = Config::at_centres;
    let published = |axes| Config {
        axes,
        payload: Payload::Index,
        accept: Accept::Parity,
        march: March::Samples,
        storage: Storage::Contiguous,
        sort: true,
        ..robust(48)
    };
    for (config, large) in [
        (robust(37), true),
        (Config { grid: Some(1), ..robust(1) }, false),
        // More columns of voxels than cells.
        (Config { grid: Some(100), ..robust(12) }, true),
        (Config { coverage: Coverage::Conservative, ..robust(40) }, true),
        (Config { storage: Storage::Linked, ..robust(40) }, true),
        (Config { storage: Storage::Paged, ..robust(40) }, true),
        (Config { addressing: rasray_voxel::Addressing::Address, ..robust(40) }, true),
        (published(Axes::All), true),
        (Config { voxels: Some(Marking::Triangles), ..published(Axes::All) }, true),
        (published(Axes::Voxel), true),
        (Config { storage: Storage::Linked, ..published(Axes::All) }, true),
    ] {
        let name = format!("{config:?}");
        let mut contents = Vec::new();
        let both = Builder::ALL.map(|builder| {
            let config = Config { builder, ..config };
            let mut structure =
                Voxels::new(bench.device(), config, &geometry, None).expect("the options are valid");
            let found = built(&bench, &mut structure, &name);
            contents.push(structure.download(bench.device()).expect("the device works"));
            found
        });
        same_hits(&name, large, both);
        let [drawn, computed] = [&contents[0], &contents[1]];
        assert!(drawn.voxels == computed.voxels, "{name}: other voxels");
        assert_eq!(drawn.header.fragments, computed.header.fragments, "{name}");
        if config.storage == Storage::Contiguous && config.sort {
            assert!(drawn.lists == computed.lists, "{name}: other lists");
            let words = 2 * drawn.header.demand as usize;
            assert!(drawn.fragments[..words] == computed.fragments[..words], "{name}: other fragments");
        }
    }
}

#[test]
fn every_edge_capacity_of_large_triangles_of_layered_depth_cubes() {
    use rasray_ldc::{Config, Demand, plan};
    let bench = Bench::new();
    let triangles = all_sizes();
    let config = Config { builder: Builder::Binning, ..Config::robust(40) };
    let mut structure = LayeredDepthCube::new(bench.device(), config, &bench.geometry(&triangles), None)
        .expect("the options are valid");
    let demand = Demand { fragments: 1 << 16, conservative: 1 << 16, layers: 1 << 8, ..Demand::default() };
    let sizes = |large| plan(&config, Demand { large, ..demand }).expect("in range");
    check_capacities_of(&bench, &mut structure, "large", sizes, &rays());
}

#[test]
fn every_edge_capacity_of_large_triangles_of_voxels() {
    use rasray_voxel::{Config, Demand, plan};
    let bench = Bench::new();
    let triangles = all_sizes();
    let config = Config { builder: Builder::Binning, ..Config::at_centres(40) };
    let mut structure = Voxels::new(bench.device(), config, &bench.geometry(&triangles), None)
        .expect("the options are valid");
    let demand = Demand { entries: 1 << 16, ..Demand::default() };
    let sizes = |large| plan(&config, Demand { large, ..demand }).expect("in range");
    check_capacities_of(&bench, &mut structure, "large", sizes, &rays());
}
