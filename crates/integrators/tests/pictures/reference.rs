//! Device images against the naive ones of the CPU, sample by sample with the same random numbers.
//!
//! The two read the scene independently, so packing, textures, lights and scattering are all held
//! against each other. What remains is rounding: a few paths take another turn where a random number
//! falls next to a threshold, so most pixels must agree closely and the means very closely.

use crate::common::{difference::*, scenes::*, *};
use glam::DVec3;
use rasray_reference::shading::Sampler;
use rasray_scene::{Camera, Scene};

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
fn independent_numbers_are_the_same_ones_too() {
    let (scene, camera) = cornell();
    let found = sampled_difference(&scene, &scene, &camera, 4, &Kind::Path(4), Sampler::Pcg);
    assert!(found.share <= 0.01 && found.mean <= 0.01, "{found:?}");
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
    let found = difference(&lower, &scene, &camera, 8, &Kind::Occlusion(0.2));
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

#[test]
fn light_through_veils_and_panes() {
    let eye = forward_camera(DVec3::new(0.0, 0.0, 0.9));
    compare(&veiled_room(), &eye, 4, &Kind::Path(3), 0.01);
    compare(&veiled_room(), &eye, 4, &Kind::OpaquePanes(3), 0.01);
}
