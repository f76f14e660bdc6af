//! Loading of a [`Scene`] from a path.

use std::path::Path;

use crate::LoadOptions;
use crate::formats::load_file;
use crate::origin::Origins;
use rasray_scene::{Scene, SceneError};

/// Loads a scene from a file; the extension of its name decides the format: `.gltf`, `.glb`,
/// `.obj` or `.ply`, in any case.
///
/// A file name with a run of `#` stands for numbered OBJ or PLY files that form one scene over time, unless
/// there is a file with just that name: see [`crate::sequence::Sequence`].
///
/// Files may come from anywhere: with any content, the function returns. Triangles and attributes that cannot
/// be rendered are dropped, images that cannot be read are left out, and [`Scene::warnings`] reports both. A
/// scene may be empty, with a warning that says why; a file with triangles of which none is left is an error.
///
/// Names, warnings and errors hold the characters of the file, control characters included: escape them
/// before writing them to a terminal.
///
/// # Errors
/// [`SceneError`]: the file or one that it needs cannot be read, exceeds a limit, is no scene, contradicts
/// its format, requires an extension that is not supported, or has triangles of which none can be shown.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    if crate::sequence::is_pattern(path) {
        return crate::sequence::load(path, options);
    }
    load_file(path, options, Origins::Own)
}
