//! Errors that end the command early, with their exit codes.

use crate::hints;
use rasray_experiment::ExperimentError;
use rasray_ray_files::FileError;
use rasray_report::one_line;
use rasray_scene_source::LoadError;
use std::borrow::Cow;
use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};

/// Exit code of a complete run.
pub const EXIT_OK: u8 = 0;
/// Exit code of a run with `--check` that missed a target.
pub const EXIT_TARGET: u8 = 1;
/// Exit code of bad input and of usage errors.
pub const EXIT_USAGE: u8 = 2;
/// Exit code of a missing, unsuitable or failing device.
pub const EXIT_DEVICE: u8 = 3;
/// Exit code of a result that could not be kept whole: it could not be written, or the trace was incomplete.
pub const EXIT_REFUSED: u8 = 4;
/// Exit code of a defect: no input, option or device is at fault.
pub const EXIT_DEFECT: u8 = 5;
/// Exit code of a run that a signal stopped, whether or not a partial result was written.
pub const EXIT_INTERRUPTED: u8 = 130;

/// Error that ended the command early. Every variant describes the fault and the remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AppError {
    /// The command line asks for something impossible. Exit code 2.
    #[error("{message}")]
    Usage {
        /// Description of the fault.
        message: String,
        /// Advice, in one sentence; may be empty.
        help: String,
    },
    /// A file cannot be read, or an output cannot be put in its place. Exit code 2.
    #[error("{}: {message}", path.display())]
    Input {
        /// Path of the file.
        path: PathBuf,
        /// Description of the fault.
        message: String,
        /// Advice, in one sentence; may be empty.
        help: String,
    },
    /// An experiment gave no result. Exit code 3 if the device is missing, lacks a required feature or
    /// failed, 4 if the result is not whole, 5 for a defect, otherwise 2.
    #[error("{}", hints::message(.0))]
    Experiment(#[from] ExperimentError),
    /// A file gave no rays or hits. Exit code 2.
    #[error(transparent)]
    Rays(#[from] FileError),
    /// There is no window, or it cannot be drawn. Exit codes as for experiments.
    #[cfg(feature = "viewer")]
    #[error(transparent)]
    Viewer(rasray_viewer::ViewerError),
    /// The operating system refuses handlers of signals. Exit code 2.
    #[error("signals cannot be handled: {0}")]
    Signals(#[source] io::Error),
    /// Another error, with its subject. The exit code is that of the other error.
    #[error("{what}: {source}")]
    About {
        /// Subject: a frame, or the comparison of a plan.
        what: String,
        /// Error without its subject.
        source: Box<Self>,
    },
    /// A result would have lost data if it had been kept. Exit code 4.
    #[error("{message}")]
    Refused {
        /// Results that would have been lost, and their place.
        message: String,
        /// Advice, in one sentence; may be empty.
        help: String,
    },
    /// The program contradicts itself, whatever the input. Exit code 5, with the advice to report it.
    #[error("{message}")]
    Defect {
        /// Description of the contradiction, and what is not done because of it.
        message: String,
    },
    /// A hard case's target was not met, and `--check` asked for it. Exit code 1.
    #[error("{message}")]
    Target {
        /// Target that was not met.
        message: String,
        /// Advice, in one sentence; may be empty.
        help: String,
    },
    /// A signal stopped the run. Exit code 130.
    #[error("{message}")]
    Interrupted {
        /// Progress of the run, and the files written.
        message: String,
        /// Advice, in one sentence; may be empty.
        help: String,
    },
}

impl From<LoadError> for AppError {
    fn from(error: LoadError) -> Self {
        Self::Experiment(error.into())
    }
}

#[cfg(feature = "viewer")]
impl From<rasray_viewer::ViewerError> for AppError {
    fn from(error: rasray_viewer::ViewerError) -> Self {
        match error {
            rasray_viewer::ViewerError::Experiment(error) => Self::Experiment(error),
            error => Self::Viewer(error),
        }
    }
}

impl AppError {
    /// Puts the subject of the error before its message.
    pub fn about(self, what: &str) -> Self {
        Self::About { what: what.to_owned(), source: Box::new(self) }
    }

    /// Makes a usage error.
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage { message: message.into(), help: help.into() }
    }

    /// Makes an error about a file that is read, or about the place of an output.
    pub fn input(path: &Path, message: impl Display, help: impl Into<String>) -> Self {
        Self::Input { path: path.to_owned(), message: message.to_string(), help: help.into() }
    }

    /// Makes the error of a result that is not kept because it is not whole.
    pub fn refused(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Refused { message: message.into(), help: help.into() }
    }

    /// Makes the error of a run that a signal stopped.
    pub fn interrupted(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Interrupted { message: message.into(), help: help.into() }
    }

    /// Returns the exit code of the command.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage { .. } | Self::Input { .. } | Self::Rays(_) | Self::Signals(_) => EXIT_USAGE,
            Self::Experiment(error) => hints::exit_code(error),
            #[cfg(feature = "viewer")]
            Self::Viewer(error) => hints::code_of_viewer(error),
            Self::About { source, .. } => source.exit_code(),
            Self::Refused { .. } => EXIT_REFUSED,
            Self::Defect { .. } => EXIT_DEFECT,
            Self::Target { .. } => EXIT_TARGET,
            Self::Interrupted { .. } => EXIT_INTERRUPTED,
        }
    }

    /// Returns the advice on the command line, in one sentence; may be empty.
    pub fn help(&self) -> Cow<'_, str> {
        match self {
            Self::Usage { help, .. }
            | Self::Input { help, .. }
            | Self::Refused { help, .. }
            | Self::Target { help, .. }
            | Self::Interrupted { help, .. } => help.into(),
            Self::Experiment(error) => hints::help(error),
            Self::Rays(error) => hints::help_of_rays(error).into(),
            #[cfg(feature = "viewer")]
            Self::Viewer(error) => hints::help_of_viewer(error),
            Self::Signals(_) => {
                "run in an environment that lets programs handle SIGINT, SIGTERM and SIGHUP".into()
            }
            Self::Defect { .. } => hints::DEFECT.into(),
            Self::About { source, .. } => source.help(),
        }
    }

    /// Returns the two lines for stderr: `error: …` and `help: …`, each without a line break inside.
    pub fn lines(&self) -> String {
        let word = if self.exit_code() == EXIT_INTERRUPTED { "interrupted" } else { "error" };
        let mut lines = format!("{word}: {}\n", one_line(&self.to_string()));
        if !self.help().is_empty() {
            lines += &format!("help: {}\n", one_line(&self.help()));
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_its_documented_exit_code() {
        let path = Path::new("a.gltf");
        assert_eq!(AppError::usage("a", "b").exit_code(), 2);
        assert_eq!(AppError::input(path, "a", "b").exit_code(), 2);
        assert_eq!(AppError::refused("a", "b").exit_code(), 4);
        assert_eq!(AppError::interrupted("a", "b").exit_code(), 130);
        let defect = AppError::Defect { message: "a".to_owned() };
        assert_eq!((defect.exit_code(), &*defect.help()), (5, hints::DEFECT));
        let target = AppError::Target { message: "a".to_owned(), help: "b".to_owned() };
        assert_eq!((target.exit_code(), &*target.help()), (1, "b"));
    }

    #[test]
    fn messages_stay_on_one_line_and_name_the_file() {
        let error = AppError::input(Path::new("scene.gltf"), "unexpected end\n of file", "export\nagain");
        assert_eq!(error.lines(), "error: scene.gltf: unexpected end of file\nhelp: export again\n");
        let error = AppError::input(Path::new("a\u{1b}[2J\u{9b}.gltf"), "b\u{7}", "c\u{202e}");
        assert_eq!(error.lines(), "error: a\\u{1b}[2J\\u{9b}.gltf: b\\u{7}\nhelp: c\\u{202e}\n");
    }
}
