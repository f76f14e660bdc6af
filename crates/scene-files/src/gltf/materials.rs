//! Materials that meshes of the scene use, with values in their ranges.

use ::gltf::json::material::{AlphaMode as JsonAlphaMode, Material as JsonMaterial};
use ::gltf::json::validation::Checked;

use super::anisotropy::{Anisotropy, anisotropy};
use super::document::Document;
use super::textures::{TextureReader, Use};
use rasray_scene::{AlphaMode, Material, Scene, SceneError};

/// Converts the materials that `scene.meshes` use, in the order of the file, and makes
/// `Mesh::material` refer to them.
pub(super) fn convert(document: &Document<'_>, scene: &mut Scene) -> Result<(), SceneError> {
    let materials = &document.root.materials;
    let mut converted = vec![None; materials.len() + 1];
    for mesh in &scene.meshes {
        converted[mesh.material] = Some(0);
    }
    let mut textures = TextureReader::new(document);
    for (i, slot) in converted.iter_mut().enumerate().filter(|(_, slot)| slot.is_some()) {
        *slot = Some(scene.materials.len());
        scene.materials.push(match materials.get(i) {
            Some(material) => convert_one(document, i, material, &mut textures)?,
            None => Material { culls_back: true, ..Material::default() },
        });
    }
    for mesh in &mut scene.meshes {
        mesh.material =
            converted[mesh.material].expect("every material that a mesh uses was converted above");
    }
    if scene.materials.is_empty() {
        scene.materials.push(Material::default());
    }
    scene.textures = textures.textures;
    scene.images = textures.images;
    Ok(())
}

fn convert_one(
    document: &Document<'_>,
    index: usize,
    source: &JsonMaterial,
    textures: &mut TextureReader<'_, '_>,
) -> Result<Material, SceneError> {
    let place = format!("materials[{index}]");
    let base = &source.pbr_metallic_roughness;
    let mut material = Material {
        name: source.name.clone().unwrap_or_else(|| format!("material{index}")),
        double_sided: source.double_sided,
        ..Material::default()
    };
    let mut range = Range { place: &place, out: Vec::new() };
    material.base_color = base.base_color_factor.0.map(|x| range.unit("baseColorFactor", x));
    material.metallic = range.unit("metallicFactor", base.metallic_factor.0);
    material.roughness = range.unit("roughnessFactor", base.roughness_factor.0);
    let strength = extension(source, |found| found.emissive_strength.as_ref())
        .map_or(1.0, |found| found.emissive_strength.0);
    material.emission =
        source.emissive_factor.0.map(|x| range.clamp("emissiveFactor", x * strength, 0.0, f32::MAX));
    material.alpha_mode = match source.alpha_mode {
        Checked::Valid(JsonAlphaMode::Mask) => AlphaMode::Mask {
            cutoff: match source.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0) {
                // No alpha is above 1, but for rounding: as the format says, no point is shown.
                cutoff if cutoff > 1.0 => f32::INFINITY,
                cutoff => range.clamp("alphaCutoff", cutoff, 0.0, 1.0),
            },
        },
        Checked::Valid(JsonAlphaMode::Blend) => AlphaMode::Blend,
        _ => AlphaMode::Opaque,
    };
    scalar_extensions(source, &mut material, &mut range);
    let anisotropy = anisotropy(source)
        .map_err(|_| document.invalid(format!("{place}.anisotropyTexture"), "has a malformed transform"))?;
    if let Some(found) = &anisotropy {
        material.anisotropy = range.unit("anisotropyStrength", found.strength);
        material.anisotropy_rotation = range.clamp("anisotropyRotation", found.rotation, -1.0e6, 1.0e6);
    }
    // Boundaries of volumes have both sides, whatever the file says (KHR_materials_volume).
    material.culls_back = !source.double_sided && material.thickness == 0.0;
    range.report(document);

    let mut read = |wanted: Option<Use<'_>>| match wanted {
        Some(wanted) => textures.read(&place, wanted),
        None => Ok(None),
    };
    material.base_color_texture = read(base.base_color_texture.as_ref().map(Into::into))?;
    material.metallic_roughness_texture = read(base.metallic_roughness_texture.as_ref().map(Into::into))?;
    material.emission_texture = read(source.emissive_texture.as_ref().map(Into::into))?;
    let transmission = extension(source, |found| found.transmission.as_ref());
    material.transmission_texture =
        read(transmission.and_then(|found| found.transmission_texture.as_ref()).map(Into::into))?;
    if let Some(Anisotropy { texture: Some(info), .. }) = &anisotropy {
        material.anisotropy_texture = read(Some(info.into()))?;
    }
    if let Some(normal) = &source.normal_texture {
        let wanted = Use::of_normal(normal)
            .map_err(|_| document.invalid(format!("{place}.normalTexture"), "has a malformed transform"))?;
        material.normal_texture = read(Some(wanted))?;
        material.normal_scale = if normal.scale.is_finite() { normal.scale } else { 1.0 };
    }
    unused_textures(document, &place, source);
    Ok(material)
}

type Extensions = ::gltf::json::extensions::material::Material;

fn extension<'a, T>(
    source: &'a JsonMaterial,
    pick: impl Fn(&'a Extensions) -> Option<&'a T>,
) -> Option<&'a T> {
    source.extensions.as_ref().and_then(pick)
}

/// Reads transmission, volume, index of refraction, specular and unlit.
fn scalar_extensions(source: &JsonMaterial, material: &mut Material, range: &mut Range<'_>) {
    let Some(extensions) = &source.extensions else { return };
    material.unlit = extensions.unlit.is_some();
    if let Some(transmission) = &extensions.transmission {
        material.transmission = range.unit("transmissionFactor", transmission.transmission_factor.0);
    }
    if let Some(ior) = &extensions.ior {
        material.ior = range.clamp("ior", ior.ior.0, 1.0, 1e3);
    }
    if let Some(volume) = &extensions.volume {
        material.thickness = range.clamp("thicknessFactor", volume.thickness_factor.0, 0.0, f32::MAX);
        material.attenuation_color = volume.attenuation_color.0.map(|x| range.unit("attenuationColor", x));
        let distance = volume.attenuation_distance.0;
        material.attenuation_distance = if distance > 0.0 {
            distance
        } else {
            range.out.push(format!("attenuationDistance {distance}"));
            f32::INFINITY
        };
    }
    if let Some(specular) = &extensions.specular {
        material.specular = range.unit("specularFactor", specular.specular_factor.0);
        material.specular_color =
            specular.specular_color_factor.0.map(|x| range.clamp("specularColorFactor", x, 0.0, f32::MAX));
    }
}

/// Notes remarks on textures that the material model does not have.
fn unused_textures(document: &Document<'_>, place: &str, source: &JsonMaterial) {
    let volume = extension(source, |found| found.volume.as_ref());
    let specular = extension(source, |found| found.specular.as_ref());
    let unused = [
        ("thicknessTexture", volume.is_some_and(|found| found.thickness_texture.is_some())),
        ("specularTexture", specular.is_some_and(|found| found.specular_texture.is_some())),
        ("specularColorTexture", specular.is_some_and(|found| found.specular_color_texture.is_some())),
    ];
    for (name, _) in unused.iter().filter(|(_, used)| *used) {
        document.note("unused-texture", place, format!("{name} is not supported; its factor is used alone"));
    }
    if source.occlusion_texture.is_some() {
        let text = "occlusionTexture is not used: what surfaces hide from each other is traced";
        document.note("unused-texture", place, text);
    }
}

/// Clamps numbers to their ranges and remembers which were outside.
struct Range<'a> {
    place: &'a str,
    out: Vec<String>,
}

impl Range<'_> {
    fn unit(&mut self, name: &'static str, x: f32) -> f32 {
        self.clamp(name, x, 0.0, 1.0)
    }

    fn clamp(&mut self, name: &'static str, x: f32, low: f32, high: f32) -> f32 {
        if (low..=high).contains(&x) {
            return x;
        }
        self.out.push(format!("{name} {x}"));
        if x.is_nan() { low } else { x.clamp(low, high) }
    }

    fn report(mut self, document: &Document<'_>) {
        self.out.dedup();
        if !self.out.is_empty() {
            document.note(
                "material-range",
                self.place,
                format!("brought into range: {}", self.out.join(", ")),
            );
        }
    }
}
