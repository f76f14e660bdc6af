//! State that a session begins with, and the change to another scene.

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
    /// Scene as it was named.
    pub scene: OsString,
    /// Words of the command line that place the camera at first.
    pub camera_words: Vec<String>,
    /// True if the camera is placed by the scene's first pose: it stays there when the time changes.
    pub camera_is_default: bool,
    /// Cameras of the scene: their indices, and the words that name them on the command line.
    pub cameras: Vec<(usize, String)>,
    /// Camera for a scene without cameras, at rest.
    pub default_camera: Camera,
    /// Words that follow those of the time on the command line, such as the words of a clip.
    pub time_words: Vec<String>,
    /// Words of the command line that never change.
    pub other_words: Vec<String>,
    /// Settings at the beginning.
    pub settings: Settings,
    /// Tone of the colours.
    pub tone: Tone,
    /// Length of the longest clip, seconds.
    pub duration: f64,
    /// Least and greatest corner of the scene in the world, metres.
    pub bounds: (DVec3, DVec3),
    /// File name of saved pictures, in which a run of # stands for a number.
    pub output: PathBuf,
}

/// Returns the cameras of a scene in the form of [`Opening::cameras`]: by name if the command line finds them
/// by it, otherwise by index.
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

    /// Returns the scene to read, and the number of the request; only once.
    pub fn asked_scene(&mut self) -> Option<(u64, OsString)> {
        let scene = self.to_open.take()?;
        self.requests += 1;
        self.reading = Some((self.requests, scene.to_string_lossy().into_owned()));
        self.not_opened = None;
        Some((self.requests, scene))
    }

    /// Returns the scene that is being read.
    pub fn reading(&self) -> Option<&str> {
        self.reading.as_ref().map(|(_, name)| name.as_str())
    }

    /// Returns the failure of the last scene to open, if it is not shown.
    pub fn not_opened(&self) -> Option<&Failure> {
        self.not_opened.as_ref()
    }

    /// Forgets the failure, which the user has read.
    pub fn dismiss(&mut self) {
        self.not_opened = None;
    }

    /// Begins another scene. The choices for the picture stay; so do those for the structure, unless they are
    /// the first ones of the scene before.
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
