//! Scenes of which a part moves.

use glam::{DAffine3, DVec3};
use rasray_gpu_scene::View;
use rasray_scene::Scene;
use rasray_scene::animation::{
    Channel, ChannelValues, Clip, Interpolation, NodeTransform, Placement, Rig, RigNode,
};
use rasray_scene::builtin::builtin;
use rasray_scene::default_view::default_camera;

/// A built-in scene.
pub fn made(name: &str) -> Scene {
    builtin(name).expect("it is built in").expect("its parameters are valid")
}

/// A node that nothing moves.
fn at_rest(name: String) -> RigNode {
    let transform =
        NodeTransform::Parts { translation: DVec3::ZERO, rotation: glam::DQuat::IDENTITY, scale: DVec3::ONE };
    RigNode { name, parent: None, transform }
}

/// A scene that moves among the instances of another one that does not: half of these come first.
pub fn among(mut moving: Scene, other: &Scene) -> Scene {
    let (meshes, materials, textures, images) =
        (moving.meshes.len(), moving.materials.len(), moving.textures.len(), moving.images.len());
    moving.images.extend(other.images.iter().cloned());
    moving.textures.extend(other.textures.iter().map(|texture| {
        let mut texture = *texture;
        texture.image += images;
        texture
    }));
    moving.materials.extend(other.materials.iter().map(|material| {
        let mut material = material.clone();
        let used = [
            &mut material.base_color_texture,
            &mut material.metallic_roughness_texture,
            &mut material.anisotropy_texture,
            &mut material.normal_texture,
            &mut material.emission_texture,
            &mut material.transmission_texture,
        ];
        used.into_iter().flatten().for_each(|texture| texture.texture += textures);
        material
    }));
    moving.meshes.extend(other.meshes.iter().map(|mesh| {
        let mut mesh = mesh.clone();
        mesh.material += materials;
        mesh
    }));
    let rig = &mut moving.animation.rig;
    let node = rig.nodes.len();
    rig.nodes.push(at_rest("static".to_owned()));
    for (place, instance) in other.instances.iter().enumerate() {
        let mut instance = instance.clone();
        instance.mesh += meshes;
        let placement = Placement { node, node_from_mesh: instance.world_from_mesh };
        let at = if place < other.instances.len() / 2 { place } else { moving.instances.len() };
        moving.instances.insert(at, instance);
        rig.placements.insert(at, placement);
    }
    moving.cameras.clear();
    moving
}

/// The hall whose banners and plants are cut out by masks; every third instance swings. With nothing of it,
/// or everything.
pub fn swinging_hall(moves: impl Fn(usize) -> bool) -> Scene {
    let mut scene = made("atrium:detail=0.25");
    let count = scene.instances.len();
    let swings: Vec<Channel> = (0..count)
        .filter(|&node| moves(node))
        .map(|node| Channel {
            node,
            interpolation: Interpolation::Linear,
            times: vec![0.0, 1.0],
            values: ChannelValues::Translation(vec![[0.0; 3], [0.4, 0.1, -0.2]]),
        })
        .collect();
    scene.animation.rig = Rig {
        nodes: (0..count).map(|node| at_rest(format!("node {node}"))).collect(),
        placements: (0..count)
            .map(|node| Placement { node, node_from_mesh: scene.instances[node].world_from_mesh })
            .collect(),
        clips: vec![Clip { name: "swing".to_owned(), duration: 1.0, channels: swings }],
        ..Rig::default()
    };
    scene.animation.clips = vec!["swing".to_owned()];
    scene
}

/// The hall, of which every third instance turns about itself, grows and moves in a time of its own, between
/// 0 and 2 s, and stands still in all others; two hang on one that moves. Every other one of these is
/// mirrored while it moves.
pub fn hall_of_objects() -> Scene {
    let mut scene = swinging_hall(|_| false);
    let mut channels = Vec::new();
    for (number, node) in (0..scene.instances.len()).filter(|&node| third(node)).enumerate() {
        let begin = 0.5 * (number % 4) as f64;
        let times: Vec<f32> = [begin, begin + 0.4].map(|seconds| seconds as f32).to_vec();
        let mut channel = |values| {
            let interpolation = Interpolation::Linear;
            channels.push(Channel { node, interpolation, times: times.clone(), values });
        };
        let angle = 0.2 + 0.1 * number as f32;
        let turned = glam::Quat::from_rotation_y(angle) * glam::Quat::from_rotation_x(0.3);
        channel(ChannelValues::Rotation(vec![[0.0, 0.0, 0.0, 1.0], turned.to_array()]));
        let side = if number % 2 == 0 { -1.0 } else { 1.0 };
        channel(ChannelValues::Scale(vec![[side, 1.0, 1.0], [1.3 * side, 0.6, 1.1]]));
        channel(ChannelValues::Translation(vec![[0.0; 3], [0.3, 0.2, -0.1]]));
        // About its own place.
        let rig = &mut scene.animation.rig;
        let placement = &mut rig.placements[node];
        let base = rig.nodes.len();
        let mut at = at_rest(format!("place {node}"));
        at.transform = NodeTransform::Parts {
            translation: placement.node_from_mesh.translation,
            rotation: glam::DQuat::IDENTITY,
            scale: DVec3::ONE,
        };
        rig.nodes.push(at);
        rig.nodes[node].parent = Some(base);
        placement.node_from_mesh.translation = DVec3::ZERO;
    }
    let rig = &mut scene.animation.rig;
    let (first, second) = (1, 4);
    for node in [0, 3] {
        rig.nodes[node].parent = Some(if node == 0 { first } else { second });
    }
    rig.clips[0].channels = channels;
    rig.clips[0].duration = 2.0;
    scene
}

/// Every third one.
pub fn third(node: usize) -> bool {
    node % 3 == 1
}

/// View of the camera of a scene, `moved` metres to its right.
pub fn view(scene: &Scene, size: [u32; 2], moved: f64) -> View {
    let mut camera = scene.cameras.first().cloned().unwrap_or_else(|| default_camera(scene));
    camera.world_from_camera *= DAffine3::from_translation(DVec3::X * moved);
    View { camera, width: size[0], height: size[1], seed: 7 }
}
