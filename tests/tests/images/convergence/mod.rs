//! Errors of rendered images: how they fall, what of them is not noise, and how they are stated:
//! `docs/image-truth.md`.

mod coupled;
mod metrics;
mod slope;

use glam::DVec3;
use rasray_reference::shading::{PosedScene, View};
use rasray_scene::{Camera, Sampler, Scene};
use rasray_tests::image_truth::Studio;

/// Pixels along a side.
const SIZE: u32 = 24;
const SAMPLES: u32 = 4;
const BOUNCES: u32 = 4;

fn cornell() -> (Scene, Camera) {
    let scene = rasray_scene::builtin::cornell();
    let camera = scene.cameras[0].clone();
    (scene, camera)
}

/// Pixels of the reference on the CPU.
fn reference(scene: &Scene, camera: &Camera, origin: DVec3, seed: u32) -> Vec<[f32; 3]> {
    let view = View {
        camera: camera.clone(),
        width: SIZE,
        height: SIZE,
        samples: SAMPLES,
        seed,
        sampler: Sampler::default(),
    };
    let posed = PosedScene::new(scene, origin).expect("the scene is whole");
    posed.render_path(&view, BOUNCES).expect("the image has pixels").pixels
}

/// Pixels of the device.
fn rendered(stage: &Studio<'_>) -> Vec<[f32; 3]> {
    let picture = stage.render(&stage.path(BOUNCES), 0..SAMPLES);
    assert_eq!(picture.non_finite, 0);
    picture.pixels
}
