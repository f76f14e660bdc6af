//! Facets that are rougher along one direction: device against CPU.

use glam::DVec3;
use rasray_gpu_scene::ShadingFeatures;
use rasray_integrators::Path;
use rasray_scene::{Material, Scene, TextureRef};

use crate::pictures::common::{
    difference::{difference, path},
    scenes::{glass_room, textured_room},
    *,
};

/// Makes a room of brushed metal: with directions from a texture over a normal map, from texture coordinates
/// alone, and on a mirrored instance.
fn brushed_room() -> Scene {
    let mut scene = textured_room();
    let direction = TextureRef { texture: 2, uv_set: 0, uv_transform: [[2.0, 0.1, 0.0], [0.3, 1.5, 0.2]] };
    let floor = &mut scene.materials[0];
    (floor.anisotropy, floor.anisotropy_rotation, floor.anisotropy_texture) = (0.9, 0.7, Some(direction));
    floor.metallic = 1.0;
    let fence = &mut scene.materials[1];
    *fence = Material {
        metallic: 0.8,
        roughness: 0.3,
        anisotropy: 0.8,
        anisotropy_rotation: -0.4,
        ..fence.clone()
    };
    scene
}

fn without(scene: &Scene) -> Scene {
    let mut plain = scene.clone();
    plain.materials.iter_mut().for_each(|material| material.anisotropy = 0.0);
    plain
}

#[test]
fn brushed_surfaces_are_those_of_the_naive_integrator() {
    let scene = brushed_room();
    let mut tangents = scene.clone();
    for mesh in &mut tangents.meshes {
        let count = mesh.positions.len();
        mesh.normals = Some(vec![[0.1, 1.0, 0.1]; count]);
        mesh.tangents = Some((0..count).map(|at| [0.7, 0.1 * at as f32, 0.6, -1.0]).collect());
    }
    let eye = forward_camera(DVec3::new(0.2, 0.3, 0.9));
    for (name, scene) in [("coordinates", &scene), ("tangents", &tangents)] {
        let found = difference(scene, scene, &eye, 4, &path(3));
        let apart = difference(scene, &without(scene), &eye, 4, &path(3));
        println!("{name}: {found:?}, without {apart:?}");
        found.assert_within(0.02, 5e-3, name);
        apart.assert(apart.share > 0.2, format_args!("{name}: anisotropy shows"));
    }
    let ward = path(2).with("specular", "ward").expect("valid");
    let found = difference(&scene, &scene, &eye, 4, &ward);
    let apart = difference(&scene, &without(&scene), &eye, 4, &ward);
    println!("Ward: {found:?}, without {apart:?}");
    found.assert_within(0.02, 5e-3, "anisotropy");
    apart.assert(apart.share > 0.2, "anisotropy shows");
    // Light samples of smooth shapes use the same facets.
    let smooth = path(2).with("shadow-terminator", "offset").expect("valid");
    let found = difference(&tangents, &tangents, &eye, 4, &smooth);
    found.assert_within(0.02, 5e-3, "anisotropy");
}

/// The scene has refracting glass, a smooth pane that anisotropy makes rough, and meshes without a source of
/// tangents.
#[test]
fn brushed_glass_is_that_of_the_naive_integrator() {
    let mut scene = glass_room();
    for mesh in scene.meshes.iter_mut().skip(6).step_by(2) {
        mesh.uvs[0] = Some(vec![[0.0, 0.0], [1.0, 0.2], [1.3, 1.0], [0.1, 0.9]]);
    }
    for material in &mut scene.materials[2..5] {
        material.roughness = if material.thickness > 0.0 { 0.2 } else { 0.0 };
        material.anisotropy = 0.6;
    }
    let eye = forward_camera(DVec3::new(0.0, 0.0, 0.9));
    let found = difference(&scene, &scene, &eye, 4, &path(6));
    let apart = difference(&scene, &without(&scene), &eye, 4, &path(6));
    println!("{found:?}, without {apart:?}");
    found.assert_within(0.03, 0.01, "anisotropy");
    apart.assert(apart.share > 0.05, "anisotropy shows");
}

/// If no material is anisotropic, kernels have no code for it, and pictures are the same with that code.
#[test]
fn code_for_it_changes_nothing_where_there_is_none() {
    let device = device();
    let stage = Setup::new(&device, &textured_room(), forward_camera(DVec3::Z * 0.9), 12, 9, 2);
    let features = stage.scene.features();
    assert!(!features.anisotropy);
    let lean = stage.render(&Path::new(&stage.desc(), 3).expect("valid"), 2);
    let all = ShadingFeatures { anisotropy: true, ..features };
    let full = stage.render(&Path::new(&stage.desc_with(108, all), 3).expect("valid"), 2);
    assert_same(&device, &lean, &full, 12, "code for anisotropy");
    assert_silent(&device);
}
