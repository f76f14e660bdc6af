//! Scenes at a time: keys and the values between them, clips that compete, skins, morph targets, cameras and
//! lights.

use glam::{DAffine3, DQuat, DVec3};
use rasray_scene::animation::{
    Channel, ChannelValues, Clip, DeformedMesh, Interpolation, MorphTarget, NodeTransform, Placement, Rig,
    RigNode, Skin, SkinBinding,
};
use rasray_scene::pose::Pose;
use rasray_scene::{Animation, Camera, Instance, Light, Mesh, Moment, Projection, Scene};

fn node(name: &str, parent: Option<usize>, translation: DVec3) -> RigNode {
    let transform = NodeTransform::Parts { translation, rotation: DQuat::IDENTITY, scale: DVec3::ONE };
    RigNode { name: name.to_owned(), parent, transform }
}

fn channel(node: usize, interpolation: Interpolation, values: ChannelValues) -> Channel {
    Channel { node, interpolation, times: vec![1.0, 3.0], values }
}

fn clip(channels: Vec<Channel>) -> Clip {
    Clip { name: "clip".to_owned(), duration: 3.0, channels }
}

/// Makes a child before its parent, and a clip of one channel.
fn rig(channel: Channel) -> Rig {
    Rig {
        nodes: vec![node("child", Some(1), DVec3::X), node("parent", None, DVec3::ZERO)],
        clips: vec![clip(vec![channel])],
        ..Rig::default()
    }
}

fn at(rig: &Rig, seconds: f64) -> Pose {
    Pose::new(rig, &Moment { seconds, clips: rig.compatible_clips() })
}

fn assert_close(found: DVec3, expected: [f64; 3]) {
    assert!(found.abs_diff_eq(DVec3::from(expected), 1.0e-12), "{found} is not {expected:?}");
}

#[test]
fn between_keys_lies_what_the_channel_says() {
    let keys = vec![[0.0, 0.0, 0.0], [2.0, 4.0, 0.0]];
    let moved = |interpolation, values: &[[f32; 3]], seconds| {
        let rig = rig(channel(1, interpolation, ChannelValues::Translation(values.to_vec())));
        at(&rig, seconds).world_from_node[0].translation - DVec3::X
    };
    for (seconds, step, linear) in [
        (-5.0, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        (1.0, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        (1.5, [0.0, 0.0, 0.0], [0.5, 1.0, 0.0]),
        (2.999, [0.0, 0.0, 0.0], [1.999, 3.998, 0.0]),
        (3.0, [2.0, 4.0, 0.0], [2.0, 4.0, 0.0]),
        (9.0, [2.0, 4.0, 0.0], [2.0, 4.0, 0.0]),
    ] {
        assert_close(moved(Interpolation::Step, &keys, seconds), step);
        assert_close(moved(Interpolation::Linear, &keys, seconds), linear);
    }
    // The curve is x = t^2 from 0 to 2: tangents are per second, in before and out after each value.
    let spline = [[9.0; 3], [0.0; 3], [0.0; 3], [4.0, 0.0, 0.0], [4.0, 0.0, 0.0], [9.0; 3]];
    for seconds in [1.0, 1.25, 2.0, 2.5, 3.0] {
        let t = seconds - 1.0;
        assert_close(moved(Interpolation::CubicSpline, &spline, seconds), [t * t, 0.0, 0.0]);
    }
}

#[test]
fn rotations_take_the_short_way_at_constant_speed() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    // The rotation is a quarter turn about z; its end is written as the other of the two quaternions for it.
    let turn = vec![[0.0, 0.0, 0.0, 2.0], [0.0, 0.0, -half, -half]];
    let rig = rig(channel(1, Interpolation::Linear, ChannelValues::Rotation(turn)));
    for (seconds, degrees) in [(1.0, 0.0_f64), (1.5, 22.5), (2.0, 45.0), (3.0, 90.0)] {
        let angle = degrees.to_radians();
        let found = at(&rig, seconds).world_from_node[0].translation;
        assert!(found.abs_diff_eq(DVec3::new(angle.cos(), angle.sin(), 0.0), 1.0e-7), "{seconds}: {found}");
    }
}

#[test]
fn clips_that_animate_the_same_property_are_not_played_at_once() {
    let moves = |node| channel(node, Interpolation::Step, ChannelValues::Translation(vec![[1.0; 3]; 2]));
    let grows = |node| channel(node, Interpolation::Step, ChannelValues::Scale(vec![[2.0; 3]; 2]));
    let rig = Rig {
        nodes: vec![node("a", None, DVec3::ZERO), node("b", None, DVec3::ZERO)],
        clips: vec![
            clip(vec![moves(0)]),
            clip(vec![moves(1), moves(0)]),
            clip(vec![grows(0)]),
            clip(vec![moves(1)]),
        ],
        ..Rig::default()
    };
    assert_eq!(rig.compatible_clips(), [0, 2, 3]);
}

/// Makes two nodes that show one mesh with a morph target, one of them animated; a third node has a mesh that
/// follows two joints.
fn crowd() -> Scene {
    let triangle = |name: &str| Mesh {
        name: name.to_owned(),
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        normals: Some(vec![[0.0, 0.0, 1.0]; 3]),
        indices: vec![0, 1, 2],
        ..Mesh::default()
    };
    let kept = |mesh: usize| DeformedMesh {
        mesh,
        positions: triangle("").positions,
        normals: triangle("").normals,
        ..DeformedMesh::default()
    };
    let target = MorphTarget { positions: Some(vec![[0.0, 0.0, 1.0]; 3]), ..MorphTarget::default() };
    let weights = ChannelValues::Weights { values: vec![0.0, 1.0], targets: 1 };
    let turn = ChannelValues::Rotation(vec![[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 0.0]]);
    let far = DVec3::new(1.0e6, 0.0, 0.0);
    let rig = Rig {
        nodes: vec![
            node("still", None, DVec3::ZERO),
            node("morphing", None, DVec3::Y),
            node("skinned", None, DVec3::splat(50.0)),
            node("joint", None, far),
            node("turning joint", Some(3), DVec3::ZERO),
        ],
        placements: (0..3).map(|node| Placement { node, node_from_mesh: DAffine3::IDENTITY }).collect(),
        clips: vec![clip(vec![
            channel(1, Interpolation::Linear, weights),
            channel(4, Interpolation::Linear, turn),
        ])],
        skins: vec![Skin {
            name: "skin".to_owned(),
            joints: vec![3, 4],
            joint_from_mesh: vec![DAffine3::IDENTITY; 2],
        }],
        deformed: vec![
            DeformedMesh { targets: vec![target], weights: vec![0.0], ..kept(0) },
            DeformedMesh {
                skin: Some(SkinBinding {
                    skin: 0,
                    per_vertex: 8,
                    joints: [0, 1, 0, 0, 0, 0, 0, 1].repeat(3),
                    // The first vertex follows the still joint, the second the other, the third each joint by
                    // one half.
                    weights: [
                        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
                        [0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5],
                    ]
                    .concat(),
                }),
                ..kept(1)
            },
        ],
        cameras: vec![4],
        lights: vec![1, 4],
    };
    let instance =
        |name: &str, mesh| Instance { name: name.to_owned(), mesh, world_from_mesh: DAffine3::IDENTITY };
    Scene {
        meshes: vec![triangle("morphed"), triangle("skinned")],
        instances: vec![instance("still", 0), instance("morphing", 0), instance("skinned", 1)],
        cameras: vec![Camera {
            name: "camera".to_owned(),
            world_from_camera: DAffine3::IDENTITY,
            projection: Projection::Perspective { fov_y: 1.0 },
            aspect_ratio: None,
            lens: None,
        }],
        lights: vec![
            Light::Point { position: DVec3::ZERO, intensity: [1.0; 3], range: 9.0 },
            Light::Directional { direction: DVec3::X, irradiance: [1.0; 3] },
        ],
        animation: Animation { rig, ..Animation::default() },
        ..Scene::default()
    }
}

#[test]
fn meshes_cameras_and_lights_are_where_their_nodes_are() {
    let scene = crowd().at(&Moment { seconds: 2.0, clips: vec![0] }).expect("a rig");
    let corners = |instance: usize| -> Vec<DVec3> {
        let instance = &scene.instances[instance];
        let mesh = &scene.meshes[instance.mesh];
        let world = |p: &[f32; 3]| instance.world_from_mesh.transform_point3(DVec3::from(p.map(f64::from)));
        mesh.positions.iter().map(world).collect()
    };
    assert_eq!(corners(0), [DVec3::ZERO, DVec3::X, DVec3::Y]);
    let half = DVec3::new(0.0, 1.0, 0.5);
    assert_eq!(corners(1), [half, half + DVec3::X, half + DVec3::Y]);
    // The clip makes half a turn, now a quarter: the second joint takes x to y, the mean of (0, 1) and (-1,
    // 0) is exact, and no position is rounded at a million metres.
    let far = DVec3::new(1.0e6, 0.0, 0.0);
    for (found, expected) in corners(2).into_iter().zip([DVec3::ZERO, DVec3::Y, DVec3::new(-0.5, 0.5, 0.0)]) {
        assert!((found - far).abs_diff_eq(expected, 1.0e-7), "{found}");
    }
    let normals = |instance: usize| scene.meshes[scene.instances[instance].mesh].normals.clone();
    assert_eq!(normals(2), Some(vec![[0.0, 0.0, 1.0]; 3]));
    let camera = scene.cameras[0].world_from_camera;
    assert!(camera.translation == far && camera.x_axis.abs_diff_eq(DVec3::Y, 1.0e-12), "{camera}");
    assert!(matches!(scene.lights[0], Light::Point { position, .. } if position == DVec3::Y));
    assert!(matches!(scene.lights[1], Light::Directional { direction, .. } if direction == DVec3::NEG_Z));
}

/// A scene at a moment is a scene: shown at another moment, it equals the scene at rest shown at that moment.
#[test]
fn a_scene_at_a_moment_can_be_shown_at_another() {
    let at = |scene: &Scene, seconds: f64| scene.at(&Moment { seconds, clips: vec![0] }).expect("a rig");
    let shown = |scene: &Scene| -> Vec<String> {
        let of = |instance: &Instance| {
            format!("{:?} {:?}", scene.meshes[instance.mesh].positions, instance.world_from_mesh)
        };
        scene.instances.iter().map(of).collect()
    };
    let rest = crowd();
    let mut scene = at(&rest, 2.0);
    for seconds in [2.5, 1.0, 3.0, 2.0] {
        scene = at(&scene, seconds);
        assert_eq!(shown(&scene), shown(&at(&rest, seconds)), "{seconds}");
    }
    assert_eq!((rest.meshes.len(), scene.meshes.len()), (2, 3), "a mesh is split once");
}
