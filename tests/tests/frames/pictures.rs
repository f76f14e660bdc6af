//! Pictures of a scene that moves, with frames in flight: those that one frame after the other gives.

use std::fmt::Display;
use std::ops::{ControlFlow, Range};

use glam::{DAffine3, DQuat, DVec3};
use rasray_frame::{
    FrameInput, FrameRenderer, FrameResult, ImagePasses, ImageRenderer, Picture, render_in_order,
};
use rasray_gpu::{Device, Timing};
use rasray_gpu_scene::{FramePose, GpuScene, Parts, PosePass, Sampling, SceneTables, View};
use rasray_integrators::{Film, IntegratorDesc, Path, Visibility};
use rasray_metrics::{Image, ImageError};
use rasray_scene::animation::{
    Channel, ChannelValues, Clip, Interpolation, NodeTransform, Placement, Rig, RigNode,
};
use rasray_scene::{Moment, Scene, builtin};
use rasray_shadow_maps::Config;
use rasray_systems::Spec;
use rasray_tests::harness::Bench;
use rasray_tracer::{FrameSettings, build_until_complete};

use crate::kept_pictures::Compared;

pub const SIZE: [u32; 2] = [24, 16];

/// Fails the running test unless a frame's picture is the expected one, bit for bit; both are kept.
#[track_caller]
pub fn assert_shown(picture: &[[f32; 3]], expected: &[[f32; 3]], why: impl Display) {
    Compared { picture, reference: expected, width: SIZE[0] }.assert_bits(why);
}

/// Every instance on a node of its own, of which the last one swings: right in one second, back in the next.
pub fn swinging() -> Scene {
    let mut scene = builtin::builtin("cornell").expect("it is built in").expect("it needs no parameter");
    let at_rest =
        NodeTransform::Parts { translation: DVec3::ZERO, rotation: DQuat::IDENTITY, scale: DVec3::ONE };
    let count = scene.instances.len();
    let node = |index| RigNode { name: format!("node {index}"), parent: None, transform: at_rest };
    let placed = |node: usize| Placement { node, node_from_mesh: scene.instances[node].world_from_mesh };
    let channel = Channel {
        node: count - 1,
        interpolation: Interpolation::Linear,
        times: vec![0.0, 1.0, 2.0],
        values: ChannelValues::Translation(vec![[0.0; 3], [0.25, 0.125, 0.0], [0.0; 3]]),
    };
    let clip = Clip { name: "swing".to_owned(), duration: 2.0, channels: vec![channel] };
    scene.animation.rig = Rig {
        nodes: (0..count).map(node).collect(),
        placements: (0..count).map(placed).collect(),
        clips: vec![clip],
        ..Rig::default()
    };
    scene.animation.clips = vec!["swing".to_owned()];
    scene
}

/// Scene, pose pass and integrator of one way to render.
struct Set {
    gpu: GpuScene,
    pose: PosePass,
    path: Path,
}

pub fn view(scene: &Scene, moved: f64) -> View {
    let mut camera = scene.cameras[0].clone();
    camera.world_from_camera *= DAffine3::from_translation(DVec3::X * moved);
    View { camera, width: SIZE[0], height: SIZE[1], seed: 7 }
}

fn sampling() -> Sampling {
    Sampling { samples: 4, ..Sampling::default() }
}

fn set(device: &Device, scene: &Scene, tables: &SceneTables) -> Set {
    let gpu = GpuScene::upload(device, tables, &view(scene, 0.0)).expect("it fits");
    let pose = PosePass::new(device, scene, tables, &gpu).expect("it fits");
    let film = Film::new(device, SIZE[0], SIZE[1]).expect("it fits");
    let path = Path::new(&IntegratorDesc::new(device, &gpu, &film), 1).expect("it fits");
    Set { gpu, pose, path }
}

pub fn tables(scene: &Scene) -> SceneTables {
    SceneTables::new(scene, DVec3::ZERO, &Parts::ALL).expect("the scene is whole")
}

pub fn spec(system: &str, options: &[(&str, &str)]) -> Spec {
    let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
    Spec::new(system, "robust", given).expect("the options are the system's")
}

/// Frames through a spec, with what each shows.
fn renderer(device: &Device, scene: &Scene, spec: &Spec, slots: u32) -> FrameRenderer {
    let Set { gpu, pose, path } = set(device, scene, &tables(scene));
    let structure = spec.create(device, gpu.geometry(), Some(gpu.binding())).expect("the options are valid");
    let settings = FrameSettings { slots, ..FrameSettings::default() };
    FrameRenderer::new(device, (gpu, Some(pose)), structure, Box::new(path), (settings, Timing::None, true))
        .expect("the device works")
}

pub fn input(view: View, pose: Option<FramePose>, samples: Range<u32>, continues: bool) -> FrameInput {
    FrameInput { view, sampling: sampling(), scene: None, pose, samples: samples.into(), continues }
}

/// The inputs of frames a quarter of a second apart, with a camera that moves as well.
fn inputs(renderer: &FrameRenderer, scene: &Scene, count: u32) -> Vec<FrameInput> {
    let pass = renderer.scene().pose().expect("it was made with one");
    let frame = |number: u32| {
        let moment = Moment { seconds: 0.25 * f64::from(number), clips: vec![0] };
        let pose = pass.frame(scene, &moment).expect("it is the same scene");
        input(view(scene, 0.01 * f64::from(number)), Some(pose), 0..2, false)
    };
    (0..count).map(frame).collect()
}

/// The picture of one frame, nothing in flight.
pub fn still(
    device: &Device,
    scene: &Scene,
    tables: &SceneTables,
    spec: &Spec,
    input: &FrameInput,
) -> Vec<[f32; 3]> {
    still_with(device, scene, tables, spec, input, None)
}

/// [`still`] with shadow maps.
pub fn still_with(
    device: &Device,
    scene: &Scene,
    tables: &SceneTables,
    spec: &Spec,
    input: &FrameInput,
    maps: Option<Config>,
) -> Vec<[f32; 3]> {
    let Set { gpu, pose, path } = set(device, scene, tables);
    let mut structure =
        spec.create(device, gpu.geometry(), Some(gpu.binding())).expect("the options are valid");
    device
        .submit(|recorder| {
            if let Some(at) = &input.pose {
                pose.record(recorder, 0, at);
            }
            gpu.record_frame(recorder, &input.view, input.sampling);
        })
        .expect("the device works");
    let viewpoint = gpu.viewpoint_of(&input.view);
    build_until_complete(device, structure.as_mut(), viewpoint, Timing::None).expect("it is built");
    let samples = 0..input.samples.index(input.samples.count());
    let mut passes = ImagePasses::from(Box::new(path));
    if let Some(config) = maps {
        passes = passes.with_shadow_maps(device, &gpu, config).expect("the device draws");
    }
    let mut image = ImageRenderer::new(device, passes, samples).expect("the device works");
    let go_on = |_: &ImageRenderer, _| ControlFlow::Continue(());
    image.render(&*structure, Timing::None, go_on).expect("the waves fit");
    assert_eq!((image.unfinished(), image.waves_done()), (0, image.waves()));
    image.film().read(device).expect("the device works")
}

pub fn pictures(renderer: &mut FrameRenderer, inputs: Vec<FrameInput>) -> (Vec<Picture>, u64) {
    let mut pictures = Vec::new();
    let done = render_in_order(renderer, inputs, |picture| {
        pictures.push(picture);
        ControlFlow::Continue(())
    });
    let done = done.expect("all frames have pictures");
    assert_eq!(done.pictures as usize, pictures.len());
    (pictures, done.repeated)
}

#[test]
fn frames_in_flight_are_the_pictures_of_single_frames() {
    let bench = Bench::new();
    let (device, scene) = (bench.device(), swinging());
    for spec in [spec("bricks", &[]), spec("bvh", &[("builder", "sah")])] {
        let mut renderer = renderer(device, &scene, &spec, 3);
        let inputs = inputs(&renderer, &scene, 6);
        let (found, _) = pictures(&mut renderer, inputs.clone());
        assert_eq!(found.len(), 6);
        let mut different = 0;
        for (number, (picture, input)) in found.iter().zip(&inputs).enumerate() {
            let means = picture.film.means();
            assert_eq!(means, still(device, &scene, &tables(&scene), &spec, input), "frame {number}");
            assert!(picture.built, "frame {number}: the block moved");
            // Posed by the host, positions differ in their last bits.
            let moment = Moment { seconds: 0.25 * number as f64, clips: vec![0] };
            let posed = scene.at(&moment).expect("a rig");
            let on_host =
                still(device, &posed, &tables(&posed), &spec, &FrameInput { pose: None, ..input.clone() });
            let image =
                |pixels| Image::new(SIZE[0] as usize, SIZE[1] as usize, pixels).expect("pixels of the size");
            let error = ImageError::measure(&image(&means), &image(&on_host)).expect("images of one size");
            assert!(error.rmse < 1.0e-3, "frame {number}: {error:?}");
            different += usize::from(means != found[0].film.means());
        }
        assert_eq!(different, 5, "frames differ, or nothing could go wrong");
    }
}

/// A simulation: each frame in flight has memory of its own for the shape.
#[test]
fn what_the_host_deforms_is_that_of_its_frame() {
    let bench = Bench::new();
    let device = bench.device();
    let scene = builtin::builtin("cloth-ball:1k").expect("it is built in").expect("a cloth");
    let spec = spec("bvh", &[("builder", "lbvh")]);
    let mut renderer = renderer(device, &scene, &spec, 3);
    let pass = renderer.scene().pose().expect("it was made with one");
    let inputs: Vec<_> = [0.2, 1.2, 0.6, 1.0, 0.8]
        .into_iter()
        .map(|seconds| {
            let pose = pass.frame(&scene, &Moment { seconds, clips: Vec::new() }).expect("a cloth");
            input(view(&scene, 0.0), Some(pose), 0..1, false)
        })
        .collect();
    let (found, _) = pictures(&mut renderer, inputs.clone());
    for (number, (picture, input)) in found.iter().zip(&inputs).enumerate() {
        let means = picture.film.means();
        assert!(means == still(device, &scene, &tables(&scene), &spec, input), "frame {number}");
        assert!(number == 0 || means != found[number - 1].film.means(), "frame {number}: the cloth moved");
    }
}

/// Bricks find every triangle, so drawing what the camera sees changes no bit.
#[test]
fn first_hits_that_are_drawn_are_those_that_are_traced() {
    let bench = Bench::new();
    let (device, scene) = (bench.device(), swinging());
    let spec = spec("bricks", &[]);
    let mut traced = renderer(device, &scene, &spec, 2);
    let drawn = renderer(device, &scene, &spec, 2);
    let visibility = Visibility::new(device, drawn.scene().gpu(), false).expect("the device draws");
    let mut drawn = drawn.with_visibility(visibility);
    let all = inputs(&traced, &scene, 3);
    let (expected, found) = (pictures(&mut traced, all.clone()).0, pictures(&mut drawn, all).0);
    for (expected, found) in expected.iter().zip(&found) {
        assert_shown(&found.film.means(), &expected.film.means(), format_args!("frame {}", expected.number));
    }
}

#[test]
fn a_camera_that_moves_alone_builds_nothing_that_does_not_depend_on_it() {
    let bench = Bench::new();
    let (device, scene) = (bench.device(), swinging());
    for (system, options) in [("bvh", ("builder", "lbvh")), ("dirt", ("centre", "fixed"))] {
        let spec = spec(system, &[options]);
        let mut renderer = renderer(device, &scene, &spec, 2);
        let mut all = inputs(&renderer, &scene, 5);
        let pose = all[3].pose.clone();
        all.iter_mut().for_each(|input| input.pose = pose.clone());
        // Until the pools suffice.
        pictures(&mut renderer, all[..1].to_vec());
        let (found, repeated) = pictures(&mut renderer, all.clone());
        assert_eq!(repeated, 0, "{system}");
        let built: Vec<bool> = found.iter().map(|picture| picture.built).collect();
        assert_eq!(built, [false; 5], "{system}");
        for (picture, input) in found.iter().zip(&all) {
            let expected = still(device, &scene, &tables(&scene), &spec, input);
            assert_shown(&picture.film.means(), &expected, system);
        }
    }
}

#[test]
fn what_continues_adds_its_samples() {
    let bench = Bench::new();
    let (device, scene) = (bench.device(), swinging());
    let mut renderer = renderer(device, &scene, &spec("bvh", &[("builder", "lbvh")]), 2);
    let at = inputs(&renderer, &scene, 1).remove(0);
    let mut submit = |samples: Range<u32>, continues: bool| {
        renderer
            .submit(&input(at.view.clone(), at.pose.clone(), samples, continues))
            .expect("a slot is free");
        match renderer.take().expect("the device works").expect("one is in flight") {
            FrameResult::Picture(picture) => picture.film.pixels,
            FrameResult::Nothing { pool } => panic!("a tree is complete at once, but {pool:?}"),
        }
    };
    let whole = submit(0..4, false);
    let parts = [submit(0..1, false), submit(1..3, true), submit(3..4, true)];
    let key = |pixels: &[rasray_integrators::FilmPixel]| {
        pixels.iter().map(|pixel| (pixel.sum.map(f32::to_bits), pixel.samples)).collect::<Vec<_>>()
    };
    assert_eq!(key(&parts[2]), key(&whole));
    assert!(parts[1].iter().all(|pixel| pixel.samples == 3));
}

#[test]
fn a_frame_that_is_not_complete_is_no_picture() {
    let bench = Bench::new();
    let (device, scene) = (bench.device(), swinging());
    let spec = spec("mmrt", &[("resolution", "64"), ("capacity", "100")]);
    let mut renderer = renderer(device, &scene, &spec, 2);
    let all = inputs(&renderer, &scene, 2);
    renderer.submit(&all[0]).expect("a slot is free");
    let continued = FrameInput { samples: (2..3).into(), continues: true, ..all[0].clone() };
    renderer.submit(&continued).expect("a slot is free");
    let mut lacking = Vec::new();
    while let Some(one) = renderer.take().expect("the device works") {
        match one {
            FrameResult::Picture(_) => {
                panic!("100 fragments are not enough, and nothing can be added to what is not there")
            }
            FrameResult::Nothing { pool } => lacking.push(pool),
        }
    }
    assert_eq!(lacking.len(), 2);
    assert!(lacking[0].is_some_and(|pool| pool.lacking() > 0), "{lacking:?}");
    // The film still is what an incomplete build left, although the pools suffice now.
    renderer.submit(&continued).expect("a slot is free");
    assert!(matches!(renderer.take(), Ok(Some(FrameResult::Nothing { pool: None }))));
    let (found, _) = pictures(&mut renderer, all);
    assert_eq!(found.len(), 2);
}

/// A frame without a pose shows what the one before it does, also where it is repeated after frames that
/// moved on.
#[test]
fn a_repeated_frame_without_a_pose_stays_where_it_was() {
    let bench = Bench::new();
    let (device, scene) = (bench.device(), swinging());
    let spec = spec("mmrt", &[("resolution", "64"), ("capacity", "100")]);
    let at = |renderer: &FrameRenderer, seconds: f64| {
        let moment = Moment { seconds, clips: vec![0] };
        Some(
            renderer
                .scene()
                .pose()
                .expect("it was made with one")
                .frame(&scene, &moment)
                .expect("it is the same scene"),
        )
    };
    for first_is_posed in [false, true] {
        let mut renderer = renderer(device, &scene, &spec, 3);
        let poses = [first_is_posed.then_some(0.25), None, Some(0.75), None]
            .map(|seconds| seconds.and_then(|seconds| at(&renderer, seconds)));
        let inputs = poses.clone().map(|pose| input(view(&scene, 0.0), pose, 0..1, false));
        let (found, repeated) = pictures(&mut renderer, inputs.to_vec());
        assert!(repeated > 0, "100 fragments are not enough");
        let mut shown = None;
        for (number, (picture, pose)) in found.iter().zip(&poses).enumerate() {
            shown = pose.clone().or(shown);
            let single = FrameInput { pose: shown.clone(), ..inputs[number].clone() };
            let expected = still(device, &scene, &tables(&scene), &spec, &single);
            let why = format!("frame {number}, first is posed: {first_is_posed}");
            assert_shown(&picture.film.means(), &expected, why);
        }
        assert_ne!(found[1].film.means(), found[2].film.means(), "nothing could go wrong");
    }
}

/// A frame whose rays pass more surfaces than rounds were recorded for is not shown; those after it have
/// enough.
#[test]
fn frames_show_what_is_behind_many_clear_layers() {
    let bench = Bench::new();
    let device = bench.device();
    let mut scene = builtin::builtin("cornell").expect("it is built in").expect("it needs no parameter");
    let clear = scene.materials.len();
    scene.materials.push(rasray_scene::Material {
        base_color: [0.0; 4],
        alpha_mode: rasray_scene::AlphaMode::Blend,
        ..rasray_scene::Material::default()
    });
    let first = scene.meshes.len();
    let world_from_mesh = scene.cameras[0].world_from_camera;
    for layer in 0..40 {
        let place = DVec3::NEG_Z * (0.01 + 0.001 * f64::from(layer));
        scene.meshes.push(rasray_tests::image_truth::square(place, DVec3::X * 0.1, DVec3::Y * 0.1, clear));
        let name = "clear".to_owned();
        scene.instances.push(rasray_scene::Instance { name, mesh: first + layer as usize, world_from_mesh });
    }
    let (tables, spec) = (tables(&scene), spec("brute-force", &[]));
    let wanted = input(view(&scene, 0.0), None, 0..2, false);
    let expected = still(device, &scene, &tables, &spec, &wanted);
    let mut renderer = renderer(device, &scene, &spec, 2);
    let (shown, repeated) = pictures(&mut renderer, vec![wanted; 3]);
    assert!(shown.len() == 3 && repeated > 0, "{repeated}");
    for picture in &shown {
        assert_eq!((picture.film.faults.unended, picture.film.faults.cut), (0, 0));
        assert_shown(&picture.film.means(), &expected, format_args!("frame {}", picture.number));
    }
}
