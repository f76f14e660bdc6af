//! Errors of getting a scene, or a view of it.

use rasray_scene::SceneError;
use std::io;
use std::path::PathBuf;

/// Error of getting a scene, or a view of it. Messages are whole sentences without a full stop.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The file has no format of scenes.
    #[error("{}: is not a scene file by its name", path.display())]
    NoSceneFile {
        /// The file.
        path: PathBuf,
    },
    /// The name is neither a file nor a built-in scene.
    #[error("{}: there is neither such a file nor such a built-in scene", path.display())]
    NoSuchScene {
        /// The name.
        path: PathBuf,
        /// The built-in scene that was probably meant, with the parameters that were given.
        meant: Option<String>,
    },
    /// A file that was read before no longer exists.
    #[error("{}: cannot be read again: {source}", path.display())]
    Gone {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The scene has no camera of this name or number.
    #[error("the scene {scene} has no camera '{wanted}'")]
    NoSuchCamera {
        /// Name of the scene.
        scene: String,
        /// Name or number of the camera.
        wanted: String,
        /// Names of the scene's cameras.
        cameras: Vec<String>,
    },
    /// A lens is asked for on a camera with a parallel projection.
    #[error("the camera {camera} has a parallel projection, which has no lens")]
    ParallelLens {
        /// Description of the camera in a few words.
        camera: String,
    },
    /// The lens has no distance of the plane in focus.
    #[error("an aperture blurs what is not in focus, and nothing says what is")]
    NoFocus,
    /// The eye and the target of a camera coincide, or are not finite.
    #[error("eye and target give no direction to look in")]
    NoDirection,
    /// A moment is asked for in a scene without motion.
    #[error("the scene {scene} has no clips that could move it")]
    NothingMoves {
        /// Name of the scene.
        scene: String,
    },
    /// A clip is asked for in a scene that deforms in one way only.
    #[error("the scene {scene} has no clips: it deforms in one way")]
    NoClips {
        /// Name of the scene.
        scene: String,
    },
    /// The scene has no clip of this name or number.
    #[error("the scene {scene} has no clip '{wanted}'")]
    NoSuchClip {
        /// Name of the scene.
        scene: String,
        /// Name or number of the clip.
        wanted: String,
        /// Names of the scene's clips.
        clips: Vec<String>,
    },
}
