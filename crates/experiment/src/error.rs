//! Everything that ends an experiment early.

use rasray_scene::SceneError;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Why an experiment gave no result. Every variant says what is wrong and what to do about it; both are whole
/// sentences without a full stop, and may name options of the command.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// The job asks for something that cannot be.
    #[error("{message}")]
    Usage {
        /// What is wrong.
        message: String,
        /// What to do; may be empty.
        help: String,
    },
    /// A file cannot be read.
    #[error("{}: {message}", path.display())]
    Input {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
        /// What to do; may be empty.
        help: String,
    },
    /// A scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The device is missing, lacks something required, or failed.
    #[error("{message}")]
    Device {
        /// What is wrong.
        message: String,
        /// What to do; may be empty.
        help: String,
    },
    /// A result exists that is not whole, and is not kept.
    #[error("{message}")]
    Refused {
        /// What would have been lost.
        message: String,
        /// What to do; may be empty.
        help: String,
    },
}

impl ExperimentError {
    /// A job that cannot be.
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage { message: message.into(), help: help.into() }
    }

    /// An error about a file that is read.
    pub fn input(path: &Path, message: impl Display, help: impl Into<String>) -> Self {
        Self::Input { path: path.to_owned(), message: message.to_string(), help: help.into() }
    }

    /// An error of the device.
    pub fn device(message: impl Display, help: impl Into<String>) -> Self {
        Self::Device { message: message.to_string(), help: help.into() }
    }

    /// A result that is not kept because it is not whole.
    pub fn refused(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Refused { message: message.into(), help: help.into() }
    }

    /// What to do about it; may be empty.
    pub fn help(&self) -> &str {
        match self {
            Self::Scene(error) => scene_help(error),
            Self::Usage { help, .. }
            | Self::Input { help, .. }
            | Self::Device { help, .. }
            | Self::Refused { help, .. } => help,
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
