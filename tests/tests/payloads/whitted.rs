//! Mirrors that face each other, through every system: what they show of each other is that of brute force,
//! bit for bit, where triangles are found without loss, and elsewhere as bright as errors of hits allow.

use glam::{DAffine3, DQuat, DVec3};
use rasray_ads::StructureKind;
use rasray_gpu::Timing;
use rasray_gpu_scene::GpuScene;
use rasray_integrators::{Film, IntegratorDesc, Select, Traced, Visibility, Whitted, WhittedOptions};
use rasray_scene::{Camera, Environment, Instance, Material, Mesh, Projection, Scene};
use rasray_systems::{SYSTEMS, Spec};
use rasray_tests::harness::{Bench, is_offered};
use rasray_tests::pictures::{rendered, rendered_through, stage, staged};
use rasray_tracer::build_until_complete;

use crate::kept_pictures::Compared;

const SIZE: u32 = 32;
const SAMPLES: u32 = 2;

/// Largest relative error of the mean where hits may be off.
const ALLOWED: f32 = 0.05;

fn image(bench: &Bench, scene: &GpuScene, system: &str) -> (StructureKind, Vec<[f32; 3]>) {
    let device = bench.device();
    let few = ["mmrt", "hu", "selective", "ldc"].contains(&system);
    let options = few.then(|| ("resolution".to_owned(), "256".to_owned()));
    let spec = Spec::new(system, "robust", options).expect("the options are valid");
    let mut structure =
        spec.create(device, scene.geometry(), Some(scene.binding())).expect("pipelines are made");
    build_until_complete(device, structure.as_mut(), scene.eye(), Timing::None).expect("the build completes");
    let film = Film::new(device, SIZE, SIZE).expect("a small film fits");
    let desc = IntegratorDesc::new(device, scene, &film);
    let options = WhittedOptions { ray_depth: 6, ..WhittedOptions::default() };
    let whitted = Whitted::new(&desc, options).expect("the options are valid");
    (structure.description().kind, rendered(bench, &whitted, &film, SAMPLES, structure.as_mut()))
}

#[test]
fn every_system_shows_what_mirrors_show_of_each_other() {
    let bench = Bench::new();
    let scene = stage(&bench, "corridor", SIZE);
    let mean = |image: &[[f32; 3]]| image.iter().flatten().sum::<f32>() / (3 * image.len()) as f32;
    let bits = |image: &[[f32; 3]]| image.iter().map(|pixel| pixel.map(f32::to_bits)).collect::<Vec<_>>();
    let (_, expected) = image(&bench, &scene, "brute-force");
    assert!(mean(&expected) > 0.1, "{}", mean(&expected));
    let mut exact = 0;
    for system in SYSTEMS.iter().filter(|system| system.name != "brute-force") {
        if !is_offered(&Spec::new(system.name, "robust", []).expect("every system is robust")) {
            continue;
        }
        let (kind, found) = image(&bench, &scene, system.name);
        let compared = Compared { picture: &found, reference: &expected, width: SIZE };
        let off = (mean(&found) / mean(&expected) - 1.0).abs();
        let differing = bits(&found).iter().zip(bits(&expected)).filter(|(a, b)| *a != b).count();
        println!("{}: {off:.4} off, {differing} pixels differ", system.name);
        if kind == StructureKind::Primitive {
            exact += 1;
            compared.assert_bits(format_args!("{}: another image than brute force's", system.name));
        }
        compared.assert(off < ALLOWED, format_args!("{}: {off} off", system.name));
    }
    assert!(exact >= 4, "{exact} systems find triangles without loss");
}

/// A mirror under a sky of texels: what the camera sees of the sky, and what the mirror shows of it.
fn mirror_under_a_sky() -> Scene {
    let corner = |x: f32, z: f32| [2.0 * x, 0.0, 2.0 * z];
    let mirror = Mesh {
        positions: vec![corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    let turn = DQuat::from_rotation_x(-0.5);
    let camera = Camera {
        name: "above".to_owned(),
        world_from_camera: DAffine3::from_rotation_translation(turn, DVec3::new(0.1, 1.4, 2.2)),
        projection: Projection::Perspective { fov_y: 1.1 },
        aspect_ratio: None,
        lens: None,
    };
    let radiance = (0..16 * 8).map(|i| [0.1 + (i % 5) as f32 * 0.2, 0.3, 0.2 + (i / 16) as f32 * 0.1]);
    Scene {
        meshes: vec![mirror],
        instances: vec![Instance { name: "mirror".to_owned(), mesh: 0, world_from_mesh: DAffine3::IDENTITY }],
        materials: vec![Material {
            metallic: 1.0,
            roughness: 0.0,
            base_color: [0.9; 4],
            ..Material::default()
        }],
        environment: Environment::LatLong { width: 16, height: 8, radiance: radiance.collect() },
        cameras: vec![camera],
        ..Scene::default()
    }
}

/// The frame that the paper publishes: drawn first hits, rays from what mirrors alone. Those that hit nothing
/// show the environment in their direction.
#[test]
fn rays_that_miss_a_layered_depth_cube_show_the_environment() {
    let bench = Bench::new();
    let device = bench.device();
    let scene = staged(&bench, &mirror_under_a_sky(), SIZE);
    let first_hits = Visibility::new(device, &scene, false).expect("the device draws");
    let picture = |system: &str, preset: &str, ray_depth: u32| {
        let spec = Spec::new(system, preset, None::<(String, String)>).expect("the options are valid");
        let mut structure =
            spec.create(device, scene.geometry(), Some(scene.binding())).expect("pipelines are made");
        build_until_complete(device, structure.as_mut(), scene.eye(), Timing::None).expect("it completes");
        let film = Film::new(device, SIZE, SIZE).expect("a small film fits");
        let options = WhittedOptions { ray_depth, select: Select::Specular, ..WhittedOptions::default() };
        let whitted = Whitted::new(&IntegratorDesc::new(device, &scene, &film), options).expect("valid");
        let traced = Traced::from(structure.as_ref()).with_primary(Some(&first_hits));
        rendered_through(&bench, &whitted, &film, SAMPLES, traced)
    };
    let expected = picture("brute-force", "robust", 1);
    for preset in ["published", "robust"] {
        let found = picture("ldc", preset, 1);
        Compared { picture: &found, reference: &expected, width: SIZE }.assert_bits(preset);
    }
    let black = picture("ldc", "published", 0);
    let mirrored = expected.iter().zip(&black).filter(|(shown, black)| shown != black).count();
    assert!(mirrored > expected.len() / 4, "{mirrored} pixels show the sky in the mirror");
}
