//! Lights of `KHR_lights_punctual` as the file has them.

use ::gltf::json::Root;
use ::gltf::json::extensions::scene::khr_lights_punctual::Light;

/// Returns the lights of a file.
pub(super) fn lights(root: &Root) -> &[Light] {
    root.extensions
        .as_ref()
        .and_then(|found| found.khr_lights_punctual.as_ref())
        .map_or(&[], |found| &found.lights)
}
