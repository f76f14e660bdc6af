//! Textures of a material that a workload reads.

use super::workload::Workload;
use crate::{AlphaMode, Material, TextureRef};

/// Textures of a material by the purpose for which a workload reads them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reads<'a> {
    /// Base colour texture, read as colour or for partial opacity.
    pub base_color: Option<&'a TextureRef>,
    /// Base colour texture, read for its alpha against a cutoff.
    pub mask: Option<&'a TextureRef>,
    pub metallic_roughness: Option<&'a TextureRef>,
    pub anisotropy: Option<&'a TextureRef>,
    pub normal: Option<&'a TextureRef>,
    pub emission: Option<&'a TextureRef>,
    pub transmission: Option<&'a TextureRef>,
}

impl<'a> Reads<'a> {
    pub fn of(material: &'a Material, workload: Workload) -> Self {
        let shaded = workload.shades && !material.unlit;
        let scattered = workload.scatters && !material.unlit;
        let mut reads = Self::default();
        if reads_base_color(material, workload) {
            reads.base_color = material.base_color_texture.as_ref();
        }
        if matches!(material.alpha_mode, AlphaMode::Mask { .. }) {
            reads.mask = material.base_color_texture.as_ref();
        }
        if shaded {
            reads.normal = material.normal_texture.as_ref();
        }
        if scattered {
            reads.metallic_roughness = material.metallic_roughness_texture.as_ref();
        }
        if is_anisotropic(material, workload) {
            reads.anisotropy = material.anisotropy_texture.as_ref();
        }
        if scattered && material.transmission > 0.0 {
            reads.transmission = material.transmission_texture.as_ref();
        }
        if workload.emission && !material.unlit && is_lit(&material.emission) {
            reads.emission = material.emission_texture.as_ref();
        }
        reads
    }

    /// Iterates over all textures that are read; one that is read twice occurs twice.
    pub fn textures(&self) -> impl Iterator<Item = &'a TextureRef> {
        let Self { base_color, mask, metallic_roughness, anisotropy, normal, emission, transmission } = *self;
        [base_color, mask, metallic_roughness, anisotropy, normal, emission, transmission]
            .into_iter()
            .flatten()
    }
}

/// True if the base colour, of material, texture or vertices, changes the workload's result.
pub(super) fn reads_base_color(material: &Material, workload: Workload) -> bool {
    workload.shades || (workload.emission && material.unlit) || blends(material, workload)
}

/// True if the workload lets light through where a material blends.
pub(super) fn blends(material: &Material, workload: Workload) -> bool {
    workload.blends && material.alpha_mode == AlphaMode::Blend
}

/// True if the workload's result depends on anisotropic roughness.
pub(super) fn is_anisotropic(material: &Material, workload: Workload) -> bool {
    workload.scatters && !material.unlit && material.anisotropy > 0.0
}

/// True if a colour is not black.
pub(super) fn is_lit(color: &[f32]) -> bool {
    color.iter().any(|channel| *channel > 0.0)
}
