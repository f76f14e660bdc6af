//! Why there is no scene to show.

use rasray_scene::SceneError;
use std::io;
use std::path::PathBuf;

/// Why there is no scene to show, or no view of it. Messages are whole sentences without a full stop.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// A file that is no scene's.
    #[error("{}: is not a scene file by its name", path.display())]
    NoSceneFile {
        /// The file.
        path: PathBuf,
    },
    /// Neither a file nor a built-in scene.
    #[error("{}: there is neither such a file nor such a built-in scene", path.display())]
    NoSuchScene {
        /// The name.
        path: PathBuf,
        /// The built-in scene that was probably meant, with the parameters that were given.
        meant: Option<String>,
    },
    /// A file that was read has gone.
    #[error("{}: cannot be read again: {source}", path.display())]
    Gone {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The scene has no such camera.
    #[error("the scene {scene} has no camera '{wanted}'")]
    NoSuchCamera {
        /// Name of the scene.
        scene: String,
        /// Name or number of the camera.
        wanted: String,
        /// Names of the cameras that it has.
        cameras: Vec<String>,
    },
    /// A lens for a camera with a parallel projection.
    #[error("the camera {camera} has a parallel projection, which has no lens")]
    ParallelLens {
        /// The camera in a few words.
        camera: String,
    },
    /// A lens without the distance of the plane in focus.
    #[error("an aperture blurs what is not in focus, and nothing says what is")]
    NoFocus,
    /// A camera is to look from a place at the same place, or at none.
    #[error("eye and target give no direction to look in")]
    NoDirection,
    /// A moment of a scene that nothing moves.
    #[error("the scene {scene} has no clips that could move it")]
    NothingMoves {
        /// Name of the scene.
        scene: String,
    },
    /// A clip of a scene that deforms in one way.
    #[error("the scene {scene} has no clips: it deforms in one way")]
    NoClips {
        /// Name of the scene.
        scene: String,
    },
    /// The scene has no such clip.
    #[error("the scene {scene} has no clip '{wanted}'")]
    NoSuchClip {
        /// Name of the scene.
        scene: String,
        /// Name or number of the clip.
        wanted: String,
        /// Names of the clips that it has.
        clips: Vec<String>,
    },
}
