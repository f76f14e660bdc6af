//! Translation from the MTL model of 1995 to metallic-roughness.

use super::mtl::MtlMaterial;
use super::textures::Textures;
use rasray_scene::default_view::plain_material;
use rasray_scene::remarks::Remarks;
use rasray_scene::{AlphaMode, Material, SceneError};

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
    note_ranges(found, remarks);

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
        Some(illumination @ (4 | 6 | 7 | 9)) if is_glass(found) => {
            note_glass(found, remarks);
            material.transmission = 1.0;
            material.base_color[..3].copy_from_slice(&unit(found.filter.unwrap_or([1.0; 3])));
            // Any thickness above 0 means a solid body. Its extent follows from the surface.
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
        _ => {}
    }
    // Reflection needs an index above 1: exporters that mean refraction alone write 1.
    if material.transmission == 0.0 && strength > 0.0 && material.ior <= 1.0 {
        material.ior = 1.5;
    }
    if material.transmission == 0.0 && opacity < 1.0 {
        material.alpha_mode = AlphaMode::Blend;
        material.base_color[3] = opacity;
    }
    // Exporters write black and white by default.
    let says = |filter: [f32; 3]| ![[0.0; 3], [1.0; 3]].contains(&unit(filter));
    if material.transmission == 0.0 && found.filter.is_some_and(says) {
        let text = "is no glass, and its Tf is not shown: that takes illum 4, 6, 7 or 9 and an Ni above 1";
        remarks.note("transparency", format!("material {}", found.name), text);
    }
    // The metallic-roughness numbers that some exporters add describe the material better.
    if let Some(metallic) = found.metallic {
        material.metallic = metallic.clamp(0.0, 1.0);
    }
    if let Some(roughness) = found.roughness {
        material.roughness = roughness.clamp(0.0, 1.0);
    }

    if let Some((texture, is_cut)) = textures.base_color(found, remarks)? {
        material.base_color_texture = Some(texture);
        if is_cut {
            if opacity < 1.0 {
                let text = "has a d or Tr beside a map_d, which alone cuts it";
                remarks.note("transparency", format!("material {}", found.name), text);
            }
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
        material.normal_scale = map.strength;
    }
    if found.has_ambient_map && found.diffuse_map.is_none() {
        let text = "has a map_Ka and no map_Kd; write map_Kd, ambient light is computed";
        remarks.note("ambient-map", format!("material {}", found.name), text);
    }
    Ok(material)
}

/// True if a material with an `illum` of transparency is glass, by the rule in [`crate::obj`].
fn is_glass(found: &MtlMaterial) -> bool {
    let has_color = found.diffuse_map.is_some() || found.diffuse.is_some_and(|color| color != [0.0; 3]);
    let bends = found.refraction.map(|ior| ior > 1.0);
    let fades = found.opacity.is_some_and(|opacity| opacity > 0.0 && opacity < 1.0);
    match found.filter {
        Some(filter) if filter.iter().all(|channel| *channel <= 0.0) => false,
        Some(_) => !has_color || bends != Some(false),
        None => !has_color || bends == Some(true) && !fades,
    }
}

/// Notes remarks on properties of a glass that are not shown.
fn note_glass(found: &MtlMaterial, remarks: &mut Remarks) {
    let has_color = found.diffuse.is_some_and(|color| color != [0.0; 3]);
    let fades = found.opacity.is_some_and(|opacity| opacity > 0.0 && opacity < 1.0);
    let lost = match (has_color, fades) {
        (false, false) => return,
        (true, false) => "Kd is",
        (false, true) => "d is",
        (true, true) => "Kd and d are",
    };
    let text = format!("is glass, coloured by Tf alone: its {lost} not shown");
    remarks.note("transparency", format!("material {}", found.name), text);
}

/// Notes remarks on numbers outside the range of a material.
fn note_ranges(found: &MtlMaterial, remarks: &mut Remarks) {
    let place = format!("material {}", found.name);
    let mut note = |what: &str, value: f32, range: &str, then: &str| {
        remarks.note("material-range", &place, format!("{what} is {value}, not {range}; it was {then}"));
    };
    let beyond = |low: f32, high: f32| move |value: &f32| !(low..=high).contains(value);
    for (what, color) in [("Kd", found.diffuse), ("Ks", found.specular), ("Tf", found.filter)] {
        if let Some(value) = color.and_then(|color| color.into_iter().find(beyond(0.0, 1.0))) {
            note(what, value, "from 0 to 1", "brought into that range");
        }
    }
    for (what, value) in [("d or 1 - Tr", found.opacity), ("Pm", found.metallic), ("Pr", found.roughness)] {
        if let Some(value) = value.filter(beyond(0.0, 1.0)) {
            note(what, value, "from 0 to 1", "brought into that range");
        }
    }
    if let Some(value) = found.emission.and_then(|color| color.into_iter().find(|value| *value < 0.0)) {
        note("Ke", value, "at least 0", "brought into that range");
    }
    if let Some(value) = found.refraction.filter(beyond(1.0, 10.0)) {
        note("Ni", value, "from 1 to 10", "taken as 1.5");
    }
}

/// Returns the perceptual roughness of a Phong exponent, in (0, 1].
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
