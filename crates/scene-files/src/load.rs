//! From a path to a [`Scene`].

use std::path::Path;

use crate::LoadOptions;
use crate::formats::load_file;
use crate::origin::Origins;
use rasray_scene::{Scene, SceneError};

/// Loads a scene from a file; the extension of its name decides the format: `.gltf`, `.glb`,
/// `.obj` or `.ply`, in any case.
///
/// A file name with a run of `#`, unless there is such a file, stands for numbered OBJ or PLY files that are
/// one scene over time: see [`crate::sequence::Sequence`].
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
    load_file(path, options, Origins::Own)
}
