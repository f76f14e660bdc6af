//! Capacity for the lists that one dispatch does not sort, at every edge capacity, in every structure that
//! sorts lists; and rounds for rays that read long ones.

use rasray_ads::{Ray, Structure, TraceMode};
use rasray_gpu::Timing;
use rasray_shaders_glsl::constants::ads::SHORT_LIST_LIMIT;
use rasray_tests::capacity::check_capacities_of;
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;
use rasray_tracer::{BatchTracer, build_until_complete};

/// Square plates in a row along z, from one metre to two, drawn in a scrambled order.
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

/// Lists for which a thread that sorts several has no steps left, and contiguous lists beyond the limit of a
/// dispatch.
#[test]
fn every_edge_capacity_of_long_lists_of_a_buffers() {
    use rasray_abuffer::{ABuffer, Config, Demand, Storage, plan};
    let bench = Bench::new();
    for (storage, layers, resolution) in [(Storage::Dll, 900, 20), (Storage::Sb, 1_100, 8)] {
        let config = Config { storage, ..Config::at_centres(resolution) };
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

/// A ray that reads a long list needs more rounds than rays are given at first: it gets them, and the same
/// answer.
#[test]
fn rays_through_long_lists_are_given_the_rounds_they_need() {
    use rasray_abuffer::{ABuffer, Config};
    let bench = Bench::new();
    let triangles = vec![[[-4.0, -4.0, 1.5], [4.0, -4.0, 1.5], [0.0, 4.0, 1.5]]; 500];
    let geometry = bench.geometry(&triangles);
    let tracer = BatchTracer::new(bench.device(), 100).expect("a queue fits");
    let built = |work_budget| {
        let config = Config { work_budget, ..Config::at_centres(8) };
        let mut structure =
            ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
        build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None)
            .expect("the build completes");
        structure
    };
    let closest = |structure| {
        let traced = tracer.trace(structure, &rays(), TraceMode::Closest, Timing::None);
        traced.expect("every ray is answered").hits.iter().map(bits).collect::<Vec<_>>()
    };
    let (ample, short) = (built(None), built(Some(8)));
    let first = short.rounds();
    let (_, counters) = trace_in_rounds(&bench, &short, &rays(), TraceMode::Closest, first);
    assert!(counters.unfinished > 0, "{first} rounds were enough");
    assert_eq!(closest(&ample), closest(&short));
    assert!(short.rounds() > first);
    while short.allow_more_rounds() {}
    assert!(short.rounds() <= 1 << 14);
}

#[test]
fn every_edge_capacity_of_long_lists_of_voxels() {
    use rasray_voxel::{Config, Demand, Voxels, plan};
    let bench = Bench::new();
    let triangles = plates(SHORT_LIST_LIMIT as usize + 50);
    let config = Config::at_centres(5);
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
    let demand = Demand { fragments: 1 << 18, conservative: 1 << 18, ..Demand::default() };
    let sizes = |long_lists| plan(&config, Demand { long_lists, ..demand }).expect("in range");
    check_capacities_of(&bench, &mut structure, "long", sizes, &rays());
}
