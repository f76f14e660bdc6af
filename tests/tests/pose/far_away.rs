//! Shapes far from the origin of the world, of the frame, or of their own space.

use glam::{DAffine3, DVec3};
use rasray_scene::Scene;
use rasray_scene::animation::{ChannelValues, NodeTransform, Rig, Skin};
use rasray_tests::harness::Bench;

use crate::pose::held::{DeviceScene, Figures, worst_ulps};
use crate::pose::shapes::{at, binding, cloud, linear, node, scene, shape, skin};

const FAR: DVec3 = DVec3::new(1.0e6, -3.0e5, 2.0e6);

/// A rigid and a skinned mesh around `place` in the world, whose own space has them around `centre`.
fn far(place: DVec3, centre: DVec3) -> Scene {
    let centre_f32 = centre.as_vec3().to_array();
    let (rigid, mesh) = (cloud(60, centre_f32, 11), cloud(60, centre_f32, 12));
    let vertices = mesh.positions.len();
    let (joint_nodes, skin, mut channels) = skin(6, 3, place, centre);
    let mut skinned = shape(1, &mesh);
    skinned.skin = Some(binding(vertices, 8, 6, 13));
    // The first mesh hangs on a turning node, which takes the centre of the mesh there.
    let mut child = node(Some(2), DVec3::ZERO);
    child.transform = NodeTransform::Matrix(DAffine3::from_translation(-centre));
    let nodes = [vec![child, node(None, DVec3::ZERO), node(None, place)], joint_nodes].concat();
    let turn = |angle: f32| [0.0, angle.sin(), 0.0, angle.cos()];
    channels.push(linear(2, ChannelValues::Rotation(vec![turn(0.2), turn(1.1)])));
    let rig = Rig { nodes, skins: vec![skin], deformed: vec![skinned], ..Rig::default() };
    scene(vec![rigid, mesh], rig, channels)
}

#[test]
fn positions_are_as_exact_as_their_size_allows() {
    let bench = Bench::new();
    let near = DVec3::new(1.0, -0.5, 2.0);
    for (what, place, centre, origin) in [
        ("near", near, DVec3::ZERO, DVec3::ZERO),
        ("far from the origin of the frame", near, DVec3::ZERO, FAR),
        ("far from that of the world", FAR + near, DVec3::ZERO, FAR),
        ("far from their own", near, FAR, DVec3::ZERO),
        ("far from all of them", FAR + near, -FAR, FAR),
    ] {
        let stage = DeviceScene::new(&bench, far(place, centre), origin);
        let figures = [0.0, 0.4, 1.0].map(|seconds| stage.held(&at(&stage.scene, seconds)));
        let worst = figures.into_iter().fold(Figures::default(), Figures::worst);
        println!("{what}: {worst:?}");
        assert_eq!((worst.vertices, worst.absent), (360, 0), "{what}");
        assert!(worst.ulps <= 4.0, "{what}: {worst:?}");
        assert!(worst.normal <= 1.0e-5 && worst.tangent <= 1.0e-5, "{what}: {worst:?}");
    }
}

/// Joints of both skins of [`two_skins`].
const JOINTS: usize = 5;

/// Two meshes around (1, -0.5, 2), each with a skin, whose joints come in another order (`turned`); `idle`
/// puts a joint that no vertex has weight of at these places of the first skin.
fn two_skins(turned: usize, idle: &[(usize, DVec3)]) -> Scene {
    let place = DVec3::new(1.0, -0.5, 2.0);
    let meshes = [cloud(40, [0.0; 3], 21), cloud(40, [0.0; 3], 22)];
    let (mut nodes, mut channels) = (vec![node(None, DVec3::ZERO), node(None, DVec3::ZERO)], Vec::new());
    let (mut skins, mut deformed) = (Vec::new(), Vec::new());
    for (number, mesh) in meshes.iter().enumerate() {
        let (own, skin, turns) = skin(JOINTS, nodes.len(), place, DVec3::ZERO);
        nodes.extend(own);
        channels.extend(turns);
        let mut shape = shape(number, mesh);
        let mut bound = binding(mesh.positions.len(), 4, JOINTS, 30 + number as u64);
        bound.skin = number;
        // Joint k is at place (k + turned) mod JOINTS.
        let order: Vec<usize> = (0..JOINTS).map(|at| (at + JOINTS - turned % JOINTS) % JOINTS).collect();
        let mut joints: Vec<_> = order.iter().map(|&joint| skin.joints[joint]).collect();
        let mut from_mesh: Vec<_> = order.iter().map(|&joint| skin.joint_from_mesh[joint]).collect();
        let mut places: Vec<u32> = (0..JOINTS).map(|joint| ((joint + turned) % JOINTS) as u32).collect();
        for &(at, far) in idle.iter().filter(|_| number == 0) {
            joints.insert(at, nodes.len());
            from_mesh.insert(at, DAffine3::IDENTITY);
            places.iter_mut().for_each(|place| *place += u32::from(*place >= at as u32));
            nodes.push(node(None, far));
        }
        bound.joints.iter_mut().for_each(|joint| *joint = places[*joint as usize]);
        shape.skin = Some(bound);
        skins.push(Skin { name: "skin".to_owned(), joints, joint_from_mesh: from_mesh });
        deformed.push(shape);
    }
    scene(meshes.into(), Rig { nodes, skins, deformed, ..Rig::default() }, channels)
}

/// A joint that moves nothing costs no digits, wherever it is, on the host and on the device; neither does
/// the order of joints.
#[test]
fn a_far_joint_without_weight_costs_no_digits() {
    let bench = Bench::new();
    let far = DVec3::new(1.0e5, -3.0e6, 2.0e5);
    let plain = DeviceScene::new(&bench, two_skins(0, &[]), DVec3::ZERO);
    let times = [0.0, 0.4, 1.0];
    let expected = times.map(|seconds| plain.fresh(&at(&plain.scene, seconds)).posed.positions);
    for (turned, idle) in [
        (0, vec![]),
        (3, vec![]),
        (0, vec![(0, far)]),
        (2, vec![(2, far)]),
        (1, vec![(JOINTS, far)]),
        (4, vec![(0, far), (3, -far), (JOINTS, 10.0 * far)]),
    ] {
        let stage = DeviceScene::new(&bench, two_skins(turned, &idle), DVec3::ZERO);
        for (seconds, expected) in times.into_iter().zip(&expected) {
            let moment = at(&stage.scene, seconds);
            let figures = stage.held(&moment);
            let host = worst_ulps(&stage.fresh(&moment).posed.positions, expected);
            let (positions, _) = stage.gpu.geometry().download(bench.device()).expect("readable");
            let device = worst_ulps(&positions, expected);
            println!("{turned} {idle:?} at {seconds} s: {figures:?}; host {host}, device {device}");
            assert_eq!((figures.vertices, figures.absent), (240, 0));
            assert!(figures.ulps <= 4.0 && host <= 1.0 && device <= 4.0, "{turned} {idle:?}");
            assert!(figures.normal <= 1.0e-5 && figures.tangent <= 1.0e-5, "{figures:?}");
        }
    }
}

/// Two meshes of one skin far from each other, and one whose joints are: each keeps the digits of its own
/// coordinates.
#[test]
fn meshes_of_a_skin_are_as_exact_as_each_of_them_allows() {
    let bench = Bench::new();
    let apart = DVec3::new(3.0e5, 0.0, -1.0e5);
    let meshes =
        [cloud(40, [0.0; 3], 23), cloud(40, apart.as_vec3().to_array(), 24), cloud(40, [0.0; 3], 25)];
    let (mut nodes, skin, channels) = skin(8, 3, DVec3::new(0.5, 1.0, 0.0), DVec3::ZERO);
    nodes.splice(0..0, [0; 3].map(|_| node(None, DVec3::ZERO)));
    let mut far_nodes = skin.joint_from_mesh.clone();
    // Joints 4 to 7 take what is far away in the space of the mesh to where the others are, for the second
    // mesh alone.
    for step in &mut far_nodes[4..] {
        *step *= DAffine3::from_translation(-apart);
    }
    let deformed = meshes.iter().enumerate().map(|(number, mesh)| {
        let mut shape = shape(number, mesh);
        let mut bound = binding(mesh.positions.len(), 4, 4, 40 + number as u64);
        if number == 1 {
            bound.joints.iter_mut().for_each(|joint| *joint += 4);
        }
        shape.skin = Some(bound);
        shape
    });
    let deformed = deformed.collect();
    let skins = vec![Skin { joint_from_mesh: far_nodes, ..skin }];
    let made = scene(meshes.into(), Rig { nodes, skins, deformed, ..Rig::default() }, channels);
    for origin in [DVec3::ZERO, FAR] {
        let stage = DeviceScene::new(&bench, made.clone(), origin);
        for seconds in [0.0, 0.3, 1.0] {
            let figures = stage.held(&at(&stage.scene, seconds));
            println!("from {origin} at {seconds} s: {figures:?}");
            assert_eq!((figures.vertices, figures.absent), (360, 0));
            assert!(figures.ulps <= 4.0, "{figures:?}");
        }
    }
}
