//! Textures and texels: one entry for each pair of scene texture and use, one sequence of texels for each
//! image in each encoding.

use std::collections::{BTreeMap, HashMap};

use rasray_scene::{Filter, Scene, TextureRef, Wrap};
use rasray_shaders_glsl::constants::scene::{
    TEXTURE_LINEAR, TEXTURE_NONE, TEXTURE_SRGB, TEXTURE_WRAP_V_SHIFT, WRAP_CLAMP, WRAP_MIRROR, WRAP_REPEAT,
};

use crate::{
    GpuSceneError,
    layout::{Texture, TextureUse},
    mips::{self, Encoding},
};

/// Empty texture slot of a material.
pub const NO_TEXTURE: TextureUse =
    TextureUse { texture: TEXTURE_NONE, uv_set: 0, row_u: [1.0, 0.0, 0.0], row_v: [0.0, 1.0, 0.0] };

/// Collector of the textures that materials use; texels are made once at the end.
pub struct TexturePacker<'a> {
    scene: &'a Scene,
    entries: Vec<(usize, Encoding)>,
    entry_of: HashMap<(usize, Encoding), u32>,
}

/// Packed tables of textures.
#[derive(Clone, Debug, Default)]
pub struct Textures {
    /// Entries to which materials refer.
    pub textures: Vec<Texture>,
    /// Texels of all levels, red in the lowest byte.
    pub texels: Vec<u32>,
}

impl<'a> TexturePacker<'a> {
    /// Makes a collector without textures.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, entries: Vec::new(), entry_of: HashMap::new() }
    }

    /// Notes that a material uses a texture and returns the record for its slot.
    ///
    /// # Errors
    /// `Malformed` where the texture or its image does not exist or the image has too few bytes.
    pub fn texture_use(
        &mut self,
        reference: Option<&TextureRef>,
        encoding: Encoding,
    ) -> Result<TextureUse, GpuSceneError> {
        let Some(reference) = reference else { return Ok(NO_TEXTURE) };
        let texture = self.scene.textures.get(reference.texture).ok_or_else(|| GpuSceneError::Malformed {
            what: format!("a material names texture {}", reference.texture),
            limit: self.scene.textures.len(),
        })?;
        let image = self.scene.images.get(texture.image).ok_or_else(|| GpuSceneError::Malformed {
            what: format!("texture {} names image {}", reference.texture, texture.image),
            limit: self.scene.images.len(),
        })?;
        if image.width == 0 || image.height == 0 || image.rgba8.len() < bytes(image.width, image.height) {
            return Err(GpuSceneError::Malformed {
                what: format!(
                    "image {} of {} x {} texels needs 4 bytes each",
                    image.name, image.width, image.height
                ),
                limit: image.rgba8.len(),
            });
        }
        let entries = &mut self.entries;
        let entry = *self.entry_of.entry((reference.texture, encoding)).or_insert_with(|| {
            entries.push((reference.texture, encoding));
            entries.len() as u32 - 1
        });
        let [row_u, row_v] = reference.uv_transform;
        Ok(TextureUse { texture: entry, uv_set: reference.uv_set.min(1), row_u, row_v })
    }

    /// Returns the images that are stored: once for each encoding, with all levels if any of their textures
    /// needs them.
    pub fn stored(&self) -> BTreeMap<(usize, Encoding), bool> {
        let mut mipmapped = BTreeMap::new();
        for &(texture, encoding) in &self.entries {
            let texture = &self.scene.textures[texture];
            *mipmapped.entry((texture.image, encoding)).or_default() |= texture.mipmapped;
        }
        mipmapped
    }

    /// Returns the number of entries to which materials refer.
    pub fn texture_count(&self) -> u64 {
        self.entries.len() as u64
    }

    /// Returns the number of texels of all stored levels.
    pub fn texel_count(&self) -> u64 {
        let stored = self.stored().into_iter().map(|((image, _), mipmapped)| {
            let image = &self.scene.images[image];
            mips::texel_count(image.width, image.height, mipmapped)
        });
        stored.sum()
    }

    /// Makes the texels of all textures that were used.
    ///
    /// # Errors
    /// `TooManyTexels` where 32-bit offsets do not reach the last texel.
    pub fn finish(self) -> Result<Textures, GpuSceneError> {
        let scene = self.scene;
        let mipmapped = self.stored();
        let count = self.texel_count();
        if count > u64::from(u32::MAX) {
            return Err(GpuSceneError::TooManyTexels { count, limit: u64::from(u32::MAX) });
        }
        let mut packed = Textures {
            textures: Vec::with_capacity(self.entries.len()),
            texels: Vec::with_capacity(count as usize),
        };
        let mut first_texel: HashMap<(usize, Encoding), u32> = HashMap::new();
        for (texture, encoding) in self.entries {
            let texture = &scene.textures[texture];
            let image = &scene.images[texture.image];
            let key = (texture.image, encoding);
            let first = *first_texel.entry(key).or_insert_with(|| {
                let first = packed.texels.len() as u32;
                let rgba8 = &image.rgba8[..bytes(image.width, image.height)];
                for level in mips::levels(image.width, image.height, rgba8, encoding, mipmapped[&key]) {
                    packed.texels.extend(level.texels);
                }
                first
            });
            packed.textures.push(Texture {
                first_texel: first,
                width: image.width,
                height: image.height,
                level_count: if texture.mipmapped { mips::level_count(image.width, image.height) } else { 1 },
                sampling: sampling(texture, encoding),
            });
        }
        Ok(packed)
    }
}

fn bytes(width: u32, height: u32) -> usize {
    (width as usize).saturating_mul(height as usize).saturating_mul(4)
}

fn sampling(texture: &rasray_scene::Texture, encoding: Encoding) -> u32 {
    let wrap = |wrap| match wrap {
        Wrap::Repeat => WRAP_REPEAT,
        Wrap::Mirror => WRAP_MIRROR,
        Wrap::Clamp => WRAP_CLAMP,
    };
    let filter = if texture.filter == Filter::Linear { TEXTURE_LINEAR } else { 0 };
    let srgb = if encoding == Encoding::Srgb { TEXTURE_SRGB } else { 0 };
    wrap(texture.wrap_u) | wrap(texture.wrap_v) << TEXTURE_WRAP_V_SHIFT | filter | srgb
}
