//! Shapes far from the origin of the world, of the frame, or of their own space.

use glam::{DAffine3, DVec3};
use rasray_scene::Scene;
use rasray_scene::animation::{ChannelValues, NodeTransform, Rig};
use rasray_tests::harness::Bench;

use crate::held::{Figures, Stage};
use crate::shapes::{at, binding, cloud, linear, node, scene, shape, skin};

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
        let stage = Stage::new(&bench, far(place, centre), origin);
        let figures = [0.0, 0.4, 1.0].map(|seconds| stage.held(&at(&stage.scene, seconds)));
        let worst = figures.into_iter().fold(Figures::default(), Figures::worst);
        println!("{what}: {worst:?}");
        assert_eq!((worst.vertices, worst.absent), (360, 0), "{what}");
        assert!(worst.ulps <= 4.0, "{what}: {worst:?}");
        assert!(worst.normal <= 1.0e-5 && worst.tangent <= 1.0e-5, "{what}: {worst:?}");
    }
}
