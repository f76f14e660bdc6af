//! Tests of the share of shadow rays on which maps and traces differ: it falls as the resolution grows.

use std::path::{Path, PathBuf};

use glam::DVec3;
use rasray_gpu::Device;
use rasray_scene::{Light, Moment, Scene, builtin};
use rasray_scene_files::{LoadOptions, load};
use rasray_shadow_maps::{Config, bytes, views_of};

use crate::lit::{Lit, cluttered_room, device, expect_silence, lights, scene_of};

/// Returns the shares of rays with different answers, for each light, at each resolution that the device has
/// room for.
fn disagreement(device: &Device, scene: &Scene, resolutions: &[u32], rays: usize) -> Vec<Vec<f64>> {
    let of_light = |light: usize| {
        let alone = Scene { lights: vec![scene.lights[light]], ..scene.clone() };
        let mut lit = Lit::new(device, &alone, Config::new(16));
        let views: Vec<_> = lit.scene.lights().iter().map(views_of).collect();
        let rays = lit.shadow_rays(0, rays);
        let traced = lit.occluded(&rays, false);
        let mut shares = Vec::new();
        for &resolution in resolutions {
            if bytes(&Config::new(resolution), &views, 0) > device.limits().max_storage_buffer_range {
                break;
            }
            lit = lit.with(Config::new(resolution));
            lit.build();
            let found = lit.occluded(&rays, true);
            let differ = found.iter().zip(&traced).filter(|(found, traced)| found != traced).count();
            shares.push(differ as f64 / rays.len() as f64);
        }
        shares
    };
    (0..scene.lights.len()).map(of_light).collect()
}

/// Returns the exponent e if shares are proportional to resolution^-e, by least squares.
pub fn exponent(resolutions: &[u32], shares: &[f64]) -> f64 {
    let x: Vec<f64> = resolutions.iter().map(|&n| f64::from(n).ln()).collect();
    let y: Vec<f64> = shares.iter().map(|share| share.ln()).collect();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mx, my) = (mean(&x), mean(&y));
    let across: f64 = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my)).sum();
    -across / x.iter().map(|x| (x - mx).powi(2)).sum::<f64>()
}

pub fn is_full() -> bool {
    std::env::var_os("RASRAY_FULL").is_some_and(|full| full == "1")
}

/// Returns `full` points in the full tier, and a third of them in the quick tier.
pub fn points(full: usize) -> usize {
    if is_full() { full } else { full / 3 }
}

fn print_and_check(name: &str, lights: &[&str], resolutions: &[u32], shares: &[Vec<f64>], least: f64) {
    println!("{name}: texels {resolutions:?}");
    for (light, shares) in lights.iter().zip(shares) {
        let e = exponent(&resolutions[..shares.len()], shares);
        let percent: Vec<String> = shares.iter().map(|share| format!("{:.3}", 100.0 * share)).collect();
        println!("  {light}: {} %, exponent {e:.2}", percent.join(" "));
        assert!((least..1.35).contains(&e), "{name}, {light}: {shares:?}, exponent {e}");
    }
}

/// Returns the lights of a room, scaled to the bounds of a scene.
fn lights_around(lower: DVec3, upper: DVec3) -> Vec<Light> {
    let (centre, size) = ((lower + upper) / 2.0, (upper - lower).max_element());
    let [above, aside] =
        [DVec3::new(0.31, 1.1, 0.7), DVec3::new(-1.0, 1.2, 0.9)].map(|at| centre + size * at);
    vec![
        Light::Point { position: above, intensity: [1.0; 3], range: f32::INFINITY },
        Light::Spot {
            position: aside,
            direction: (centre - aside).normalize(),
            intensity: [1.0; 3],
            range: f32::INFINITY,
            inner_cone: 0.3,
            outer_cone: 0.6,
        },
        Light::Directional { direction: DVec3::new(0.4, -0.8, 0.3).normalize(), irradiance: [1.0; 3] },
    ]
}

fn bounds(scene: &Scene) -> [DVec3; 2] {
    let corners = || {
        scene.instances.iter().flat_map(|instance| {
            let place =
                |p: &[f32; 3]| instance.world_from_mesh.transform_point3(glam::Vec3::from(*p).as_dvec3());
            scene.meshes[instance.mesh].positions.iter().map(place)
        })
    };
    [corners().fold(DVec3::INFINITY, DVec3::min), corners().fold(DVec3::NEG_INFINITY, DVec3::max)]
}

/// Returns Cornell's room, lit from within, where everything is inside of the view of a light. Its lamp
/// remains as a part of the ceiling.
fn lit_cornell() -> Scene {
    let mut scene = builtin::cornell();
    scene.lights = vec![
        Light::Point { position: DVec3::new(0.05, 0.5, -0.25), intensity: [1.0; 3], range: f32::INFINITY },
        Light::Spot {
            position: DVec3::new(-0.2, 0.5, -0.05),
            direction: DVec3::new(0.35, -0.8, -0.4).normalize(),
            intensity: [1.0; 3],
            range: f32::INFINITY,
            inner_cone: 0.4,
            outer_cone: 0.7,
        },
        Light::Directional { direction: DVec3::new(-0.2, -0.4, -0.9).normalize(), irradiance: [1.0; 3] },
    ];
    scene
}

const KINDS: [&str; 3] = ["point", "spot", "directional"];

#[test]
fn errors_fall_as_resolution_grows_in_cornell() {
    let (device, _turn) = device();
    let resolutions: &[u32] = if is_full() { &[256, 512, 1024, 2048, 4096] } else { &[64, 128, 256, 512] };
    let shares = disagreement(&device, &lit_cornell(), resolutions, points(200_000));
    print_and_check("cornell", &KINDS, resolutions, &shares, 0.75);
    expect_silence(&device);
}

#[test]
fn errors_fall_as_resolution_grows_in_clutter() {
    let (device, _turn) = device();
    let resolutions: &[u32] = if is_full() { &[256, 512, 1024, 2048, 4096] } else { &[64, 128, 256, 512] };
    let scene = scene_of(&cluttered_room(60), lights());
    let shares = disagreement(&device, &scene, resolutions, points(60_000));
    let kinds = ["point", "spot", "directional", "wide spot", "point by a wall"];
    print_and_check("cluttered room", &kinds, resolutions, &shares, 0.75);
    expect_silence(&device);
}

/// Measures an animated scene of `RASRAY_SCENES`, at a time of its clip, on a floor.
#[test]
fn errors_fall_as_resolution_grows_for_a_moving_truck() {
    let Some(folder) = std::env::var_os("RASRAY_SCENES").map(PathBuf::from) else {
        println!("skipped: RASRAY_SCENES names no folder of scenes");
        return;
    };
    let place = folder.join(Path::new("animated/CesiumMilkTruck/CesiumMilkTruck.glb"));
    let rest = load(&place, &LoadOptions::default()).expect("the scene is read");
    let moment = Moment { seconds: 0.7, clips: rest.animation.rig.compatible_clips() };
    let mut scene = rest.at(&moment).expect("it can be posed");
    let [lower, upper] = bounds(&scene);
    scene.lights = lights_around(lower, upper);
    let (device, _turn) = device();
    let resolutions: &[u32] = if is_full() { &[256, 512, 1024, 2048, 4096] } else { &[128, 256, 512] };
    let shares = disagreement(&device, &scene, resolutions, points(40_000));
    // The truck's decals and panels lie closer together than a coarse map can tell apart, so errors fall in
    // steps.
    print_and_check("CesiumMilkTruck", &KINDS, resolutions, &shares, 0.5);
    expect_silence(&device);
}
