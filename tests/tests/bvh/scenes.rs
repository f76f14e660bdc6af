//! Triangles of built-in scenes.

use rasray_gpu_scene::Posed;
use rasray_tests::shapes::Triangle;

/// The triangles of a built-in scene as it begins.
pub(crate) fn built_in(name: &str) -> Vec<Triangle> {
    let scene = rasray_scene::builtin::builtin(name).expect("it is built in").expect("it can be made");
    let posed = Posed::new(&scene, glam::DVec3::ZERO, |_| 0).expect("ids fit");
    let corner = |index: &u32| posed.positions[*index as usize];
    posed.indices.as_chunks::<3>().0.iter().map(|corners| corners.each_ref().map(corner)).collect()
}
