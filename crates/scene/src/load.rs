//! From a path to a [`Scene`].

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::remarks::Remarks;
use crate::{LoadOptions, Scene, SceneError};

/// Loads a scene from a file; the extension of its name decides the format: `.gltf`, `.glb`,
/// `.obj` or `.ply`, in any case.
///
/// A file name with a run of `#`, unless there is such a file, stands for numbered OBJ or PLY files that are one scene over
/// time: see [`crate::sequence::Sequence`].
///
/// Files may come from anywhere: whatever they hold, this returns. Triangles and attributes that
/// cannot be rendered are dropped, images that cannot be read are left out, and both are said in
/// [`Scene::warnings`]. A scene may be empty, with a warning that says why; a file with triangles of
/// which none is left is an error.
///
/// Names, warnings and errors hold the characters of the file, control characters included: escape
/// them before they are written to a terminal.
///
/// # Errors
/// [`SceneError`]: the file or one that it cannot be shown without cannot be read, exceeds a limit,
/// is no scene, contradicts its format, requires an extension that is not supported, or has
/// triangles of which none can be shown.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    if crate::sequence::is_pattern(path) {
        return crate::sequence::load(path, options);
    }
    load_file(path, options)
}

/// Loads one file.
pub(crate) fn load_file(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
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

/// Why a file shows no triangle.
pub(crate) enum Empty {
    /// It has none: a scene all the same, and a warning unless one says it already.
    Bare(String),
    /// It has some, and all were dropped.
    Dropped(String),
}

/// The last step of every format: what holds for the scene as a whole is checked, and what was remarked
/// becomes warnings. `empty` says why, should there be no triangle.
///
/// # Errors
/// [`SceneError::NoTriangles`] if all triangles were dropped.
pub(crate) fn finish(
    path: &Path,
    mut scene: Scene,
    mut remarks: Remarks,
    empty: impl FnOnce(&Remarks) -> Option<Empty>,
) -> Result<Scene, SceneError> {
    let placed = |instance: &crate::Instance| scene.meshes[instance.mesh].triangle_count() > 0;
    if !scene.instances.iter().any(placed) {
        match empty(&remarks) {
            Some(Empty::Dropped(reason)) => {
                return Err(SceneError::NoTriangles { path: path.to_owned(), reason });
            }
            Some(Empty::Bare(reason)) => {
                remarks.note("no-triangles", "", format!("{reason}; only the background is shown"));
            }
            None => {}
        }
    }
    crate::check::textured(&scene, &mut remarks);
    scene.files = std::mem::take(&mut remarks.files);
    scene.warnings.extend(remarks.into_warnings());
    Ok(scene)
}

/// The name of a scene that was read from `path`: the file's stem.
pub(crate) fn scene_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Reads a file that `place` of the scene at `path` refers to and cannot do without.
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
