//! Shadow maps over frames in flight: drawn where lights or triangles have moved, and only then; pictures are
//! those of maps that are drawn for one frame alone.

use glam::{DQuat, DVec3};
use rasray_frame::{FrameInput, FrameRenderer, FrameScene};
use rasray_gpu::{Device, Timing};
use rasray_gpu_scene::{GpuScene, PosePass};
use rasray_integrators::{Film, IntegratorDesc, Path};
use rasray_scene::animation::{
    Channel, ChannelValues, Clip, Interpolation, NodeTransform, Placement, Rig, RigNode,
};
use rasray_scene::{Light, Moment, Scene, builtin};
use rasray_shadow_maps::Config;
use rasray_tests::harness::Bench;
use rasray_tracer::FrameSettings;

use crate::frames::pictures::{SIZE, assert_shown, input, pictures, spec, still, still_with, tables, view};

const MAPS: Config = Config { resolution: 128, bias: 1.0, points: 2 };

fn lamp() -> Light {
    Light::Point { position: DVec3::ZERO, intensity: [0.3, 0.2, 0.2], range: f32::INFINITY }
}

/// Cornell's box with a lamp on a node that swings, and where `block_moves` a block as well.
fn lamp_in_cornell(block_moves: bool) -> Scene {
    let mut scene = builtin::cornell();
    let count = scene.instances.len();
    let node = |name: String, translation: DVec3| RigNode {
        name,
        parent: None,
        transform: NodeTransform::Parts { translation, rotation: DQuat::IDENTITY, scale: DVec3::ONE },
    };
    let swing = |node: usize, from: [f32; 3], to: [f32; 3]| Channel {
        node,
        interpolation: Interpolation::Linear,
        times: vec![0.0, 1.0],
        values: ChannelValues::Translation(vec![from, to]),
    };
    let mut channels = vec![swing(count, [0.0, 0.45, -0.2], [0.15, 0.4, -0.1])];
    if block_moves {
        channels.push(swing(count - 1, [0.0; 3], [0.1, 0.0, 0.1]));
    }
    let placement = |(node, instance): (usize, &rasray_scene::Instance)| Placement {
        node,
        node_from_mesh: instance.world_from_mesh,
    };
    let mut nodes: Vec<_> = (0..count).map(|index| node(format!("node {index}"), DVec3::ZERO)).collect();
    nodes.push(node("lamp".to_owned(), DVec3::new(0.0, 0.45, -0.2)));
    scene.animation.rig = Rig {
        nodes,
        placements: scene.instances.iter().enumerate().map(placement).collect(),
        lights: vec![count],
        clips: vec![Clip { name: "swing".to_owned(), duration: 1.0, channels }],
        ..Rig::default()
    };
    scene.animation.clips = vec!["swing".to_owned()];
    scene.lights = vec![lamp()];
    scene
}

fn renderer(device: &Device, scene: &Scene) -> FrameRenderer {
    let tables = tables(scene);
    let gpu = GpuScene::upload(device, &tables, &view(scene, 0.0)).expect("it fits");
    let pose = PosePass::new(device, scene, &tables, &gpu).expect("it fits");
    let film = Film::new(device, SIZE[0], SIZE[1]).expect("it fits");
    let path = Path::new(&IntegratorDesc::new(device, &gpu, &film), 1).expect("it fits");
    let spec = spec("bvh", &[("builder", "lbvh")]);
    let structure = spec.create(device, gpu.geometry(), Some(gpu.binding())).expect("valid");
    let rest = (FrameSettings { slots: 3, ..FrameSettings::default() }, Timing::None, true);
    let renderer = FrameRenderer::new(device, (gpu, Some(pose)), structure, Box::new(path), rest);
    renderer.expect("the device works").with_shadow_maps(MAPS).expect("the device draws")
}

/// A frame at a time, with a camera that was moved.
fn at(renderer: &FrameRenderer, scene: &Scene, seconds: f64, camera: f64) -> FrameInput {
    let pass = renderer.scene().pose().expect("it was made with one");
    let pose = pass.frame(scene, &Moment { seconds, clips: vec![0] }).expect("it is the same scene");
    input(view(scene, camera), Some(pose), 0..2, false)
}

#[test]
fn maps_are_drawn_where_anything_has_moved_and_only_then() {
    let bench = Bench::new();
    let device = bench.device();
    for block_moves in [false, true] {
        let scene = lamp_in_cornell(block_moves);
        let mut renderer = renderer(device, &scene);
        let times = [(0.0, 0.0), (0.0, 0.0), (0.6, 0.0), (0.6, 0.02), (0.6, 0.02), (0.0, 0.02)];
        let inputs: Vec<_> =
            times.iter().map(|&(seconds, camera)| at(&renderer, &scene, seconds, camera)).collect();
        let (found, _) = pictures(&mut renderer, inputs.clone());
        let drawn: Vec<_> = found.iter().map(|picture| picture.drew_maps).collect();
        assert_eq!(drawn, [true, false, true, false, false, true], "block moves: {block_moves}");
        let built: Vec<_> = found.iter().map(|picture| picture.built).collect();
        assert_eq!(built, [true, false, block_moves, false, false, block_moves]);
        let spec = spec("bvh", &[("builder", "lbvh")]);
        let mut differ = 0;
        for (number, (picture, input)) in found.iter().zip(&inputs).enumerate() {
            let means = picture.film.means();
            let alone = still_with(device, &scene, &tables(&scene), &spec, input, Some(MAPS));
            assert!(means == alone, "frame {number}, block moves: {block_moves}");
            differ += usize::from(means != still(device, &scene, &tables(&scene), &spec, input));
        }
        assert!(differ > 0, "maps answer nothing");
    }
}

/// Another scene with more lights in the same renderer: its maps grow.
#[test]
fn a_scene_with_more_lights_has_more_maps() {
    let bench = Bench::new();
    let device = bench.device();
    let scene = lamp_in_cornell(true);
    let mut more = scene.clone();
    more.lights.push(Light::Directional {
        direction: DVec3::new(-0.2, -0.4, -0.9).normalize(),
        irradiance: [1.0; 3],
    });
    more.lights.push(lamp());
    let count = more.instances.len();
    more.animation.rig.lights = vec![count; 3];
    more.animation.rig.nodes.push(more.animation.rig.nodes[count].clone());
    let mut renderer = renderer(device, &scene);
    let made = tables(&more);
    let gpu = GpuScene::upload(device, &made, &view(&more, 0.0)).expect("it fits");
    let pose = PosePass::new(device, &more, &made, &gpu).expect("it fits");
    let other = FrameScene::new(device, gpu, Some(pose), renderer.slots()).expect("it fits");
    let pose = other.pose().expect("it moves").frame(&more, &Moment { seconds: 0.3, clips: vec![0] });
    let pose = pose.expect("it is the same scene");
    let first = at(&renderer, &scene, 0.3, 0.0);
    let second = FrameInput { scene: Some(other), ..input(view(&more, 0.0), Some(pose), 0..2, false) };
    let third = FrameInput { scene: Some(renderer.scene().clone()), ..first.clone() };
    let (found, _) = pictures(&mut renderer, vec![first.clone(), second.clone(), third]);
    assert!(found.iter().all(|picture| picture.drew_maps));
    let spec = spec("bvh", &[("builder", "lbvh")]);
    for (picture, (scene, input)) in found.iter().zip([(&scene, &first), (&more, &second), (&scene, &first)])
    {
        let alone = still_with(device, scene, &tables(scene), &spec, input, Some(MAPS));
        assert_shown(&picture.film.means(), &alone, format_args!("frame {}", picture.number));
    }
}
