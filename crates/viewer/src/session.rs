//! Session: the choices of the user, and their results.

mod cameras;
mod opening;
mod picks;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use crate::command_line::{frame_words, quoted, system_words};
use crate::engine::SceneSource;
use crate::error::ViewerError;
use crate::option_controls::SystemChoice;
use crate::picked::{Pick, Picked};
use crate::picture::Picture;
use crate::playback::Playback;
use crate::rate::Rate;
use crate::settings::{Settings, Shown, Standpoint};
use crate::worker::{Opened, Update};
use cameras::Stand;
pub use opening::{Opening, camera_names};
use rasray_experiment::{Frame, SystemConfig};
use rasray_metrics::{Tone, ToneCurve};
use rasray_scene::Lens;

/// Seconds after the last motion before the whole picture is made.
const REST: f64 = 0.2;

/// Description of a failure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Description of the fault, in one sentence.
    pub message: String,
    /// Advice to the user; may be empty.
    pub help: String,
}

impl Failure {
    /// Returns the message of an error, without advice.
    pub fn without_help(error: &impl std::error::Error) -> Self {
        Self { message: error.to_string(), help: String::new() }
    }
}

/// Function that describes an error and gives advice.
pub type Explain = fn(&ViewerError) -> Failure;

/// True if both configurations make one structure, whoever chose it.
fn is_same(one: &SystemConfig, other: &SystemConfig) -> bool {
    one.system == other.system && one.preset == other.preset && one.options == other.options
}

/// Session of a user: choices made by hand, and the last picture.
pub struct Session {
    opening: Opening,
    explain: Explain,
    /// System with the options that were set; the choice may be invalid.
    pub system: SystemChoice,
    /// Last valid configuration.
    config: SystemConfig,
    /// Frame: integrator, samples and seed; its size is the picture's.
    pub frame: Frame,
    /// Picture or map that is shown.
    pub shown: Shown,
    /// True if the picture is denoised.
    pub denoised: bool,
    /// Tone of the colours that are shown and saved.
    pub tone: Tone,
    /// Playback of the animation.
    pub playback: Playback,
    stand: Stand,
    /// Number of scenes opened before this one.
    scene: u32,
    /// Scene to open, as it was named.
    to_open: Option<OsString>,
    /// Scene that is being read: the number of the request, and its name.
    reading: Option<(u64, String)>,
    requests: u64,
    /// Failure of the last scene to open; absent if the scene is shown.
    not_opened: Option<Failure>,
    /// Pick that is still to be asked.
    to_pick: Option<Pick>,
    /// Last pick with its answers.
    picked: Option<Picked>,
    picks: u64,
    /// Time until which something moves, seconds.
    moving_until: f64,
    /// Settings that were asked for last.
    asked: Option<Settings>,
    /// Last complete picture.
    pub picture: Option<Box<Picture>>,
    /// Number of pictures that have arrived.
    pub pictures: u64,
    /// Rate of arriving pictures.
    pub picture_rate: Rate,
    /// Description of work that takes long, in a few words; absent without such work.
    pub status: Option<String>,
    /// Failure of the settings that were asked for; absent if there is a picture.
    failed: Option<Failure>,
    /// Failure of the options; absent if they are valid.
    invalid: Option<Failure>,
}

impl Session {
    /// Begins a session, whose errors `explain` describes in words.
    pub fn new(opening: Opening, explain: Explain) -> Self {
        let Settings { system, frame, shown, denoised, seconds, .. } = opening.settings.clone();
        Self {
            system: SystemChoice::new(&system),
            config: system,
            frame,
            shown,
            denoised,
            tone: opening.tone,
            playback: Playback::new(seconds, opening.duration),
            stand: Stand::AsGiven,
            scene: 0,
            to_open: None,
            reading: None,
            requests: 0,
            not_opened: None,
            to_pick: None,
            picked: None,
            picks: 0,
            moving_until: f64::NEG_INFINITY,
            asked: None,
            picture: None,
            pictures: 0,
            picture_rate: Rate::default(),
            status: Some("starting".to_owned()),
            failed: None,
            invalid: None,
            opening,
            explain,
        }
    }

    /// Returns the scene as it was named.
    pub fn scene_name(&self) -> String {
        self.opening.scene.to_string_lossy().into_owned()
    }

    /// Returns half the diagonal of the scene, metres.
    pub fn radius(&self) -> f64 {
        let (low, high) = self.opening.bounds;
        let radius = 0.5 * (high - low).length();
        if radius.is_finite() && radius > 0.0 { radius } else { 1.0 }
    }

    /// Sets the time of the animation at `now` (seconds).
    pub fn seek(&mut self, seconds: f64, now: f64) {
        self.playback.seek(seconds);
        self.moving_until = now + REST;
    }

    /// Returns the settings at `now` (seconds), if they differ from those asked for before. Invalid options
    /// are a failure, and the settings stay unchanged.
    pub fn changed_settings(&mut self, now: f64) -> Option<Settings> {
        self.invalid = None;
        match self.system.config() {
            // A configuration that nobody changed keeps the reason for its choice, and its structure.
            Ok(config) if is_same(&config, &self.config) => (),
            Ok(config) => self.config = config,
            Err(error) => {
                self.invalid = Some((self.explain)(&error.into()));
            }
        }
        let seconds = self.playback.shown();
        let is_elsewhen = self.asked.as_ref().is_some_and(|asked| asked.seconds != seconds);
        if self.opening.camera_is_default && is_elsewhen && matches!(self.stand, Stand::AsGiven) {
            // Otherwise the camera would jump about with the moving scene. Before the first picture there is
            // no camera to keep.
            _ = self.take_camera();
        }
        let standpoint = match &self.stand {
            Stand::AsGiven => Standpoint::AsGiven,
            Stand::Camera(index) => Standpoint::Camera(*index),
            Stand::Moved(control) => Standpoint::Placed(control.rounded()),
        };
        let settings = Settings {
            scene: self.scene,
            standpoint,
            seconds,
            system: self.config.clone(),
            frame: self.frame.clone(),
            shown: self.shown,
            denoised: self.denoised && self.shown == Shown::Picture,
            moving: self.playback.playing || now < self.moving_until,
        };
        if self.asked.as_ref() == Some(&settings) {
            return None;
        }
        self.failed = None;
        self.asked = Some(settings.clone());
        Some(settings)
    }

    /// Returns the time in seconds at which the settings change by themselves; `None` while they stay.
    pub fn wakes_at(&self) -> Option<f64> {
        let moving = self.asked.as_ref().is_some_and(|asked| asked.moving);
        (moving && !self.playback.playing).then_some(self.moving_until)
    }

    /// Takes an update at `now` (seconds). A picture of settings that are no longer asked for is shown as
    /// well, since it is complete and holds its settings; a picture of a scene before is not. For a scene
    /// that was read, the source for an engine is returned, with the settings of the pictures to make.
    pub fn take(&mut self, update: Update, now: f64) -> Option<(SceneSource, Settings)> {
        match update {
            Update::Status(text) => self.status = Some(text),
            Update::Picture(picture) if picture.settings.scene == self.scene => {
                self.status = None;
                self.picture = Some(picture);
                self.pictures += 1;
                self.picture_rate.count(now);
            }
            Update::Picture(_) => (),
            Update::Failed(error) => {
                self.status = None;
                self.failed = Some((self.explain)(&error));
            }
            Update::Answered(number, answer) => {
                if let Some(picked) = self.picked.as_mut().filter(|picked| picked.pick.number == number) {
                    picked.awaited = picked.awaited.saturating_sub(1);
                    picked.answers.push(answer);
                }
            }
            Update::Read(number, read) => {
                if self.reading.as_ref().is_none_or(|(wanted, _)| *wanted != number) {
                    return None;
                }
                self.reading = None;
                match read {
                    Ok(opened) => {
                        let Opened { opening, source } = *opened;
                        self.begin(opening);
                        return self.changed_settings(now).map(|settings| (source, settings));
                    }
                    Err(failure) => self.not_opened = Some(failure),
                }
            }
        }
        None
    }

    /// Returns the failure for which the choices give no picture, if any.
    pub fn failure(&self) -> Option<&Failure> {
        self.invalid.as_ref().or(self.failed.as_ref())
    }

    /// Returns the command line that makes the picture of these settings at the end of its refinement, and
    /// writes it to `output`.
    pub fn command_line(&self, settings: &Settings, output: &Path) -> String {
        let Opening { scene, camera_words, cameras, time_words, other_words, .. } = &self.opening;
        let mut words = vec!["rasray".to_owned(), "render".to_owned(), scene.to_string_lossy().into_owned()];
        match &settings.standpoint {
            Standpoint::AsGiven => words.extend_from_slice(camera_words),
            Standpoint::Camera(index) => {
                let word = cameras.iter().find(|(own, _)| own == index).map(|(_, word)| word.clone());
                words.extend(word.into_iter().flat_map(|word| ["--camera".to_owned(), word]));
            }
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
        let Tone { curve, exposure } = self.tone;
        if exposure != 0.0 {
            words.extend(["--exposure".to_owned(), exposure.to_string()]);
        }
        if curve != ToneCurve::default() {
            words.extend(["--tone".to_owned(), curve.name().to_owned()]);
        }
        if settings.denoised {
            words.push("--denoise".to_owned());
        }
        words.extend(["--output".to_owned(), output.to_string_lossy().into_owned()]);
        words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
    }

    /// Returns the first file name for a picture that `is_taken` does not report as taken. A name without a
    /// run of # gives one file, which is overwritten.
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
mod tests;
