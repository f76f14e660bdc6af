//! A scene at times of its animation.

use rasray_experiment::{ExperimentError, LoadedScene};
use rasray_scene::Scene;

/// A scene that can be shown at any time, and at rest again. [`SceneAtTime::show`] is the one place that steps a scene: on
/// the host for now.
pub(crate) struct SceneAtTime {
    loaded: LoadedScene,
    /// As the file places everything, without its images, which do not move and may be most of the memory. Absent where
    /// nothing moves, and where the scene was handed over at a time.
    rest: Option<Scene>,
    /// The clip that moves it; else all that can be played at once.
    clip: Option<String>,
}

impl SceneAtTime {
    /// Takes a scene as it was read.
    pub(crate) fn new(mut loaded: LoadedScene, clip: Option<String>) -> Self {
        let animation = &loaded.scene.animation;
        let changes = !animation.clips.is_empty() || animation.deformer.is_some();
        let moves = loaded.pose.is_none() && changes;
        let rest = moves.then(|| {
            let images = std::mem::take(&mut loaded.scene.images);
            let rest = loaded.scene.clone();
            loaded.scene.images = images;
            rest
        });
        Self { loaded, rest, clip }
    }

    /// Shows it at a time, seconds, or at rest.
    ///
    /// # Errors
    /// It has no clips, or no such clip.
    pub(crate) fn show(&mut self, seconds: Option<f64>) -> Result<(), ExperimentError> {
        match (seconds, &self.rest) {
            (Some(seconds), _) => self.loaded.pose(seconds, self.clip.as_deref()),
            (None, Some(rest)) => {
                let images = std::mem::take(&mut self.loaded.scene.images);
                self.loaded.scene = Scene { images, ..rest.clone() };
                self.loaded.pose = None;
                Ok(())
            }
            (None, None) => Ok(()),
        }
    }

    /// As it is shown.
    pub(crate) fn loaded(&self) -> &LoadedScene {
        &self.loaded
    }

    /// As it is shown, for images to be made smaller.
    pub(crate) fn loaded_mut(&mut self) -> &mut LoadedScene {
        &mut self.loaded
    }
}
