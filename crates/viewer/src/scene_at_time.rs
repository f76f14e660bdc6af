//! Scene at times of its animation.

use rasray_scene::{Camera, Motion, Scene};
use rasray_scene_source::{ChosenCamera, LoadError, LoadedScene};

/// Function that chooses the camera of a scene as the command line asked for.
pub type ChooseCamera = dyn Fn(&mut LoadedScene) -> Result<ChosenCamera, LoadError> + Send;

/// Scene that can be shown at any time, and at rest again. Only [`SceneAtTime::show`] changes the time of a
/// scene: the scene stays at rest, and the device poses it. A scene whose triangles may differ at every time
/// is posed by the host.
pub(crate) struct SceneAtTime {
    loaded: LoadedScene,
    /// Scene as the file places everything, for a scene that the host poses. It lacks the images, which do
    /// not move and may be most of the memory.
    rest: Option<Scene>,
    /// Name of the clip that moves the scene; absent for all clips that can be played together.
    clip: Option<String>,
    seconds: Option<f64>,
    /// Camera at the shown time, while nobody moves it.
    chosen: Option<Camera>,
}

impl SceneAtTime {
    /// Makes it from a scene as it was read, at rest.
    pub(crate) fn new(mut loaded: LoadedScene, clip: Option<String>) -> Self {
        let rest = (loaded.scene.motion() == Motion::Changing).then(|| {
            let images = std::mem::take(&mut loaded.scene.images);
            let rest = loaded.scene.clone();
            loaded.scene.images = images;
            rest
        });
        Self { loaded, rest, clip, seconds: None, chosen: None }
    }

    /// Shows the scene at a time, seconds, or at rest.
    ///
    /// # Errors
    /// The scene has no clips, or no such clip, or the file of that time cannot be read.
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
        // The light is that of a picture of this time.
        self.loaded.relight();
        (self.seconds, self.chosen) = (seconds, None);
        Ok(())
    }

    /// Returns the pose of the camera that nobody moves.
    ///
    /// # Errors
    /// The scene has no such camera.
    pub(crate) fn camera(&mut self, choose: &ChooseCamera) -> Result<Camera, LoadError> {
        if let Some(chosen) = &self.chosen {
            return Ok(chosen.clone());
        }
        Ok(self.chosen.insert(choose(&mut self.loaded)?.camera).clone())
    }

    /// Returns the scene as it is shown, or at rest if the device poses it.
    pub(crate) fn loaded(&self) -> &LoadedScene {
        &self.loaded
    }

    /// Returns the scene as [`Self::loaded`], mutably, so that its images can be made smaller.
    pub(crate) fn loaded_mut(&mut self) -> &mut LoadedScene {
        &mut self.loaded
    }
}
