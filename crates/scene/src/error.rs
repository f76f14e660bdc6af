//! What can go wrong while a scene is read.

use std::path::{Path, PathBuf};

/// Why a scene could not be loaded. Every message names the file, and says what to do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file, or one it refers to, could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file that could not be read.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// A limit of [`crate::Limits`] was exceeded.
    #[error("{}: {what} is {found}, the limit is {limit}; raise `{option}` if this is intended", path.display())]
    TooLarge {
        /// The scene file, or the file it refers to.
        path: PathBuf,
        /// What is too large.
        what: String,
        /// How much there is.
        found: u64,
        /// How much is allowed.
        limit: u64,
        /// The field of [`crate::Limits`] that decides.
        option: &'static str,
    },
    /// The extension of the file name tells no known format.
    #[error("{}: unknown scene format; use .gltf, .glb, .obj or .ply", path.display())]
    UnknownFormat {
        /// The scene file.
        path: PathBuf,
    },
    /// The bytes do not follow the grammar of the format.
    #[error("{}: {reason}", path.display())]
    Syntax {
        /// The scene file.
        path: PathBuf,
        /// What is wrong, and where (line, byte or element).
        reason: String,
    },
    /// The file can be parsed, but contradicts itself or its format.
    #[error("{}: {place}: {reason}", path.display())]
    Invalid {
        /// The scene file.
        path: PathBuf,
        /// The element at fault, such as `accessors[3]`.
        place: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A triangle refers to a vertex that does not exist.
    #[error("{}: {mesh}: vertex index {index}, but there are only {vertices} vertices", path.display())]
    IndexOutOfRange {
        /// The scene file.
        path: PathBuf,
        /// Name of the mesh.
        mesh: String,
        /// The offending index.
        index: u64,
        /// Number of vertices.
        vertices: u64,
    },
    /// The file cannot be shown without something that is not supported.
    #[error("{}: requires {extension}, which is not supported; {fix}", path.display())]
    UnsupportedExtension {
        /// The scene file.
        path: PathBuf,
        /// Name of the extension.
        extension: String,
        /// How to get a file that can be loaded.
        fix: &'static str,
    },
    /// A reference to another file leaves the folder of the scene, or is not a file.
    #[error("{}: {place}: the reference {uri:?} {reason}; only data: URIs and files below the scene's folder are read", path.display())]
    UnsafeReference {
        /// The scene file.
        path: PathBuf,
        /// The element at fault, such as `buffers[0]`.
        place: String,
        /// The reference as written, shortened.
        uri: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// An image could not be decoded.
    #[error("{}: image {image}: {reason}", path.display())]
    Image {
        /// The scene file.
        path: PathBuf,
        /// Name or file of the image.
        image: String,
        /// What the decoder said.
        reason: String,
    },
    /// The file has no such scene.
    #[error("{}: there is no scene {wanted}; the file has: {available}", path.display())]
    NoSuchScene {
        /// The scene file.
        path: PathBuf,
        /// What was asked for.
        wanted: String,
        /// Names or numbers of the scenes in the file.
        available: String,
    },
    /// The parameters of a built-in scene are wrong.
    #[error("built-in scene `{spec}`: {problem}")]
    Builtin {
        /// The name with its parameters, as written.
        spec: String,
        /// What is wrong with them, and what would be right.
        problem: String,
    },
    /// A library that reads the format panicked; the panic was caught. This is a defect, please
    /// report it with the file.
    #[error("{}: the reader failed on this file: {reason}; please report it", path.display())]
    Internal {
        /// The scene file.
        path: PathBuf,
        /// The message of the panic.
        reason: String,
    },
}

impl SceneError {
    /// An element of `path` that contradicts itself or the format.
    pub(crate) fn invalid(path: &Path, place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Invalid { path: path.to_owned(), place: place.into(), reason: reason.into() }
    }

    /// Bytes of `path` that do not follow the grammar of its format.
    pub(crate) fn syntax(path: &Path, reason: impl Into<String>) -> Self {
        Self::Syntax { path: path.to_owned(), reason: reason.into() }
    }

    /// More of something than [`crate::Limits`] allows.
    pub(crate) fn too_large(
        path: &Path,
        what: impl Into<String>,
        found: u64,
        limit: u64,
        option: &'static str,
    ) -> Self {
        Self::TooLarge { path: path.to_owned(), what: what.into(), found, limit, option }
    }
}
