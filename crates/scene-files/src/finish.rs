//! Last step of every format.

use std::path::Path;

use rasray_scene::remarks::Remarks;
use rasray_scene::{Scene, SceneError};

/// Reason why a file shows no triangle.
pub(crate) enum Empty {
    /// The file has no triangles: it is still a scene, with a warning unless one says so already.
    Bare(String),
    /// The file has triangles, and all were dropped.
    Dropped(String),
}

/// Finishes a scene of any format: checks the scene as a whole, and turns the remarks into warnings. `empty`
/// is the reason to name if there are no triangles.
///
/// # Errors
/// [`SceneError::NoTriangles`] if all triangles were dropped.
pub(crate) fn finish(
    path: &Path,
    mut scene: Scene,
    mut remarks: Remarks,
    empty: impl FnOnce(&Remarks) -> Option<Empty>,
) -> Result<Scene, SceneError> {
    let placed = |instance: &rasray_scene::Instance| scene.meshes[instance.mesh].triangle_count() > 0;
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
    rasray_scene::check::textured(&scene, &mut remarks);
    scene.files = std::mem::take(&mut remarks.files);
    scene.warnings.extend(remarks.into_warnings());
    Ok(scene)
}

/// Returns the name of a scene that was read from `path`: the file's stem.
pub(crate) fn scene_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned())
}
