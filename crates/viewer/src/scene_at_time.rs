//! A scene at times of its animation.

use rasray_scene::{Camera, Motion, Scene};
use rasray_scene_source::{ChosenCamera, LoadError, LoadedScene};

/// Chooses the camera of a scene as the command line said.
pub type ChooseCamera = dyn Fn(&mut LoadedScene) -> Result<ChosenCamera, LoadError> + Send;

/// A scene that can be shown at any time, and at rest again. [`SceneAtTime::show`] is the one place that
/// steps a scene: it stays at rest, and the device poses it. Scenes whose triangles may be others at every
/// time are posed here.
pub(crate) struct SceneAtTime {
    loaded: LoadedScene,
    /// As the file places everything, without its images, which do not move and may be most of the memory, of
    /// a scene that is posed here.
    rest: Option<Scene>,
    /// The clip that moves it; else all that can be played at once.
    clip: Option<String>,
    seconds: Option<f64>,
    /// The camera at that time, while nobody moves it.
    chosen: Option<Camera>,
}

impl SceneAtTime {
    /// Takes a scene as it was read, at rest.
    pub(crate) fn new(mut loaded: LoadedScene, clip: Option<String>) -> Self {
        let rest = (loaded.scene.motion() == Motion::Changing).then(|| {
            let images = std::mem::take(&mut loaded.scene.images);
            let rest = loaded.scene.clone();
            loaded.scene.images = images;
            rest
        });
        Self { loaded, rest, clip, seconds: None, chosen: None }
    }

    /// Shows it at a time, seconds, or at rest.
    ///
    /// # Errors
    /// It has no clips, or no such clip, or the file of that time cannot be read.
    pub(crate) fn show(&mut self, seconds: Option<f64>) -> Result<(), LoadError> {
        if self.seconds == seconds {
            return Ok(());
        }
        match (seconds, &self.rest) {
            (Some(seconds), _) => self.loaded.show(seconds, self.clip.as_deref())?,
            (None, rest) => {
                if let Some(rest) = rest {
                    let scene = &mut self.loaded.scene;
                    let (images, environment) =
                        (std::mem::take(&mut scene.images), std::mem::take(&mut scene.environment));
                    self.loaded.scene = Scene { images, environment, ..rest.clone() };
                }
                (self.loaded.moment, self.loaded.pose) = (None, None);
            }
        }
        // As a picture of that time is lit.
        self.loaded.relight();
        (self.seconds, self.chosen) = (seconds, None);
        Ok(())
    }

    /// Pose of the camera that nobody moves.
    ///
    /// # Errors
    /// The scene has no such camera.
    pub(crate) fn camera(&mut self, choose: &ChooseCamera) -> Result<Camera, LoadError> {
        if let Some(chosen) = &self.chosen {
            return Ok(chosen.clone());
        }
        Ok(self.chosen.insert(choose(&mut self.loaded)?.camera).clone())
    }

    /// As it is shown, or at rest where the device poses it.
    pub(crate) fn loaded(&self) -> &LoadedScene {
        &self.loaded
    }

    /// As [`Self::loaded`], for images to be made smaller.
    pub(crate) fn loaded_mut(&mut self) -> &mut LoadedScene {
        &mut self.loaded
    }
}
