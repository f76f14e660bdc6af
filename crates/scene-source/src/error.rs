//! Why there is no scene to show.

use rasray_scene::SceneError;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Why there is no scene to show, or no view of it. Every variant says what is wrong and what to do about it; both are
/// whole sentences without a full stop, and may name options of the command.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The scene does not have what is asked for.
    #[error("{message}")]
    Usage {
        /// What is wrong.
        message: String,
        /// What to do.
        help: String,
    },
    /// A name that is no scene's, or a file that cannot be read.
    #[error("{}: {message}", path.display())]
    Input {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
        /// What to do.
        help: String,
    },
    /// A scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

impl LoadError {
    /// Something that the scene does not have.
    pub(crate) fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage { message: message.into(), help: help.into() }
    }

    /// An error about a file that is read.
    pub(crate) fn input(path: &Path, message: impl Display, help: impl Into<String>) -> Self {
        Self::Input { path: path.to_owned(), message: message.to_string(), help: help.into() }
    }

    /// What to do about it; may be empty.
    pub fn help(&self) -> &str {
        match self {
            Self::Scene(error) => scene_help(error),
            Self::Usage { help, .. } | Self::Input { help, .. } => help,
        }
    }
}

/// What to do about a scene that cannot be read. Messages that already end in what to do get none.
fn scene_help(error: &SceneError) -> &'static str {
    match error {
        SceneError::Read { .. } => "check the name and that you may read the file",
        SceneError::Missing { .. } => {
            "put that file where the scene looks for it, and check that you may read it"
        }
        SceneError::TooLarge { .. } => "split or simplify the scene",
        SceneError::Syntax { .. }
        | SceneError::Invalid { .. }
        | SceneError::IndexOutOfRange { .. }
        | SceneError::NoTriangles { .. } => {
            "the file is damaged or breaks its format: correct it, or export it again"
        }
        SceneError::Sequence { .. } => {
            "numbered files go on without a gap, with the meshes and materials of the first"
        }
        SceneError::Image { .. } => "convert the image to .png or .jpg and refer to that",
        SceneError::Builtin { .. } => {
            "write NAME:PARAMETER=VALUE,PARAMETER=VALUE, or the name alone for its defaults"
        }
        _ => "",
    }
}
