//! Choice of the file format by the extension of the name.

use std::path::Path;

use crate::LoadOptions;
use crate::origin::Origins;
use rasray_scene::{Scene, SceneError};

/// Loads one file. `origins` concerns formats that place meshes by origins.
pub(crate) fn load_file(
    path: &Path,
    options: &LoadOptions,
    origins: Origins<'_>,
) -> Result<Scene, SceneError> {
    let extension = path.extension().and_then(|text| text.to_str()).unwrap_or_default().to_ascii_lowercase();
    let scene = match extension.as_str() {
        "gltf" | "glb" => crate::gltf::load(path, options),
        "obj" => crate::obj::load_placed(path, options, origins),
        "ply" => crate::ply::load_placed(path, options, origins),
        _ => Err(SceneError::UnknownFormat { path: path.to_owned() }),
    }?;
    for warning in &scene.warnings {
        tracing::warn!(kind = warning.kind, file = %path.display(), "{}", warning.message);
    }
    Ok(scene)
}
