//! Device images against the naive ones of the CPU, sample by sample with the same random numbers.
//!
//! The two read the scene independently, so packing, textures, lights and scattering are all held
//! against each other. What remains is rounding: a few paths take another turn where a random number
//! falls next to a threshold, so most pixels must agree closely and the means very closely.

mod common;

use common::{scenes::*, *};
use glam::DVec3;
use rasray_integrators::{AmbientOcclusion, Path};
use rasray_reference::shading::{PosedScene, View};
use rasray_scene::{Camera, Scene};

const WIDTH: u32 = 24;
const HEIGHT: u32 = 20;
const SEED: u32 = 11;

enum Kind {
    Path(u32),
    Occlusion(f32),
}

/// How far an image is from its reference.
#[derive(Debug)]
struct Difference {
    /// Share of the pixels that differ by more than 1e-3 of their value.
    share: f64,
    /// Difference of the means over the reference's.
    mean: f64,
}

/// Renders `shown` on the device and `scene` on the CPU.
fn difference(shown: &Scene, scene: &Scene, camera: &Camera, samples: u32, kind: &Kind) -> Difference {
    let device = device();
    let stage = Stage::new(&device, shown, camera.clone(), WIDTH, HEIGHT, SEED);
    let view = View { camera: camera.clone(), width: WIDTH, height: HEIGHT, samples, seed: SEED };
    let posed = PosedScene::new(scene, stage.scene.frame_origin()).expect("the scene is well formed");
    let (image, reference) = match *kind {
        Kind::Path(bounces) => (
            stage.render(&Path::new(&stage.desc(), bounces).expect("valid"), samples),
            posed.render_path(&view, bounces).expect("valid").pixels,
        ),
        Kind::Occlusion(range) => (
            stage.render(&AmbientOcclusion::new(&stage.desc(), range).expect("valid"), samples),
            posed.render_ambient_occlusion(&view, range).expect("valid").pixels,
        ),
    };
    assert_eq!(stage.film.read_faults(&device).expect("readable").non_finite, 0);
    let differs = |(a, b): (&[f32; 3], &[f32; 3])| {
        (0..3).any(|channel| (a[channel] - b[channel]).abs() > 1e-3 * (b[channel].abs() + 1e-2))
    };
    let count = image.iter().zip(&reference).filter(|&pair| differs(pair)).count();
    let (mean_image, mean_reference) = (mean(&image), mean(&reference));
    assert!(mean_reference > 0.01, "{}: the reference is black", scene.name);
    assert_silent(&device);
    Difference {
        share: count as f64 / image.len() as f64,
        mean: (mean_image - mean_reference).abs() / mean_reference,
    }
}

/// At most `deviating` of the pixels may differ.
fn compare(scene: &Scene, camera: &Camera, samples: u32, kind: &Kind, deviating: f64) {
    let found = difference(scene, scene, camera, samples, kind);
    eprintln!("{}: {found:?}", scene.name);
    assert!(found.share <= deviating && found.mean <= 0.01, "{}: {found:?}", scene.name);
}

#[test]
fn cornell_box() {
    let (scene, camera) = cornell();
    compare(&scene, &camera, 4, &Kind::Path(4), 0.01);
    compare(&scene, &camera, 4, &Kind::Occlusion(0.2), 0.01);
}

#[test]
fn a_wrong_scene_is_noticed() {
    let (scene, camera) = cornell();
    let mut brighter = scene.clone();
    for material in &mut brighter.materials {
        material.base_color[0] *= 1.01;
    }
    let found = difference(&brighter, &scene, &camera, 4, &Kind::Path(4));
    assert!(found.share > 0.5, "{found:?}");
    let mut lower = scene.clone();
    for instance in &mut lower.instances {
        instance.world_from_mesh.translation.y -= 0.01;
    }
    let found = difference(&lower, &scene, &camera, 4, &Kind::Occlusion(0.2));
    assert!(found.share > 0.1, "{found:?}");
}

#[test]
fn textures_masks_lights_and_an_environment_map() {
    let eye = forward_camera(DVec3::new(0.0, 0.2, 1.0));
    compare(&textured_room(), &eye, 4, &Kind::Path(3), 0.01);
    compare(&textured_room(), &eye, 4, &Kind::Occlusion(1.0), 0.01);
}

#[test]
fn glass_mirrors_and_blended_surfaces() {
    let eye = forward_camera(DVec3::new(0.0, 0.0, 0.9));
    compare(&glass_room(), &eye, 4, &Kind::Path(5), 0.01);
}
