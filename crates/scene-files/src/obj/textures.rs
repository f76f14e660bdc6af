//! Textures of OBJ materials: each file is decoded once, alpha masks are merged into the colours that they
//! cut.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use image::imageops::{FilterType, resize};
use image::{Rgba, RgbaImage};

use super::mtl::{Map, MtlMaterial};
use crate::Limits;
use crate::images::{Encoded, count_texels, read_image};
use crate::reference::{Place, texture};
use rasray_scene::remarks::Remarks;
use rasray_scene::text::shown;
use rasray_scene::{Filter, Image, SceneError, Texture, TextureRef, Wrap};

/// Images and textures that materials use.
pub(super) struct Textures<'a> {
    path: &'a Path,
    limits: &'a Limits,
    /// Decoded files; `None` for those that could not be decoded.
    files: HashMap<PathBuf, Option<Image>>,
    /// File for each map that leads outside the folder, by its name; `None` where no file stands in.
    outside: HashMap<String, Option<PathBuf>>,
    images: Vec<Image>,
    textures: Vec<Texture>,
    /// Index of each image by the files that it was made from.
    made: HashMap<Source, usize>,
    pixels: u64,
}

/// Files that an image of the scene was made from.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Source {
    color: Option<PathBuf>,
    mask: Option<PathBuf>,
}

impl<'a> Textures<'a> {
    /// Makes an empty collection. `path` is the OBJ file, for messages.
    pub fn new(path: &'a Path, limits: &'a Limits) -> Self {
        Self {
            path,
            limits,
            files: HashMap::new(),
            outside: HashMap::new(),
            images: Vec::new(),
            textures: Vec::new(),
            made: HashMap::new(),
            pixels: 0,
        }
    }

    /// Returns the texture of a file as it is. `None`, with a warning, if it is missing or cannot be decoded.
    pub fn color(&mut self, map: &Map, remarks: &mut Remarks) -> Result<Option<TextureRef>, SceneError> {
        match self.decode(map, remarks)? {
            Some(file) => self.texture(Source { color: Some(file), mask: None }, map).map(Some),
            None => Ok(None),
        }
    }

    /// Returns the base colour of a material with its `map_d` as alpha, and true if it has such alpha. A mask
    /// without a colour cuts white.
    pub fn base_color(
        &mut self,
        found: &MtlMaterial,
        remarks: &mut Remarks,
    ) -> Result<Option<(TextureRef, bool)>, SceneError> {
        let mut source = Source { color: None, mask: None };
        let mut placed = None;
        if let Some(map) = &found.opacity_map
            && let Some(file) = self.decode(map, remarks)?
        {
            source.mask = Some(file);
            placed = Some(map);
        }
        if let Some(map) = &found.diffuse_map
            && let Some(file) = self.decode(map, remarks)?
        {
            source.color = Some(file);
            if placed.is_some_and(|mask| {
                (mask.scale, mask.offset, mask.clamp) != (map.scale, map.offset, map.clamp)
            }) {
                let place = format!("material {}", shown(&found.name));
                let text = "places map_d otherwise than map_Kd; the mask follows map_Kd";
                remarks.note("mask-placement", place, text);
            }
            placed = Some(map);
        }
        let is_cut = source.mask.is_some();
        placed.map(|map| Ok((self.texture(source, map)?, is_cut))).transpose()
    }

    /// Returns the textures and images of the scene.
    pub fn finish(self) -> (Vec<Texture>, Vec<Image>) {
        (self.textures, self.images)
    }

    /// Decodes the file of a map; `None`, with a warning, if there is no file or it cannot be decoded.
    fn decode(&mut self, map: &Map, remarks: &mut Remarks) -> Result<Option<PathBuf>, SceneError> {
        let file = match &map.place {
            Place::Below(file) => file.clone(),
            Place::Outside { .. } => {
                let known = self.outside.entry(map.name.clone());
                match known.or_insert_with(|| texture(&map.place, &map.name, remarks)) {
                    Some(file) => file.clone(),
                    None => return Ok(None),
                }
            }
        };
        if let Some(known) = self.files.get(&file) {
            return Ok(known.is_some().then_some(file));
        }
        let decoded = read_image(self.path, &map.name, Encoded::File(&file), self.limits, remarks)?;
        let is_shown = decoded.is_some();
        self.files.insert(file.clone(), decoded);
        Ok(is_shown.then_some(file))
    }

    fn texture(&mut self, source: Source, map: &Map) -> Result<TextureRef, SceneError> {
        let image = match self.made.get(&source) {
            Some(image) => *image,
            None => {
                let file =
                    |path: &Option<PathBuf>| path.as_ref().and_then(|path| self.files.get(path)?.as_ref());
                let image = match (file(&source.color), file(&source.mask)) {
                    (color, Some(mask)) => merge(color, mask),
                    (Some(color), None) => color.clone(),
                    (None, None) => {
                        return Err(SceneError::Internal {
                            path: self.path.to_owned(),
                            reason: format!("texture {} was used before it was decoded", map.name),
                        });
                    }
                };
                count_texels(self.path, &image, &mut self.pixels, self.limits)?;
                self.images.push(image);
                self.made.insert(source, self.images.len() - 1);
                self.images.len() - 1
            }
        };
        let wrap = if map.clamp { Wrap::Clamp } else { Wrap::Repeat };
        let texture = Texture { image, wrap_u: wrap, wrap_v: wrap, filter: Filter::Linear, mipmapped: true };
        let index = self.textures.iter().position(|other| *other == texture).unwrap_or_else(|| {
            self.textures.push(texture);
            self.textures.len() - 1
        });
        // The v coordinate was flipped with the vertices, so the placement is flipped too: 1 - (s (1 - v) +
        // o).
        let ([scale_u, scale_v], [offset_u, offset_v]) = (map.scale, map.offset);
        let uv_transform = [[scale_u, 0.0, offset_u], [0.0, scale_v, 1.0 - scale_v - offset_v]];
        Ok(TextureRef { texture: index, uv_set: 0, uv_transform })
    }
}

/// Merges a colour (white if absent) with alpha from the mask, at the larger size of the two.
fn merge(color: Option<&Image>, mask: &Image) -> Image {
    let (width, height) = match color {
        Some(color) => (color.width.max(mask.width), color.height.max(mask.height)),
        None => (mask.width, mask.height),
    };
    let alpha = scaled(&mask.name, width, height, mask.rgba8.clone(), (mask.width, mask.height));
    // An image with transparency of its own cuts by that; otherwise bright means opaque.
    let has_alpha = mask.rgba8.chunks_exact(4).any(|texel| texel[3] != 255);
    let mut texels = match color {
        Some(color) => scaled(&color.name, width, height, color.rgba8.clone(), (color.width, color.height)),
        None => RgbaImage::from_pixel(width, height, Rgba([255; 4])),
    };
    for (texel, mask) in texels.pixels_mut().zip(alpha.pixels()) {
        let Rgba([red, green, blue, opacity]) = *mask;
        texel.0[3] = if has_alpha {
            opacity
        } else {
            // Weights of Rec. 709 in 1/65536; they sum to 65536, so white stays 255.
            ((13_933 * u32::from(red) + 46_871 * u32::from(green) + 4_732 * u32::from(blue) + 32_768) >> 16)
                as u8
        };
    }
    let name = match color {
        Some(color) => format!("{} cut by {}", color.name, mask.name),
        None => mask.name.clone(),
    };
    Image { name, width, height, rgba8: texels.into_raw() }
}

fn scaled(name: &str, width: u32, height: u32, rgba8: Vec<u8>, size: (u32, u32)) -> RgbaImage {
    // An image always has width times height texels; a blank one stands in should that ever fail.
    let image = RgbaImage::from_raw(size.0, size.1, rgba8).unwrap_or_else(|| {
        tracing::error!(name, "image with a wrong number of texels");
        RgbaImage::new(size.0, size.1)
    });
    if size == (width, height) { image } else { resize(&image, width, height, FilterType::Triangle) }
}
