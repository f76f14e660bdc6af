//! From the MTL model of 1995 to metallic-roughness.

use super::mtl::MtlMaterial;
use super::textures::Textures;
use crate::default_view::plain_material;
use crate::remarks::Remarks;
use crate::{AlphaMode, Material, SceneError};

/// Translates a material by the table at [`crate::obj`].
pub(super) fn translate(
    found: &MtlMaterial,
    textures: &mut Textures<'_>,
    remarks: &mut Remarks,
) -> Result<Material, SceneError> {
    let mut material = plain_material(&found.name);
    let unit = |color: [f32; 3]| color.map(|channel| channel.clamp(0.0, 1.0));
    if let Some(diffuse) = found.diffuse {
        material.base_color[..3].copy_from_slice(&unit(diffuse));
    }
    material.roughness = roughness(found.shininess.unwrap_or(0.0));
    material.ior = found.refraction.filter(|ior| (1.0..=10.0).contains(ior)).unwrap_or(1.5);

    let specular = unit(found.specular.unwrap_or([0.0; 3]));
    let strength = specular.into_iter().fold(0.0, f32::max);
    material.specular = strength;
    if strength > 0.0 {
        material.specular_color = specular.map(|channel| channel / strength);
    }

    let mut emission = found.emission.unwrap_or([0.0; 3]).map(|channel| channel.max(0.0));
    if let Some(map) = &found.emission_map {
        material.emission_texture = textures.color(map, remarks)?;
        if material.emission_texture.is_some() && emission == [0.0; 3] {
            emission = [1.0; 3];
        }
    }
    material.emission = emission;

    let opacity = found.opacity.unwrap_or(1.0).clamp(0.0, 1.0);
    match found.illumination {
        Some(illumination @ (4 | 6 | 7 | 9)) => {
            material.transmission = 1.0;
            material.base_color[..3].copy_from_slice(&unit(found.filter.unwrap_or([1.0; 3])));
            // Any thickness above 0 says: a solid body. Its extent follows from the surface.
            material.thickness = if matches!(illumination, 6 | 7) { 1.0 } else { 0.0 };
            if strength == 0.0 {
                material.specular = 1.0;
            }
            if found.shininess.is_none_or(|shininess| shininess <= 0.0) {
                material.roughness = 0.0;
            }
        }
        Some(3 | 5 | 8) if strength > 0.0 && material.base_color[..3] == [0.0; 3] => {
            material.metallic = 1.0;
            material.base_color[..3].copy_from_slice(&specular);
            if found.shininess.is_none() {
                material.roughness = 0.0;
            }
        }
        _ if opacity < 1.0 => {
            material.alpha_mode = AlphaMode::Blend;
            material.base_color[3] = opacity;
        }
        _ => {}
    }

    material.base_color_texture = textures.base_color(found, remarks)?;
    if material.base_color_texture.is_some() {
        if found.opacity_map.is_some() && textures.has_mask(found) {
            material.alpha_mode = AlphaMode::Mask { cutoff: 0.5 };
            material.base_color[3] = 1.0;
        }
        if material.base_color[..3] == [0.0; 3] && found.diffuse_map.is_some() {
            material.base_color[..3].copy_from_slice(&[1.0; 3]);
            let text = "has a black Kd with a map_Kd; Kd was taken as white";
            remarks.note("black-diffuse", format!("material {}", found.name), text);
        }
    }
    if let Some(map) = &found.normal_map {
        material.normal_texture = textures.color(map, remarks)?;
    }
    Ok(material)
}

/// Perceptual roughness of a Phong exponent, in (0, 1].
fn roughness(shininess: f32) -> f32 {
    (2.0 / (shininess.max(0.0) + 2.0)).sqrt().sqrt()
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::roughness;

    #[test]
    fn roughness_falls_with_the_exponent() {
        assert_eq!(roughness(0.0), 1.0);
        assert_eq!(roughness(-5.0), 1.0);
        // alpha^2 = 2 / 32 = 1/16, alpha = 1/4, perceptual 1/2.
        assert_abs_diff_eq!(roughness(30.0), 0.5, epsilon = 1.0e-6);
        assert!(roughness(1.0e9) < 0.01 && roughness(f32::MAX) >= 0.0);
    }
}
