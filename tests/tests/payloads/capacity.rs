//! Capacity for fragments with a payload from the scene, at every edge capacity: attributes, normals, and the
//! triangles that are kept for diagnostics. What is shaded afterwards is what ample capacity had.

use rasray_ads::{Ray, Sizes, Structure};
use rasray_gpu_scene::GpuScene;
use rasray_tests::capacity::{Counted, check_capacities};
use rasray_tests::harness::Bench;
use rasray_tests::pictures::{rays_inside, stage};
use rasray_tests::tier::{in_turn, is_full};

/// Cells along a side of each view.
const RESOLUTION: u32 = 24;

/// The scene that fragments are read from.
fn room(bench: &Bench) -> (GpuScene, Vec<Ray>) {
    let scene = stage(bench, "cornell", 32);
    let rays = rays_inside(&scene, 500);
    (scene, rays)
}

/// Hits of rays, and their surfaces, to the bit. Fragments without ids are identified by
/// their payload: their place in a pool follows the order of threads.
fn shaded(bench: &Bench, structure: &dyn Structure, rays: &[Ray]) -> Vec<Option<[u32; 10]>> {
    let shaded: Vec<_> = bench
        .surfaces(structure, rays)
        .into_iter()
        .map(|(hit, surface)| {
            let ([x, y, z], [red, green, blue]) = (surface.normal, surface.base_color);
            let terms = [hit.t, x, y, z, red, green, blue, surface.metallic, surface.roughness];
            let [t, x, y, z, red, green, blue, metallic, roughness] = terms.map(f32::to_bits);
            hit.is_hit().then_some([t, hit.primitive, x, y, z, red, green, blue, metallic, roughness])
        })
        .collect();
    assert!(shaded.iter().flatten().count() > rays.len() / 8, "something is hit");
    shaded
}

fn every_edge_capacity(
    bench: &Bench,
    (scene, rays): &(GpuScene, Vec<Ray>),
    structure: &mut dyn Structure,
    counted: Counted,
    sizes: impl Fn(u64) -> Sizes,
) {
    // From within, where views have much to store.
    let [lower, upper] = scene.geometry().bounds();
    let eye: [f32; 3] = std::array::from_fn(|axis| 0.375 * lower[axis] + 0.625 * upper[axis]);
    let demand = check_capacities(bench, structure, eye.into(), counted, sizes, |structure| {
        shaded(bench, structure, rays)
    });
    assert!(demand > 200, "{demand} fragments, or pages of them");
}

#[test]
fn every_edge_capacity_of_a_buffers() {
    use rasray_abuffer::{ABuffer, Config, Demand, Payload, Storage, plan};
    let bench = Bench::new();
    let room = room(&bench);
    let geometry = room.0.geometry();
    let published = Config::published(RESOLUTION);
    let normals = Config { payload: Payload::Normal, ..published };
    let tried = [
        Config { inline: true, ..published },
        Config { ids: true, ..normals },
        Config { ids: true, ..published },
        Config { ids: true, inline: true, ..normals },
    ];
    for (index, storage) in Storage::ALL.into_iter().enumerate() {
        for &config in in_turn(&tried, index) {
            let config = Config { storage, ..config };
            let mut structure = ABuffer::new(bench.device(), config, geometry, Some(room.0.binding()))
                .expect("the options are valid");
            let rest = Demand {
                near_triangles: 64,
                long_lists: 64,
                triangles: u64::from(geometry.triangle_count()),
                ..Demand::default()
            };
            let sizes = |nodes| plan(&config, Demand { nodes, ..rest }).expect("in range");
            let pages = storage == Storage::Paged;
            let counted = Counted { demand: "nodes", pool: "nodes", pages };
            every_edge_capacity(&bench, &room, &mut structure, counted, sizes);
        }
    }
}

#[test]
fn every_edge_capacity_of_voxels() {
    use rasray_voxel::{Config, Demand, Storage, Voxels, plan};
    let bench = Bench::new();
    let room = room(&bench);
    let hu = Config::published_hu(RESOLUTION);
    for (index, storage) in Storage::ALL.into_iter().enumerate() {
        let tried = [hu, Config::published_selective(RESOLUTION), Config { ids: true, ..hu }];
        for &config in in_turn(&tried, index) {
            let config = Config { storage, ..config };
            let mut structure =
                Voxels::new(bench.device(), config, room.0.geometry(), Some(room.0.binding()))
                    .expect("the options are valid");
            let rest = Demand { long_lists: 64, ..Demand::default() };
            let sizes = |entries| plan(&config, Demand { entries, ..rest }).expect("in range");
            let pages = storage == Storage::Paged;
            let counted = Counted { demand: "fragments", pool: "fragments", pages };
            every_edge_capacity(&bench, &room, &mut structure, counted, sizes);
        }
    }
}

#[test]
fn every_edge_capacity_of_layered_depth_cubes() {
    use rasray_ldc::{Config, Demand, LayeredDepthCube, Making, plan};
    let bench = Bench::new();
    let room = room(&bench);
    let published = Config::published(RESOLUTION);
    for making in [Making::Single, Making::Peel] {
        for ids in [false, true] {
            if !is_full() && ids != (making == Making::Single) {
                continue;
            }
            let config = Config { making, ids, ..published };
            let mut structure =
                LayeredDepthCube::new(bench.device(), config, room.0.geometry(), Some(room.0.binding()))
                    .expect("the options are valid");
            let rest = Demand { long_lists: 64, layers: 64, ..Demand::default() };
            let sizes = |fragments| plan(&config, Demand { fragments, ..rest }).expect("in range");
            let counted = Counted { demand: "fragments", pool: "payload", pages: false };
            every_edge_capacity(&bench, &room, &mut structure, counted, sizes);
        }
    }
}
