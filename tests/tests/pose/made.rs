//! Scenes made in code: mirrored over time, flattened, many joints, morph targets, splines, values that no
//! number holds.

use glam::{DAffine3, DQuat, DVec3};
use rasray_scene::animation::{Channel, ChannelValues, Interpolation, NodeTransform, Placement, Rig};
use rasray_scene::{Instance, Moment};
use rasray_shaders_glsl::constants::contract::DRAW_MIRRORED;
use rasray_tests::harness::Bench;
use rasray_tests::invariance::Subject;
use rasray_tests::tier;

use crate::pose::held::{DeviceScene, Figures};
use crate::pose::shapes::{at, binding, cloud, linear, node, scene, shape, skin, target};

/// All times, posed in this order.
const TIMES: [f64; 6] = [0.0, 1.0, 0.3, 0.5, 0.77, 0.1];

fn worst(stage: &DeviceScene<'_>) -> Figures {
    let figures = TIMES.map(|seconds| stage.held(&at(&stage.scene, seconds)));
    figures.into_iter().fold(Figures::default(), Figures::worst)
}

fn assert_close(what: &str, figures: Figures, vertices: usize, directions: f32) {
    println!("{what}: {figures:?}");
    assert_eq!((figures.vertices, figures.absent), (vertices, 0), "{what}");
    assert!(figures.ulps <= 4.0, "{what}: {figures:?}");
    assert!(figures.normal <= directions && figures.tangent <= directions, "{what}: {figures:?}");
}

/// A turned node under one whose scale goes through zero, beside one that stays.
#[test]
fn a_scale_that_changes_its_sign_mirrors() {
    let bench = Bench::new();
    let turned = NodeTransform::Parts {
        translation: DVec3::new(0.3, -2.0, 0.1),
        rotation: DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 0.5).normalize(), 0.8),
        scale: DVec3::new(1.0, 0.4, 2.5),
    };
    let mut child = node(Some(2), DVec3::ZERO);
    child.transform = turned;
    let rig = Rig { nodes: vec![child, node(None, DVec3::X), node(None, DVec3::Y)], ..Rig::default() };
    let scale = ChannelValues::Scale(vec![[1.0, 3.0, 0.7], [-0.5, 3.0, 0.7]]);
    let made = scene(vec![cloud(70, [0.5; 3], 1), cloud(5, [0.0; 3], 2)], rig, vec![linear(2, scale)]);
    let stage = DeviceScene::new(&bench, made, DVec3::ZERO);
    assert_eq!(stage.pass.moving_draws(), [true, false]);
    assert_close("mirrored", worst(&stage), 210, 1.0e-5);
    let mirrored = |seconds| {
        let fresh = stage.fresh(&at(&stage.scene, seconds));
        fresh.draw_shadings.iter().map(|draw| draw.flags & DRAW_MIRRORED != 0).collect::<Vec<_>>()
    };
    // `held` compares flags with these, those of the geometry's draws, too.
    assert_eq!([mirrored(0.1), mirrored(0.9)], [vec![false, false], vec![true, false]]);
}

/// Shapes that many joints and two morph targets move; a third target is never shown, a fourth only at the
/// end.
#[test]
fn morph_targets_come_before_eight_joints() {
    let bench = Bench::new();
    let mesh = cloud(100, [0.2, 0.1, 0.0], 3);
    let vertices = mesh.positions.len();
    let (joint_nodes, skin, mut channels) = skin(11, 2, DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO);
    let targets: Vec<_> = (0..4).map(|seed| target(vertices, 40 + seed)).collect();
    let mut skinned = shape(0, &mesh);
    skinned.skin = Some(binding(vertices, 8, 11, 5));
    skinned.targets = targets.clone();
    skinned.weights = vec![0.3, 0.0, 0.0, 0.0];
    let mut morphed = shape(1, &mesh);
    // Positions alone, normals alone, and what comes of both.
    morphed.targets = targets;
    morphed.targets[0].normals = None;
    morphed.targets[1].positions = None;
    morphed.weights = vec![0.0; 4];
    let weights = vec![0.3, -0.5, 0.0, 0.0, 0.6, 1.2, 0.0, 0.25];
    for number in 0..2 {
        channels.push(linear(number, ChannelValues::Weights { values: weights.clone(), targets: 4 }));
    }
    let nodes = [vec![node(None, DVec3::ONE), node(None, DVec3::NEG_X)], joint_nodes].concat();
    let rig = Rig { nodes, skins: vec![skin], deformed: vec![skinned, morphed], ..Rig::default() };
    let made = scene(vec![mesh.clone(), mesh], rig, channels);
    let stage = DeviceScene::new(&bench, made, DVec3::new(0.0, 1.0, 0.0));
    assert_close("morphed and skinned", worst(&stage), 2 * vertices, 1.0e-5);
    let frame = |seconds| stage.pass.frame(&stage.scene, &at(&stage.scene, seconds)).expect("it is whole");
    let shown = |seconds| frame(seconds).bytes();
    assert_eq!(shown(0.5) - shown(0.0), 2 * 16, "a target without weight costs nothing");
}

#[test]
fn splines_of_translation_and_rotation() {
    let bench = Bench::new();
    let spline = |node, values| Channel {
        node,
        interpolation: Interpolation::CubicSpline,
        times: vec![0.0, 1.0],
        values,
    };
    let moves = vec![[0.0; 3], [1.0, 0.0, 0.0], [3.0, -2.0, 1.0], [0.5, 4.0, 0.0], [0.0, 5.0, 2.0], [0.0; 3]];
    let turns = vec![
        [0.0; 4],
        [0.0, 0.0, 0.0, 1.0],
        [0.4, 0.1, 0.0, -0.3],
        [0.2, 0.0, 0.5, 0.1],
        [0.0, 0.7, 0.0, 0.7],
        [0.0; 4],
    ];
    let channels =
        vec![spline(0, ChannelValues::Translation(moves)), spline(0, ChannelValues::Rotation(turns))];
    let rig = Rig { nodes: vec![node(None, DVec3::ZERO)], ..Rig::default() };
    let stage = DeviceScene::new(&bench, scene(vec![cloud(50, [0.0; 3], 8)], rig, channels), DVec3::ZERO);
    assert_close("splines", worst(&stage), 150, 1.0e-5);
}

/// Copies of a mesh at two nodes, one of which shows other targets for a while: the host has another mesh
/// then.
#[test]
fn instances_of_a_mesh_have_weights_of_their_own() {
    let bench = Bench::new();
    let mesh = cloud(30, [0.0; 3], 14);
    let vertices = mesh.positions.len();
    let mut morphed = shape(0, &mesh);
    morphed.targets = vec![target(vertices, 15)];
    morphed.weights = vec![0.5];
    let weights = ChannelValues::Weights { values: vec![0.5, 1.0], targets: 1 };
    let nodes = vec![node(None, DVec3::X), node(None, DVec3::Y), node(None, DVec3::Z)];
    let rig = Rig { nodes, deformed: vec![morphed], ..Rig::default() };
    let channels =
        vec![linear(1, weights), linear(2, ChannelValues::Scale(vec![[1.0; 3], [-2.0, 1.0, 1.0]]))];
    let mut made = scene(vec![mesh, cloud(30, [0.0; 3], 16)], rig, channels);
    // The first mesh twice at the animated node, apart, once at the one that stays; the second one twice at
    // the last.
    let copy =
        |node, x| Placement { node, node_from_mesh: DAffine3::from_translation(DVec3::new(x, 0.0, 0.0)) };
    made.animation.rig.placements =
        vec![copy(0, 0.0), copy(1, 0.0), copy(1, 7.0), copy(2, 3.0), copy(2, -3.0)];
    made.instances = [0, 0, 0, 1, 1].map(|mesh| Instance { mesh, ..made.instances[0].clone() }).into();
    let made = made.at(&Moment::default()).expect("a rig");
    let meshes = made.meshes.len();
    let stage = DeviceScene::new(&bench, made, DVec3::ZERO);
    assert_eq!(stage.pass.moving_draws(), [false, true, true, true, true]);
    assert_close("copies", worst(&stage), 4 * vertices, 1.0e-5);
    let count = |seconds| stage.scene.at(&at(&stage.scene, seconds)).expect("a rig").meshes.len() - meshes;
    assert_eq!([count(0.0), count(0.5)], [0, 1]);
}

/// A draw that leaves the range of numbers: the build says how many triangles are out of the bounds.
#[test]
fn what_leaves_the_range_of_numbers_is_counted() {
    let bench = Bench::new();
    let rig = Rig { nodes: vec![node(None, DVec3::ZERO), node(None, DVec3::ZERO)], ..Rig::default() };
    let scale = ChannelValues::Scale(vec![[1.0; 3], [1.0e30, 1.0, 1.0]]);
    let made = scene(vec![cloud(20, [0.0; 3], 9), cloud(7, [0.0; 3], 10)], rig, vec![linear(1, scale)]);
    let stage = DeviceScene::new(&bench, made, DVec3::ZERO);
    let quick = |name: &str| ["bricks robust", "bvh robust"].contains(&name);
    for subject in Subject::all() {
        let name = subject.name();
        if !tier::is_full() && !quick(&name) {
            continue;
        }
        let mut structure = subject.structure(&bench, stage.gpu.geometry());
        for (seconds, outside) in [(0.0, 0), (1.0, 7), (0.0, 0)] {
            stage.pose(&at(&stage.scene, seconds));
            let status = bench.build_once(structure.as_mut(), [0.0; 3]);
            // Structures without pools have nothing to place by bounds.
            let outside = if status.pools.is_empty() { 0 } else { outside };
            println!("{name} at {seconds} s: {} outside", status.outside);
            assert_eq!(status.outside, outside, "{name} at {seconds} s");
            assert!(outside == 0 || !status.complete, "{name} at {seconds} s");
        }
    }
    assert_eq!(stage.fresh(&at(&stage.scene, 1.0)).posed.dropped_triangles, 7, "as the host counts them");
}

/// Meshes hidden at rest by a scale of 0, of a node or of a joint, are whole when shown, with normals and
/// tangents.
#[test]
fn what_is_hidden_at_rest_is_whole_when_it_is_shown() {
    let bench = Bench::new();
    let (rigid, mesh) = (cloud(30, [0.0; 3], 17), cloud(30, [0.0; 3], 18));
    let vertices = mesh.positions.len();
    let (joint_nodes, skin, mut channels) = skin(4, 2, DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO);
    let mut nodes = [vec![node(None, DVec3::X), node(None, DVec3::Y)], joint_nodes].concat();
    for hidden in [0, 2] {
        if let NodeTransform::Parts { scale, .. } = &mut nodes[hidden].transform {
            *scale = DVec3::ZERO;
        }
        channels.push(linear(hidden, ChannelValues::Scale(vec![[0.0; 3], [1.0, 2.0, 0.5]])));
    }
    let mut skinned = shape(1, &mesh);
    skinned.skin = Some(binding(vertices, 4, 4, 19));
    let rig = Rig { nodes, skins: vec![skin], deformed: vec![skinned], ..Rig::default() };
    let made = scene(vec![rigid, mesh], rig, channels);
    assert!(made.meshes.iter().all(|mesh| mesh.normals.is_some() && mesh.tangents.is_some()));
    let stage = DeviceScene::new(&bench, made, DVec3::ZERO);
    for seconds in [1.0, 0.25] {
        assert_close("hidden at rest", stage.held(&at(&stage.scene, seconds)), 2 * vertices, 1.0e-5);
    }
}
