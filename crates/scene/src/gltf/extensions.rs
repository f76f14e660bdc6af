//! Which extensions are understood, and what is said of the others.

use std::path::Path;

use ::gltf::json::Root;

use crate::{SceneError, Warning};

/// Extensions that change the scene as they should.
const SUPPORTED: [&str; 10] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Refuses files that require what is not supported, and warns of all else that they use.
pub(super) fn check(path: &Path, root: &Root, warnings: &mut Vec<Warning>) -> Result<(), SceneError> {
    let unsupported = |name: &&String| !SUPPORTED.contains(&name.as_str());
    if let Some(name) = root.extensions_required.iter().find(unsupported) {
        return Err(SceneError::UnsupportedExtension {
            path: path.to_owned(),
            extension: name.clone(),
            fix: fix_for(name),
        });
    }
    for name in root.extensions_used.iter().filter(unsupported) {
        warnings.push(Warning {
            kind: "unsupported-extension",
            message: format!("{name} is used but not supported; the scene is shown without it"),
        });
    }
    Ok(())
}

/// How to get rid of an extension.
fn fix_for(name: &str) -> &'static str {
    match name {
        "KHR_draco_mesh_compression" | "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
            "decompress the meshes first: npx @gltf-transform/cli copy in.glb out.glb"
        }
        "KHR_texture_basisu" | "EXT_texture_webp" | "EXT_texture_avif" | "MSFT_texture_dds" => {
            "convert the images first: npx @gltf-transform/cli png in.glb out.glb"
        }
        "KHR_materials_pbrSpecularGlossiness" => {
            "convert the materials first: npx @gltf-transform/cli metalrough in.glb out.glb"
        }
        _ => "export the scene without it",
    }
}
