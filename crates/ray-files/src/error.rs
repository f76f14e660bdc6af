use std::io;
use std::path::PathBuf;

/// Error of reading rays or hits from a file.
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
    /// The content of the file does not match its name.
    #[error("{}: {source}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Fault of the file's bytes.
        source: FormatError,
    },
}

/// Error of parsing bytes as rays or hits.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// The first bytes are those of another format.
    #[error("does not begin as a {format} file does")]
    Magic {
        /// Name of the expected format.
        format: &'static str,
    },
    /// The version is not a supported one.
    #[error("is of version {version}, and only {known} can be read")]
    Version {
        /// Version in the file.
        version: String,
        /// Supported versions.
        known: &'static str,
    },
    /// The number of bytes is not the one of the header.
    #[error("has {bytes} bytes where its header promises {promised}")]
    Length {
        /// Number of bytes found.
        bytes: u64,
        /// Number of bytes that the header promises.
        promised: u64,
    },
    /// The header cannot be understood.
    #[error("its header is not valid: {what}")]
    Header {
        /// Fault in the header.
        what: String,
    },
    /// The array has another content than the expected one.
    #[error("holds {what}, not {wanted}")]
    Content {
        /// Content of the array.
        what: String,
        /// Expected content.
        wanted: &'static str,
    },
    /// A ray cannot be traced, or a hit is invalid.
    #[error("entry {index} is not valid: {what}")]
    Entry {
        /// Index of the entry, from 0.
        index: usize,
        /// Fault in the entry.
        what: &'static str,
    },
    /// The file has more than [`super::LIMIT`] entries.
    #[error("holds {entries} entries; at most {} can be read", super::LIMIT)]
    TooMany {
        /// Number of entries by the header.
        entries: u64,
    },
}
