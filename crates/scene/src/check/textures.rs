//! Remarks on textures of meshes without matching coordinates.

use super::place::place;
use crate::remarks::Remarks;
use crate::{Material, Scene, TextureRef};

/// Notes a remark on every mesh without the coordinates that a texture of its material needs.
pub fn textured(scene: &Scene, remarks: &mut Remarks) {
    for mesh in &scene.meshes {
        let Some(material) = scene.materials.get(mesh.material) else { continue };
        for (what, texture) in textures(material) {
            let Some(TextureRef { uv_set, .. }) = texture else { continue };
            if mesh.uvs.get(uv_set as usize).is_none_or(Option::is_none) {
                // A tangent is derived from coordinates unless the mesh has its own.
                let is_laid = ["normal map", "anisotropy texture"].contains(&what);
                let flat = is_laid && mesh.tangents.is_none();
                let effect =
                    if flat { "it has no effect" } else { "the same texel of it is used everywhere" };
                remarks.note(
                    "texture-without-coordinates",
                    place(mesh),
                    format!(
                        "its material has a {what}, but it has no texture coordinates {uv_set}: {effect}"
                    ),
                );
            }
        }
    }
}

/// Returns the textures of a material with their names.
fn textures(material: &Material) -> [(&'static str, Option<TextureRef>); 6] {
    [
        ("base colour texture", material.base_color_texture),
        ("metallic-roughness texture", material.metallic_roughness_texture),
        ("anisotropy texture", material.anisotropy_texture),
        ("normal map", material.normal_texture),
        ("emission texture", material.emission_texture),
        ("transmission texture", material.transmission_texture),
    ]
}
