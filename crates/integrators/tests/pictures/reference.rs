//! Device images against the naive ones of the CPU, sample by sample with the same random numbers.
//!
//! The two read the scene independently, so packing, textures, lights and scattering are all held
//! against each other. What remains is rounding: a few paths take another turn where a random number
//! falls next to a threshold, so most pixels must agree closely and the means very closely.

use crate::pictures::common::{difference::*, scenes::*, *};
use glam::DVec3;
use rasray_reference::shading::Sampler;
use rasray_scene::{BackFaces, Camera, Environment, Instance, Scene};

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

/// Rooms that are looked into from outside, through walls without an outside and behind blended surfaces.
#[test]
fn backs_are_passed_by_the_rays_that_are_asked_to() {
    let eye = forward_camera(DVec3::new(0.1, 0.05, 2.6));
    let mut behind_a_veil = glass_room();
    let (number, veil) = (behind_a_veil.meshes.len(), 5);
    behind_a_veil.meshes.push(square(DVec3::Z * 1.5, DVec3::X * 0.5, DVec3::Y * 0.5, veil));
    let instance = behind_a_veil.instances[0].clone();
    behind_a_veil.instances.push(Instance { mesh: number, ..instance });
    for mut scene in [behind_a_veil, textured_room()] {
        scene.environment = Environment::Constant([0.3; 3]);
        for (number, material) in scene.materials.iter_mut().enumerate() {
            material.culls_back = number != 1;
        }
        let mirror = glam::DAffine3::from_scale(DVec3::new(1.0, -1.0, 1.0));
        // Not the walls.
        for instance in scene.instances.iter_mut().skip(6).step_by(2) {
            instance.world_from_mesh = mirror * instance.world_from_mesh;
        }
        for back_faces in BackFaces::ALL {
            for kind in [Kind::Path(4), Kind::Occlusion(1.0)] {
                let found = passing_difference([back_faces; 2], &scene, &eye, 4, &kind);
                eprintln!("{back_faces:?}: {found:?}");
                assert!(found.share <= 0.01 && found.mean <= 0.01, "{back_faces:?}: {found:?}");
            }
            let others = BackFaces::ALL.iter().filter(|other| **other != back_faces);
            for other in others {
                let found = passing_difference([*other, back_faces], &scene, &eye, 4, &Kind::Path(4));
                assert!(found.share > 0.1, "{other:?} in place of {back_faces:?} is noticed: {found:?}");
            }
        }
    }
}
