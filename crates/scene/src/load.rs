//! From a path to a [`Scene`].

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::{LoadOptions, Scene, SceneError};

/// Loads a scene from a file; the extension of its name decides the format: `.gltf`, `.glb`,
/// `.obj` or `.ply`, in any case.
///
/// Files may come from anywhere: whatever they hold, this returns. Triangles and attributes that
/// cannot be rendered are dropped, each kind counted in [`Scene::warnings`].
///
/// # Errors
/// [`SceneError`]: the file or one it refers to cannot be read, exceeds a limit, contradicts its
/// format, or requires an extension that is not supported.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let extension = path.extension().and_then(|text| text.to_str()).unwrap_or_default().to_ascii_lowercase();
    let scene = match extension.as_str() {
        "gltf" | "glb" => crate::gltf::load(path, options),
        "obj" => crate::obj::load(path, options),
        "ply" => crate::ply::load(path, options),
        _ => Err(SceneError::UnknownFormat { path: path.to_owned() }),
    }?;
    for warning in &scene.warnings {
        tracing::warn!(kind = warning.kind, file = %path.display(), "{}", warning.message);
    }
    Ok(scene)
}

/// The name of a scene that was read from `path`: the file's stem.
pub(crate) fn scene_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Reads a whole file of at most `limit` bytes. The length is asked for first; what grows while it
/// is read is cut off by the same limit. Only regular files are opened: a pipe or a device could
/// keep its reader waiting for ever.
///
/// # Errors
/// [`SceneError::Read`], or [`SceneError::TooLarge`] naming `file_bytes`.
pub(crate) fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, SceneError> {
    let failed = |source| SceneError::Read { path: path.to_owned(), source };
    if !std::fs::metadata(path).map_err(failed)?.is_file() {
        let reason = "it is not a regular file but a folder, a pipe, a socket or a device";
        return Err(failed(std::io::Error::new(std::io::ErrorKind::InvalidInput, reason)));
    }
    let file = File::open(path).map_err(failed)?;
    let length = file.metadata().map_err(failed)?.len();
    crate::Limits::check(path, "the size in bytes", length, limit, "file_bytes")?;
    let mut bytes = Vec::new();
    bytes
        .try_reserve_exact(usize::try_from(length).unwrap_or(usize::MAX))
        .map_err(|_| SceneError::too_large(path, "the size in bytes", length, limit, "file_bytes"))?;
    file.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(failed)?;
    crate::Limits::check(path, "the size in bytes", bytes.len() as u64, limit, "file_bytes")?;
    Ok(bytes)
}
