//! Room for the lists that one dispatch does not sort, at every edge capacity, in every structure that sorts lists.

use rasray_ads::Ray;
use rasray_shaders_glsl::constants::ads::SHORT_LIST_LIMIT;
use rasray_tests::capacity::check_capacities_of;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;

/// Square plates one behind the other along z, from one metre to two, drawn in a scrambled order.
fn plates(count: usize) -> Vec<Triangle> {
    let plate = |index: usize| {
        let z = 1.0 + (index * 619 % count) as f32 / count as f32;
        let corner = |x: f32, y: f32| [0.9 * x, 0.9 * y, z];
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        [[a, b, c], [a, c, d]]
    };
    (0..count).flat_map(plate).collect()
}

fn rays() -> Vec<Ray> {
    let mut random = Random::new(83);
    let mut at = |z: f32| [random.between(-0.8, 0.8), random.between(-0.8, 0.8), z];
    (0..100)
        .map(|index| (at(1.0 + 0.01 * index as f32), index))
        .map(|(origin, index)| Ray::new(origin, [0.01, 0.02, if index % 2 == 0 { 1.0 } else { -1.0 }]))
        .collect()
}

/// What a thread that sorts several lists has no steps left for, and contiguous lists beyond the limit of a dispatch.
#[test]
fn every_edge_capacity_of_long_lists_of_a_buffers() {
    use rasray_abuffer::{ABuffer, Config, Demand, Storage, plan};
    let bench = Bench::new();
    for (storage, layers, resolution) in [(Storage::Dll, 900, 20), (Storage::Sb, 1_100, 8)] {
        let config = Config { storage, ..Config::robust(resolution) };
        let triangles = plates(layers);
        let mut structure = ABuffer::new(bench.device(), config, &bench.geometry(&triangles), None)
            .expect("the options are valid");
        let demand = Demand {
            nodes: 1 << 18,
            near_triangles: 1 << 12,
            triangles: triangles.len() as u64,
            ..Demand::default()
        };
        let sizes = |long_lists| plan(&config, Demand { long_lists, ..demand }).expect("in range");
        check_capacities_of(&bench, &mut structure, "long", sizes, &rays());
    }
}

#[test]
fn every_edge_capacity_of_long_lists_of_voxels() {
    use rasray_voxel::{Config, Demand, Voxels, plan};
    let bench = Bench::new();
    let triangles = plates(SHORT_LIST_LIMIT as usize + 50);
    let config = Config::robust(5);
    let mut structure = Voxels::new(bench.device(), config, &bench.geometry(&triangles), None)
        .expect("the options are valid");
    let demand = Demand { entries: 1 << 18, ..Demand::default() };
    let sizes = |long_lists| plan(&config, Demand { long_lists, ..demand }).expect("in range");
    check_capacities_of(&bench, &mut structure, "long", sizes, &rays());
}

#[test]
fn every_edge_capacity_of_long_lists_of_layered_depth_cubes() {
    use rasray_ldc::{Config, Demand, LayeredDepthCube, plan};
    let bench = Bench::new();
    let triangles = plates(SHORT_LIST_LIMIT as usize + 50);
    let config = Config::robust(5);
    let mut structure = LayeredDepthCube::new(bench.device(), config, &bench.geometry(&triangles), None)
        .expect("the options are valid");
    let demand = Demand { fragments: 1 << 18, fringe: 1 << 18, ..Demand::default() };
    let sizes = |long_lists| plan(&config, Demand { long_lists, ..demand }).expect("in range");
    check_capacities_of(&bench, &mut structure, "long", sizes, &rays());
}
