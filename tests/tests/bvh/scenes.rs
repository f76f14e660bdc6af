//! Triangles of built-in scenes.

use rasray_gpu_scene::Posed;
use rasray_scene::{Moment, Scene};
use rasray_tests::shapes::Triangle;

/// The triangles of a built-in scene as it begins.
pub(crate) fn built_in(name: &str) -> Vec<Triangle> {
    triangles(&scene(name))
}

/// Those of a frame of its clips, at 30 a second.
pub(crate) fn frame_of(scene: &Scene, frame: usize) -> Vec<Triangle> {
    let clips = scene.animation.rig.compatible_clips();
    triangles(&scene.at(&Moment { seconds: frame as f64 / 30.0, clips }).expect("it moves"))
}

/// A built-in scene.
pub(crate) fn scene(name: &str) -> Scene {
    rasray_scene::builtin::builtin(name).expect("it is built in").expect("it can be made")
}

fn triangles(scene: &Scene) -> Vec<Triangle> {
    let posed = Posed::new(scene, glam::DVec3::ZERO, |_| 0).expect("ids fit");
    let corner = |index: &u32| posed.positions[*index as usize];
    posed.indices.as_chunks::<3>().0.iter().map(|corners| corners.each_ref().map(corner)).collect()
}
