//! Contents of lists, counted from closed forms: k parallel triangles are k layers in every cell that they
//! cover.

use std::collections::{BTreeMap, BTreeSet};

use rasray_abuffer::{ABuffer, Config as ABufferConfig, Coverage, Storage, Views};
use rasray_ads::{CameraView, Inspect, ListCounts, Structure, Viewpoint};
use rasray_gpu::Timing;
use rasray_ldc::{Config as LdcConfig, Depth, LayeredDepthCube, Making};
use rasray_primitive::{Centre, Config as PrimitiveConfig, PrimitiveLists};
use rasray_tests::harness::Bench;
use rasray_tests::invariance::Subject;
use rasray_tests::shapes::{Triangle, sphere};
use rasray_tracer::build_until_complete;
use rasray_voxel::{Config as VoxelConfig, Storage as VoxelStorage, Voxels};

const LAYERS: u64 = 7;

/// Cells along a side.
const SIDE: u32 = 16;

/// A triangle in the plane, well within the square of a face.
const FLAT: [[f64; 2]; 3] = [[-0.7, -0.75], [0.8, -0.6], [-0.1, 0.8]];

/// Triangles that are one behind the other as seen from the origin, along +z.
fn behind_each_other() -> Vec<Triangle> {
    let layer = |k: u64| {
        let depth = 2.0 + k as f64;
        FLAT.map(|[x, y]| [x * depth, y * depth, depth].map(|coordinate| coordinate as f32))
    };
    (0..LAYERS).map(layer).collect()
}

/// Triangles that are one above the other along the z axis.
fn above_each_other() -> Vec<Triangle> {
    let layer = |k: u64| FLAT.map(|[x, y]| [x, y, height(k)].map(|coordinate| coordinate as f32));
    (0..LAYERS).map(layer).collect()
}

/// Unevenly spaced: none is between two voxels of the cube around them.
fn height(layer: u64) -> f64 {
    let layer = layer as f64;
    0.13 * layer + 0.01 * layer * layer
}

/// True if a point is in the flat triangle; no point that is asked for is close to an edge.
fn is_covered(point: [f64; 2]) -> bool {
    let edges: [f64; 3] = std::array::from_fn(|corner| {
        let (a, b) = (FLAT[corner], FLAT[(corner + 1) % 3]);
        (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0])
    });
    assert!(edges.iter().all(|edge| edge.abs() > 1.0e-4), "{point:?} is on an edge");
    edges.iter().all(|edge| *edge > 0.0)
}

/// Cells of a square view of which the flat triangle covers the centre; `at` is where a row or column has its
/// centre.
fn covered(at: impl Fn(u32) -> f64) -> u64 {
    let cells = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| [column, row]));
    cells.filter(|cell| is_covered(cell.map(&at))).count() as u64
}

fn counted<S: Structure + Inspect>(
    bench: &Bench,
    structure: &mut S,
    viewpoint: impl Into<Viewpoint>,
) -> Vec<ListCounts> {
    build_until_complete(bench.device(), structure, viewpoint, Timing::None).expect("the build completes");
    structure.list_counts(bench.device()).expect("the lists are whole")
}

/// Everything is in one view, as many layers in each of the cells that it covers.
fn check(counts: &[ListCounts], name: &str, cells: u64, cells_of_view: u64) {
    let all = ListCounts::all(counts).expect("there are views");
    for count in counts.iter().filter(|count| count.cells_of != ListCounts::VOXELS) {
        assert_eq!(count.cells, cells_of_view, "{count:?}");
        let (occupied, most) = if count.cells_of == name { (cells, LAYERS) } else { (0, 0) };
        assert_eq!(
            (count.occupied, count.layers, count.most),
            (occupied, LAYERS * occupied, most),
            "{count:?}"
        );
    }
    assert_eq!((all.occupied, all.layers, all.most), (cells, LAYERS * cells, LAYERS), "{counts:?}");
}

#[test]
fn parallel_triangles_are_layers_of_an_a_buffer() {
    let bench = Bench::new();
    let geometry = bench.geometry(&behind_each_other());
    let cells = covered(|place| (2.0 * f64::from(place) + 1.0) / f64::from(SIDE) - 1.0);
    assert!(cells > 40, "{cells}");
    let base = ABufferConfig { coverage: Coverage::Exact, ..ABufferConfig::robust(SIDE) };
    for config in [
        base,
        ABufferConfig { storage: Storage::Sb, ..base },
        ABufferConfig { storage: Storage::Ll, inline: true, ..base },
        ABufferConfig { storage: Storage::Paged, page: 4, buckets: 2, ..base },
    ] {
        let mut structure =
            ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
        let counts = counted(&bench, &mut structure, [0.0; 3]);
        check(&counts, "+z", cells, u64::from(SIDE + 2).pow(2));
        let view = &counts[4];
        let header = structure.header().expect("the header is readable");
        assert_eq!(view.entries, view.layers);
        assert_eq!(view.slot_bytes, 8, "a depth and a triangle");
        if config.storage == Storage::Paged {
            // Two buckets of 4 and 3, or of 7 and none where rounding has it so: at least two pages.
            assert_eq!(view.slots, 4 * u64::from(header.demand));
            assert!(view.slots >= 8 * cells, "{view:?}");
        } else {
            assert_eq!((view.slots, u64::from(header.demand)), (view.layers, view.layers));
        }
    }
    // The camera looks along the same axis, with a right angle: the same cells once more, in a view of its
    // own.
    let camera = CameraView {
        right: [1.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        forward: [0.0, 0.0, 1.0],
        half_width: 1.0,
        half_height: 1.0,
    };
    let config = ABufferConfig { views: Views::Camera, ..base };
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    let viewpoint = Viewpoint { eye: [0.0; 3], camera: Some(camera) };
    check(&counted(&bench, &mut structure, viewpoint), "camera", cells, u64::from(SIDE + 2).pow(2));
}

#[test]
fn parallel_triangles_are_layers_of_a_layered_depth_cube() {
    let bench = Bench::new();
    let geometry = bench.geometry(&above_each_other());
    let (coverage, accept) = (rasray_ldc::Coverage::Exact, rasray_ldc::Accept::Plane);
    let base = LdcConfig { coverage, accept, ..LdcConfig::robust(SIDE) };
    for config in [
        base,
        LdcConfig { making: Making::Peel, ..base },
        LdcConfig { depth: Depth::Bits16, making: Making::Peel, ..base },
    ] {
        let mut structure =
            LayeredDepthCube::new(bench.device(), config, &geometry, None).expect("the options are valid");
        let counts = counted(&bench, &mut structure, [0.0; 3]);
        let header = structure.header().expect("the header is readable");
        // x and y are the first two axes of the view along z.
        let lower = [header.origin[0], header.origin[1]].map(f64::from);
        let centre =
            |axis: usize, place: u32| lower[axis] + (f64::from(place) + 0.5) * f64::from(header.cell);
        let inside = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| [column, row]));
        let cells =
            inside.filter(|[column, row]| is_covered([centre(0, *column), centre(1, *row)])).count() as u64;
        check(&counts, "z", cells, u64::from(SIDE).pow(2));
        assert_eq!(counts[2].slots, counts[2].layers);
        if config.making == Making::Peel {
            assert_eq!(u64::from(header.layer_demand), counts[2].most, "layers that were peeled");
        }
    }
}

#[test]
fn parallel_triangles_are_layers_of_columns_and_of_voxels() {
    const GRID: u32 = 4;
    let bench = Bench::new();
    let geometry = bench.geometry(&above_each_other());
    let base = VoxelConfig {
        coverage: rasray_voxel::Coverage::Exact,
        grid: Some(GRID),
        ..VoxelConfig::robust(SIDE)
    };
    for storage in VoxelStorage::ALL {
        let config = VoxelConfig { storage, page: 4, ..base };
        let mut structure =
            Voxels::new(bench.device(), config, &geometry, None).expect("the options are valid");
        let counts = counted(&bench, &mut structure, [0.0; 3]);
        let header = structure.header().expect("the header is readable");
        let centre = |axis: usize, place: u32| {
            f64::from(header.lower[axis]) + (f64::from(place) + 0.5) * f64::from(header.cell)
        };
        let cells: Vec<[f64; 2]> = (0..SIDE)
            .flat_map(|row| (0..SIDE).map(move |column| [column, row]))
            .map(|[column, row]| [centre(0, column), centre(1, row)])
            .filter(|point| is_covered(*point))
            .collect();
        check(&counts, "z", cells.len() as u64, u64::from(SIDE).pow(2));
        if storage == VoxelStorage::Paged {
            // Seven fragments take two pages of four at least.
            assert_eq!(counts[2].slots, 4 * u64::from(header.demand));
            assert!(counts[2].slots >= 8 * counts[2].occupied, "{counts:?}");
        } else {
            assert_eq!(counts[2].slots, counts[2].entries);
        }
        // Each fragment by the voxel in which its point lies.
        let mut voxels: BTreeMap<[u64; 3], u64> = BTreeMap::new();
        for [x, y] in &cells {
            for layer in 0..LAYERS {
                let point = [*x, *y, height(layer)];
                let voxel = std::array::from_fn(|axis| {
                    let along = (point[axis] - f64::from(header.lower[axis])) / f64::from(header.voxel);
                    assert!((along - along.round()).abs() > 1.0e-4, "{point:?} is between two voxels");
                    along as u64
                });
                *voxels.entry(voxel).or_default() += 1;
            }
        }
        let found = counts.last().expect("there are voxels");
        assert_eq!((found.cells_of, found.cells), (ListCounts::VOXELS, u64::from(GRID.pow(3))));
        assert_eq!(found.layers, LAYERS * cells.len() as u64);
        assert_eq!(Some(found.most), voxels.values().copied().max());
        assert!(found.occupied >= voxels.len() as u64 && found.occupied < found.cells, "{found:?}");
    }
}

/// Triangles that reach into several buckets are entries there and one layer of the tile.
#[test]
fn a_tile_has_each_triangle_once_however_many_of_its_buckets_list_it() {
    let bench = Bench::new();
    let flat = bench.geometry(&behind_each_other());
    let round = bench.geometry(&sphere([0.5, 0.25, 3.0], 2.0, 8));
    let mut several = 0;
    for buckets in [1, 20] {
        let config =
            PrimitiveConfig { tile: 1, buckets, centre: Centre::Eye, ..PrimitiveConfig::robust(SIDE) };
        for (geometry, is_flat) in [(&flat, true), (&round, false)] {
            let mut structure =
                PrimitiveLists::new(bench.device(), config, geometry, None).expect("the options are valid");
            let counts = counted(&bench, &mut structure, [0.0; 3]);
            let contents = structure.download(bench.device()).expect("the device works");
            let all = ListCounts::all(&counts).expect("there are faces");
            assert_eq!(all.entries, u64::from(contents.header.demand));
            let mut listed = BTreeMap::new();
            for list in 0..contents.lists.len() {
                let (cell, bucket) = (list / buckets as usize, list % buckets as usize);
                let triangles = contents.list(cell, bucket).expect("the list is whole");
                listed.entry(cell).or_insert_with(BTreeSet::new).extend(triangles);
            }
            let layers = || listed.values().map(BTreeSet::len);
            assert_eq!(all.layers, layers().sum::<usize>() as u64);
            assert_eq!(all.most, layers().max().unwrap_or(0) as u64);
            assert_eq!(all.occupied, layers().filter(|layers| *layers > 0).count() as u64);
            assert!(buckets > 1 || all.entries == all.layers, "{all:?}");
            several += all.entries - all.layers;
            if is_flat {
                // A tile that one of them reaches into, all do.
                assert_eq!((all.layers, all.most), (LAYERS * all.occupied, LAYERS));
            }
        }
    }
    assert!(several > 0, "no triangle reached into two buckets of a tile");
}

/// Bounds that hold for every structure: no cell holds more than the stated maximum, and nothing is counted
/// twice.
#[test]
fn counts_of_every_structure_agree_with_what_it_reports() {
    let bench = Bench::new();
    let geometry = bench.geometry(&sphere([0.5, 0.25, 3.0], 2.0, 8));
    let mut with_lists = 0;
    for subject in Subject::by_turns() {
        let mut structure =
            subject.spec.create(bench.device(), &geometry, None).expect("the options are valid");
        build_until_complete(bench.device(), structure.as_mut(), [0.0; 3], Timing::None)
            .expect("the build completes");
        let Some(pools) = structure.inspect() else { continue };
        let counts = pools.list_counts(bench.device()).expect("the lists are whole");
        let Some(all) = ListCounts::all(&counts) else { continue };
        with_lists += 1;
        let stored = structure.report().expect("readable").stored.expect("it stores what it lists");
        let name = subject.name();
        assert!(all.occupied > 0 && all.occupied <= all.cells, "{name}: {all:?}");
        assert!(all.layers >= all.occupied && all.layers <= all.most * all.occupied, "{name}: {all:?}");
        assert!(all.layers <= all.entries && all.entries <= all.slots, "{name}: {all:?}");
        // Triangles of conservative lists are stored and are no layers.
        assert!(all.entries <= stored, "{name}: {all:?}, {stored} stored");
    }
    assert!(with_lists >= 6, "{with_lists} structures with lists");
}
