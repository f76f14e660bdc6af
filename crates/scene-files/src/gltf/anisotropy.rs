//! `KHR_materials_anisotropy`: roughness along one direction.

use ::gltf::json::deserialize::from_value;
use ::gltf::json::material::Material as JsonMaterial;
use ::gltf::json::texture::Info;
use ::gltf::json::{Error, Value};

/// Anisotropy of a material, after the checks.
pub(super) struct Anisotropy {
    pub strength: f32,
    /// Rotation of the direction, radians.
    pub rotation: f32,
    pub texture: Option<Info>,
}

/// Reads the extension of a material, which the typed tree keeps as plain JSON.
pub(super) fn anisotropy(source: &JsonMaterial) -> Result<Option<Anisotropy>, Error> {
    let extensions = source.extensions.as_ref();
    let Some(found) = extensions.and_then(|found| found.others.get("KHR_materials_anisotropy")) else {
        return Ok(None);
    };
    let number = |name: &str| found.get(name).and_then(Value::as_f64).unwrap_or_default() as f32;
    let texture = found.get("anisotropyTexture").map(|info| from_value(info.clone())).transpose()?;
    Ok(Some(Anisotropy {
        strength: number("anisotropyStrength"),
        rotation: number("anisotropyRotation"),
        texture,
    }))
}
