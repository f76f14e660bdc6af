//! Parts of a scene that are packed.

use rasray_scene::needs::{Needs, Term};

/// Kinds of textures, in the order of `Material`'s texture fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureKind {
    /// Base colour and alpha.
    BaseColor,
    /// Metallic and roughness.
    MetallicRoughness,
    /// Direction and strength of anisotropy.
    Anisotropy,
    /// Tangent-space normals.
    Normal,
    /// Emission.
    Emission,
    /// Transmission.
    Transmission,
}

/// Parts of a scene that are packed and uploaded. An omitted part reads as absent: no attribute, no texture,
/// no light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// Shading normals.
    pub normals: bool,
    /// Tangents.
    pub tangents: bool,
    /// Texture coordinates of set 0 and set 1.
    pub uvs: [bool; 2],
    /// Vertex colours.
    pub colors: bool,
    /// Base colour textures. Those of alpha-masked materials are packed whenever `alpha` is on.
    pub base_color_textures: bool,
    /// Metallic-roughness textures.
    pub metallic_roughness_textures: bool,
    /// Anisotropy textures.
    pub anisotropy_textures: bool,
    /// Normal maps.
    pub normal_textures: bool,
    /// Emission textures.
    pub emission_textures: bool,
    /// Transmission textures.
    pub transmission_textures: bool,
    /// Tables of the light that rough glass loses in one scattering.
    pub glass_albedos: bool,
    /// Alpha masks. If false, masked draws count as opaque everywhere.
    pub alpha: bool,
    /// Point, directional and spot lights.
    pub lights: bool,
    /// Emissive triangles that are sampled as lights.
    pub emissive_triangles: bool,
    /// The environment.
    pub environment: bool,
}

impl Parts {
    /// All parts of the scene.
    pub const ALL: Self = Self {
        normals: true,
        tangents: true,
        uvs: [true; 2],
        colors: true,
        base_color_textures: true,
        metallic_roughness_textures: true,
        anisotropy_textures: true,
        normal_textures: true,
        emission_textures: true,
        transmission_textures: true,
        glass_albedos: true,
        alpha: true,
        lights: true,
        emissive_triangles: true,
        environment: true,
    };

    /// Geometry and alpha masks: the parts that visibility rays observe.
    pub const VISIBILITY: Self = Self {
        normals: false,
        tangents: false,
        uvs: [true; 2],
        colors: true,
        base_color_textures: false,
        metallic_roughness_textures: false,
        anisotropy_textures: false,
        normal_textures: false,
        emission_textures: false,
        transmission_textures: false,
        glass_albedos: false,
        alpha: true,
        lights: false,
        emissive_triangles: false,
        environment: false,
    };

    /// True if textures of a kind are packed for a material; `masked` says if it is alpha-masked.
    pub fn has_texture(&self, kind: TextureKind, masked: bool) -> bool {
        match kind {
            TextureKind::BaseColor => self.base_color_textures || (masked && self.alpha),
            TextureKind::MetallicRoughness => self.metallic_roughness_textures,
            TextureKind::Anisotropy => self.anisotropy_textures,
            TextureKind::Normal => self.normal_textures,
            TextureKind::Emission => self.emission_textures,
            TextureKind::Transmission => self.transmission_textures,
        }
    }
}

impl From<&Needs> for Parts {
    /// Returns the parts that a render can observe. `Needs::all` gives [`Parts::ALL`].
    fn from(needs: &Needs) -> Self {
        let has = |term| needs.requires(term);
        Self {
            normals: has(Term::Normals),
            tangents: has(Term::Tangents),
            uvs: [has(Term::Uv0), has(Term::Uv1)],
            colors: has(Term::Colors),
            base_color_textures: has(Term::BaseColorTextures),
            metallic_roughness_textures: has(Term::MetallicRoughnessTextures),
            anisotropy_textures: has(Term::AnisotropyTextures),
            normal_textures: has(Term::NormalTextures),
            emission_textures: has(Term::EmissionTextures),
            transmission_textures: has(Term::TransmissionTextures),
            glass_albedos: has(Term::Transmission),
            alpha: has(Term::AlphaMask),
            lights: has(Term::PointLights) || has(Term::DirectionalLights) || has(Term::SpotLights),
            emissive_triangles: has(Term::AreaLights),
            environment: has(Term::Environment),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_needs_are_all_parts() {
        assert_eq!(Parts::from(&Needs::all()), Parts::ALL);
    }
}
