use std::io;
use std::path::PathBuf;

/// Why a file gave no rays or hits.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// The name has another extension than `.rays` and `.npy`.
    #[error("{}: is not a file of rays by its name", path.display())]
    NotRays {
        /// The file.
        path: PathBuf,
    },
    /// The name has another extension than `.npy`.
    #[error("{}: is not a file of hits by its name", path.display())]
    NotHits {
        /// The file.
        path: PathBuf,
    },
    /// The file is not what its name says.
    #[error("{}: {source}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong with its bytes.
        source: FormatError,
    },
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
