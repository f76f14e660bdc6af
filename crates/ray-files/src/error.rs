use std::path::{Path, PathBuf};

/// Why a file gave no rays or hits.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}: {why}", path.display())]
pub struct FileError {
    path: PathBuf,
    why: Why,
}

/// What is wrong with the file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum Why {
    #[error("cannot be read: {0}")]
    Unreadable(String),
    #[error("is not a file of rays by its name")]
    NotRays,
    #[error("is not a file of hits by its name")]
    NotHits,
    #[error(transparent)]
    Format(FormatError),
}

impl FileError {
    pub(crate) fn new(path: &Path, why: Why) -> Self {
        Self { path: path.to_owned(), why }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is wrong with it, without its name.
    pub fn message(&self) -> String {
        self.why.to_string()
    }

    /// What to do about it.
    pub fn help(&self) -> &'static str {
        match &self.why {
            Why::Unreadable(_) => "check the name and that you may read the file",
            Why::NotRays => "name a .rays file or a .npy array of N x 6, 7 or 8 numbers",
            Why::NotHits => "name a .npy array with fields t and primitive",
            Why::Format(error) => error.help(),
        }
    }
}

/// Why bytes are not a file of rays or hits.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// The first bytes are those of another format.
    #[error("does not begin as a {format} file does")]
    Magic {
        /// What was expected.
        format: &'static str,
    },
    /// The version is not one that is known here.
    #[error("is of version {version}, and only {known} can be read")]
    Version {
        /// What the file says.
        version: String,
        /// What is known.
        known: &'static str,
    },
    /// The bytes end before, or after, what the header promises.
    #[error("has {bytes} bytes where its header promises {promised}")]
    Length {
        /// Bytes there are.
        bytes: u64,
        /// Bytes there should be.
        promised: u64,
    },
    /// The header cannot be understood.
    #[error("its header is not valid: {what}")]
    Header {
        /// What is wrong.
        what: String,
    },
    /// The array holds something else.
    #[error("holds {what}, not {wanted}")]
    Content {
        /// What it holds.
        what: String,
        /// What is wanted.
        wanted: &'static str,
    },
    /// A ray that cannot be traced, or a hit that is none.
    #[error("entry {index} is not valid: {what}")]
    Entry {
        /// Counted from 0.
        index: usize,
        /// What is wrong.
        what: &'static str,
    },
    /// More than [`super::LIMIT`] entries.
    #[error("holds {entries} entries; at most {} can be read", super::LIMIT)]
    TooMany {
        /// What the header says.
        entries: u64,
    },
}

impl FormatError {
    /// What to do about it.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Magic { .. } | Self::Version { .. } | Self::Header { .. } => {
                "write the file again: .rays by --save-rays, .npy by numpy.save"
            }
            Self::Length { .. } => "the file is cut short or has something after it; write it again",
            Self::Content { .. } => "docs/ray-files.md shows the arrays that can be read",
            Self::Entry { .. } => {
                "directions must be finite and not zero, origins finite, and no number NaN; correct the entry"
            }
            Self::TooMany { .. } => "split the file",
        }
    }
}
