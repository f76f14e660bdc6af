//! Metal and plastic under a white sky against their albedo by quadrature.

use glam::DVec3;
use rasray_scene::{Camera, Environment, Material, Scene};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    Plastic, Studio, System, assert_refused, assert_truth, metal_albedo, parallel, plastic_albedo, scene_of,
    square,
};
use rasray_tests::tier::is_full;

use super::grey;

const SIZE: u32 = 64;

/// Largest error of the polynomials that stand for the integrals of facets (docs/shading.md, "Energy").
const FITTED: f64 = 0.01;

/// Base colour, metallic, roughness.
const MATERIALS: [(f32, f32, f32); 4] = [(1.0, 1.0, 0.5), (0.7, 1.0, 1.0), (0.8, 0.0, 0.5), (1.0, 0.0, 0.9)];

fn truth((color, metallic, roughness): (f32, f32, f32), cosine: f64) -> f64 {
    let (base_color, roughness) = (f64::from(color), f64::from(roughness));
    if metallic == 1.0 {
        metal_albedo(base_color, roughness, cosine)
    } else {
        plastic_albedo(Plastic { base_color, roughness, ior: 1.5 }, cosine)
    }
}

fn scene(materials: impl Iterator<Item = (f32, f32, f32)>) -> Scene {
    let materials: Vec<Material> = materials
        .map(|(color, metallic, roughness)| Material {
            base_color: [color, color, color, 1.0],
            metallic,
            roughness,
            ..Material::default()
        })
        .collect();
    let place = |i: usize| square(DVec3::X * 10.0 * i as f64, DVec3::X, -DVec3::Z, i);
    let mut scene = scene_of((0..materials.len()).map(place).collect(), materials);
    scene.environment = Environment::Constant([1.0; 3]);
    scene
}

fn camera(index: usize, cosine: f64) -> Camera {
    let point = DVec3::X * 10.0 * index as f64;
    let direction = DVec3::new(0.6, 0.0, 0.8) * (1.0 - cosine * cosine).sqrt() + DVec3::Y * cosine;
    parallel(point + 2.0 * direction, point, 1e-3)
}

#[test]
fn metal_and_plastic_reflect_what_their_lobes_integrate_to() {
    let bench = Bench::new();
    let samples = if is_full() { 256 } else { 12 };
    let right = scene(MATERIALS.into_iter());
    let smoother =
        scene(MATERIALS.into_iter().map(|(color, metallic, rough)| (color, metallic, rough * 0.8)));
    let darker = scene(MATERIALS.into_iter().map(|(color, metallic, rough)| (color * 0.96, metallic, rough)));
    let [mut stage, mut smoother, mut darker] =
        [right, smoother, darker].map(|s| Studio::new(&bench, &s, camera(0, 0.9), SIZE, System::BruteForce));
    let paths = [stage.path(1), smoother.path(1), darker.path(1)];
    for (index, material) in MATERIALS.into_iter().enumerate() {
        for cosine in [0.9, 0.3] {
            let expected = truth(material, cosine);
            // Nothing shows more of a white sky than there is.
            assert!(expected < 1.0 + 1e-9);
            let name = format!("albedo of {material:?} under cosine {cosine}");
            stage.look(camera(index, cosine));
            assert_truth(&name, &stage.estimate(&paths[0], samples), grey(expected), FITTED);
            if cosine == 0.9 {
                darker.look(camera(index, cosine));
                assert_refused(&name, &darker.estimate(&paths[2], samples), grey(expected), FITTED);
            }
        }
    }
    // A rough metal that is a little smoother reflects more at a slant.
    smoother.look(camera(1, 0.3));
    let expected = truth(MATERIALS[1], 0.3);
    assert_refused("smoother metal", &smoother.estimate(&paths[1], samples), grey(expected), FITTED);
}
