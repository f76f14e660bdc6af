//! The formats of files, by the extension of their names.

use std::path::Path;

use crate::{LoadOptions, Scene, SceneError};

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
