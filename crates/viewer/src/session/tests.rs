//! Tests of sessions, without a device or a window.

use super::*;
use crate::camera_control::Side;
use crate::picked::{Answer, PickedHit};
use crate::picture::Pixels;
use crate::settings::tests::some;
use glam::DVec3;
use rasray_experiment::OptionValues;
use rasray_scene::default_view::camera_looking_at;
use rasray_systems::{Preset, SYSTEMS};

fn session() -> Session {
    Session::new(opening("a b.glb"), Failure::without_help)
}

fn opening(scene: &str) -> Opening {
    Opening {
        scene: scene.into(),
        camera_words: vec!["--camera".to_owned(), "door".to_owned()],
        camera_is_default: false,
        cameras: vec![(0, "door".to_owned()), (2, "2".to_owned())],
        default_camera: camera_looking_at("default", DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 0.8),
        time_words: vec!["--clip".to_owned(), "walk".to_owned()],
        other_words: vec!["--alpha".to_owned(), "off".to_owned()],
        settings: some(),
        tone: Tone::default(),
        duration: 2.0,
        bounds: (DVec3::splat(-1.0), DVec3::splat(1.0)),
        output: PathBuf::from("out/a.###.png"),
    }
}

fn take(session: &mut Session, update: Update) {
    assert!(session.take(update, 0.0).is_none(), "no other scene");
}

fn picture(session: &mut Session) {
    let settings = session.asked.clone().expect("settings");
    take(
        session,
        Update::Picture(Box::new(Picture {
            width: 1,
            height: 1,
            pixels: Pixels::Radiance(vec![[0.0; 3]]),
            settings,
            samples: 1,
            denoised: None,
            cut_rays: 0,
            camera: camera_looking_at("", DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO, 0.7),
            sample_ms: 1.0,
            passes: Vec::new(),
            memory: Default::default(),
            resolved: Default::default(),
        })),
    );
}

#[test]
fn settings_are_asked_for_once() {
    // A system that nobody named stays too, and its structure exists already.
    let mut opening = opening("a.glb");
    opening.settings.system.chosen = Some("the fastest".to_owned());
    let first = opening.settings.clone();
    assert_eq!(Session::new(opening, Failure::without_help).changed_settings(0.0), Some(first));
    let mut session = session();
    assert_eq!(session.changed_settings(0.0), Some(some()));
    assert_eq!(session.changed_settings(0.1), None);
    session.shown = Shown::Tests;
    assert!(session.changed_settings(0.2).is_some_and(|settings| settings.shown == Shown::Tests));
}

#[test]
fn a_lens_is_part_of_the_camera_and_of_the_command_line() {
    let mut session = session();
    session.changed_settings(0.0);
    assert_eq!(session.lens(), None);
    picture(&mut session);
    assert_eq!(session.lens(), Some(Lens { aperture: 0.0, focus: 4.0 }));
    assert!(!session.is_camera_moved(), "a look at it moves nothing");
    session.set_lens(Lens { aperture: 0.05, focus: 3.5 }, 1.0);
    let settings = session.changed_settings(2.0).expect("changed");
    let line = session.command_line(&settings, Path::new("o.png"));
    assert!(line.contains("--aperture 0.05 --focus 3.5 "), "{line}");
    session.reset_camera();
    assert_eq!(session.lens().map(|lens| lens.aperture), Some(0.0));
}

#[test]
fn a_moved_camera_moves_for_a_while_and_then_rests() {
    let mut session = session();
    session.changed_settings(0.0);
    assert!(session.move_camera(0.0).is_none(), "nothing says where the camera is");
    picture(&mut session);
    session.move_camera(1.0).expect("a camera").zoom(1.0);
    let moving = session.changed_settings(1.0).expect("changed");
    assert!(moving.moving && session.wakes_at().is_some_and(|at| at > 1.0));
    let resting = session.changed_settings(1.0 + REST).expect("changed");
    assert_eq!(Settings { moving: true, ..resting.clone() }, moving);
    assert_eq!((resting.moving, session.wakes_at()), (false, None));
    let line = session.command_line(&resting, Path::new("p.png"));
    assert!(line.contains(" --eye 0,0,3.6 --target 0,0,0 --fov "), "{line}");
    session.reset_camera();
    assert_eq!(session.changed_settings(2.0), Some(some()));
}

#[test]
fn a_camera_that_was_placed_by_where_everything_is_stays_when_the_time_changes() {
    for follows in [false, true] {
        let mut session = session();
        session.opening.camera_is_default = follows;
        session.changed_settings(0.0);
        picture(&mut session);
        assert!(session.changed_settings(0.1).is_none() && !session.is_camera_moved());
        session.seek(0.5, 0.2);
        let later = session.changed_settings(0.2).expect("changed");
        assert_eq!(matches!(later.standpoint, Standpoint::Placed(_)), follows);
        session.reset_camera();
        session.changed_settings(0.3);
        assert!(!session.is_camera_moved(), "as the command line has it at that time");
    }
}

#[test]
fn options_that_are_not_valid_change_nothing_and_say_why() {
    let mut session = session();
    session.changed_settings(0.0);
    session.system.options.set("grid", 9);
    assert!(session.changed_settings(0.1).is_some());
    session.system.options.set("grid", 0);
    assert_eq!(session.changed_settings(0.2), None);
    let failure = session.failure().cloned().expect("a failure");
    assert!(failure.message.contains("grid"), "{failure:?}");
    session.system.options.set("grid", 9);
    assert!(session.changed_settings(0.3).is_none() && session.failure().is_none());
}

#[test]
fn a_failure_keeps_the_last_picture() {
    let mut session = session();
    session.changed_settings(0.0);
    picture(&mut session);
    take(&mut session, Update::Failed(ViewerError::Moved));
    let expected = Failure::without_help(&ViewerError::Moved);
    assert_eq!((session.picture.is_some(), session.failure()), (true, Some(&expected)));
}

#[test]
fn the_command_line_names_everything() {
    let mut session = session();
    let mut settings = some();
    assert_eq!(
        session.command_line(&settings, Path::new("p.png")),
        "rasray render 'a b.glb' --camera door --size 40x30 --spp 4 --integrator path --bounces 3 --seed 1 \
         --sampler sobol --system bricks --preset robust --alpha off --output p.png"
    );
    settings.seconds = Some(0.25);
    session.tone = Tone { curve: ToneCurve::Agx, exposure: -1.5 };
    let line = session.command_line(&settings, Path::new("p.png"));
    assert!(
        line.contains(" --time 0.25 --clip walk ") && line.contains(" --exposure -1.5 --tone agx "),
        "{line}"
    );
}

#[test]
fn noise_is_taken_out_of_pictures_alone() {
    let mut session = session();
    session.changed_settings(0.0);
    session.denoised = true;
    let settings = session.changed_settings(0.1).expect("changed");
    let line = session.command_line(&settings, Path::new("p.png"));
    assert!(settings.denoised && line.ends_with(" --alpha off --denoise --output p.png"), "{line}");
    for shown in Shown::ALL {
        session.shown = shown;
        session.changed_settings(0.2);
        let denoised = session.asked.as_ref().map(|asked| asked.denoised);
        assert_eq!(denoised, Some(shown == Shown::Picture), "{shown:?}");
    }
}

#[test]
fn pictures_are_numbered_and_never_written_over() {
    let session = session();
    let taken = [PathBuf::from("out/a.001.png"), PathBuf::from("out/a.002.png")];
    let place = session.place_for_picture(|place| taken.contains(&place.to_owned()));
    assert_eq!(place, PathBuf::from("out/a.003.png"));
}

/// Answers the last pick.
fn answer(session: &mut Session, system: &str, hit: Option<PickedHit>) {
    let number = session.picked().expect("a pick").pick.number;
    take(session, Update::Answered(number, Answer { system: system.to_owned(), hit: Ok(hit) }));
}

#[test]
fn cameras_of_the_scene_are_named_by_the_command_line() {
    let mut session = session();
    session.changed_settings(0.0);
    assert_eq!(session.cameras().collect::<Vec<_>>(), ["door", "2"]);
    for (place, words) in [(0, " --camera door --size"), (1, " --camera 2 --size")] {
        session.choose_camera(place);
        assert_eq!(session.chosen_camera(), Some(place));
        let settings = session.changed_settings(1.0).expect("changed");
        let line = session.command_line(&settings, Path::new("o.png"));
        assert!(line.contains(words), "{line}");
        assert!(!settings.moving && !session.is_camera_moved(), "it moves with the scene");
    }
    session.choose_default_camera();
    let settings = session.changed_settings(2.0).expect("changed");
    let line = session.command_line(&settings, Path::new("o.png"));
    assert!(line.contains(" --eye 0,0,5 --target 0,0,0 --fov "), "{line}");
    session.choose_camera(7);
    assert!(session.is_camera_moved(), "there is none");
}

#[test]
fn everything_and_sides_are_seen_by_a_moved_camera() {
    let mut session = session();
    session.changed_settings(0.0);
    session.frame_all(0.0);
    session.view_along(Side::Top, 0.0);
    assert!(!session.is_camera_moved(), "nothing says where the camera is");
    picture(&mut session);
    session.view_along(Side::Right, 1.0);
    let line = |session: &mut Session| {
        let settings = session.changed_settings(1.0).expect("changed");
        session.command_line(&settings, Path::new("o.png"))
    };
    assert!(line(&mut session).contains(" --eye 4,0,0 --target 0,0,0 "));
    session.frame_all(1.0);
    let all = line(&mut session);
    assert!(all.contains(" --target 0,0,0 ") && !all.contains(" --eye 4,0,0 "), "{all}");
}

#[test]
fn what_is_picked_is_asked_once_answered_and_turned_to() {
    let mut session = session();
    session.changed_settings(0.0);
    session.pick([0.5, 0.5]);
    assert!(session.asked_pick().is_none() && session.picked().is_none(), "nothing is shown");
    picture(&mut session);
    session.pick([0.25, 0.5]);
    let pick = session.asked_pick().expect("a pick");
    assert_eq!((pick.place, pick.size, pick.systems.len()), ([10.0, 15.0], [40, 30], 1));
    assert!(session.asked_pick().is_none(), "once");
    session.pick_through_all();
    assert!(session.asked_pick().is_none(), "the own system has not answered yet");
    let point = DVec3::new(0.5, 0.0, 1.0);
    answer(
        &mut session,
        "bricks robust",
        Some(PickedHit { point, depth: 3.0, distance: 3.1, triangle: None }),
    );
    session.pick_through_all();
    let pick = session.asked_pick().expect("a pick");
    assert_eq!(pick.systems.len(), SYSTEMS.len() - 1, "all but the own");
    answer(&mut session, "mmrt robust", None);
    let picked = session.picked().expect("a pick");
    assert_eq!((picked.answers.len(), picked.awaited), (2, SYSTEMS.len() - 2));
    let late = Update::Answered(0, Answer { system: "late".to_owned(), hit: Ok(None) });
    take(&mut session, late);
    assert_eq!(session.picked().expect("a pick").answers.len(), 2, "of an earlier pick");

    session.turn_to_picked(1.0);
    let settings = session.changed_settings(1.0).expect("changed");
    let line = session.command_line(&settings, Path::new("o.png"));
    assert!(line.contains(" --target 0.5,0,1 "), "{line}");
    session.set_lens(Lens { aperture: 0.1, focus: 9.0 }, 1.0);
    session.focus_on_picked(1.0);
    assert_eq!(session.lens(), Some(Lens { aperture: 0.1, focus: 3.0 }));
    session.unpick();
    assert!(session.picked().is_none());
}

fn read(scene: &str) -> Box<Opened> {
    let loaded = rasray_scene_source::load("cornell".as_ref()).expect("a scene");
    let camera = Box::new(rasray_scene_source::LoadedScene::default_view);
    let source = SceneSource { loaded, clip: None, needs_all: false, camera };
    Box::new(Opened { opening: opening(scene), source })
}

#[test]
fn another_scene_keeps_what_was_chosen_and_one_that_cannot_be_read_changes_nothing() {
    let mut session = session();
    session.changed_settings(0.0);
    picture(&mut session);
    session.frame.spp = 9;
    session.system.options.set("grid", 8);
    session.move_camera(0.0).expect("a camera").zoom(1.0);
    let before = session.changed_settings(0.0).expect("changed");
    session.open("missing.glb".into());
    let (number, scene) = session.asked_scene().expect("a request");
    assert_eq!((scene, session.reading()), ("missing.glb".into(), Some("missing.glb")));
    let failure = Failure { message: "missing.glb: no such file".to_owned(), help: "name one".to_owned() };
    take(&mut session, Update::Read(number, Err(failure.clone())));
    assert_eq!((session.not_opened(), session.reading()), (Some(&failure), None));
    assert!(session.picture.is_some() && session.failure().is_none() && session.scene_name() == "a b.glb");
    assert!(session.changed_settings(0.1).is_none(), "the old scene stays");
    session.dismiss();
    assert!(session.not_opened().is_none());

    session.open("other.glb".into());
    let (old, _) = session.asked_scene().expect("a request");
    session.open("newest.glb".into());
    let (newest, _) = session.asked_scene().expect("a request");
    take(&mut session, Update::Read(old, Ok(read("other.glb"))));
    assert_eq!(session.scene_name(), "a b.glb", "no longer wanted");
    let (_, settings) = session.take(Update::Read(newest, Ok(read("newest.glb"))), 1.0).expect("a scene");
    assert_eq!(session.scene_name(), "newest.glb");
    assert_eq!((settings.frame.spp, settings.scene, &settings.standpoint), (9, 1, &Standpoint::AsGiven));
    assert_eq!(settings.system, before.system, "what was set by hand stays");
    assert!(session.picture.is_none() && !session.is_camera_moved());
    // The engine may still have made a picture of the scene before.
    let late = session.asked.replace(before);
    picture(&mut session);
    assert!(session.picture.is_none());
    session.asked = late;
    picture(&mut session);
    assert!(session.picture.is_some());
}

#[test]
fn a_structure_that_nobody_chose_is_chosen_anew_for_another_scene() {
    let mut session = session();
    session.changed_settings(0.0);
    session.open("other.glb".into());
    let (number, _) = session.asked_scene().expect("a request");
    let mut other = read("other.glb");
    other.opening.settings.system = SystemConfig::new(&SYSTEMS[1], Preset::Robust, OptionValues::default());
    let (_, settings) = session.take(Update::Read(number, Ok(other)), 0.0).expect("a scene");
    assert_eq!(settings.system.system, &SYSTEMS[1]);
}

#[test]
fn cameras_are_named_as_the_command_line_finds_them() {
    let mut loaded = rasray_scene_source::load("cornell".as_ref()).expect("a scene");
    let camera = |name: &str| camera_looking_at(name, DVec3::Z, DVec3::ZERO, 0.5);
    loaded.scene.cameras = ["door", "", "door", "1", "0"].map(camera).to_vec();
    let names: Vec<_> = camera_names(&loaded).into_iter().collect();
    // The second camera is found neither by its name, which it lacks, nor by its index, which is another
    // camera's name.
    let expected = [(0, "door"), (2, "2"), (3, "1"), (4, "0")];
    assert_eq!(names, expected.map(|(index, word)| (index, word.to_owned())));
    for (index, word) in names {
        assert_eq!(loaded.named_view(&word).expect("a camera").index, Some(index));
    }
}
