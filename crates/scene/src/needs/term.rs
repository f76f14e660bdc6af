//! Parts of scenes that a render may or may not need.

/// Part of scenes that a render may or may not need.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Term {
    /// Shading normals of vertices.
    Normals,
    /// Tangents of vertices.
    Tangents,
    /// Texture coordinates of set 0.
    Uv0,
    /// Texture coordinates of set 1.
    Uv1,
    /// Colours of vertices.
    Colors,
    /// Base colour textures, read as colour. Textures of alpha masks come with [`Term::AlphaMask`].
    BaseColorTextures,
    /// Metallic-roughness textures.
    MetallicRoughnessTextures,
    /// Anisotropy textures.
    AnisotropyTextures,
    /// Normal maps.
    NormalTextures,
    /// Emission textures.
    EmissionTextures,
    /// Transmission textures.
    TransmissionTextures,
    /// Surfaces that emit light.
    Emission,
    /// Specular reflection, of metals and of dielectrics.
    Specular,
    /// Light that passes through surfaces.
    Transmission,
    /// Absorption inside of bodies.
    Volume,
    /// Alpha that is tested against a cutoff.
    AlphaMask,
    /// Partial opacity.
    AlphaBlend,
    /// Point lights.
    PointLights,
    /// Directional lights.
    DirectionalLights,
    /// Spot lights.
    SpotLights,
    /// Emissive triangles that are sampled as lights.
    AreaLights,
    /// Radiance that arrives from outside the scene.
    Environment,
    /// Geometry that changes with time.
    Motion,
}

impl Term {
    /// All terms, in the order that reports list them.
    pub const ALL: [Self; 23] = [
        Self::Normals,
        Self::Tangents,
        Self::Uv0,
        Self::Uv1,
        Self::Colors,
        Self::BaseColorTextures,
        Self::MetallicRoughnessTextures,
        Self::AnisotropyTextures,
        Self::NormalTextures,
        Self::EmissionTextures,
        Self::TransmissionTextures,
        Self::Emission,
        Self::Specular,
        Self::Transmission,
        Self::Volume,
        Self::AlphaMask,
        Self::AlphaBlend,
        Self::PointLights,
        Self::DirectionalLights,
        Self::SpotLights,
        Self::AreaLights,
        Self::Environment,
        Self::Motion,
    ];

    /// Name of the term in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Normals => "shading normals",
            Self::Tangents => "tangents",
            Self::Uv0 => "texture coordinates 0",
            Self::Uv1 => "texture coordinates 1",
            Self::Colors => "vertex colours",
            Self::BaseColorTextures => "base colour textures",
            Self::MetallicRoughnessTextures => "metallic-roughness textures",
            Self::AnisotropyTextures => "anisotropy textures",
            Self::NormalTextures => "normal maps",
            Self::EmissionTextures => "emission textures",
            Self::TransmissionTextures => "transmission textures",
            Self::Emission => "emission",
            Self::Specular => "specular reflection",
            Self::Transmission => "transmission",
            Self::Volume => "volumes",
            Self::AlphaMask => "alpha masks",
            Self::AlphaBlend => "alpha blending",
            Self::PointLights => "point lights",
            Self::DirectionalLights => "directional lights",
            Self::SpotLights => "spot lights",
            Self::AreaLights => "area lights",
            Self::Environment => "environment",
            Self::Motion => "motion",
        }
    }
}
