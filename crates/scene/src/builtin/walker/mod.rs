//! A figure that walks in a circle: a skin over joints, moved by a clip.

mod body;
mod gait;
mod skeleton;

use std::ops::RangeInclusive;

use glam::{DAffine3, DVec2, DVec3};

use super::atrium::sky;
use super::cornell::{diffuse, place_each};
use super::shape::Shapes;
use super::solid::Surface;
use super::texture::{repeating, textured, tiles};
use crate::animation::{
    Channel, ChannelValues, Clip, DeformedMesh, Interpolation, NodeTransform, Placement, Rig, RigNode,
};
use crate::default_view::camera_looking_at;
use crate::{Animation, Light, Material, Mesh, Moment, Scene};
use body::{Part, parts};
use gait::{STRIDES, stance};
use skeleton::{COUNT, Joint, PELVIS, joints};

/// Number of keys per second: between two keys a standing foot slides by less than a millimetre.
const KEYS_PER_SECOND: usize = 60;
/// Half the side of the ground, metres.
const GROUND: f64 = 12.0;
/// Index of the node of the first joint.
const FIRST_JOINT: usize = 1;

/// Parameters of [`walker`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Walker {
    /// Number of triangles that is asked for, within [`Walker::TRIANGLES`]; the scene has that many within 5
    /// %.
    pub triangles: u64,
}

impl Walker {
    /// Valid range of [`Walker::triangles`].
    pub const TRIANGLES: RangeInclusive<u64> = 8_000..=2_000_000;
}

impl Default for Walker {
    fn default() -> Self {
        Self { triangles: 30_000 }
    }
}

/// Makes a figure of 1.76 m that walks in a circle on a tiled floor, under a low sun and a blue sky: a rig of
/// 19 joints with one clip, `walk`, that ends as it begins after 6 s. Body and clothes are six closed meshes,
/// each vertex of which is moved by up to four joints. At rest the scene is at the beginning of the clip.
pub fn walker(parameters: Walker) -> Scene {
    let triangles = parameters.triangles.clamp(*Walker::TRIANGLES.start(), *Walker::TRIANGLES.end());
    let joints = joints();
    let parts = parts(&joints);
    let mut ground = Shapes::new("ground", 0);
    let corner = |x: f64, z: f64| DVec3::new(GROUND * x, 0.0, GROUND * z);
    ground.quad(
        [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)],
        DVec2::splat(8.0),
    );

    let mut meshes = vec![ground.finish()];
    let mut deformed = Vec::new();
    for (part, surface) in parts.iter().zip(surfaces(&parts, triangles)) {
        let mesh = mesh(part.name, meshes.len(), &surface);
        deformed.push(DeformedMesh {
            mesh: meshes.len(),
            positions: mesh.positions.clone(),
            normals: mesh.normals.clone(),
            skin: Some(part.binding(&surface.positions)),
            ..DeformedMesh::default()
        });
        meshes.push(mesh);
    }
    let instances = place_each(&meshes);
    let camera = camera_looking_at("camera", DVec3::new(2.1, 1.7, 4.9), DVec3::new(0.0, 0.88, 0.0), 0.47);
    let sun = DVec3::new(-0.55, -0.7, -0.45).normalize();
    let rig = rig(&joints, deformed, instances.len(), camera.world_from_camera, sun);
    let scene = Scene {
        name: "walker".to_owned(),
        instances,
        meshes,
        materials: materials(),
        textures: vec![repeating(0)],
        images: vec![tiles()],
        lights: vec![Light::Directional { direction: sun, irradiance: [3.2, 2.9, 2.5] }],
        environment: sky(0.45),
        cameras: vec![camera],
        animation: Animation {
            clips: rig.clips.iter().map(|clip| clip.name.clone()).collect(),
            duration: STRIDES as f32,
            skins: 1,
            rig,
            ..Animation::default()
        },
        ..Scene::default()
    };
    scene.posed(&Moment { seconds: 0.0, clips: vec![0] })
}

/// Makes the materials of the ground and of the parts, in their order.
fn materials() -> Vec<Material> {
    let dull = |material: Material| Material { specular: 0.4, roughness: 0.7, ..material };
    vec![
        dull(textured(diffuse("tiles", [1.0; 3]), 0)),
        Material { specular: 0.6, roughness: 0.5, ..diffuse("skin", [0.56, 0.31, 0.21]) },
        dull(diffuse("shirt", [0.62, 0.1, 0.06])),
        dull(diffuse("trousers", [0.045, 0.075, 0.16])),
        Material { specular: 0.8, roughness: 0.4, ..diffuse("shoes", [0.5, 0.46, 0.4]) },
        dull(diffuse("hair", [0.035, 0.02, 0.012])),
        Material { specular: 1.0, roughness: 0.15, ..diffuse("eyes", [0.01; 3]) },
    ]
}

/// Meshes the surfaces of all parts, with about `triangles` triangles in all.
fn surfaces(parts: &[Part], triangles: u64) -> Vec<Surface> {
    // Size of a triangle, metres. The number of triangles per area is as the inverse square of their size, so
    // few steps suffice; the smallest parts have a size of their own.
    let mut size = 0.012 * (30_000.0 / triangles as f64).sqrt();
    let mut made: Vec<Surface> = Vec::new();
    for _ in 0..8 {
        made = parts.iter().map(|part| part.surface(size)).collect();
        let count: usize = made.iter().map(|surface| surface.triangles.len()).sum();
        let ratio = count as f64 / triangles as f64;
        if (ratio - 1.0).abs() < 0.04 {
            break;
        }
        size *= ratio.sqrt();
    }
    made
}

fn mesh(name: &str, material: usize, surface: &Surface) -> Mesh {
    let place = |place: &DVec3| place.as_vec3().to_array();
    Mesh {
        name: name.to_owned(),
        positions: surface.positions.iter().map(place).collect(),
        normals: Some(surface.normals.iter().map(place).collect()),
        uvs: [Some(surface.positions.iter().map(|at| [at.x as f32, 1.0 - at.y as f32]).collect()), None],
        indices: surface.triangles.as_flattened().to_vec(),
        material,
        ..Mesh::default()
    }
}

/// Makes the nodes, in this order: the node of objects that stand still, the joints, the camera, the sun.
fn rig(
    joints: &[Joint],
    deformed: Vec<DeformedMesh>,
    instances: usize,
    world_from_camera: DAffine3,
    sun: DVec3,
) -> Rig {
    let fixed = |name: &str, transform: DAffine3| RigNode {
        name: name.to_owned(),
        parent: None,
        transform: NodeTransform::Matrix(transform),
    };
    let mut nodes = vec![fixed("still", DAffine3::IDENTITY)];
    nodes.extend(skeleton::nodes(joints, FIRST_JOINT));
    let (camera, light) = (nodes.len(), nodes.len() + 1);
    nodes.push(fixed("camera", world_from_camera));
    nodes.push(fixed("sun", camera_looking_at("sun", DVec3::ZERO, sun, 1.0).world_from_camera));
    let (clip, first) = (walk(joints), stance(joints, 0.0));
    // The pose at rest is the pose at the beginning of the clip.
    for (node, turned) in nodes[FIRST_JOINT..].iter_mut().zip(first.rotations) {
        if let NodeTransform::Parts { rotation, .. } = &mut node.transform {
            *rotation = turned;
        }
    }
    if let NodeTransform::Parts { translation, .. } = &mut nodes[FIRST_JOINT + PELVIS].transform {
        *translation = first.pelvis;
    }
    Rig {
        nodes,
        placements: vec![Placement { node: 0, node_from_mesh: DAffine3::IDENTITY }; instances],
        clips: vec![clip],
        skins: vec![skeleton::skin(joints, FIRST_JOINT)],
        deformed,
        cameras: vec![camera],
        lights: vec![light],
    }
}

/// Makes the keys of the gait; a stride takes a second.
fn walk(joints: &[Joint]) -> Clip {
    let keys = STRIDES * KEYS_PER_SECOND;
    let seconds = |key: usize| key as f64 / KEYS_PER_SECOND as f64;
    let times: Vec<f32> = (0..=keys).map(|key| seconds(key) as f32).collect();
    let mut places = Vec::with_capacity(times.len());
    let mut turns = vec![Vec::new(); COUNT];
    for key in 0..=keys {
        let stance = stance(joints, seconds(key));
        places.push(stance.pelvis.as_vec3().to_array());
        for (keys, turn) in turns.iter_mut().zip(stance.rotations) {
            keys.push(turn.as_quat().to_array());
        }
    }
    let channel = |joint: usize, values: ChannelValues| Channel {
        node: FIRST_JOINT + joint,
        interpolation: Interpolation::Linear,
        times: times.clone(),
        values,
    };
    let mut channels = vec![channel(PELVIS, ChannelValues::Translation(places))];
    channels.extend(
        turns.into_iter().enumerate().map(|(joint, keys)| channel(joint, ChannelValues::Rotation(keys))),
    );
    Clip { name: "walk".to_owned(), duration: STRIDES as f32, channels }
}
