//! Reading of the files of a scene.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use rasray_scene::SceneError;

/// Reads a file that `place` of the scene at `path` refers to and needs.
///
/// # Errors
/// [`SceneError::Missing`] and [`SceneError::TooLarge`], which name both files.
pub(crate) fn read_needed(path: &Path, place: &str, file: &Path, limit: u64) -> Result<Vec<u8>, SceneError> {
    read_file(file, limit).map_err(|error| match error {
        SceneError::Read { path: file, source } => {
            SceneError::Missing { path: path.to_owned(), place: place.to_owned(), file, source }
        }
        other => other.of_scene(path),
    })
}

/// Reads a whole file of at most `limit` bytes. The length is queried first; bytes that are added during the
/// reading are cut off by the same limit. Only regular files are opened: a pipe or a device could keep its
/// reader waiting for ever.
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
