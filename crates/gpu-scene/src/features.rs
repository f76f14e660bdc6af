//! Parts of the shading code that a scene can use.

use rasray_shaders_glsl::constant_ids::scene as ids;
use rasray_shaders_glsl::constants::contract::DRAW_ALPHA_MASKED;
use rasray_shaders_glsl::constants::scene::{
    ATTRIBUTE_NONE, BSDF_SMOOTH_ROUGHNESS, ENVIRONMENT_CONSTANT, MATERIAL_ALPHA_BLEND, MATERIAL_UNLIT,
    TEXTURE_NONE,
};
use rasray_shaders_glsl::records::Material;

use crate::{SceneTables, TexelRuns};

/// Parts of the shading code that rays in a scene and its materials can use. Kernels leave the rest out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadingFeatures {
    /// True if any material refers to a texture.
    pub textures: bool,
    /// True if any material transmits.
    pub transmission: bool,
    /// True if any material blends.
    pub blend: bool,
    /// True if any material may be a smooth thin pane: it transmits, has no thickness and may be smooth.
    pub panes: bool,
    /// True if texels lie in several buffers.
    pub texel_runs: bool,
    /// True if any draw is alpha-masked.
    pub alpha_masks: bool,
    /// True if there is any light without extent.
    pub lights: bool,
    /// True if any triangle is sampled as a light.
    pub emitters: bool,
    /// True if the environment is a map, and not one radiance.
    pub environment_map: bool,
    /// True if any draw has vertex colours.
    pub colors: bool,
    /// True if any material reflects at facets: it is specular or metallic, or transmits.
    pub facets: bool,
    /// True if the facets of any material are rougher along one direction.
    pub anisotropy: bool,
}

impl ShadingFeatures {
    /// All features: a reference that proves that leaving code out does not change a picture.
    pub const ALL: Self = Self {
        textures: true,
        transmission: true,
        blend: true,
        panes: true,
        texel_runs: true,
        alpha_masks: true,
        lights: true,
        emitters: true,
        environment_map: true,
        colors: true,
        facets: true,
        anisotropy: true,
    };

    /// Returns the features of a scene whose texels are in runs of that length.
    pub(crate) fn of(tables: &SceneTables, runs: TexelRuns) -> Self {
        Self {
            textures: !tables.textures.is_empty(),
            transmission: tables.materials.iter().any(|material| material.transmission > 0.0),
            blend: tables.materials.iter().any(|material| material.flags & MATERIAL_ALPHA_BLEND != 0),
            panes: tables.materials.iter().any(may_be_pane),
            texel_runs: tables.texels.len() as u64 > runs.length(),
            alpha_masks: tables.posed.draws.iter().any(|draw| draw.flags & DRAW_ALPHA_MASKED != 0),
            lights: !tables.lights.is_empty(),
            emitters: !tables.emissive_triangles.is_empty(),
            environment_map: tables.environment.kind != ENVIRONMENT_CONSTANT,
            colors: tables.draw_shadings.iter().any(|draw| draw.colors != ATTRIBUTE_NONE),
            facets: tables.materials.iter().any(has_facets),
            anisotropy: tables.materials.iter().any(|material| material.anisotropy > 0.0),
        }
    }

    /// Returns each feature with its name.
    fn named(self) -> [(&'static str, bool); 12] {
        [
            ("textures", self.textures),
            ("transmission", self.transmission),
            ("blended materials", self.blend),
            ("smooth thin panes", self.panes),
            ("textures beyond one binding", self.texel_runs),
            ("alpha masks", self.alpha_masks),
            ("lights without extent", self.lights),
            ("surfaces that are sampled as lights", self.emitters),
            ("a map of the environment", self.environment_map),
            ("colours of vertices", self.colors),
            ("specular or metallic materials", self.facets),
            ("anisotropic materials", self.anisotropy),
        ]
    }

    /// Returns the names of the features of `other` that these lack.
    pub fn lacks(self, other: Self) -> Vec<&'static str> {
        let both = self.named().into_iter().zip(other.named());
        both.filter(|((_, here), (_, there))| *there && !here).map(|((name, _), _)| name).collect()
    }

    /// Returns the union of these features and those of `other`.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            textures: self.textures || other.textures,
            transmission: self.transmission || other.transmission,
            blend: self.blend || other.blend,
            panes: self.panes || other.panes,
            texel_runs: self.texel_runs || other.texel_runs,
            alpha_masks: self.alpha_masks || other.alpha_masks,
            lights: self.lights || other.lights,
            emitters: self.emitters || other.emitters,
            environment_map: self.environment_map || other.environment_map,
            colors: self.colors || other.colors,
            facets: self.facets || other.facets,
            anisotropy: self.anisotropy || other.anisotropy,
        }
    }

    /// Returns the specialisation constants of modules that read the scene (`scene/features.glsl`): id and
    /// bits. A module without one of them ignores it.
    pub fn constants(self) -> [(u32, u32); 10] {
        [
            (ids::SCENE_HAS_TEXTURES, self.textures.into()),
            (ids::SCENE_HAS_TRANSMISSION, self.transmission.into()),
            (ids::SCENE_HAS_BLEND, self.blend.into()),
            (ids::SCENE_HAS_TEXEL_RUNS, self.texel_runs.into()),
            (ids::SCENE_HAS_LIGHTS, self.lights.into()),
            (ids::SCENE_HAS_EMITTERS, self.emitters.into()),
            (ids::SCENE_HAS_ENVIRONMENT_MAP, self.environment_map.into()),
            (ids::SCENE_HAS_COLORS, self.colors.into()),
            (ids::SCENE_HAS_FACETS, self.facets.into()),
            (ids::SCENE_HAS_ANISOTROPY, self.anisotropy.into()),
        ]
    }
}

/// True if some point of a surface with this material reflects or transmits other than by its diffuse base.
fn has_facets(material: &Material) -> bool {
    let terms = [material.specular, material.metallic, material.transmission];
    material.flags & MATERIAL_UNLIT == 0 && terms.iter().any(|&term| term > 0.0)
}

/// True if some point of a surface with this material may be a smooth thin pane.
fn may_be_pane(material: &Material) -> bool {
    let may_be_smooth = material.roughness < BSDF_SMOOTH_ROUGHNESS
        || material.metallic_roughness_texture.texture != TEXTURE_NONE;
    let is_thin = material.transmission > 0.0 && material.thickness <= 0.0;
    is_thin && may_be_smooth && material.flags & MATERIAL_UNLIT == 0
}
