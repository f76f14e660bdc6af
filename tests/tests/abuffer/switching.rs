//! Rays that pass from view to view: as published they lose what lies within a cell of a view's side, and
//! nothing else.

use rasray_abuffer::{ABuffer, Config, March, ViewSwitching, Views};
use rasray_ads::{CameraView, Hit, Ray, TraceMode, Viewpoint};
use rasray_gpu::Timing;
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::invariance::{EYE, general_rays, rays, scene};
use rasray_tests::random::Random;
use rasray_tests::rays::segment;
use rasray_tests::shapes::Triangle;
use rasray_tests::views::ALONG_Z;
use rasray_tracer::build_until_complete;

fn snapped(config: Config) -> Config {
    Config { view_switching: ViewSwitching::Snap, ..config }
}

fn hits_of(
    bench: &Bench,
    config: Config,
    triangles: &[Triangle],
    camera: Option<CameraView>,
    rays: &[Ray],
) -> Vec<Hit> {
    let geometry = bench.geometry(triangles);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, Viewpoint { eye: EYE, camera }, Timing::None)
        .expect("it completes");
    let (hits, counters) = trace_in_rounds(bench, &structure, rays, TraceMode::Closest, 512);
    assert_eq!((counters.unfinished, counters.not_ready, counters.corrupted), (0, 0, 0));
    hits
}

fn key(hit: &Hit) -> [u32; 2] {
    [hit.t.to_bits(), hit.primitive]
}

/// Distance in cells of a point of a ray from the nearest side of the face that it is in.
fn cells_to_side(ray: &Ray, t: f32, resolution: u32) -> f64 {
    let mut sizes: [f64; 3] = std::array::from_fn(|axis| {
        let origin = f64::from(ray.origin[axis]) - f64::from(EYE[axis]);
        (origin + f64::from(t) * f64::from(ray.direction[axis])).abs()
    });
    sizes.sort_by(f64::total_cmp);
    (1.0 - sizes[1] / sizes[2]) * f64::from(resolution) / 2.0
}

#[test]
fn rays_that_are_snapped_lose_hits_by_the_sides_of_faces_only() {
    let bench = Bench::new();
    let triangles = scene(false);
    let rays = general_rays(4000);
    let lost = |resolution: u32| {
        let config = Config::at_centres(resolution);
        let exact = hits_of(&bench, config, &triangles, None, &rays);
        let snap = hits_of(&bench, snapped(config), &triangles, None, &rays);
        let mut lost = 0;
        for ((ray, exact), snap) in rays.iter().zip(&exact).zip(&snap) {
            if key(exact) == key(snap) {
                continue;
            }
            assert!(exact.is_hit() && exact.t < snap.t, "{ray:?}: {exact:?}, snapped {snap:?}");
            let cells = cells_to_side(ray, exact.t, resolution);
            // At a side the cell beyond it is searched as well, over the ray's interval in the last cell.
            assert!(cells < 1.01, "{cells} cells from a side: {ray:?} {exact:?}, snapped {snap:?}");
            lost += 1;
        }
        lost
    };
    let [coarse, fine] = [16, 128].map(lost);
    println!("{coarse} and {fine} of {} rays lose their hit", rays.len());
    // As many as there are within half a cell of a side: an eighth with cells of an eighth of the size.
    assert!(coarse > 100 && fine > 0 && fine < coarse / 4, "{coarse} and {fine} of {} rays", rays.len());
}

#[test]
fn the_march_of_snapped_rays_may_pause_anywhere() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), rays(400));
    for (views, march, camera) in [
        (Views::Cube, March::Exact, None),
        (Views::Cube, March::Pyramid, None),
        (Views::CubeCamera, March::Exact, Some(ALONG_Z)),
        (Views::Camera, March::Samples, Some(ALONG_Z)),
    ] {
        let config = snapped(Config { views, march, ..Config::at_centres(24) });
        let expected = hits_of(&bench, config, &triangles, camera, &rays);
        let paused = hits_of(&bench, Config { work_budget: Some(2), ..config }, &triangles, camera, &rays);
        for ((ray, expected), paused) in rays.iter().zip(&expected).zip(&paused) {
            assert_eq!(key(expected), key(paused), "{ray:?} {config:?}");
        }
    }
}

/// The faces have more cells than the camera's view, and other hits: none of them counts where the camera
/// sees the ray.
#[test]
fn rays_that_the_camera_sees_are_searched_in_its_view_alone() {
    let bench = Bench::new();
    let triangles = scene(false);
    let mut random = Random::new(5);
    let mut point = || {
        let [x, y, z] = random.point(-1.0, 1.0);
        let depth = 5.0 + 4.5 * z;
        [EYE[0] + 0.8 * x * depth, EYE[1] + 0.8 * y * depth, EYE[2] + depth]
    };
    let rays: Vec<Ray> = (0..1000).map(|_| segment(point(), point())).collect();
    let config = Config { camera_resolution: [24; 2], ..Config::at_centres(48) };
    let of = |config| hits_of(&bench, config, &triangles, Some(ALONG_Z), &rays);
    let camera = of(Config { views: Views::Camera, ..config });
    let both = Config { views: Views::CubeCamera, ..config };
    let (exact, snap) = (of(both), of(snapped(both)));
    let mut other = 0;
    for (((ray, camera), exact), snap) in rays.iter().zip(&camera).zip(&exact).zip(&snap) {
        assert_eq!(key(camera), key(snap), "{ray:?}");
        other += usize::from(key(exact) != key(snap));
    }
    assert!(other > 0, "the faces find what the camera's view does");
}
