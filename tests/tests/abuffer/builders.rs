//! Both builders of A-buffers store the same fragments: what is drawn and what is computed.

use rasray_abuffer::{
    ABuffer, Accept, Addressing, Builder, Config, Contents, Coverage, Demand, Storage, Views, plan,
};
use rasray_ads::{Ray, Structure, Viewpoint};
use rasray_gpu::Timing;
use rasray_tests::capacity::check_capacities_of;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, all_sizes};
use rasray_tests::tier::{in_turn, is_full};
use rasray_tests::views::LEANING;
use rasray_tracer::build_until_complete;

/// Triangles of all sizes, with some that span the faces of a cube and pass the eye closely.
fn scene() -> Vec<Triangle> {
    let mut triangles = all_sizes();
    let mut random = Random::new(0x6275);
    for _ in 0..40 {
        triangles.push([random.point(-9.0, 9.0), random.point(-9.0, 9.0), random.point(-9.0, 9.0)]);
    }
    triangles
}

fn viewpoint(config: &Config, eye: [f32; 3]) -> Viewpoint {
    Viewpoint { eye, camera: config.views.has_camera().then_some(LEANING) }
}

struct Built {
    contents: Contents,
    hits: Vec<[u32; 4]>,
    stored: Option<u64>,
}

fn built(bench: &Bench, triangles: &[Triangle], config: Config, eye: [f32; 3], rays: &[Ray]) -> Built {
    let geometry = bench.geometry(triangles);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    let viewpoint = viewpoint(&config, eye);
    build_until_complete(bench.device(), &mut structure, viewpoint, Timing::None)
        .expect("the build completes");
    let report = structure.report().expect("the header is readable");
    assert_eq!(report.bytes() - report.slack(), report.formula_bytes, "{config:?}");
    let hits = bench.trace(&structure, rays).hits.iter().map(bits).collect();
    let contents = structure.download(bench.device()).expect("the device works");
    Built { contents, hits, stored: report.stored }
}

#[test]
fn both_builders_store_the_same_fragments() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(), Random::new(0x6c64).rays(2000, -2.0, 2.0));
    let mut compared = 0;
    for (index, storage) in Storage::ALL.into_iter().enumerate() {
        let tried = [
            (Coverage::Exact, Accept::Plane, Views::Cube, 37, [0.0; 3]),
            (Coverage::Exact, Accept::Interval, Views::CubeCamera, 64, [0.3, -0.7, 0.2]),
            (Coverage::Conservative, Accept::Plane, Views::Cube, 48, [12.0, 1.0, -3.0]),
            (Coverage::Conservative, Accept::Plane, Views::CubeCamera, 5, [0.1, 0.0, 0.0]),
            (Coverage::EdgeOn, Accept::Plane, Views::CubeCamera, 29, [0.3, -0.7, 0.2]),
            (Coverage::Exact, Accept::Plane, Views::Cube, 1, [0.0; 3]),
        ];
        for &(coverage, accept, views, resolution, eye) in in_turn(&tried, index) {
            let addressing = if index % 2 == 0 { Addressing::Descriptor } else { Addressing::Address };
            let config = Config {
                storage,
                coverage,
                accept,
                views,
                camera_resolution: [resolution + 9, resolution],
                addressing,
                ..Config::at_centres(resolution)
            };
            let [drawn, computed] = Builder::ALL
                .map(|builder| built(&bench, &triangles, Config { builder, ..config }, eye, &rays));
            let name = format!("{storage:?}, {coverage:?}, {views:?}, {resolution} cells along a side");
            // A view of few cells is traversed in one dispatch.
            assert_eq!(computed.contents.header.large_demand > 0, resolution > 1, "{name}");
            assert_eq!(drawn.contents.header.large_demand, 0, "{name}");
            assert_eq!(drawn.stored, computed.stored, "{name}");
            assert_eq!(drawn.contents.header.lost, computed.contents.header.lost, "{name}");
            assert!(drawn.hits == computed.hits, "{name}: other hits");
            assert!(drawn.hits.iter().any(|hit| hit[1] != u32::MAX), "{name}: nothing is hit");
            // Sorted contiguous lists have one order; decoupled payload is where threads put it.
            if storage == Storage::Sb {
                assert!(drawn.contents.lists == computed.contents.lists, "{name}: other lists");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, if is_full() { 6 } else { 1 });
}

/// Large triangles beyond the capacity of their queue are counted, the queue grows, and no ray is answered
/// before.
#[test]
fn every_edge_capacity_of_large_triangles() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(), Random::new(0x6c64).rays(500, -2.0, 2.0));
    let geometry = bench.geometry(&triangles);
    let config = Config { builder: Builder::Binning, ..Config::at_centres(48) };
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    let demand = Demand {
        nodes: 1 << 20,
        near_triangles: 1 << 10,
        triangles: triangles.len() as u64,
        ..Demand::default()
    };
    let sizes = |large| plan(&config, Demand { large, ..demand }).expect("in range");
    let large = check_capacities_of(&bench, &mut structure, "large", sizes, &rays);
    assert_eq!(sizes(large).elements("scratch"), Some(large));
}
