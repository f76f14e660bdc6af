//! Tests of a window without its drawing: other scenes, picks, cameras, and pictures while something moves.

use std::ffi::OsStr;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use glam::DVec3;
use rasray_experiment::{Frame, open};
use rasray_scene::default_view::{bounds, default_camera};
use rasray_scene_source::load;
use rasray_systems::SYSTEMS;
use rasray_viewer::{
    Answer, Failure, Opened, Opening, Picture, Pixels, Session, Standpoint, Step, Viewer, camera_names,
};

use crate::{
    VALIDATED, engine_for, engine_of, engine_with, finished, first, integrator, radiance, rendered_of,
    rendered_with, settings, source_of, system,
};

/// Advice of the opening function for a scene that cannot be opened.
const HELP: &str = "name another file";

/// Opens a scene, and returns the state that its session begins with, with the settings of these tests.
fn opened(scene: &OsStr) -> Result<Opened, Failure> {
    let loaded =
        load(scene).map_err(|error| Failure { message: error.to_string(), help: HELP.to_owned() })?;
    let opening = Opening {
        scene: scene.to_owned(),
        camera_words: Vec::new(),
        camera_is_default: loaded.scene.cameras.is_empty(),
        cameras: camera_names(&loaded),
        default_camera: default_camera(&loaded.scene),
        time_words: Vec::new(),
        other_words: Vec::new(),
        settings: settings(),
        tone: Default::default(),
        duration: loaded.scene.animation.duration.into(),
        bounds: bounds(&loaded.scene).unwrap_or_default(),
        output: "test.###.png".into(),
    };
    Ok(Opened { opening, source: source_of(loaded) })
}

/// Viewer that runs as in a window, with its clock.
struct Running {
    viewer: Viewer,
    woken: Receiver<()>,
    now: f64,
}

impl Running {
    fn of(scene: &str) -> Self {
        let Opened { opening, source } = opened(OsStr::new(scene)).expect("a scene");
        let first = opening.settings.clone();
        let (sender, woken) = channel();
        let viewer = Viewer::start(
            Session::new(opening, Failure::without_help),
            move || engine_for(source, &first),
            Arc::new(opened),
            // The receiver may be gone, if the test has failed.
            move || _ = sender.send(()),
        );
        Self { viewer: viewer.expect("threads"), woken, now: 0.0 }
    }

    fn session(&mut self) -> &mut Session {
        &mut self.viewer.session
    }

    /// Runs as the window does, until `is_so` holds.
    fn until(&mut self, what: &str, is_so: impl Fn(&Session) -> bool) {
        for _ in 0..10_000 {
            self.viewer.take_updates(self.now);
            self.viewer.ask(self.now).expect("threads");
            if is_so(&self.viewer.session) {
                return;
            }
            self.now += 0.1;
            // Changes by the clock alone wake nobody, so the wait is limited.
            _ = self.woken.recv_timeout(Duration::from_millis(100));
        }
        panic!("{what}: {:?}", self.viewer.session.failure());
    }

    /// Runs until the picture is complete.
    fn finish(&mut self) -> &Picture {
        self.until("a whole picture", |session| {
            session.picture.as_ref().is_some_and(|picture| picture.is_finished())
        });
        self.viewer.session.picture.as_ref().expect("a picture")
    }
}

#[test]
fn a_dropped_file_is_shown_and_one_that_cannot_be_read_leaves_the_scene_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("a file");
        path
    };
    let wall = write("wall.obj", "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n");
    let broken = write("broken.glb", "no glTF");
    let mut running = Running::of("cornell");
    let before = radiance(running.finish()).to_vec();

    for (path, word) in [(broken, "broken.glb"), (folder.path().join("missing.obj"), "missing.obj")] {
        running.session().drop_file(path);
        running.until("an error", |session| session.not_opened().is_some());
        let failure = running.session().not_opened().expect("an error");
        assert!(failure.message.contains(word) && failure.help == HELP, "{failure:?}");
        assert_eq!(running.session().scene_name(), "cornell");
        assert!(radiance(running.finish()) == before, "the picture stays");
    }

    running.session().drop_file(wall.clone());
    running.until("the new scene", |session| session.scene_name().ends_with("wall.obj"));
    assert!(running.session().not_opened().is_none());
    let picture = running.finish();
    let mut backend = open(&VALIDATED).expect("a device");
    let expected = rendered_of(wall.as_os_str(), backend.as_mut(), &settings());
    assert!(radiance(picture) == expected && expected != before, "that of a render of the file");
    assert_eq!(picture.settings.scene, 1);

    running.session().open("walker:8k".into());
    running.until("a built-in one", |session| session.scene_name() == "walker:8k");
    assert!(running.session().playback.can_play(), "what moves it came with it");
    running.finish();
}

#[test]
fn what_is_picked_is_what_exact_systems_agree_on() {
    let mut running = Running::of("cornell");
    running.finish();
    for place in [[0.5, 0.25], [0.45, 0.85]] {
        running.session().pick(place);
        running.until("an answer", |session| session.picked().is_some_and(|picked| picked.awaited == 0));
        let own = running.session().picked().and_then(|picked| picked.hit()).expect("a hit").clone();
        let triangle = own.triangle.clone().expect("bricks keep it");
        assert!(own.depth > 0.0 && own.depth <= own.distance && !triangle.material.is_empty(), "{own:?}");
        running.session().pick_through_all();
        running.until("all answers", |session| session.picked().is_some_and(|picked| picked.awaited == 0));
        let picked = running.session().picked().expect("a pick").clone();
        for Answer { system, hit } in &picked.answers {
            let hit = hit.as_ref().unwrap_or_else(|error| panic!("{system}: {error}")).as_ref();
            let hit = hit.unwrap_or_else(|| panic!("{system}: nothing"));
            assert!((hit.depth - own.depth).abs() < 0.05 * own.depth, "{system}: {hit:?}");
            if ["bricks", "bvh", "grid", "driver-rt", "brute-force"]
                .iter()
                .any(|exact| system.starts_with(exact))
            {
                assert_eq!(hit, &own, "{system}");
            }
        }
        assert_eq!(picked.answers.len(), SYSTEMS.len());
        // The point lies on the ray through the picked place.
        let seen = picked.pick.camera.world_from_camera.inverse().transform_point3(own.point);
        let [half_width, half_height] = picked.pick.camera.half_extents(33, 20);
        let share = [0.5 - 0.5 * seen.x / seen.z / half_width, 0.5 + 0.5 * seen.y / seen.z / half_height];
        assert!((0..2).all(|axis| (share[axis] - f64::from(place[axis])).abs() < 1.0e-4), "{share:?}");
    }
}

#[test]
fn cameras_of_the_scene_are_looked_through() {
    let mut backend = open(&VALIDATED).expect("a device");
    let mut loaded = load(OsStr::new("cornell")).expect("a scene");
    let one = default_camera(&loaded.scene);
    let mut other = one.clone();
    other.world_from_camera.translation += DVec3::new(0.2, 0.1, 0.0);
    loaded.scene.cameras = vec![one, other];
    let mut settings = settings();
    let mut engine = engine_with(loaded.clone(), &settings);
    let mut seen = Vec::new();
    for standpoint in [Standpoint::AsGiven, Standpoint::Camera(1), Standpoint::Camera(0)] {
        settings.standpoint = standpoint;
        engine.apply(settings.clone());
        let picture = finished(&mut engine);
        let expected = rendered_with(loaded.clone(), backend.as_mut(), &settings);
        assert!(radiance(&picture) == expected, "{:?}", settings.standpoint);
        seen.push(expected);
    }
    assert!(seen[0] == seen[2] && seen[0] != seen[1]);
    settings.standpoint = Standpoint::Camera(2);
    engine.apply(settings);
    let error = match engine.step(&mut |_| ()) {
        Ok(Step::Working | Step::Picture(_) | Step::Done) => panic!("a picture from nowhere"),
        Err(error) => error,
    };
    assert!(error.to_string().contains("no camera 2"), "{error}");
}

/// Checks settings that change before every step, like those of a scene that plays on a slow device.
#[test]
fn pictures_come_however_often_settings_change() {
    let mut settings = settings();
    settings.frame.integrator = integrator("path");
    settings.moving = true;
    let mut engine = engine_of(OsStr::new("cornell"), &settings);
    let mut pictures = 0;
    for seed in 0..4 {
        settings.frame.seed = seed;
        engine.apply(settings.clone());
        if let Step::Picture(picture) = engine.step(&mut |_| ()).expect("a step") {
            assert_eq!(picture.settings.frame.seed, seed);
            pictures += 1;
        }
    }
    assert_eq!(pictures, 4);
}

/// Returns the mean absolute error of values as they are shown.
fn error_as_shown(picture: &[[f32; 3]], truth: &[[f32; 3]]) -> f64 {
    let bytes = |picture: &[[f32; 3]]| Pixels::Radiance(picture.to_vec()).bytes(0.0);
    let (picture, truth) = (bytes(picture), bytes(truth));
    let apart = picture.iter().zip(&truth).map(|(one, other)| f64::from(one.abs_diff(*other)));
    apart.sum::<f64>() / truth.len() as f64
}

/// Compares with converged direct light: a preview has half of the sides, and is much nearer to that light
/// than the sample it is made of.
#[test]
fn a_preview_can_be_read() {
    let mut backend = open(&VALIDATED).expect("a device");
    for (scene, share) in [("cornell", 0.75), ("walker:8k", 0.5)] {
        let scene = OsStr::new(scene);
        let mut settings = settings();
        settings.system = system("bvh");
        settings.frame.integrator = integrator("path");
        (settings.frame.width, settings.frame.height, settings.frame.spp) = (320, 180, 1);
        settings.moving = true;
        let preview = first(&mut engine_of(scene, &settings));
        assert_eq!([preview.width, preview.height], [160, 90]);
        let direct = integrator("path").with("bounces", 1).expect("valid");
        settings.frame = Frame { integrator: direct, width: 160, height: 90, ..settings.frame };
        let sample = rendered_of(scene, backend.as_mut(), &settings);
        settings.frame.spp = 64;
        let truth = rendered_of(scene, backend.as_mut(), &settings);
        let (noisy, smooth) = (error_as_shown(&sample, &truth), error_as_shown(radiance(&preview), &truth));
        println!("{scene:?}: {noisy:.1} of 255 with a sample, {smooth:.1} with the preview");
        assert!(smooth < share * noisy, "{scene:?}: {noisy} with a sample, {smooth} with the preview");
    }
}
