//! Costs of builds and rays of the paper's comparators, as a table: [the
//! page](../../../docs/measurements/hu.md#a-sparse-octree).

use rasray_ads::{Counters, Hit, Structure};
use rasray_tests::harness::{Bench, bits_of_any_build, processor_seconds};
use rasray_tests::pictures::{rays_inside, stage};
use rasray_tests::tier::{Counts, first};
use rasray_tests::voxels::built_of;
use rasray_voxel::{Config, Leaves, Traversal};

/// Rays of each row.
const RAYS: Counts<usize> = Counts { quick: 1000, software: 20_000, full: 20_000 };

/// Builds and traces of each row.
const REPEATS: Counts<u32> = Counts { quick: 1, software: 5, full: 5 };

/// Milliseconds of processor time that one of several calls takes.
fn milliseconds(repeats: u32, mut call: impl FnMut()) -> Option<f64> {
    call();
    let begun = processor_seconds()?;
    (0..repeats).for_each(|_| call());
    Some((processor_seconds()? - begun) * 1e3 / f64::from(repeats))
}

/// Fragments in voxels, by DDA and by the octree; and voxels as fine as the cells of the fragments, both
/// ways: the paper compares its fragments with rays traced down to the leaves of an octree of that size.
fn compared(cells: u32) -> [(&'static str, Config); 4] {
    let fragments = Config { counters: Counters::Sums, ..Config::at_centres(cells) };
    let voxels = Config { leaves: Leaves::Voxels, grid: Some(cells), ..fragments };
    let octree = |config| Config { traversal: Traversal::Octree, ..config };
    [
        ("fragments, dda", fragments),
        ("fragments, octree", octree(fragments)),
        ("voxels, dda", voxels),
        ("voxels, octree", octree(voxels)),
    ]
}

/// An octree changes no hit and steps through fewer cells. With `RASRAY_FULL=1` times are worth reading.
#[test]
fn octrees_trade_cells_for_nodes() {
    let bench = Bench::new();
    let (count, repeats) = (RAYS.on(bench.device(), "rays"), REPEATS.on(bench.device(), "repeats"));
    println!("scene, cells: what | build ms | trace ms | cells, entries per ray | nodes | KiB");
    for name in first(&["spheres:10k", "cornell", "atrium:detail=0.25"], 1) {
        let scene = stage(&bench, name, 8);
        let rays = rays_inside(&scene, count);
        for &cells in first(&[64, 128, 256], 1) {
            let mut known: Option<(Vec<Hit>, u64)> = None;
            for (what, config) in compared(cells) {
                let mut structure = built_of(&bench, config, scene.geometry());
                let build = milliseconds(repeats, || {
                    assert!(bench.build_once(&mut structure, [0.0; 3]).complete);
                });
                let outcome = bench.trace(&structure, &rays);
                let trace = milliseconds(repeats, || {
                    bench.trace(&structure, &rays);
                });
                let header = structure.header().expect("the header is readable");
                let per_ray = |sum: u64| sum as f64 / rays.len() as f64;
                let [build, trace] =
                    [build, trace].map(|time| time.map_or("-".to_owned(), |ms| format!("{ms:.0}")));
                println!(
                    "{name}, {cells}: {what} | {build} | {trace} | {:.1}, {:.1} | {} | {}",
                    per_ray(outcome.counters.cells),
                    per_ray(outcome.counters.entries),
                    header.node_demand,
                    structure.sizes().bytes() / 1024
                );
                known = match known.take() {
                    Some((hits, stepped)) if config.traversal == Traversal::Octree => {
                        let bits = |hits: &[Hit]| hits.iter().map(bits_of_any_build).collect::<Vec<_>>();
                        assert!(bits(&hits) == bits(&outcome.hits), "{name}, {cells}: {what}");
                        assert!(outcome.counters.cells < stepped, "{name}, {cells}: {what}");
                        None
                    }
                    _ => Some((outcome.hits, outcome.counters.cells)),
                };
            }
        }
    }
}
