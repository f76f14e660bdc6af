//! Choices of the user, and what came of them.

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

/// Seconds after the last motion until the whole picture is made.
const REST: f64 = 0.2;

/// A failure in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Fault, in one sentence.
    pub message: String,
    /// Advice on what to do about it; may be empty.
    pub help: String,
}

impl Failure {
    /// The message of an error, without advice.
    pub fn without_help(error: &impl std::error::Error) -> Self {
        Self { message: error.to_string(), help: String::new() }
    }
}

/// Says in words what is wrong and what to do about it.
pub type Explain = fn(&ViewerError) -> Failure;

/// True if both make one structure, whoever chose it.
fn is_same(one: &SystemConfig, other: &SystemConfig) -> bool {
    one.system == other.system && one.preset == other.preset && one.options == other.options
}

/// Choices made by hand, and the last picture.
pub struct Session {
    opening: Opening,
    explain: Explain,
    /// The system and what is set of its options; it need not be valid.
    pub system: SystemChoice,
    /// The last valid configuration.
    config: SystemConfig,
    /// Integrator, samples, seed; its size is the picture's.
    pub frame: Frame,
    /// Picture or map that is shown.
    pub shown: Shown,
    /// True if noise is taken out of the picture.
    pub denoised: bool,
    /// Tone of colours, shown and saved.
    pub tone: Tone,
    /// The time.
    pub playback: Playback,
    stand: Stand,
    /// Number of scenes opened before this one.
    scene: u32,
    /// A scene that is to be opened, as it was named, and its number among those.
    to_open: Option<OsString>,
    /// The scene that is being read: the number of the request, and how it was named.
    reading: Option<(u64, String)>,
    requests: u64,
    /// Why the last scene that was to be opened is not shown.
    not_opened: Option<Failure>,
    /// A pick that nobody was asked about so far.
    to_pick: Option<Pick>,
    /// Last pick.
    picked: Option<Picked>,
    picks: u64,
    /// Until when something moves, seconds.
    moving_until: f64,
    /// The settings that were asked for last.
    asked: Option<Settings>,
    /// The last complete picture.
    pub picture: Option<Box<Picture>>,
    /// Number of pictures that have come.
    pub pictures: u64,
    /// Rate at which they come.
    pub picture_rate: Rate,
    /// Work that takes long, in a few words; absent where there is none.
    pub status: Option<String>,
    /// Why there is no picture of the settings that were asked for.
    failed: Option<Failure>,
    /// Why options are not valid.
    invalid: Option<Failure>,
}

impl Session {
    /// Begins a session, whose errors `explain` says in words.
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

    /// Goes to a time at `now` (seconds).
    pub fn seek(&mut self, seconds: f64, now: f64) {
        self.playback.seek(seconds);
        self.moving_until = now + REST;
    }

    /// The settings at `now` (seconds), where they are others than those asked for before. Options that are
    /// not valid are a failure, and the settings stay what they were.
    pub fn changed_settings(&mut self, now: f64) -> Option<Settings> {
        self.invalid = None;
        match self.system.config() {
            // One that nobody changed keeps why it was taken, and its structure.
            Ok(config) if is_same(&config, &self.config) => (),
            Ok(config) => self.config = config,
            Err(error) => {
                self.invalid = Some((self.explain)(&error.into()));
            }
        }
        let seconds = self.playback.shown();
        let is_elsewhen = self.asked.as_ref().is_some_and(|asked| asked.seconds != seconds);
        if self.opening.camera_is_default && is_elsewhen && matches!(self.stand, Stand::AsGiven) {
            // Else it would jump about with what moves. Without a picture so far there is nothing to stay at.
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

    /// When the settings change by themselves next, seconds; absent while they stay.
    pub fn wakes_at(&self) -> Option<f64> {
        let moving = self.asked.as_ref().is_some_and(|asked| asked.moving);
        (moving && !self.playback.playing).then_some(self.moving_until)
    }

    /// Takes what was said at `now` (seconds). Pictures of settings that are no longer asked for are shown
    /// all the same: they are complete, and say what they are of. Those of a scene before are not. Of a scene
    /// that was read there is what an engine shows, with the settings of which pictures are to be made.
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

    /// Why there is no picture of what was chosen, if there is none.
    pub fn failure(&self) -> Option<&Failure> {
        self.invalid.as_ref().or(self.failed.as_ref())
    }

    /// The command line that makes the picture of these settings when its refinement has ended, and writes it
    /// to `output`.
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

    /// The first place for a picture where `is_taken` says that there is no file. Without a run of # in the
    /// name there is one place, which is written over.
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
