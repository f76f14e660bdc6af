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
        /// Error of the operating system.
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
        /// Fault in its bytes.
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
        /// Format that was expected.
        format: &'static str,
    },
    /// The version is not one that is known here.
    #[error("is of version {version}, and only {known} can be read")]
    Version {
        /// Version in the file.
        version: String,
        /// Versions that are known.
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
        /// Fault in the header.
        what: String,
    },
    /// The array holds something else.
    #[error("holds {what}, not {wanted}")]
    Content {
        /// Contents of the array.
        what: String,
        /// Contents that are wanted.
        wanted: &'static str,
    },
    /// A ray that cannot be traced, or a hit that is none.
    #[error("entry {index} is not valid: {what}")]
    Entry {
        /// Counted from 0.
        index: usize,
        /// Fault in the entry.
        what: &'static str,
    },
    /// More than [`super::LIMIT`] entries.
    #[error("holds {entries} entries; at most {} can be read", super::LIMIT)]
    TooMany {
        /// Entries, by its header.
        entries: u64,
    },
}
