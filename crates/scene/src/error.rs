//! Errors of reading a scene.

use std::path::{Path, PathBuf};

use crate::text::{reason, sentence, shown};

/// Error of loading a scene. Every message names the scene file and the place at fault, and no message holds
/// control characters, even if names in the file do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The scene file could not be read.
    #[error("cannot read {}: {}", path.display(), reason(source))]
    Read {
        /// The scene file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// A file that the scene refers to and needs could not be read.
    #[error("{}: {} needs {}, which cannot be read: {}", path.display(), shown(place), file.display(), reason(source))]
    Missing {
        /// The scene file.
        path: PathBuf,
        /// The element that refers to it, such as `buffers[0]`.
        place: String,
        /// The file that could not be read.
        file: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// A limit of loading was exceeded. The limit can be raised in the field `option`.
    #[error("{}: {} is {found}, which is more than the limit of {limit} ({option})", path.display(), shown(what))]
    TooLarge {
        /// The scene file.
        path: PathBuf,
        /// Name of the quantity that is too large.
        what: String,
        /// Amount found.
        found: u64,
        /// Amount allowed.
        limit: u64,
        /// Field of the limits that sets the limit.
        option: &'static str,
    },
    /// The extension of the file name stands for no known format.
    #[error("{}: unknown scene format; use .gltf, .glb, .obj or .ply", path.display())]
    UnknownFormat {
        /// The scene file.
        path: PathBuf,
    },
    /// The format of the file, or of one that it needs, is not the one of its name, or has a version that is
    /// not supported.
    #[error("{}: {}; {fix}", path.display(), sentence(found))]
    NotThisFormat {
        /// The scene file.
        path: PathBuf,
        /// Kind of file found, such as `is an HTML page, not glTF`.
        found: String,
        /// Advice on getting a file that can be loaded.
        fix: &'static str,
    },
    /// The bytes do not follow the grammar of the format.
    #[error("{}: {}", path.display(), sentence(reason))]
    Syntax {
        /// The scene file.
        path: PathBuf,
        /// Fault, and its place (line, byte or element).
        reason: String,
    },
    /// The file can be parsed, but contradicts itself or its format.
    #[error("{}: {}: {}", path.display(), shown(place), sentence(reason))]
    Invalid {
        /// The scene file.
        path: PathBuf,
        /// The element at fault, such as `accessors[3]`.
        place: String,
        /// Fault of the element.
        reason: String,
    },
    /// A triangle refers to a vertex that does not exist.
    #[error("{}: {}: vertex index {index}, but there are only {vertices} vertices", path.display(), shown(mesh))]
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
    /// The file has triangles, but none of them can be shown.
    #[error("{}: none of its triangles can be shown: {}", path.display(), sentence(reason))]
    NoTriangles {
        /// The scene file.
        path: PathBuf,
        /// Reason, such as that all were dropped.
        reason: String,
    },
    /// The file cannot be shown without something that is not supported.
    #[error("{}: requires {}, which is not supported; {fix}", path.display(), shown(extension))]
    UnsupportedExtension {
        /// The scene file.
        path: PathBuf,
        /// Name of the extension.
        extension: String,
        /// Advice on getting a file that can be loaded.
        fix: &'static str,
    },
    /// A reference to another file leaves the folder of the scene, or does not name a file.
    #[error("{}: {}: the reference `{}` {reason}; only data: URIs and files below the scene's folder are read", path.display(), shown(place), shown(uri))]
    UnsafeReference {
        /// The scene file.
        path: PathBuf,
        /// The element at fault, such as `buffers[0]`.
        place: String,
        /// The reference as written, shortened.
        uri: String,
        /// Fault of the reference, as words that follow it.
        reason: &'static str,
    },
    /// An image could not be decoded.
    #[error("{}: image {}: {}", path.display(), shown(image), sentence(reason))]
    Image {
        /// The scene file.
        path: PathBuf,
        /// Name or file of the image.
        image: String,
        /// Fault of the image.
        reason: String,
    },
    /// The file has no scene of the name or number that was asked for.
    #[error("{}: there is no scene {}; the file has: {}", path.display(), shown(wanted), sentence(available))]
    NoSuchScene {
        /// The scene file.
        path: PathBuf,
        /// Scene that was asked for.
        wanted: String,
        /// Names or numbers of the scenes in the file.
        available: String,
    },
    /// The files of a sequence do not form one scene over time.
    #[error("{}: {}", path.display(), sentence(problem))]
    Sequence {
        /// The pattern, or the file at fault.
        path: PathBuf,
        /// Fault, as a sentence.
        problem: String,
    },
    /// The parameters of a built-in scene are wrong.
    #[error("built-in scene `{}`: {}", shown(spec), sentence(problem))]
    Builtin {
        /// The name with its parameters, as written.
        spec: String,
        /// Fault of the parameters, and the valid ones.
        problem: String,
    },
    /// A library that reads the format panicked; the panic was caught. This is a defect, please
    /// report it with the file.
    #[error("{}: the reader failed on this file: {}; please report it", path.display(), sentence(reason))]
    Internal {
        /// The scene file.
        path: PathBuf,
        /// The message of the panic.
        reason: String,
    },
}

impl SceneError {
    /// Makes the error of an element of `path` that contradicts itself or the format.
    pub fn invalid(path: &Path, place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Invalid { path: path.to_owned(), place: place.into(), reason: reason.into() }
    }

    /// Makes the error of bytes of `path` that do not follow the grammar of its format.
    pub fn syntax(path: &Path, reason: impl Into<String>) -> Self {
        Self::Syntax { path: path.to_owned(), reason: reason.into() }
    }

    /// Makes the error of an amount that exceeds the limits of loading.
    pub fn too_large(
        path: &Path,
        what: impl Into<String>,
        found: u64,
        limit: u64,
        option: &'static str,
    ) -> Self {
        Self::TooLarge { path: path.to_owned(), what: what.into(), found, limit, option }
    }

    /// Turns the error of a file that `scene` refers to into an error of `scene`; the message names both.
    pub fn of_scene(self, scene: &Path) -> Self {
        let path = scene.to_owned();
        let below = |file: &Path, text: &str| format!("{}: {text}", file.display());
        match self {
            Self::Syntax { path: file, reason } => Self::Syntax { path, reason: below(&file, &reason) },
            Self::Invalid { path: file, place, reason } => {
                Self::Invalid { path, place: below(&file, &place), reason }
            }
            Self::UnsafeReference { path: file, place, uri, reason } => {
                Self::UnsafeReference { path, place: below(&file, &place), uri, reason }
            }
            Self::TooLarge { path: file, what, found, limit, option } => {
                Self::TooLarge { path, what: below(&file, &what), found, limit, option }
            }
            other => other,
        }
    }
}
