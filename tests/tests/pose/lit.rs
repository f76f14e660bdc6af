//! Lights that move, and lamps whose power changes with their size.

use glam::DVec3;
use rasray_gpu_scene::layout::Frame;
use rasray_scene::animation::{ChannelValues, Rig};
use rasray_scene::{Camera, Environment, Light, Material, Projection, Scene};
use rasray_tests::harness::Bench;

use crate::pose::held::DeviceScene;
use crate::pose::shapes::{at, cloud, linear, node, scene};

/// A lamp that shrinks to nothing and grows, another one that stays, and lights and a camera on moving nodes.
fn lamps(lights: Vec<Light>, environment: [f32; 3], others: bool) -> Scene {
    let mut meshes = vec![cloud(30, [0.0; 3], 21), cloud(10, [4.0, 0.0, 0.0], 22), cloud(20, [0.0; 3], 23)];
    meshes[0].material = 1;
    meshes[1].material = if others { 1 } else { 0 };
    let rig = Rig {
        nodes: (0..4).map(|number| node(None, DVec3::new(f64::from(number), 0.0, 1.0))).collect(),
        lights: vec![3; lights.len()],
        cameras: vec![3],
        ..Rig::default()
    };
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let channels = vec![
        linear(0, ChannelValues::Scale(vec![[0.0; 3], [2.0, 1.0, 3.0]])),
        linear(2, ChannelValues::Translation(vec![[0.0; 3], [30.0, 0.0, 0.0]])),
        linear(3, ChannelValues::Translation(vec![[0.0; 3], [5.0, 6.0, 7.0]])),
        linear(3, ChannelValues::Rotation(vec![[0.0, 0.0, 0.0, 1.0], [half, 0.0, 0.0, half]])),
    ];
    let made = scene(meshes, rig, channels);
    let camera = Camera {
        name: "camera".to_owned(),
        world_from_camera: glam::DAffine3::IDENTITY,
        projection: Projection::Perspective { fov_y: 1.0 },
        aspect_ratio: None,
        lens: None,
    };
    let lamp = Material { emission: [3.0, 2.0, 1.0], ..Material::default() };
    let materials = vec![Material::default(), lamp];
    Scene {
        lights,
        materials,
        cameras: vec![camera],
        environment: Environment::Constant(environment),
        ..made
    }
}

#[test]
fn lights_and_lamps_are_those_of_fresh_tables() {
    let bench = Bench::new();
    let point = Light::Point { position: DVec3::ZERO, intensity: [4.0; 3], range: 50.0 };
    let sun = Light::Directional { direction: DVec3::NEG_Y, irradiance: [0.2; 3] };
    let spot = Light::Spot {
        position: DVec3::ZERO,
        direction: DVec3::NEG_Z,
        intensity: [9.0; 3],
        range: f32::INFINITY,
        inner_cone: 0.2,
        outer_cone: 0.6,
    };
    let mut counts = Vec::new();
    for (lights, environment, others) in [
        (vec![], [0.0; 3], false),
        (vec![], [0.0; 3], true),
        (vec![point, spot], [0.0; 3], true),
        (vec![point, sun, spot], [0.0; 3], false),
        (vec![sun, sun], [0.0; 3], true),
        (vec![], [0.1; 3], true),
        (vec![spot, sun, point], [0.1; 3], true),
    ] {
        let stage = DeviceScene::new(&bench, lamps(lights, environment, others), DVec3::ZERO);
        for seconds in [0.0, 0.6, 0.0, 1.0] {
            // Compares lights, lamps and shares.
            stage.held(&at(&stage.scene, seconds));
            let buffer = &stage.gpu.posed_buffers().frame;
            let frame: Frame = bench.device().download_as(buffer, 0, 1).expect("readable")[0];
            counts.push(frame.emissive_count);
        }
    }
    assert_eq!(counts[..8], [0, 30, 0, 30, 40, 40, 40, 40], "a lamp without area is no light");
}

/// A scene whose lights alone move has no draw that does.
#[test]
fn lights_move_by_themselves() {
    let bench = Bench::new();
    let rig = Rig {
        nodes: vec![node(None, DVec3::ZERO), node(None, DVec3::ONE)],
        lights: vec![1],
        ..Rig::default()
    };
    let moves = ChannelValues::Translation(vec![[0.0; 3], [5.0, 6.0, 7.0]]);
    let mut made = scene(vec![cloud(3, [0.0; 3], 30)], rig, vec![linear(1, moves)]);
    made.lights = vec![Light::Point { position: DVec3::ONE, intensity: [1.0; 3], range: 9.0 }];
    let stage = DeviceScene::new(&bench, made, DVec3::ZERO);
    assert_eq!((stage.pass.moves(), stage.pass.moving_draws()), (true, &[false][..]));
    for seconds in [0.5, 1.0, 0.0] {
        assert_eq!(stage.held(&at(&stage.scene, seconds)).vertices, 0);
    }
}
