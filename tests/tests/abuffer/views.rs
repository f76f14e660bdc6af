//! Views of an A-buffer: the cube's faces, what a camera sees, and both.

use rasray_abuffer::{ABuffer, Addressing, Config, Contents, Storage, Views, cell_count, well_formed};
use rasray_ads::{CameraView, Hit, PRIMITIVE_NONE, Ray, TraceMode, Viewpoint};
use rasray_gpu::Timing;
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::{Bench, oracle_of, oracle_ray};
use rasray_tests::invariance::scene;
use rasray_tests::random::Random;
use rasray_tests::rays::segment;
use rasray_tests::shapes::{Triangle, sphere};
use rasray_tests::views::{ALONG_Z, TURNED};
use rasray_tracer::{TracerError, build_until_complete};

const EYE: [f32; 3] = [0.1, -0.2, 0.3];

fn at_eye(camera: CameraView) -> Viewpoint {
    Viewpoint { eye: EYE, camera: Some(camera) }
}

/// Rays between two points that the camera sees: all of each is seen. Depths are metres along the view.
fn seen_rays(camera: CameraView, count: usize) -> Vec<Ray> {
    let mut random = Random::new(7);
    let mut point = || {
        let [x, y, z] = random.point(-1.0, 1.0);
        let depth = 5.0 + 4.5 * z;
        let across = [0.98 * x * depth * camera.half_width, 0.98 * y * depth * camera.half_height];
        std::array::from_fn::<f32, 3, _>(|i| {
            EYE[i] + camera.right[i] * across[0] + camera.up[i] * across[1] + camera.forward[i] * depth
        })
    };
    (0..count)
        .map(|index| {
            let (from, to) = (if index % 4 == 0 { EYE } else { point() }, point());
            segment(from, to)
        })
        .collect()
}

fn built(bench: &Bench, config: Config, triangles: &[Triangle], viewpoint: Viewpoint) -> ABuffer {
    let geometry = bench.geometry(triangles);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, viewpoint, Timing::None).expect("it completes");
    structure
}

fn contents(bench: &Bench, structure: &ABuffer) -> Contents {
    let contents = structure.download(bench.device()).expect("the device works");
    well_formed(&contents).expect("lists are well formed");
    contents
}

fn keys(hits: &[Hit]) -> Vec<[u32; 4]> {
    hits.iter().map(|hit| [hit.t.to_bits(), hit.primitive, hit.a.to_bits(), hit.b.to_bits()]).collect()
}

/// A camera that sees the same as a face, with as many cells, finds the same hits, bit for bit.
#[test]
fn a_camera_along_an_axis_is_a_face() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), seen_rays(ALONG_Z, 600));
    let cube = Config::at_centres(24);
    let expected = bench.trace(&built(&bench, cube, &triangles, EYE.into()), &rays).hits;
    let hit = expected.iter().filter(|hit| hit.is_hit()).count();
    assert!(hit > 100, "{hit} of {} rays hit", rays.len());
    let camera = Config { views: Views::Camera, ..cube };
    for config in [
        Config { storage: Storage::Sb, work_budget: Some(16), ..camera },
        Config { storage: Storage::Paged, addressing: Addressing::Address, ..camera },
        Config { views: Views::CubeCamera, work_budget: Some(16), ..cube },
    ] {
        let structure = built(&bench, config, &triangles, at_eye(ALONG_Z));
        let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 64);
        assert_eq!((counters.unfinished, counters.not_ready), (0, 0));
        assert_eq!(keys(&hits), keys(&expected), "{config:?}");
    }
}

/// Nothing outside of the pyramid is stored or hit, whatever the path of a ray.
#[test]
fn a_camera_alone_knows_what_it_sees_and_nothing_else() {
    let bench = Bench::new();
    let triangles = scene(false);
    let camera = TURNED;
    let config = Config { views: Views::Camera, camera_resolution: [40, 19], ..Config::at_centres(8) };
    let structure = built(&bench, config, &triangles, at_eye(camera));
    let contents = contents(&bench, &structure);
    // An even and an odd number: the smaller one is increased by one.
    assert_eq!(cell_count(&config), 42 * 22);
    assert_eq!(contents.lists.len() as u64, 2 * 4 * 42 * 22);
    let rays = Random::new(13).rays(2000, -6.0, 6.0);
    let hits = bench.trace(&structure, &rays).hits;
    let mut found = 0;
    for (ray, hit) in rays.iter().zip(&hits).filter(|(_, hit)| hit.is_hit()) {
        let point = |axis: usize| {
            f64::from(ray.origin[axis]) + f64::from(hit.t) * f64::from(ray.direction[axis])
                - f64::from(EYE[axis])
        };
        // A cell beyond the pyramid is its border.
        let slack = CameraView { half_width: 0.9 * 42.5 / 40.0, half_height: 0.45 * 22.5 / 20.0, ..camera };
        assert!(slack.sees(std::array::from_fn(point)), "{ray:?} {hit:?}");
        found += 1;
    }
    assert!(found > 100 && found < 1500, "{found} of 2000 rays hit");
}

/// A view that is rotated and wider than high follows the law of fragments, and is as exact as the cube.
#[test]
fn a_turned_camera_keeps_the_law_of_fragments() {
    let bench = Bench::new();
    let triangles = sphere([0.0; 3], 6.0, 10);
    let camera = TURNED;
    let rays = seen_rays(camera, 2000).into_iter().map(|ray| Ray { t_max: f32::INFINITY, ..ray });
    // A hit inside a closed sphere may lie outside of the view.
    let oracle = oracle_of(&triangles);
    let (rays, truths): (Vec<Ray>, Vec<_>) = rays
        .filter_map(|ray| {
            let truth = oracle.closest(&oracle_ray(&ray));
            let (primitive, t) = truth.outcome.hit().filter(|_| !truth.ambiguous)?;
            let point = |axis: usize| {
                f64::from(ray.origin[axis]) + t * f64::from(ray.direction[axis]) - f64::from(EYE[axis])
            };
            camera.sees(std::array::from_fn(point)).then_some((ray, (primitive, t)))
        })
        .unzip();
    assert!(rays.len() > 500, "{} rays", rays.len());
    let wrong = |config: Config| {
        let structure = built(&bench, config, &triangles, at_eye(camera));
        let hits = bench.trace(&structure, &rays).hits;
        let off = |hit: &Hit, t: f64| (f64::from(hit.t) - t).abs() > 1e-3 * t;
        hits.iter().zip(&truths).filter(|(hit, (_, t))| !hit.is_hit() || off(hit, *t)).count()
    };
    let share = |resolution: u32| {
        let config = Config {
            views: Views::Camera,
            camera_resolution: [resolution, resolution / 2],
            ..Config::at_centres(8)
        };
        wrong(config) as f64 / rays.len() as f64
    };
    let [coarse, fine] = [16, 128].map(share);
    // Errors fall with the size of a cell, here by eight.
    assert!(
        coarse > 0.0 && fine < 0.02 && fine < 0.2 * coarse,
        "{fine} of the rays, {coarse} in coarse cells"
    );
}

#[test]
fn a_view_of_a_camera_needs_one() {
    let bench = Bench::new();
    let geometry = bench.geometry(&scene(false));
    for views in [Views::CubeCamera, Views::Camera] {
        let config = Config { views, ..Config::at_centres(8) };
        let mut structure =
            ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
        let flat = CameraView { half_height: 0.0, ..ALONG_Z };
        for viewpoint in [Viewpoint::from(EYE), at_eye(flat)] {
            let error = build_until_complete(bench.device(), &mut structure, viewpoint, Timing::None);
            let error = error.expect_err("there is no camera");
            assert!(matches!(error, TracerError::Ads(_)) && error.to_string().contains("views"), "{error}");
        }
        // After a build with the eye alone nothing is answered.
        let hits = trace_in_rounds(&bench, &structure, &seen_rays(ALONG_Z, 10), TraceMode::Closest, 2);
        assert_eq!(hits.1.not_ready, 10);
        assert!(hits.0.iter().all(|hit| hit.primitive == PRIMITIVE_NONE));
    }
}
