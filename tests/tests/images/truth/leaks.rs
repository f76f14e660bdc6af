//! A closed box keeps light out, and coarse smooth normals stay harmless.

use glam::DVec3;
use rasray_scene::{Environment, Light, Material, Mesh, Scene};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    Picture, SIGMAS, Studio, System, box_around, diffuse, glowing, looking, scene_of, square,
};
use rasray_tests::tier::Counts;

use super::{RESOLUTION, law};

/// Paths in a closed box.
const PATHS: Counts<u32> = Counts { quick: 100_000, software: 1_000_000, full: 10_000_000 };

/// A closed grey box in a bright surrounding.
fn closed_box() -> Scene {
    let mut meshes = box_around(DVec3::ZERO, DVec3::ONE, 0);
    meshes.push(square(DVec3::Y * 3.0, DVec3::X * 2.0, DVec3::Z * 2.0, 1));
    let mut scene = scene_of(meshes, vec![diffuse([0.9; 3]), glowing([0.0; 3], [5.0; 3])]);
    scene.environment = Environment::Constant([1.0; 3]);
    scene.lights.push(Light::Point { position: DVec3::X * 2.0, intensity: [9.0; 3], range: f32::INFINITY });
    scene
}

fn inside(bench: &Bench, scene: &Scene, system: System, paths: u32) -> Picture {
    const SIZE: u32 = 32;
    let camera = looking(DVec3::new(0.1, -0.2, 0.3), DVec3::new(-0.5, 0.3, -0.9), 2.0);
    let stage = Studio::new(bench, scene, camera, SIZE, system);
    stage.render(&stage.path(4), 0..paths.div_ceil(SIZE * SIZE))
}

fn mean(picture: &Picture) -> f64 {
    picture.pixels.iter().flatten().map(|x| f64::from(*x)).sum::<f64>() / (3 * picture.pixels.len()) as f64
}

#[test]
fn no_light_enters_a_closed_box() {
    let bench = Bench::new();
    let paths = PATHS.on(bench.device(), "paths");
    let picture = inside(&bench, &closed_box(), System::BruteForce, paths);
    assert!(picture.pixels.iter().flatten().all(|x| *x == 0.0), "brightest: {}", mean(&picture));
    // A scratch of a hundredth of the box lets light in.
    let mut scratched = closed_box();
    scratched.meshes[3].positions[0][0] += 0.02;
    scratched.meshes[3].positions[1][0] += 0.02;
    let leaking = inside(&bench, &scratched, System::BruteForce, 20_000);
    assert!(mean(&leaking) > 1e-4, "{}", mean(&leaking));

    // Fragments leave gaps of a cell's width along edges: the law bounds what comes in.
    let system = System::Fragments(RESOLUTION);
    let mut scene = closed_box();
    scene.meshes.truncate(6);
    scene.instances.truncate(6);
    scene.lights.clear();
    let leak = mean(&inside(&bench, &scene, system, 8192));
    eprintln!("closed box, {system:?}: mean {leak:.6}");
    assert!(leak <= law(system, 9), "{leak}");
    scene.instances.truncate(5);
    let open = mean(&inside(&bench, &scene, system, 8192));
    assert!(open > law(system, 9), "{open}");
}

/// A sphere of 8 rows and 16 columns with the normals of the true sphere.
fn coarse_sphere(material: usize) -> Mesh {
    let facets = rasray_tests::shapes::sphere([0.0; 3], 1.0, 8);
    let positions: Vec<[f32; 3]> = facets.into_iter().flatten().collect();
    let unit = |p: &[f32; 3]| DVec3::from(p.map(f64::from)).normalize().as_vec3().to_array();
    Mesh {
        name: "coarse sphere".to_owned(),
        normals: Some(positions.iter().map(unit).collect()),
        indices: (0..positions.len() as u32).collect(),
        positions,
        material,
        ..Mesh::default()
    }
}

fn stage<'a>(bench: &'a Bench, material: Material, light: Option<Light>) -> Studio<'a> {
    let mut scene = scene_of(vec![coarse_sphere(0)], vec![material]);
    match light {
        Some(light) => scene.lights.push(light),
        None => scene.environment = Environment::Constant([1.0; 3]),
    }
    let camera = looking(DVec3::new(0.0, 0.5, 4.0), DVec3::ZERO, 0.6);
    Studio::new(bench, &scene, camera, 32, System::BruteForce)
}

/// True if all samples are finite, no pixel is negative, and the terminator is in the picture.
fn sound(stage: &Studio<'_>) -> bool {
    let picture = stage.render(&stage.path(3), 0..16);
    let mut values = picture.pixels.iter().flatten();
    picture.non_finite == 0 && values.all(|x| *x >= 0.0) && mean(&picture) > 0.0
}

/// Standard errors by which the picture is brighter than the sky.
fn surplus(stage: &Studio<'_>) -> f64 {
    let found = stage.estimate(&stage.path(3), 32);
    (found.mean[0] - 1.0) / found.sigma[0].max(1e-7)
}

#[test]
fn smooth_normals_on_coarse_facets_are_finite_and_add_no_energy() {
    let bench = Bench::new();
    let glossy = Material { roughness: 0.3, metallic: 0.0, ..Material::default() };
    // Parallel light from the side: the terminator faces the camera.
    let side = Light::Directional { direction: DVec3::NEG_X, irradiance: [1.0; 3] };
    assert!(sound(&stage(&bench, diffuse([1.0; 3]), Some(side))));
    assert!(sound(&stage(&bench, glossy.clone(), Some(side))));
    let infinite = Material { emission: [f32::INFINITY; 3], ..diffuse([1.0; 3]) };
    assert!(!sound(&stage(&bench, infinite, Some(side))));

    let mirror = Material { roughness: 0.0, ..Material::default() };
    for (name, material) in [("mirror", mirror), ("plastic", glossy.clone())] {
        let surplus = surplus(&stage(&bench, material, None));
        eprintln!("coarse {name} in a white sky: {surplus:.2} sigma above it");
        assert!(surplus <= SIGMAS, "{name}: {surplus}");
    }
    let brighter = Material { emission: [0.2; 3], ..glossy };
    assert!(surplus(&stage(&bench, brighter, None)) > SIGMAS);
}
