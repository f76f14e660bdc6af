//! What was chosen, and what came of it.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use glam::DVec3;

use crate::camera_control::CameraControl;
use crate::command_line::{frame_words, quoted, system_words};
use crate::option_controls::SystemChoice;
use crate::picture::Picture;
use crate::playback::Playback;
use crate::settings::{Settings, Standpoint};
use crate::worker::Update;
use rasray_experiment::{Frame, SystemConfig};
use rasray_scene::Lens;

/// Seconds after the last motion until the whole picture is made.
const REST: f64 = 0.2;

/// What a session begins with.
#[derive(Clone, Debug)]
pub struct Opening {
    /// The scene as it was named.
    pub scene: OsString,
    /// Words of the command line that put the camera where it is at first.
    pub camera_words: Vec<String>,
    /// Whether the camera is placed by where everything is at first: it stays there when the time changes.
    pub camera_is_default: bool,
    /// Words that say when the scene is shown are followed by these, such as those of a clip.
    pub time_words: Vec<String>,
    /// Words of the command line that stay as they are.
    pub other_words: Vec<String>,
    /// What is shown at first.
    pub settings: Settings,
    /// Stops of exposure.
    pub exposure: f32,
    /// Length of the longest clip, seconds.
    pub duration: f64,
    /// The least and greatest corner of the scene, world, metres.
    pub bounds: (DVec3, DVec3),
    /// Where pictures are saved: a run of # stands for a number.
    pub output: PathBuf,
}

/// A failure in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// What is wrong.
    pub message: String,
    /// What to do; may be empty.
    pub help: String,
}

/// What was chosen by hand, and the last picture.
pub struct Session {
    opening: Opening,
    /// The system and what is set of its options; it need not be valid.
    pub system: SystemChoice,
    /// The last valid configuration.
    config: SystemConfig,
    /// Integrator, samples, seed; its size is the picture's.
    pub frame: Frame,
    /// What is shown.
    pub shown: crate::settings::Shown,
    /// Stops of exposure.
    pub exposure: f32,
    /// The time.
    pub playback: Playback,
    /// The camera, where it was moved.
    control: Option<CameraControl>,
    /// Until when something moves, seconds.
    moving_until: f64,
    /// The settings that were asked for last.
    asked: Option<Settings>,
    /// The last complete picture.
    pub picture: Option<Box<Picture>>,
    /// How many pictures have come.
    pub pictures: u64,
    /// What takes long.
    pub status: Option<String>,
    /// Why there is no picture of the settings that were asked for.
    failed: Option<Failure>,
    /// Why options are not valid.
    invalid: Option<Failure>,
}

impl Session {
    /// Begins a session.
    pub fn new(opening: Opening) -> Self {
        let Settings { system, frame, shown, seconds, .. } = opening.settings.clone();
        Self {
            system: SystemChoice::new(&system),
            config: system,
            frame,
            shown,
            exposure: opening.exposure,
            playback: Playback::new(seconds, opening.duration),
            control: None,
            moving_until: f64::NEG_INFINITY,
            asked: None,
            picture: None,
            pictures: 0,
            status: Some("starting".to_owned()),
            failed: None,
            invalid: None,
            opening,
        }
    }

    /// The scene as it was named.
    pub fn scene_name(&self) -> String {
        self.opening.scene.to_string_lossy().into_owned()
    }

    /// Half the diagonal of the scene, metres.
    pub fn radius(&self) -> f64 {
        let (low, high) = self.opening.bounds;
        let radius = 0.5 * (high - low).length();
        if radius.is_finite() && radius > 0.0 { radius } else { 1.0 }
    }

    /// The camera, to be moved at `now` (seconds); nothing before the first picture says where it is.
    pub fn move_camera(&mut self, now: f64) -> Option<&mut CameraControl> {
        self.take_camera()?;
        self.moving_until = now + REST;
        self.control.as_mut()
    }

    /// The camera as it was moved, or else that of the last picture.
    fn camera(&self) -> Option<CameraControl> {
        if self.control.is_some() {
            return self.control.clone();
        }
        let picture = self.picture.as_ref()?;
        let camera = &picture.camera;
        let frame = &camera.world_from_camera;
        let (low, high) = self.opening.bounds;
        let forward = (-frame.matrix3.z_axis).normalize_or_zero();
        // Around the middle of the scene, or what is in front of a camera that has passed it.
        let ahead = (0.5 * (low + high) - frame.translation).dot(forward);
        let distance = ahead.max(0.2 * self.radius());
        Some(CameraControl::from_camera(camera, [picture.width, picture.height], distance))
    }

    /// Takes the camera from where the last picture was seen.
    fn take_camera(&mut self) -> Option<()> {
        self.control = Some(self.camera()?);
        Some(())
    }

    /// The lens of the camera, as [`CameraControl::lens`]; nothing before the first picture says where it is.
    pub fn lens(&self) -> Option<Lens> {
        self.camera().map(|camera| camera.lens())
    }

    /// Changes it at `now` (seconds).
    pub fn set_lens(&mut self, lens: Lens, now: f64) {
        if let Some(camera) = self.move_camera(now) {
            camera.set_lens(lens);
        }
    }

    /// Puts the camera back to where the command line had it.
    pub fn reset_camera(&mut self) {
        self.control = None;
    }

    /// Whether the camera was moved.
    pub fn is_camera_moved(&self) -> bool {
        self.control.is_some()
    }

    /// Goes to a time at `now` (seconds).
    pub fn seek(&mut self, seconds: f64, now: f64) {
        self.playback.seek(seconds);
        self.moving_until = now + REST;
    }

    /// The settings at `now` (seconds), where they are others than those asked for before. Options that are not valid are
    /// a failure, and the settings stay what they were.
    pub fn changed_settings(&mut self, now: f64) -> Option<Settings> {
        self.invalid = None;
        match self.system.config() {
            Ok(config) => self.config = config,
            Err(error) => {
                let help = error.help().to_owned();
                self.invalid = Some(Failure { message: error.to_string(), help });
            }
        }
        let seconds = self.playback.shown();
        let is_elsewhen = self.asked.as_ref().is_some_and(|asked| asked.seconds != seconds);
        if self.opening.camera_is_default && is_elsewhen {
            // Else it would jump about with what moves. Without a picture so far there is nothing to stay at.
            _ = self.take_camera();
        }
        let standpoint = match &self.control {
            None => Standpoint::AsGiven,
            Some(control) => Standpoint::Placed(control.rounded()),
        };
        let settings = Settings {
            standpoint,
            seconds,
            system: self.config.clone(),
            frame: self.frame.clone(),
            shown: self.shown,
            moving: self.playback.playing || now < self.moving_until,
        };
        if self.asked.as_ref() == Some(&settings) {
            return None;
        }
        self.failed = None;
        self.asked = Some(settings.clone());
        Some(settings)
    }

    /// When the settings change by themselves next, seconds; absent while they stay.
    pub fn wakes_at(&self) -> Option<f64> {
        let moving = self.asked.as_ref().is_some_and(|asked| asked.moving);
        (moving && !self.playback.playing).then_some(self.moving_until)
    }

    /// Takes what a worker says. Pictures of settings that are no longer asked for are shown all the same: they are
    /// complete, and say what they are of.
    pub fn take(&mut self, update: Update) {
        match update {
            Update::Status(text) => self.status = Some(text),
            Update::Picture(picture) => {
                self.status = None;
                self.picture = Some(picture);
                self.pictures += 1;
            }
            Update::Failed { message, help } => {
                self.status = None;
                self.failed = Some(Failure { message, help });
            }
        }
    }

    /// Why there is no picture of what was chosen, if there is none.
    pub fn failure(&self) -> Option<&Failure> {
        self.invalid.as_ref().or(self.failed.as_ref())
    }

    /// The command line that makes the picture of these settings when its refinement has ended, and writes it to `output`.
    pub fn command_line(&self, settings: &Settings, output: &Path) -> String {
        let Opening { scene, camera_words, time_words, other_words, .. } = &self.opening;
        let mut words = vec!["rasray".to_owned(), "render".to_owned(), scene.to_string_lossy().into_owned()];
        match &settings.standpoint {
            Standpoint::AsGiven => words.extend_from_slice(camera_words),
            Standpoint::Placed(camera) => {
                let pairs = [("--eye", &camera.eye), ("--target", &camera.target), ("--fov", &camera.fov)];
                words
                    .extend(pairs.into_iter().flat_map(|(option, value)| [option.to_owned(), value.clone()]));
                if let Some(Lens { aperture, focus }) = camera.lens {
                    words.extend(["--aperture".to_owned(), aperture.to_string()]);
                    words.extend(["--focus".to_owned(), focus.to_string()]);
                }
            }
        }
        if let Some(seconds) = settings.seconds {
            words.extend(["--time".to_owned(), seconds.to_string()]);
            words.extend_from_slice(time_words);
        }
        words.extend(frame_words(&settings.frame));
        words.extend(system_words(&settings.system));
        words.extend_from_slice(other_words);
        if self.exposure != 0.0 {
            words.extend(["--exposure".to_owned(), self.exposure.to_string()]);
        }
        words.extend(["--output".to_owned(), output.to_string_lossy().into_owned()]);
        words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
    }

    /// The first place for a picture where `is_taken` says that there is no file. Without a run of # in the name there is
    /// one place, which is written over.
    pub fn place_for_picture(&self, is_taken: impl Fn(&Path) -> bool) -> PathBuf {
        let pattern = &self.opening.output;
        let name = pattern.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let Some(end) = name.rfind('#').map(|last| last + 1) else { return pattern.clone() };
        let begin = name[..end].trim_end_matches('#').len();
        let width = end - begin;
        let numbered = |number: u32| {
            pattern.with_file_name(format!("{}{number:0width$}{}", &name[..begin], &name[end..]))
        };
        (1..).map(numbered).find(|place| !is_taken(place)).unwrap_or_else(|| pattern.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Pixels;
    use crate::settings::{Shown, tests::some};
    use rasray_scene::default_view::camera_looking_at;

    fn session() -> Session {
        Session::new(Opening {
            scene: "a b.glb".into(),
            camera_words: vec!["--camera".to_owned(), "door".to_owned()],
            camera_is_default: false,
            time_words: vec!["--clip".to_owned(), "walk".to_owned()],
            other_words: vec!["--alpha".to_owned(), "off".to_owned()],
            settings: some(),
            exposure: 0.0,
            duration: 2.0,
            bounds: (DVec3::splat(-1.0), DVec3::splat(1.0)),
            output: PathBuf::from("out/a.###.png"),
        })
    }

    fn picture(session: &mut Session) {
        let settings = session.asked.clone().expect("settings");
        session.take(Update::Picture(Box::new(Picture {
            width: 1,
            height: 1,
            pixels: Pixels::Radiance(vec![[0.0; 3]]),
            settings,
            samples: 1,
            cut_rays: 0,
            camera: camera_looking_at("", DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO, 0.7),
            sample_ms: 1.0,
            passes: Vec::new(),
            memory: Default::default(),
            resolved: Default::default(),
        })));
    }

    #[test]
    fn settings_are_asked_for_once() {
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
        session.take(Update::Failed { message: "no memory".to_owned(), help: String::new() });
        assert!(session.picture.is_some() && session.failure().is_some());
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
        session.exposure = -1.5;
        let line = session.command_line(&settings, Path::new("p.png"));
        assert!(line.contains(" --time 0.25 --clip walk ") && line.contains(" --exposure -1.5 "), "{line}");
    }

    #[test]
    fn pictures_are_numbered_and_never_written_over() {
        let session = session();
        let taken = [PathBuf::from("out/a.001.png"), PathBuf::from("out/a.002.png")];
        let place = session.place_for_picture(|place| taken.contains(&place.to_owned()));
        assert_eq!(place, PathBuf::from("out/a.003.png"));
    }
}
