//! Scenes whose triangles change in number from frame to frame: pictures are those of renderers made for
//! each.

use std::ops::ControlFlow;

use glam::{DAffine3, DVec3};
use rasray_ads::{AdsError, Combined};
use rasray_frame::{FrameError, FrameInput, FrameRenderer, FrameScene, render_in_order};
use rasray_gpu::{Device, RawDevice, Timing, vk};
use rasray_gpu_scene::{GpuScene, PosePass, ShadingFeatures};
use rasray_integrators::{Film, IntegratorDesc, IntegratorError, Path, Raycast, Visibility};
use rasray_scene::{AlphaMode, Camera, Mesh, Moment, Projection, Scene, builtin};
use rasray_scene_files::LoadOptions;
use rasray_systems::Spec;
use rasray_tests::harness::Bench;
use rasray_tracer::{FrameSettings, Refresh};

use crate::frames::pictures::{SIZE, assert_shown, input, pictures, spec, still, swinging, tables, view};

/// Cells along a side of a sheet in each frame, two triangles each: one that grows, shrinks, and goes.
const SIDES: [usize; 9] = [1, 2, 24, 3, 0, 0, 17, 18, 2];

/// A sheet with bumps, across the middle of the room.
fn sheet(mesh: &Mesh, side: usize) -> Mesh {
    let across = side + 1;
    let at = |index: usize| (index as f32 / side as f32 - 0.5) * 0.4;
    let corner = |index: usize| {
        let (x, z) = (at(index % across), at(index / across));
        [x, 0.25 + 0.05 * (20.0 * x).sin() * (15.0 * z).cos(), z - 0.25]
    };
    let cell = |cell: usize| {
        let first = (cell / side * across + cell % side) as u32;
        let next = first + across as u32;
        [first, first + 1, next, next, first + 1, next + 1]
    };
    Mesh {
        name: mesh.name.clone(),
        material: mesh.material,
        positions: (0..if side == 0 { 0 } else { across * across }).map(corner).collect(),
        indices: (0..side * side).flat_map(cell).collect(),
        ..Mesh::default()
    }
}

/// A room in which the last mesh is a sheet of so many cells along a side.
fn room(mut scene: Scene, side: usize) -> Scene {
    let last = scene.meshes.last_mut().expect("there are meshes");
    *last = sheet(last, side);
    scene
}

fn cornell() -> Scene {
    builtin::builtin("cornell").expect("it is built in").expect("it needs no parameter")
}

fn uploaded(device: &Device, scene: &Scene) -> GpuScene {
    GpuScene::upload(device, &tables(scene), &view(scene, 0.0)).expect("it fits")
}

/// The scene as a frame brings it: on its way to the device.
fn brought(device: &Device, scene: &Scene, slots: u32) -> FrameScene {
    let staged = GpuScene::staged(device, &tables(scene), &view(scene, 0.0)).expect("it fits");
    FrameScene::new(device, staged, None, slots).expect("it fits")
}

/// A renderer that begins with a scene, which may say that later ones have more features.
fn beginning(
    device: &Device,
    scene: &Scene,
    allowing: Option<ShadingFeatures>,
    spec: &Spec,
) -> FrameRenderer {
    let gpu = allowing.into_iter().fold(uploaded(device, scene), GpuScene::allowing);
    let film = Film::new(device, SIZE[0], SIZE[1]).expect("it fits");
    let path = Path::new(&IntegratorDesc::new(device, &gpu, &film), 1).expect("it fits");
    let structure = spec.create(device, gpu.geometry(), Some(gpu.binding())).expect("the options are valid");
    FrameRenderer::new(
        device,
        (gpu, None),
        structure,
        Box::new(path),
        (FrameSettings::default(), Timing::None, true),
    )
    .expect("the device works")
}

fn with_scene(scene: &Scene, moved: f64, brought: Option<FrameScene>) -> FrameInput {
    FrameInput { scene: brought, ..input(view(scene, moved), None, 0..2, false) }
}

fn specs() -> Vec<Spec> {
    vec![
        spec("bricks", &[]),
        spec("bvh", &[("builder", "lbvh")]),
        spec("bvh", &[("builder", "sah")]),
        spec("grid", &[]),
        spec("brute-force", &[]),
        spec("mmrt", &[("resolution", "64"), ("capacity", "100")]),
    ]
}

#[test]
fn pictures_are_those_of_renderers_made_for_each_scene() {
    let bench = Bench::new();
    let device = bench.device();
    for spec in specs() {
        let name = spec.system().name;
        let mut renderer = beginning(device, &room(cornell(), 4), None, &spec);
        assert_eq!(renderer.slots(), 2);
        let (mut scenes, mut inputs) = (Vec::new(), Vec::new());
        for (number, side) in SIDES.into_iter().enumerate() {
            let scene = room(cornell(), side);
            // Every fourth frame keeps the scene of the one before, seen from elsewhere.
            let kept = number % 4 == 3;
            scenes.push(if kept { number - 1 } else { number });
            let brought = (!kept).then(|| brought(device, &scene, 2));
            inputs.push(with_scene(&scene, 0.01 * number as f64, brought));
        }
        let (found, repeated) = pictures(&mut renderer, inputs.clone());
        assert!(repeated > 0 || name != "mmrt", "100 fragments are not enough");
        for (number, (picture, input)) in found.iter().zip(&inputs).enumerate() {
            let scene = room(cornell(), SIDES[scenes[number]]);
            let expected =
                still(device, &scene, &tables(&scene), &spec, &FrameInput { scene: None, ..input.clone() });
            assert_shown(&picture.film.means(), &expected, format_args!("{name}, frame {number}"));
        }
        let distinct = found.windows(2).filter(|pair| pair[0].film.means() != pair[1].film.means()).count();
        assert_eq!(distinct, SIDES.len() - 1, "{name}: frames differ, or nothing could go wrong");
    }
}

/// Scenes are made while frames before are in flight, and dropped while those that show them are.
#[test]
fn nothing_of_earlier_scenes_is_left() {
    let bench = Bench::new();
    let device = bench.device();
    let before = device.allocated_bytes();
    let spec = spec("bricks", &[]);
    let mut renderer = beginning(device, &room(cornell(), 8), None, &spec);
    let sides = [3, 8, 1, 7, 2];
    let frames = 60;
    let expected = sides.map(|side| {
        let scene = room(cornell(), side);
        still(device, &scene, &tables(&scene), &spec, &with_scene(&scene, 0.0, None))
    });
    let inputs = (0..frames).map(|number| {
        let scene = room(cornell(), sides[number % sides.len()]);
        with_scene(&scene, 0.0, Some(brought(device, &scene, 2)))
    });
    let (mut shown, mut most) = (0, [0; 2]);
    let done = render_in_order(&mut renderer, inputs, |picture| {
        assert_shown(&picture.film.means(), &expected[shown % sides.len()], format_args!("frame {shown}"));
        let most = &mut most[usize::from(shown >= frames / 2)];
        *most = device.allocated_bytes().max(*most);
        shown += 1;
        ControlFlow::Continue(())
    });
    assert_eq!(done.expect("all frames have pictures").pictures as usize, frames);
    let [first, second] = most;
    assert!(second <= first + 65_536, "{first} bytes at most in the first half, {second} in the second");
    drop(renderer);
    assert_eq!(device.allocated_bytes(), before);
}

/// A device that cannot submit cannot wait either.
#[test]
fn a_staged_scene_neither_submits_nor_waits() {
    let bench = Bench::new();
    let host = bench.device();
    let raw = RawDevice {
        instance: host.raw_instance().clone(),
        physical: host.raw_physical(),
        device: host.raw().clone(),
        queue: vk::Queue::null(),
        queue_family: host.queue_family(),
        api_version: host.api_version(),
        enabled: host.enabled(),
        debug_utils: true,
        pipeline_cache: vk::PipelineCache::null(),
        memory: None,
        memory_limit: None,
    };
    // SAFETY: `raw` describes a device made by this crate, which outlives the adopted one.
    let device = unsafe { Device::from_raw(raw) }.expect("it is adopted");
    let scene = swinging();
    let (tables, view) = (tables(&scene), view(&scene, 0.0));
    GpuScene::upload(&device, &tables, &view).expect_err("nothing can be submitted");
    let gpu = GpuScene::staged(&device, &tables, &view).expect("it fits");
    let mut pose = PosePass::new(&device, &scene, &tables, &gpu).expect("it fits");
    pose.parts(&device).expect("it fits");
    FrameScene::new(&device, gpu, Some(pose), 2).expect("it fits");
}

#[test]
fn what_moves_in_a_scene_moves_in_the_next() {
    let bench = Bench::new();
    let device = bench.device();
    let moment = |seconds| Moment { seconds, clips: vec![0] };
    for in_parts in [false, true] {
        for spec in &specs()[..2] {
            let name = spec.system().name;
            // The sheet does not move: what does is the last instance, which stays the last.
            let scene = |side| {
                let mut scene = swinging();
                let changed = scene.meshes.len() - 2;
                scene.meshes[changed] = sheet(&scene.meshes[changed], side);
                scene
            };
            let prepared = |side, staged: bool| {
                let scene = scene(side);
                let (tables, view) = (tables(&scene), view(&scene, 0.0));
                let made = if staged { GpuScene::staged } else { GpuScene::upload };
                let gpu = made(device, &tables, &view).expect("it fits");
                let mut pose = PosePass::new(device, &scene, &tables, &gpu).expect("it fits");
                if in_parts {
                    pose.parts(device).expect("it fits");
                }
                (gpu, pose)
            };
            let (gpu, pose) = prepared(2, false);
            let film = Film::new(device, SIZE[0], SIZE[1]).expect("it fits");
            let path = Path::new(&IntegratorDesc::new(device, &gpu, &film), 1).expect("it fits");
            let binding = Some(gpu.binding());
            let structure: Refresh = match pose.divided() {
                Some(parts) => Combined::new(parts, |part| spec.create(device, part, binding))
                    .expect("it finds all")
                    .into(),
                None => spec.create(device, gpu.geometry(), binding).expect("the options are valid").into(),
            };
            let rest = (FrameSettings::default(), Timing::None, true);
            let mut renderer = FrameRenderer::new(device, (gpu, Some(pose)), structure, Box::new(path), rest)
                .expect("the device works");
            let (mut inputs, mut singles) = (Vec::new(), Vec::new());
            for (number, side) in [(0, 5), (1, 5), (2, 9), (3, 9), (4, 1), (5, 5)] {
                let scene = scene(side);
                let brought = (number % 2 == 0 || number == 5).then(|| {
                    let (gpu, pose) = prepared(side, true);
                    FrameScene::new(device, gpu, Some(pose), 2).expect("it fits")
                });
                let shown = brought
                    .clone()
                    .or_else(|| inputs.last().and_then(|last: &FrameInput| last.scene.clone()));
                let pass = shown.as_ref().and_then(FrameScene::pose).expect("it was made with one");
                let pose =
                    pass.frame(&scene, &moment(0.25 * f64::from(number))).expect("it is the same scene");
                // The first frame says nothing of where things are.
                let single = input(view(&scene, 0.0), Some(pose).filter(|_| number > 0), 0..1, false);
                inputs.push(FrameInput { scene: brought, ..single.clone() });
                singles.push((scene, single));
            }
            let (found, _) = pictures(&mut renderer, inputs);
            for (number, (picture, (scene, single))) in found.iter().zip(&singles).enumerate() {
                let expected = still(device, scene, &tables(scene), spec, single);
                let why = format!("{name}, frame {number}, in parts: {in_parts}");
                assert_shown(&picture.film.means(), &expected, why);
            }
            if in_parts {
                // A scene that is not in parts is refused, and frames go on with the one before.
                let whole = brought(device, &scene(5), 2);
                let refused = renderer.submit(&with_scene(&scene(5), 0.0, Some(whole)));
                let refused = refused.expect_err("it is not in parts");
                assert!(matches!(refused, FrameError::Ads(AdsError::InParts { .. })), "{refused}");
                let (again, _) = pictures(&mut renderer, vec![singles[5].1.clone()]);
                assert_shown(&again[0].film.means(), &found[5].film.means(), name);
            }
        }
    }
}

#[test]
fn a_scene_that_needs_other_kernels_is_refused() {
    let bench = Bench::new();
    let device = bench.device();
    let spec = spec("bricks", &[]);
    let plain = room(cornell(), 2);
    let mut glass = room(cornell(), 6);
    let material = glass.meshes.last().expect("a sheet").material;
    glass.materials[material].transmission = 1.0;
    let mut masked = room(cornell(), 7);
    masked.materials[material].alpha_mode = AlphaMode::Mask { cutoff: 0.5 };
    masked.materials[material].base_color[3] = 0.25;
    let mut refusing = beginning(device, &plain, None, &spec);
    let expected = pictures(&mut refusing, vec![with_scene(&plain, 0.0, None)]).0.remove(0);
    let of_glass = "transmission, specular or metallic materials";
    for (scene, expected_missing) in [(&glass, of_glass), (&masked, "alpha masks")] {
        let refused = refusing.submit(&with_scene(scene, 0.0, Some(brought(device, scene, 2))));
        match refused.expect_err("its kernels have no such code") {
            FrameError::Integrator(IntegratorError::LeftOut { missing }) => {
                assert_eq!(missing, expected_missing)
            }
            other => panic!("{other}"),
        }
        let still_there = pictures(&mut refusing, vec![with_scene(&plain, 0.0, None)]).0.remove(0);
        assert_shown(&still_there.film.means(), &expected.film.means(), "the scene before");
    }
    // A view of another size is no picture of this film.
    let mut wide = with_scene(&plain, 0.0, None);
    wide.view.width += 1;
    let refused = refusing.submit(&wide).expect_err("the film is smaller");
    assert!(matches!(refused, FrameError::Integrator(IntegratorError::SizesDiffer { .. })), "{refused}");

    let mut allowing = beginning(device, &plain, Some(ShadingFeatures::ALL), &spec);
    let visibility = Visibility::new(device, allowing.scene().gpu(), false).expect("the device draws");
    let mut drawing =
        beginning(device, &plain, Some(ShadingFeatures::ALL), &spec).with_visibility(visibility);
    let scenes = [&glass, &plain, &masked, &glass];
    for renderer in [&mut allowing, &mut drawing] {
        let inputs = scenes.map(|scene| with_scene(scene, 0.0, Some(brought(device, scene, 2))));
        let (found, _) = pictures(renderer, inputs.to_vec());
        for (number, (picture, scene)) in found.iter().zip(scenes).enumerate() {
            let single = with_scene(scene, 0.0, None);
            let expected = still(device, scene, &tables(scene), &spec, &single);
            assert_shown(&picture.film.means(), &expected, format_args!("frame {number}"));
        }
        assert_ne!(found[0].film.means(), found[1].film.means());
    }
}

#[test]
fn numbered_files_are_frames() {
    let bench = Bench::new();
    let device = bench.device();
    let folder = tempfile::tempdir().expect("a folder for files");
    let blank = Mesh::default();
    for (number, side) in [1, 5, 2, 0, 6].into_iter().enumerate() {
        let mesh = sheet(&blank, side);
        let vertex = |[x, y, z]: &[f32; 3]| format!("v {x} {y} {z}\n");
        let face = |corners: &[u32]| format!("f {} {} {}\n", corners[0] + 1, corners[1] + 1, corners[2] + 1);
        let lines = mesh.positions.iter().map(vertex).chain(mesh.indices.chunks(3).map(face));
        let text: String = std::iter::once("# a sheet\n".to_owned()).chain(lines).collect();
        std::fs::write(folder.path().join(format!("sheet.{number:02}.obj")), text).expect("a file");
    }
    let options = LoadOptions { fps: 10.0, ..LoadOptions::default() };
    let scene =
        rasray_scene_files::load(&folder.path().join("sheet.##.obj"), &options).expect("files of one name");
    let eye = DAffine3::from_translation(DVec3::new(0.0, 0.5, 0.3));
    let camera = Camera {
        name: "above".to_owned(),
        world_from_camera: eye * DAffine3::from_rotation_x(-0.5),
        projection: Projection::Perspective { fov_y: 0.8 },
        aspect_ratio: None,
        lens: None,
    };
    let shown = |number: u32| {
        let mut posed =
            scene.at(&Moment { seconds: 0.1 * f64::from(number), clips: Vec::new() }).expect("a file");
        posed.cameras = vec![camera.clone()];
        posed
    };
    let renderer = |scene: &Scene| {
        let gpu = uploaded(device, scene);
        let film = Film::new(device, SIZE[0], SIZE[1]).expect("it fits");
        let raycast = Raycast::new(&IntegratorDesc::new(device, &gpu, &film)).expect("it fits");
        let structure = spec("bricks", &[]).create(device, gpu.geometry(), Some(gpu.binding()));
        let structure = structure.expect("the options are valid");
        let rest = (FrameSettings::default(), Timing::None, true);
        FrameRenderer::new(device, (gpu, None), structure, Box::new(raycast), rest).expect("the device works")
    };
    let inputs = (0..5).map(|number| {
        let scene = shown(number);
        with_scene(&scene, 0.0, Some(brought(device, &scene, 2)))
    });
    let (found, _) = pictures(&mut renderer(&shown(0)), inputs.collect());
    let mut seen = Vec::new();
    for (number, picture) in (0..).zip(&found) {
        let scene = shown(number);
        let (expected, _) = pictures(&mut renderer(&scene), vec![with_scene(&scene, 0.0, None)]);
        assert_shown(&picture.film.means(), &expected[0].film.means(), format_args!("file {number}"));
        seen.push(expected[0].film.means());
    }
    seen.sort_by(|one, other| one.partial_cmp(other).expect("numbers"));
    seen.dedup();
    assert_eq!(seen.len(), 5, "files differ, or nothing could go wrong");
}

/// Frames in flight that were recorded with too few rounds are repeated, although those before them have
/// allowed as many as there can be.
#[test]
fn frames_in_flight_that_need_more_rounds_are_repeated() {
    let bench = Bench::new();
    let device = bench.device();
    let mut scene = cornell();
    // A ray that passes one of these triangles is in the boxes of all of them.
    let last = scene.meshes.last_mut().expect("there are meshes");
    let triangle = [[-0.2, 0.1, -0.1], [0.2, 0.1, -0.4], [-0.2, 0.5, -0.4]];
    *last = Mesh { positions: triangle.to_vec(), indices: [0, 1, 2].repeat(120), ..sheet(last, 0) };
    let whole = spec("bvh", &[("builder", "lbvh")]);
    let mut renderer = beginning(device, &scene, None, &whole.clone().with_work_budget(64));
    let inputs = [0.0, 0.01, 0.02].map(|moved| with_scene(&scene, moved, None));
    let (found, repeated) = pictures(&mut renderer, inputs.to_vec());
    assert_eq!(repeated, 2, "both frames in flight have too few rounds");
    for (picture, input) in found.iter().zip(&inputs) {
        let expected = still(device, &scene, &tables(&scene), &whole, input);
        assert_shown(&picture.film.means(), &expected, format_args!("frame {}", picture.number));
    }
}
