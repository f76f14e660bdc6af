//! Closed rooms that glow, and objects that vanish in a white sky.

use glam::DVec3;
use rasray_scene::{Environment, Material, Scene};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    Studio, System, assert_refused, assert_truth, box_around, enclosure, glass, glowing, looking,
    octahedron_sphere, scene_of,
};

use super::{SYSTEMS, by_system, grey, law, samples};

const EMISSION: [f32; 3] = [1.0, 2.0, 0.5];
const ALBEDO: [f32; 3] = [0.2, 0.5, 0.8];

fn room(albedo: [f32; 3]) -> Scene {
    scene_of(box_around(DVec3::ZERO, DVec3::ONE, 0), vec![glowing(albedo, EMISSION)])
}

fn truth(albedo: [f32; 3], bounces: u32) -> [f64; 3] {
    std::array::from_fn(|c| enclosure(f64::from(EMISSION[c]), f64::from(albedo[c]), bounces))
}

#[test]
fn a_closed_room_adds_up_the_series_of_its_albedo() {
    let bench = Bench::new();
    let camera = looking(DVec3::new(0.1, -0.2, 0.3), DVec3::new(-0.5, 0.3, -0.9), 1.0);
    for system in SYSTEMS {
        let size = by_system(system, 64, 32);
        let stage = Studio::new(&bench, &room(ALBEDO), camera.clone(), size, system);
        let bounces: &[u32] = by_system(system, &[0, 1, 3, 24], &[0, 3]);
        let samples = samples(&bench, 8);
        let slack = |bounces| law(system, 2 * bounces + 1);
        for &bounces in bounces {
            let name = format!("furnace, {bounces} bounces, {system:?}");
            let found = stage.estimate(&stage.path(bounces), samples);
            assert_truth(&name, &found, truth(ALBEDO, bounces), slack(bounces.min(3)));
        }
        let factor = by_system(system, 1.01, 1.2);
        let broken = Studio::new(&bench, &room(ALBEDO.map(|x| x * factor)), camera.clone(), size, system);
        let found = broken.estimate(&broken.path(3), samples);
        assert_refused(&format!("furnace, {system:?}"), &found, truth(ALBEDO, 3), slack(3));
    }
}

/// Facets of glass hold light for long: after 24 scatterings half a percent is still inside, after 96 nothing
/// that more would let out.
const SCATTERINGS: u32 = 96;

/// A mirror, a solid sphere of glass and a hollow one, side by side under a white sky.
fn lossless(base_color: f32) -> Scene {
    let mirror = Material {
        base_color: [base_color, base_color, base_color, 1.0],
        roughness: 0.0,
        ..Material::default()
    };
    let solid = Material { base_color: mirror.base_color, ..glass(1.5) };
    let hollow = Material { thickness: 0.0, ..solid.clone() };
    let spheres = (0..3).map(|i| octahedron_sphere(DVec3::X * 3.0 * i as f64, 1.0, 2, i)).collect();
    let mut scene = scene_of(spheres, vec![mirror, solid, hollow]);
    scene.environment = Environment::Constant([1.0; 3]);
    scene
}

#[test]
fn lossless_mirrors_and_glass_vanish_in_a_white_sky() {
    let bench = Bench::new();
    let camera = |i: usize| {
        let place = DVec3::X * 3.0 * i as f64;
        looking(place + DVec3::new(0.3, 0.4, 4.0), place, 0.6)
    };
    let [mut stage, mut broken] =
        [1.0, 0.97].map(|color| Studio::new(&bench, &lossless(color), camera(0), 32, System::BruteForce));
    let (path, broken_path) = (stage.path(SCATTERINGS), broken.path(SCATTERINGS));
    let samples = samples(&bench, 8);
    for (i, name) in ["mirror", "glass", "thin glass"].into_iter().enumerate() {
        // Light still in the glass after so many scatterings is below a thousandth.
        let slack = 1e-3;
        stage.look(camera(i));
        assert_truth(name, &stage.estimate(&path, samples), grey(1.0), slack);
        broken.look(camera(i));
        assert_refused(name, &broken.estimate(&broken_path, samples), grey(1.0), slack);
    }
}
