//! Light through layers that let their share pass in a straight line: blended ones, and smooth thin panes.

use std::f64::consts::PI;

use glam::DVec3;
use rasray_integrators::{GlassShadows, PathOptions};
use rasray_scene::{AlphaMode, Camera, Environment, Light, Material, Mesh, Scene};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    Studio, System, assert_refused, assert_truth, diffuse, glass, glowing, looking, parallel,
    polygon_irradiance, scene_of, square,
};
use rasray_tests::tier::is_full;

use super::{grey, samples};

const SIZE: u32 = 32;
const ALBEDO: f32 = 0.8;
const SUN: f64 = 3.0;
const SKY: f64 = 2.0;

/// Half of a layer's side: what comes in beside it is a millionth of the sky.
const HALF: f64 = 1000.0;

/// Black where it is not transparent: it shadows, and adds nothing.
fn veil(alpha: f32) -> Material {
    Material { base_color: [0.0, 0.0, 0.0, alpha], alpha_mode: AlphaMode::Blend, ..diffuse([0.0; 3]) }
}

/// A pane without reflection, so that what it lets through is its colour alone.
fn pane(color: [f32; 3]) -> Material {
    let [red, green, blue] = color;
    Material { base_color: [red, green, blue, 1.0], specular: 0.0, thickness: 0.0, ..glass(1.5) }
}

/// Light on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Lamp {
    Sun,
    Sky,
    /// A square above the layers, so large that scattered rays find it as often as light samples.
    Square,
    Point,
}

const LAMPS: [Lamp; 4] = [Lamp::Sun, Lamp::Sky, Lamp::Square, Lamp::Point];

fn towards_sun() -> DVec3 {
    DVec3::new(0.3, 0.8, -0.2).normalize()
}

/// The place of the point lamp, and the middle of the square one.
const LAMP: DVec3 = DVec3::new(0.5, 4.0, 0.3);

fn square_lamp() -> Mesh {
    square(LAMP, DVec3::X * 3.0, DVec3::Z * 3.0, 2)
}

impl Lamp {
    fn light(self, scene: &mut Scene) {
        match self {
            Self::Sun => {
                let (direction, irradiance) = (-towards_sun(), [SUN as f32; 3]);
                scene.lights.push(Light::Directional { direction, irradiance });
            }
            Self::Sky => scene.environment = Environment::Constant([SKY as f32; 3]),
            Self::Square => {
                let mesh = scene.meshes.len();
                scene.meshes.push(square_lamp());
                scene.instances.push(rasray_scene::Instance { mesh, ..scene.instances[0].clone() });
            }
            Self::Point => {
                scene.lights.push(Light::Point {
                    position: LAMP,
                    intensity: [40.0; 3],
                    range: f32::INFINITY,
                });
            }
        }
    }

    /// W/m^2 on the floor without layers.
    fn irradiance(self) -> f64 {
        match self {
            Self::Sun => SUN * towards_sun().y,
            Self::Sky => SKY * PI,
            Self::Square => {
                let corners: Vec<_> =
                    square_lamp().positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
                5.0 * polygon_irradiance(DVec3::ZERO, DVec3::Y, &corners)
            }
            Self::Point => 40.0 * LAMP.y / LAMP.length().powi(3),
        }
    }
}

/// A spot of floor under layers of one material, a centimetre apart, with the lamp above them.
fn under_layers(lamp: Lamp, count: usize, material: Material) -> Scene {
    let layer = |i: usize| square(DVec3::Y * (0.01 * i as f64 + 0.5), DVec3::Z * HALF, DVec3::X * HALF, 1);
    let mut meshes = vec![square(DVec3::ZERO, DVec3::Z * 0.01, DVec3::X * 0.01, 0)];
    meshes.extend((0..count).map(layer));
    let mut scene = scene_of(meshes, vec![diffuse([ALBEDO; 3]), material, glowing([0.0; 3], [5.0; 3])]);
    lamp.light(&mut scene);
    scene
}

/// From below the layers at a spot of the floor that is as good as a point.
fn at_the_floor() -> Camera {
    parallel(DVec3::new(0.1, 0.3, 0.1), DVec3::ZERO, 5e-4)
}

fn shown(lamp: Lamp, share: [f64; 3]) -> [f64; 3] {
    share.map(|share| f64::from(ALBEDO) / PI * lamp.irradiance() * share)
}

#[test]
fn light_under_blended_layers_is_what_each_lets_pass() {
    let bench = Bench::new();
    for lamp in LAMPS {
        for (count, alpha) in [(0, 1.0), (1, 0.3), (3, 0.5), (40, 0.02), (25, 0.0)] {
            let name = format!("{lamp:?} under {count} layers of alpha {alpha}");
            let scene = under_layers(lamp, count, veil(alpha));
            let studio = Studio::new(&bench, &scene, at_the_floor(), SIZE, System::BruteForce);
            let found = studio.estimate(&studio.path(1), samples(&bench, 16));
            let share = |alpha: f32| (1.0 - f64::from(alpha)).powi(count as i32);
            // The lamp shines on a point; the view shows a spot.
            assert_truth(&name, &found, shown(lamp, grey(share(alpha))), 2e-5);
            if count == 3 {
                assert_refused(&name, &found, shown(lamp, grey(share(0.55))), 2e-5);
            }
        }
    }
}

#[test]
fn light_under_thin_panes_has_their_tint() {
    let bench = Bench::new();
    let color = [0.9_f32, 0.5, 0.2];
    for lamp in LAMPS {
        for count in [1, 4] {
            let name = format!("{lamp:?} under {count} panes");
            let scene = under_layers(lamp, count, pane(color));
            let studio = Studio::new(&bench, &scene, at_the_floor(), SIZE, System::BruteForce);
            let truth = shown(lamp, color.map(|c| f64::from(c).powi(count as i32)));
            let found = studio.estimate(&studio.path(1), samples(&bench, 16));
            assert_truth(&name, &found, truth, 2e-5);
            // Scattered rays find what has an extent without light samples, for a bounce per pane.
            let opaque =
                PathOptions { glass_shadows: GlassShadows::Opaque, ..PathOptions::from(1 + count as u32) };
            let found = studio.estimate(&studio.path(opaque), samples(&bench, 16));
            match lamp {
                Lamp::Sky | Lamp::Square => assert_truth(&format!("{name}, opaque"), &found, truth, 2e-5),
                Lamp::Sun | Lamp::Point => assert_eq!(found.mean, [0.0; 3], "{name}"),
            }
        }
    }
}

/// Schlick's reflectance under the angle of the sun is lost at each pane.
#[test]
fn panes_reflect_their_share_of_the_sun() {
    let bench = Bench::new();
    let scene = |ior| under_layers(Lamp::Sun, 2, Material { thickness: 0.0, ..glass(ior) });
    let through = |ior: f64| {
        let f0 = ((ior - 1.0) / (ior + 1.0)).powi(2);
        1.0 - f0 - (1.0 - f0) * (1.0 - towards_sun().y).powi(5)
    };
    let truth = shown(Lamp::Sun, grey(through(1.5).powi(2)));
    for (ior, check) in [(1.5, assert_truth as fn(&str, &_, _, _)), (1.6, assert_refused)] {
        let studio = Studio::new(&bench, &scene(ior), at_the_floor(), SIZE, System::BruteForce);
        check("sun under two sheets", &studio.estimate(&studio.path(1), 2), truth, 2e-5);
    }
}

/// Panes of partial opacity let light pass through their holes and through their glass.
#[test]
fn a_blended_pane_lets_light_pass_in_both_ways() {
    let bench = Bench::new();
    let mut material = pane([0.6; 3]);
    material.base_color[3] = 0.25;
    material.alpha_mode = AlphaMode::Blend;
    let share = grey((0.75_f64 + 0.25 * f64::from(0.6_f32)).powi(2));
    for lamp in LAMPS {
        let scene = under_layers(lamp, 2, material.clone());
        let studio = Studio::new(&bench, &scene, at_the_floor(), SIZE, System::BruteForce);
        let found = studio.estimate(&studio.path(1), samples(&bench, 16));
        assert_truth(&format!("{lamp:?} under blended panes"), &found, shown(lamp, share), 2e-5);
    }
}

/// Layers that glow and let pass what they do not hide: the floor sees each behind those before it.
#[test]
fn blended_emitters_shine_through_each_other() {
    let bench = Bench::new();
    for (count, alpha) in [(1, 0.5), (12, 0.1)] {
        let material = Material { emission: [1.5; 3], ..veil(alpha) };
        let studio = Studio::new(
            &bench,
            &under_layers(Lamp::Sky, count, material),
            at_the_floor(),
            SIZE,
            System::BruteForce,
        );
        let passes = (1.0 - f64::from(alpha)).powi(count as i32);
        let truth = grey(f64::from(ALBEDO) * (SKY * passes + 1.5 * (1.0 - passes)));
        let found = studio.estimate(&studio.path(1), samples(&bench, 16));
        assert_truth(&format!("{count} glowing layers"), &found, truth, 2e-5);
    }
}

/// A small lamp, half of it there, far away: light samples find it, where scattered rays would meet it once
/// in ten thousand.
#[test]
fn a_blended_lamp_shines_as_its_opacity_says() {
    let bench = Bench::new();
    let lamp = || square(DVec3::new(0.5, 4.0, 0.3), DVec3::X * 0.05, DVec3::Z * 0.05, 1);
    let floor = || square(DVec3::ZERO, DVec3::Z * 0.01, DVec3::X * 0.01, 0);
    let corners: Vec<_> = lamp().positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
    let irradiance = 1000.0 * polygon_irradiance(DVec3::ZERO, DVec3::Y, &corners);
    for (alpha, share) in [(1.0, 1.0), (0.5, 0.5), (0.0, 0.0)] {
        let material = Material { emission: [1000.0; 3], ..veil(alpha) };
        let scene = scene_of(vec![floor(), lamp()], vec![diffuse([ALBEDO; 3]), material]);
        let studio = Studio::new(&bench, &scene, at_the_floor(), SIZE, System::BruteForce);
        let found = studio.estimate(&studio.path(1), samples(&bench, 16));
        let truth = f64::from(ALBEDO) / PI * irradiance * share;
        let name = format!("a lamp of opacity {alpha}");
        // The lamp shines on a point; the view shows a spot.
        assert_truth(&name, &found, grey(truth), 2e-4);
        if share > 0.0 {
            assert_refused(&name, &found, grey(1.01 * truth), 2e-4);
        }
    }
}

/// A white wall in a white world is white behind any number of clear layers, and lit as if they were not
/// there.
#[test]
fn clear_layers_change_nothing() {
    let bench = Bench::new();
    let most = if is_full() { 300 } else { 60 };
    for (bounces, counts) in [(8, [0, 12, 20]), (1, [1, 40, most])] {
        for count in counts {
            let mut meshes = vec![square(DVec3::ZERO, DVec3::X * 20.0, DVec3::Y * 20.0, 0)];
            meshes
                .extend((0..count).map(|i| {
                    square(DVec3::Z * (1.0 + 0.02 * i as f64), DVec3::X * HALF, DVec3::Y * HALF, 1)
                }));
            let mut scene = scene_of(meshes, vec![diffuse([1.0; 3]), veil(0.0)]);
            scene.environment = Environment::Constant([1.0; 3]);
            let eye = DVec3::new(0.0, 0.0, 10.0);
            let studio =
                Studio::new(&bench, &scene, looking(eye, DVec3::ZERO, 0.5), SIZE, System::BruteForce);
            let found = studio.estimate(&studio.path(bounces), 4);
            assert_truth(&format!("{count} clear layers, {bounces} bounces"), &found, grey(1.0), 2e-5);
        }
    }
}
