//! Materials as the shaders read them.

use rasray_scene::{AlphaMode, Scene, TextureRef};
use rasray_shaders_glsl::constants::scene::{
    ATTRIBUTE_NONE, MATERIAL_ALPHA_BLEND, MATERIAL_ALPHA_MASK, MATERIAL_DOUBLE_SIDED, MATERIAL_UNLIT,
};

use crate::{
    GpuSceneError, Parts,
    layout::Material,
    mips::Encoding,
    parts::TextureKind,
    textures::{TexturePacker, Textures},
};

/// Packs all materials and the textures that they use.
///
/// # Errors
/// Errors of [`TexturePacker`].
pub fn pack_materials(scene: &Scene, parts: &Parts) -> Result<(Vec<Material>, Textures), GpuSceneError> {
    let (materials, textures) = collect_materials(scene, parts)?;
    Ok((materials, textures.finish()?))
}

/// Packs all materials and notes the textures that they use.
///
/// # Errors
/// `Malformed` where a texture does not exist.
pub fn collect_materials<'a>(
    scene: &'a Scene,
    parts: &Parts,
) -> Result<(Vec<Material>, TexturePacker<'a>), GpuSceneError> {
    let mut textures = TexturePacker::new(scene);
    let mut materials = Vec::with_capacity(scene.materials.len());
    for material in &scene.materials {
        materials.push(pack(material, parts, &mut textures)?);
    }
    Ok((materials, textures))
}

fn pack(
    material: &rasray_scene::Material,
    parts: &Parts,
    textures: &mut TexturePacker<'_>,
) -> Result<Material, GpuSceneError> {
    let (alpha_flag, alpha_cutoff) = match material.alpha_mode {
        AlphaMode::Opaque => (0, 0.0),
        AlphaMode::Mask { cutoff } if parts.alpha => (MATERIAL_ALPHA_MASK, cutoff),
        AlphaMode::Mask { .. } => (0, 0.0),
        AlphaMode::Blend => (MATERIAL_ALPHA_BLEND, 0.0),
    };
    let masked = alpha_flag == MATERIAL_ALPHA_MASK;
    let mut slot = |kind: TextureKind, reference: &Option<TextureRef>, encoding: Encoding| {
        textures.texture_use(reference.as_ref().filter(|_| parts.has_texture(kind, masked)), encoding)
    };
    Ok(Material {
        base_color: material.base_color,
        emission: material.emission,
        metallic: material.metallic,
        roughness: material.roughness,
        transmission: material.transmission,
        ior: material.ior,
        thickness: material.thickness,
        attenuation_color: material.attenuation_color,
        attenuation_distance: material.attenuation_distance,
        specular_color: material.specular_color,
        specular: material.specular,
        normal_scale: material.normal_scale,
        alpha_cutoff,
        flags: alpha_flag
            | if material.double_sided { MATERIAL_DOUBLE_SIDED } else { 0 }
            | if material.unlit { MATERIAL_UNLIT } else { 0 },
        albedo: ATTRIBUTE_NONE,
        anisotropy: material.anisotropy,
        anisotropy_rotation: {
            let (sine, cosine) = material.anisotropy_rotation.sin_cos();
            [cosine, sine]
        },
        base_color_texture: slot(TextureKind::BaseColor, &material.base_color_texture, Encoding::Srgb)?,
        metallic_roughness_texture: slot(
            TextureKind::MetallicRoughness,
            &material.metallic_roughness_texture,
            Encoding::Linear,
        )?,
        normal_texture: slot(TextureKind::Normal, &material.normal_texture, Encoding::Linear)?,
        emission_texture: slot(TextureKind::Emission, &material.emission_texture, Encoding::Srgb)?,
        transmission_texture: slot(
            TextureKind::Transmission,
            &material.transmission_texture,
            Encoding::Linear,
        )?,
        anisotropy_texture: slot(TextureKind::Anisotropy, &material.anisotropy_texture, Encoding::Linear)?,
    })
}
