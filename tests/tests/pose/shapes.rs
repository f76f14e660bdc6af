//! Animated scenes made in code.

use glam::{DAffine3, DQuat, DVec3};
use rasray_scene::animation::{
    Channel, ChannelValues, Clip, DeformedMesh, Interpolation, MorphTarget, NodeTransform, Placement, Rig,
    RigNode, Skin, SkinBinding,
};
use rasray_scene::{Animation, Instance, Material, Mesh, Moment, Scene};
use rasray_tests::random::Random;

/// Every clip at a time.
pub fn at(scene: &Scene, seconds: f64) -> Moment {
    Moment { seconds, clips: (0..scene.animation.rig.clips.len()).collect() }
}

pub fn node(parent: Option<usize>, translation: DVec3) -> RigNode {
    let transform = NodeTransform::Parts { translation, rotation: DQuat::IDENTITY, scale: DVec3::ONE };
    RigNode { name: "node".to_owned(), parent, transform }
}

/// Two keys, at 0 and 1 seconds.
pub fn linear(node: usize, values: ChannelValues) -> Channel {
    Channel { node, interpolation: Interpolation::Linear, times: vec![0.0, 1.0], values }
}

/// Triangles with corners around `centre`, no farther than 1 along an axis, with normals and tangents.
pub fn cloud(triangles: usize, centre: [f32; 3], seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let vertices = 3 * triangles;
    let positions = (0..vertices).map(|_| random.near(centre, 1.0)).collect();
    let normals = (0..vertices).map(|_| random.direction()).collect();
    let tangents = (0..vertices).map(|vertex| {
        let [x, y, z] = random.direction();
        [x, y, z, if vertex % 2 == 0 { 1.0 } else { -1.0 }]
    });
    Mesh {
        name: "cloud".to_owned(),
        tangents: Some(tangents.collect()),
        normals: Some(normals),
        positions,
        indices: (0..vertices as u32).collect(),
        ..Mesh::default()
    }
}

/// The mesh as it is before it is deformed.
pub fn shape(mesh: usize, of: &Mesh) -> DeformedMesh {
    DeformedMesh {
        mesh,
        positions: of.positions.clone(),
        normals: of.normals.clone(),
        tangents: of.tangents.clone(),
        ..DeformedMesh::default()
    }
}

/// A morph target that moves everything.
pub fn target(vertices: usize, seed: u64) -> MorphTarget {
    let mut random = Random::new(seed);
    let mut some = || Some((0..vertices).map(|_| random.point(-0.4, 0.4)).collect());
    MorphTarget { positions: some(), normals: some(), tangents: some() }
}

/// Joints of each vertex at random, with shares at random, some of them zero.
pub fn binding(vertices: usize, per_vertex: usize, joints: usize, seed: u64) -> SkinBinding {
    let mut random = Random::new(seed);
    let mut binding = SkinBinding { skin: 0, per_vertex, joints: Vec::new(), weights: Vec::new() };
    for _ in 0..vertices {
        let mut weights: Vec<f32> = (0..per_vertex).map(|_| random.between(-0.3, 1.0).max(0.0)).collect();
        weights[0] += 0.01;
        let sum: f32 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        binding.joints.extend((0..per_vertex).map(|_| (random.bits() % joints as u64) as u32));
        binding.weights.extend(weights);
    }
    binding
}

/// A scene of these meshes, each at the node of its number, with these nodes and channels, as it is at rest.
pub fn scene(meshes: Vec<Mesh>, rig: Rig, channels: Vec<Channel>) -> Scene {
    let count = meshes.len();
    let instance =
        |mesh: usize| Instance { name: "instance".to_owned(), mesh, world_from_mesh: DAffine3::IDENTITY };
    let clip = Clip { name: "clip".to_owned(), duration: 1.0, channels };
    let rig = Rig {
        placements: (0..count).map(|node| Placement { node, node_from_mesh: DAffine3::IDENTITY }).collect(),
        clips: vec![clip],
        ..rig
    };
    let scene = Scene {
        name: "made".to_owned(),
        meshes,
        instances: (0..count).map(instance).collect(),
        materials: vec![Material::default()],
        animation: Animation { rig, ..Animation::default() },
        ..Scene::default()
    };
    // Without clips it is at rest.
    scene.at(&Moment::default()).expect("a rig")
}

/// A skin of a chain of joints in the world around `place`, which turn, for a mesh around `centre` of its own
/// space.
pub fn skin(
    joints: usize,
    first_node: usize,
    place: DVec3,
    centre: DVec3,
) -> (Vec<RigNode>, Skin, Vec<Channel>) {
    let step = |joint: usize| if joint == 0 { place } else { DVec3::new(0.3, 0.2, -0.1) };
    let parent = |joint: usize| (joint > 0).then(|| first_node + joint - 1);
    let nodes = (0..joints).map(|joint| node(parent(joint), step(joint))).collect();
    let to_joint = |joint: usize| (1..=joint).map(step).sum::<DVec3>();
    let joint_from_mesh =
        (0..joints).map(|joint| DAffine3::from_translation(-centre - to_joint(joint))).collect();
    let turns = (0..joints).map(|joint| {
        let axis = DVec3::new(1.0, joint as f64, 0.5).normalize();
        let turn = |angle: f64| DQuat::from_axis_angle(axis, angle).as_quat().to_array();
        linear(first_node + joint, ChannelValues::Rotation(vec![turn(0.1), turn(0.7)]))
    });
    let skin = Skin {
        name: "skin".to_owned(),
        joints: (first_node..first_node + joints).collect(),
        joint_from_mesh,
    };
    (nodes, skin, turns.collect())
}
