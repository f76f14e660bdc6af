//! Tests of pictures of an engine on a device, without a window: they equal those of a render, bit for bit,
//! after every kind of change.

mod denoised;
mod viewing;

use std::ffi::OsStr;
use std::ops::ControlFlow;
use std::sync::mpsc::channel;
use std::time::Duration;

use glam::{DQuat, DVec3};
use rasray_experiment::{
    AovSelection, Backend, DeviceChoice, Frame, IntegratorRow, IntegratorSpec, KeptScene, OccluderKind,
    OptionValues, Primary, Progress, Refresh, RenderJob, RenderOutput, Sampler, SystemConfig, open,
    open_device,
};
use rasray_scene::Moment;
use rasray_scene::animation::{
    Channel, ChannelValues, Clip, Interpolation, NodeTransform, Placement, Rig, RigNode,
};
use rasray_scene_source::{LoadedScene, load};
use rasray_systems::{Preset, System};
use rasray_viewer::{
    Engine, Picture, Pixels, Rounded, SceneSource, Settings, Shown, Standpoint, Step, Update, Worker,
};

const VALIDATED: DeviceChoice = DeviceChoice { device: None, validation: true };

fn system(name: &str) -> SystemConfig {
    let system = System::named(name).expect("a system");
    SystemConfig::new(system, Preset::Robust, OptionValues::default())
}

fn integrator(name: &str) -> IntegratorSpec {
    IntegratorRow::named(name).expect("it is registered").into()
}

fn settings() -> Settings {
    let frame = Frame {
        integrator: integrator("ao"),
        width: 33,
        height: 20,
        spp: 2,
        adaptive: None,
        seed: 7,
        sampler: Sampler::Sobol,
        primary: Primary::Trace,
        occluder: OccluderKind::Structure,
        back_faces: rasray_scene::BackFaces::Camera,
    };
    let system = system("bricks");
    Settings {
        scene: 0,
        standpoint: Standpoint::AsGiven,
        seconds: None,
        system,
        frame,
        shown: Shown::Picture,
        denoised: false,
        moving: false,
    }
}

fn engine(settings: &Settings) -> Engine {
    engine_of(OsStr::new("cornell"), settings)
}

fn engine_of(scene: &OsStr, settings: &Settings) -> Engine {
    engine_with(load(scene).expect("a scene"), settings)
}

fn engine_with(loaded: LoadedScene, settings: &Settings) -> Engine {
    engine_for(source_of(loaded), settings)
}

fn source_of(mut loaded: LoadedScene) -> SceneSource {
    loaded.light(None);
    SceneSource { loaded, clip: None, needs_all: false, camera: Box::new(LoadedScene::default_view) }
}

fn engine_for(source: SceneSource, settings: &Settings) -> Engine {
    let device = open_device(&VALIDATED).expect("a device");
    Engine::new(device, true, source, settings.clone())
}

/// Returns the picture at the end of its refinement.
fn finished(engine: &mut Engine) -> Picture {
    told(engine).0
}

/// Returns the picture as [`finished`], with the texts about long work.
fn told(engine: &mut Engine) -> (Picture, Vec<String>) {
    let (mut last, mut told) = (None, Vec::new());
    for _ in 0..1000 {
        match engine.step(&mut |text| told.push(text.to_owned())).expect("a step") {
            Step::Working => (),
            Step::Picture(picture) => last = Some(*picture),
            Step::Done => return (last.expect("a picture before the end"), told),
        }
    }
    panic!("it does not end");
}

/// Returns the first picture.
fn first(engine: &mut Engine) -> Picture {
    loop {
        match engine.step(&mut |_| ()).expect("a step") {
            Step::Working => (),
            Step::Picture(picture) => return *picture,
            Step::Done => panic!("no picture"),
        }
    }
}

fn radiance(picture: &Picture) -> &[[f32; 3]] {
    match &picture.pixels {
        Pixels::Radiance(radiance) => radiance,
        Pixels::Map(..) => panic!("a map"),
    }
}

/// Renders the pixels of the settings by a render job.
fn rendered(backend: &mut dyn Backend, settings: &Settings) -> Vec<[f32; 3]> {
    rendered_of(OsStr::new("cornell"), backend, settings)
}

fn rendered_of(scene: &OsStr, backend: &mut dyn Backend, settings: &Settings) -> Vec<[f32; 3]> {
    rendered_with(load(scene).expect("a scene"), backend, settings)
}

fn rendered_with(loaded: LoadedScene, backend: &mut dyn Backend, settings: &Settings) -> Vec<[f32; 3]> {
    rendered_as(loaded, backend, settings, AovSelection::default()).beauty
}

/// Renders the settings with additional images.
fn rendered_as(
    mut loaded: LoadedScene,
    backend: &mut dyn Backend,
    settings: &Settings,
    aovs: AovSelection,
) -> RenderOutput {
    if let Some(seconds) = settings.seconds {
        loaded.show(seconds, None).expect("it moves");
    }
    loaded.light(None);
    let camera = match &settings.standpoint {
        Standpoint::AsGiven => loaded.default_view().expect("a view").camera,
        Standpoint::Camera(index) => loaded.camera(*index).expect("a camera"),
        Standpoint::Placed(rounded) => rounded.camera().expect("a camera"),
    };
    let job = RenderJob {
        shard: None,
        scene: &loaded.scene,
        moment: loaded.moment.as_ref(),
        camera,
        system: settings.system.clone(),
        refresh: Refresh::All,
        frame: settings.frame.clone(),
        aovs,
        before: None,
        needs: aovs.needs(&loaded.scene, settings.frame.workload()),
        repetitions: 0,
    };
    let (mut kept, mut progress) = (KeptScene::default(), |_: Progress<'_>| ControlFlow::Continue(()));
    backend.render(&job, &mut kept, &mut progress).expect("a picture")
}

#[test]
fn pictures_are_those_of_a_render_after_every_change() {
    let mut backend = open(&VALIDATED).expect("a device");
    let mut settings = settings();
    let mut engine = engine(&settings);
    let mut seen: Vec<Vec<[f32; 3]>> = Vec::new();
    let mut check = |engine: &mut Engine, settings: &Settings, what: &str| {
        engine.apply(settings.clone());
        let picture = finished(engine);
        let expected = rendered(backend.as_mut(), settings);
        assert!(radiance(&picture) == expected, "{what}: another picture than a render");
        assert_eq!(
            (picture.samples, [picture.width, picture.height]),
            (settings.frame.spp, [33, 20]),
            "{what}"
        );
        seen.push(expected);
    };
    check(&mut engine, &settings, "at first");
    let placed = Rounded { eye: "0.5,1.25,3".into(), target: "0,1,0".into(), fov: "50".into(), lens: None };
    settings.standpoint = Standpoint::Placed(placed);
    check(&mut engine, &settings, "another camera");
    settings.frame.seed = 8;
    check(&mut engine, &settings, "another seed");
    settings.system = system("bvh");
    check(&mut engine, &settings, "another system");
    settings.frame.integrator = integrator("raycast");
    check(&mut engine, &settings, "another integrator");
    // While something moves there are fewer pixels, afterwards all of them.
    settings.moving = true;
    engine.apply(settings.clone());
    let preview = first(&mut engine);
    assert!(preview.width < 33 && preview.settings.moving && !preview.is_finished());
    // A small picture is fast, so that all pixels come back.
    assert!(finished(&mut engine).settings.moving);
    settings.moving = false;
    check(&mut engine, &settings, "after something moved");
    assert!(seen[0] != seen[1] && seen[1] != seen[2] && seen[3] != seen[4], "changes that can be seen");
    assert!(seen[2] == seen[3] && seen[4] == seen[5], "and such that cannot");
}

/// Checks a rig and a simulation, through an exact system and one that is not, at times and at rest in
/// between.
#[test]
fn a_scene_that_moves_is_posed_on_the_device_and_is_that_of_a_render_at_any_time() {
    let mut backend = open(&VALIDATED).expect("a device");
    for (scene, last) in [("walker:8k", "mmrt"), ("cloth-ball:1k", "bvh")] {
        let scene = OsStr::new(scene);
        let mut settings = settings();
        settings.frame.spp = 1;
        settings.system = system("bvh");
        let mut engine = engine_of(scene, &settings);
        let mut seen: Vec<Vec<[f32; 3]>> = Vec::new();
        for (step, seconds) in
            [None, Some(0.7), Some(0.25), Some(0.7), None, Some(0.25)].into_iter().enumerate()
        {
            settings.seconds = seconds;
            if step == 3 {
                settings.system = system(last);
            }
            engine.apply(settings.clone());
            let (picture, told) = told(&mut engine);
            let expected = rendered_of(scene, backend.as_mut(), &settings);
            assert!(
                radiance(&picture) == expected,
                "{scene:?} at {seconds:?}: another picture than a render"
            );
            let is_uploaded = told.iter().any(|text| text == "scene to the device");
            // From one time to the next everything stays except the moving parts.
            assert_eq!(is_uploaded, !matches!(step, 2 | 3), "{scene:?} at {seconds:?}: {told:?}");
            assert!(step != 2 || told.is_empty(), "{scene:?} at {seconds:?}: {told:?}");
            seen.push(expected);
        }
        assert!(seen[0] != seen[1] && seen[1] != seen[2] && seen[2] != seen[0], "{scene:?}: it moves");
        assert!(
            last != "bvh" || (seen[1] == seen[3] && seen[0] == seen[4] && seen[2] == seen[5]),
            "{scene:?}"
        );
    }
}

/// Checks numbered files, whose triangles differ at every time: they are posed and uploaded anew.
#[test]
fn numbered_files_are_those_of_a_render_at_any_time() {
    let folder = tempfile::tempdir().expect("a folder");
    for number in 0..3 {
        let corners =
            |index: usize| format!("v {} 0 0\nv {} 1 0\nv {} 0 1\n", index, index + number, index + 1);
        let faces = |index: usize| format!("f {} {} {}\n", 3 * index + 1, 3 * index + 2, 3 * index + 3);
        let text: String = (0..1 + number).map(corners).chain((0..1 + number).map(faces)).collect();
        std::fs::write(folder.path().join(format!("s.{number}.obj")), text).expect("a file");
    }
    let scene = folder.path().join("s.#.obj");
    let mut backend = open(&VALIDATED).expect("a device");
    let mut settings = settings();
    settings.system = system("bvh");
    let mut engine = engine_of(scene.as_os_str(), &settings);
    for frame in [None, Some(2.0), Some(1.0), None, Some(2.0)] {
        settings.seconds = frame.map(|frame: f64| frame / 24.0);
        engine.apply(settings.clone());
        let picture = finished(&mut engine);
        let expected = rendered_of(scene.as_os_str(), backend.as_mut(), &settings);
        assert!(radiance(&picture) == expected, "at {frame:?}");
    }
}

/// Returns the Cornell box with its lamp hidden at rest, by a scale of 0, and shown from second 1 to 2.
fn blinking() -> LoadedScene {
    let mut loaded = load(OsStr::new("cornell")).expect("a scene");
    let scene = &mut loaded.scene;
    let is_lamp = |mesh: usize| scene.materials[scene.meshes[mesh].material].emission != [0.0; 3];
    let (mut nodes, mut placements, mut channels) = (Vec::new(), Vec::new(), Vec::new());
    for (node, instance) in scene.instances.iter_mut().enumerate() {
        let is_lamp = is_lamp(instance.mesh);
        if is_lamp {
            let values = ChannelValues::Scale(vec![[0.0; 3], [1.0; 3], [0.0; 3]]);
            let times = vec![0.0, 1.0, 2.0];
            channels.push(Channel { node, interpolation: Interpolation::Step, times, values });
        }
        let transform = NodeTransform::Parts {
            translation: DVec3::ZERO,
            rotation: DQuat::IDENTITY,
            scale: if is_lamp { DVec3::ZERO } else { DVec3::ONE },
        };
        nodes.push(RigNode { name: "node".to_owned(), parent: None, transform });
        placements.push(Placement { node, node_from_mesh: instance.world_from_mesh });
    }
    let clip = Clip { name: "blink".to_owned(), duration: 2.0, channels };
    scene.animation.clips = vec![clip.name.clone()];
    scene.animation.rig = Rig { nodes, placements, clips: vec![clip], ..Rig::default() };
    loaded.scene = loaded.scene.at(&Moment::default()).expect("a rig");
    loaded
}

/// Checks that a sky stands in for missing light at the time that is shown, as for a render.
#[test]
fn the_sky_comes_and_goes_as_in_renders() {
    let mut backend = open(&VALIDATED).expect("a device");
    let mut settings = settings();
    let mut engine = engine_with(blinking(), &settings);
    let mut means = Vec::new();
    for seconds in [None, Some(1.0), Some(0.5), Some(1.5), None] {
        settings.seconds = seconds;
        engine.apply(settings.clone());
        let picture = finished(&mut engine);
        let expected = rendered_with(blinking(), &mut *backend, &settings);
        assert!(radiance(&picture) == expected, "{seconds:?}");
        means.push(expected.as_flattened().iter().sum::<f32>());
    }
    assert!(means[1] != means[0] && means[0] == means[2] && means[1] == means[3], "{means:?}");
}

#[test]
fn exact_systems_have_no_difference_and_work_is_counted() {
    let mut settings = settings();
    settings.frame.integrator = integrator("raycast");
    settings.shown = Shown::Difference;
    let mut engine = engine(&settings);
    let picture = finished(&mut engine);
    let Pixels::Map(colours, legend) = &picture.pixels else { panic!("a map") };
    assert_eq!((colours.len(), legend.most), (33 * 20, 0.0));
    for shown in [Shown::Cells, Shown::Tests] {
        settings.shown = shown;
        engine.apply(settings.clone());
        let picture = finished(&mut engine);
        let Pixels::Map(_, legend) = &picture.pixels else { panic!("a map") };
        assert!(legend.most >= 1.0 && legend.mean > 0.0, "{shown:?}: {legend:?}");
    }
}

/// Checks a stack of clear sheets before the eye, two more than a ray may pass: the picture tells how many
/// rays were cut.
#[test]
fn cut_rays_are_told_when_refinement_has_ended() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("sheets.obj");
    let mut text = String::from("mtllib sheets.mtl\nusemtl clear\n");
    // Rays pass at most 4,096.
    for sheet in 0..4098_u32 {
        let z = f64::from(sheet) / 4096.0;
        text += &format!("v -9 -9 {z}\nv 9 -9 {z}\nv 0 9 {z}\nf -3 -2 -1\n");
    }
    std::fs::write(&path, text).expect("a scene");
    std::fs::write(folder.path().join("sheets.mtl"), "newmtl clear\nKd 0 0 0\nd 0.000001\n")
        .expect("materials");
    let mut settings = settings();
    let camera =
        Rounded { eye: "0,0,4".to_owned(), target: "0,0,0".to_owned(), fov: "10".to_owned(), lens: None };
    settings.standpoint = Standpoint::Placed(camera);
    settings.system = system("brute-force");
    let direct = integrator("path").with("bounces", 1).expect("valid");
    settings.frame = Frame { integrator: direct, width: 2, height: 1, spp: 1, ..settings.frame };
    let picture = finished(&mut engine_of(path.as_os_str(), &settings));
    assert!(picture.cut_rays >= 2, "{}", picture.cut_rays);
    settings.frame.integrator = integrator("raycast");
    assert_eq!(finished(&mut engine_of(path.as_os_str(), &settings)).cut_rays, 0);
}

#[test]
fn a_failure_is_told_and_the_next_settings_go_on() {
    let good = settings();
    let mut bad = good.clone();
    bad.system.options = bad.system.options.with("grid", 0);
    let (sender, updates) = channel();
    let worker = Worker::start(
        move || engine(&bad),
        move |update| {
            // The receiver may be gone, if the test has failed.
            _ = sender.send(update);
        },
    )
    .expect("a thread");
    let next = || updates.recv_timeout(Duration::from_secs(300)).expect("an update");
    loop {
        match next() {
            Update::Failed(error) => break assert!(error.to_string().contains("grid"), "{error}"),
            Update::Status(_) => (),
            Update::Picture(_) | Update::Answered(..) | Update::Read(..) => panic!("nobody asked for it"),
        }
    }
    worker.want(good);
    loop {
        match next() {
            Update::Picture(picture) if picture.is_finished() => break,
            Update::Picture(_) | Update::Status(_) => (),
            Update::Failed(error) => panic!("{error}"),
            Update::Answered(..) | Update::Read(..) => panic!("nobody asked for it"),
        }
    }
}
