//! Lamps behind mirrors through fragments that store surfaces in place of triangles: an emitter keeps its
//! triangle, by which paths know the light that photons brought, so that none counts twice.

use glam::DVec3;
use rasray_gpu::Timing;
use rasray_integrators::{Film, Integrator, IntegratorDesc, Path, PathOptions, PhotonOptions, Photons};
use rasray_scene::{Material, Scene};
use rasray_systems::Spec;
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{diffuse, glowing, looking, scene_of, square};
use rasray_tests::pictures::{rendered, staged};
use rasray_tracer::build_until_complete;

const SIZE: u32 = 32;
const SAMPLES: u32 = 64;

/// A floor before a mirror, which a lamp faces.
fn before_a_mirror() -> Scene {
    let mirror = Material { metallic: 1.0, roughness: 0.0, ..diffuse([1.0; 3]) };
    let meshes = vec![
        square(DVec3::ZERO, DVec3::X, -DVec3::Z, 0),
        square(DVec3::new(-1.0, 1.0, 0.0), -DVec3::Z, DVec3::Y, 1),
        square(DVec3::new(1.2, 1.0, 0.0), DVec3::Z * 0.3, DVec3::Y * 0.3, 2),
    ];
    let mut scene = scene_of(meshes, vec![diffuse([0.7; 3]), mirror, glowing([0.0; 3], [5.0; 3])]);
    scene.cameras = vec![looking(DVec3::new(-0.2, 1.8, 0.0), DVec3::new(-0.6, 0.0, 0.0), 0.3)];
    scene
}

#[test]
fn lamps_behind_mirrors_count_once_through_fragments() {
    let bench = Bench::new();
    let device = bench.device();
    let scene = staged(&bench, &before_a_mirror(), SIZE);
    let film = Film::new(device, SIZE, SIZE).expect("a small film fits");
    let desc = IntegratorDesc::new(device, &scene, &film);
    let of_bounces = |bounces| Path::new(&desc, bounces).expect("valid");
    let options = PhotonOptions {
        paths: PathOptions::from(2),
        photon_paths: 4096,
        radius: Some(0.05),
        ..PhotonOptions::default()
    };
    let photons = Photons::new(&desc, options).expect("valid");
    for (system, preset) in [("brute-force", "robust"), ("hu", "published"), ("selective", "published")] {
        let few = (system != "brute-force").then(|| ("resolution".to_owned(), "256".to_owned()));
        let spec = Spec::new(system, preset, few).expect("the options are valid");
        let mut structure =
            spec.create(device, scene.geometry(), Some(scene.binding())).expect("pipelines are made");
        build_until_complete(device, structure.as_mut(), scene.eye(), Timing::None).expect("it completes");
        let mut mean = |integrator: &dyn Integrator| {
            let image = rendered(&bench, integrator, &film, SAMPLES, structure.as_mut());
            image.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / image.len() as f64
        };
        let [direct, by_paths, by_photons] = [mean(&of_bounces(1)), mean(&of_bounces(2)), mean(&photons)];
        println!("{system} {preset}: direct {direct}, by paths {by_paths}, by photons {by_photons}");
        // Twice as much light by the mirror would be more than that.
        assert!(by_paths > 1.2 * direct, "{system}: {by_paths}, {direct}");
        assert!((by_photons / by_paths - 1.0).abs() < 0.06, "{system}: {by_photons}, {by_paths}");
    }
}
