//! Everything that ends an experiment early.

use rasray_scene_source::LoadError;
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
    /// There is no scene to show, or no view of it.
    #[error(transparent)]
    Load(#[from] LoadError),
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
            Self::Load(error) => error.help(),
            Self::Usage { help, .. }
            | Self::Input { help, .. }
            | Self::Device { help, .. }
            | Self::Refused { help, .. } => help,
        }
    }
}
