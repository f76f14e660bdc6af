//! Supported extensions, and remarks on the others.

use std::collections::BTreeSet;
use std::path::Path;

use ::gltf::json::Value;

use rasray_scene::SceneError;
use rasray_scene::remarks::Remarks;
use rasray_scene::text::shown;

/// Names of the extensions that are fully supported.
const SUPPORTED: [&str; 13] = [
    "EXT_mesh_gpu_instancing",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
    "KHR_texture_transform",
];

fn is_supported(name: &str) -> bool {
    #[cfg(feature = "meshopt")]
    if super::compression::EXTENSIONS.contains(&name) {
        return true;
    }
    SUPPORTED.contains(&name)
}

/// Refuses files that require an unsupported extension.
pub(super) fn check_required(path: &Path, tree: &Value) -> Result<(), SceneError> {
    let required = tree["extensionsRequired"].as_array().into_iter().flatten().filter_map(Value::as_str);
    match required.into_iter().find(|name| !is_supported(name)) {
        Some(name) => Err(SceneError::UnsupportedExtension {
            path: path.to_owned(),
            extension: name.to_owned(),
            fix: fix_for(name),
        }),
        None => Ok(()),
    }
}

/// Notes remarks on unsupported extensions that a file uses, declared or not.
pub(super) fn report<'a>(used: impl Iterator<Item = &'a String>, remarks: &mut Remarks) {
    let unsupported: BTreeSet<&String> = used.filter(|name| !is_supported(name)).collect();
    for name in unsupported {
        let text = format!("{} is used but not supported; the scene is shown without it", shown(name));
        remarks.note("unsupported-extension", "", text);
    }
}

/// Returns advice on getting rid of an extension.
fn fix_for(name: &str) -> &'static str {
    match name {
        "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
            "decompress the meshes first: npx @gltf-transform/cli copy in.glb out.glb"
        }
        "EXT_texture_webp" | "EXT_texture_avif" | "MSFT_texture_dds" => {
            "convert the images first: npx @gltf-transform/cli png in.glb out.glb"
        }
        "KHR_materials_pbrSpecularGlossiness" => {
            "convert the materials first: npx @gltf-transform/cli metalrough in.glb out.glb"
        }
        _ => "export the scene without it",
    }
}
