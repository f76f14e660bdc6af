//! State that a session begins with, and another scene in its course.

use std::ffi::OsString;
use std::path::PathBuf;

use glam::DVec3;
use rasray_metrics::Tone;
use rasray_scene::Camera;
use rasray_scene_source::LoadedScene;

use super::cameras::Stand;
use super::{Failure, Session, is_same};
use crate::option_controls::SystemChoice;
use crate::playback::Playback;
use crate::settings::Settings;

/// State that a session begins with.
#[derive(Clone, Debug)]
pub struct Opening {
    /// The scene as it was named.
    pub scene: OsString,
    /// Words of the command line that put the camera where it is at first.
    pub camera_words: Vec<String>,
    /// True if the camera is placed by where everything is at first: it stays there when the time changes.
    pub camera_is_default: bool,
    /// The cameras of the scene: their positions there, and the words that name them on the command line.
    pub cameras: Vec<(usize, String)>,
    /// The camera of a scene that has none, at rest.
    pub default_camera: Camera,
    /// Words that say when the scene is shown are followed by these, such as those of a clip.
    pub time_words: Vec<String>,
    /// Words of the command line that stay as they are.
    pub other_words: Vec<String>,
    /// Settings at first.
    pub settings: Settings,
    /// Tone of colours.
    pub tone: Tone,
    /// Length of the longest clip, seconds.
    pub duration: f64,
    /// The least and greatest corner of the scene, world, metres.
    pub bounds: (DVec3, DVec3),
    /// File that pictures are saved as: a run of # stands for a number.
    pub output: PathBuf,
}

/// The cameras of a scene as [`Opening::cameras`] has them: by name where the command line finds them by it,
/// else by position.
pub fn camera_names(loaded: &LoadedScene) -> Vec<(usize, String)> {
    let words = loaded.scene.cameras.iter().enumerate().filter_map(|(index, camera)| {
        let is_it = |word: &String| loaded.named_view(word).is_ok_and(|chosen| chosen.index == Some(index));
        let words = [camera.name.clone(), index.to_string()];
        let word = words.into_iter().filter(|word| !word.is_empty()).find(is_it)?;
        Some((index, word))
    });
    words.collect()
}

impl Session {
    /// Asks for another scene: a file, or a built-in one.
    pub fn open(&mut self, scene: OsString) {
        if !scene.is_empty() {
            self.to_open = Some(scene);
        }
    }

    /// Asks for a file that was dropped on the window.
    pub fn drop_file(&mut self, path: PathBuf) {
        self.open(path.into_os_string());
    }

    /// The scene that is to be read, and the number of the request, once.
    pub fn asked_scene(&mut self) -> Option<(u64, OsString)> {
        let scene = self.to_open.take()?;
        self.requests += 1;
        self.reading = Some((self.requests, scene.to_string_lossy().into_owned()));
        self.not_opened = None;
        Some((self.requests, scene))
    }

    /// The scene that is being read.
    pub fn reading(&self) -> Option<&str> {
        self.reading.as_ref().map(|(_, name)| name.as_str())
    }

    /// Why the last scene that was to be opened is not shown.
    pub fn not_opened(&self) -> Option<&Failure> {
        self.not_opened.as_ref()
    }

    /// Forgets the failure, which was read.
    pub fn dismiss(&mut self) {
        self.not_opened = None;
    }

    /// Goes on with another scene. What was chosen of the picture stays, and of the structure what is not as
    /// the scene before had it at first.
    pub(super) fn begin(&mut self, opening: Opening) {
        let Settings { system, seconds, .. } = &opening.settings;
        if is_same(&self.config, &self.opening.settings.system) {
            (self.system, self.config) = (SystemChoice::new(system), system.clone());
        }
        self.playback = Playback::new(*seconds, opening.duration);
        self.stand = Stand::AsGiven;
        self.scene += 1;
        self.moving_until = f64::NEG_INFINITY;
        (self.asked, self.picture, self.failed) = (None, None, None);
        self.status = Some("starting".to_owned());
        self.unpick();
        self.opening = opening;
    }
}
