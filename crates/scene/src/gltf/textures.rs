//! Textures, samplers and images, read only where a material uses them.

use std::collections::HashMap;

use ::gltf::json::Index;
use ::gltf::json::deserialize::from_value;
use ::gltf::json::extensions::texture::TextureTransform;
use ::gltf::json::texture::{Info, MagFilter, MinFilter, Texture as JsonTexture, WrappingMode};
use ::gltf::json::validation::Checked;

use super::buffers::view_bytes;
use super::document::Document;
use super::uri::{Reference, resolve};
use crate::load::read_file;
use crate::{Filter, Image, Limits, SceneError, Texture, TextureRef, Warning, Wrap, decode_image};

/// What a texture reference says, whichever of the typed structs it came from.
pub(super) struct Use<'a> {
    pub texture: usize,
    pub uv_set: u32,
    pub transform: Option<std::borrow::Cow<'a, TextureTransform>>,
}

impl<'a> From<&'a Info> for Use<'a> {
    fn from(info: &'a Info) -> Self {
        let transform = info.extensions.as_ref().and_then(|found| found.texture_transform.as_ref());
        Self {
            texture: info.index.value(),
            uv_set: info.tex_coord,
            transform: transform.map(std::borrow::Cow::Borrowed),
        }
    }
}

impl<'a> Use<'a> {
    /// Of a normal texture, whose transform the typed tree keeps as plain JSON.
    pub fn of_normal(info: &'a ::gltf::json::material::NormalTexture) -> Result<Self, ::gltf::json::Error> {
        let raw = info.extensions.as_ref().and_then(|found| found.others.get("KHR_texture_transform"));
        let transform: Option<TextureTransform> = raw.map(|raw| from_value(raw.clone())).transpose()?;
        Ok(Self {
            texture: info.index.value(),
            uv_set: info.tex_coord,
            transform: transform.map(std::borrow::Cow::Owned),
        })
    }
}

/// The image of a texture; `None` if only an extension names one.
pub(super) fn source(texture: &JsonTexture) -> Option<Index<::gltf::json::Image>> {
    // The typed tree writes the absent index as the largest one.
    Some(texture.source).filter(|source| source.value() != u32::MAX as usize)
}

/// Textures and images read so far.
pub(super) struct TextureReader<'a> {
    document: &'a Document<'a>,
    pub textures: Vec<Texture>,
    pub images: Vec<Image>,
    known_textures: HashMap<usize, Option<usize>>,
    known_images: HashMap<usize, usize>,
    pixels: u64,
}

impl<'a> TextureReader<'a> {
    /// A reader that has read nothing.
    pub fn new(document: &'a Document<'a>) -> Self {
        Self {
            document,
            textures: Vec::new(),
            images: Vec::new(),
            known_textures: HashMap::new(),
            known_images: HashMap::new(),
            pixels: 0,
        }
    }

    /// Reads what a material uses; `None`, with a warning, if it cannot be shown.
    pub fn read(
        &mut self,
        place: &str,
        wanted: Use<'_>,
        warnings: &mut Vec<Warning>,
    ) -> Result<Option<TextureRef>, SceneError> {
        let transform = wanted.transform.as_deref();
        let uv_set = transform.and_then(|transform| transform.tex_coord).unwrap_or(wanted.uv_set);
        if uv_set > 1 {
            warnings.push(Warning {
                kind: "uv-set",
                message: format!("{place}: texture coordinates {uv_set} are not supported, only 0 and 1; the texture was dropped"),
            });
            return Ok(None);
        }
        let Some(texture) = self.texture(wanted.texture, warnings)? else { return Ok(None) };
        Ok(Some(TextureRef {
            texture,
            uv_set,
            uv_transform: transform.map_or(IDENTITY, |found| matrix(place, found, warnings)),
        }))
    }

    fn texture(&mut self, index: usize, warnings: &mut Vec<Warning>) -> Result<Option<usize>, SceneError> {
        if let Some(&known) = self.known_textures.get(&index) {
            return Ok(known);
        }
        let texture = &self.document.root.textures[index];
        let read = match source(texture) {
            Some(image) if image.value() >= self.document.root.images.len() => {
                let reason = format!("refers to images[{}], which does not exist", image.value());
                return Err(self.document.invalid(format!("textures[{index}]"), reason));
            }
            Some(image) => {
                let image = self.image(image.value(), warnings)?;
                self.textures.push(sampled(self.document, texture, image));
                Some(self.textures.len() - 1)
            }
            None => {
                warnings.push(Warning {
                    kind: "texture-without-image",
                    message: format!("textures[{index}] has no PNG or JPEG image; it was dropped"),
                });
                None
            }
        };
        self.known_textures.insert(index, read);
        Ok(read)
    }

    fn image(&mut self, index: usize, warnings: &mut Vec<Warning>) -> Result<usize, SceneError> {
        if let Some(&known) = self.known_images.get(&index) {
            return Ok(known);
        }
        let Document { path, limits, root, buffers, .. } = self.document;
        let image = &root.images[index];
        let place = format!("images[{index}]");
        let file_name = image.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
        let name = image.name.as_deref().or(file_name).unwrap_or(&place);
        let read;
        let bytes: &[u8] = match (image.buffer_view, &image.uri) {
            (Some(view), _) => view_bytes(path, root, buffers, view.value())?,
            (None, Some(uri)) => {
                read = match resolve(path, &place, uri, limits.file_bytes)? {
                    Reference::Data(bytes) => bytes,
                    Reference::File(file) => read_file(&file, limits.file_bytes)?,
                };
                &read
            }
            (None, None) => {
                return Err(self.document.invalid(place, "has neither a reference nor a buffer view"));
            }
        };
        let decoded = decode_image(path, name, bytes, limits, warnings)?;
        self.pixels += u64::from(decoded.width) * u64::from(decoded.height);
        Limits::check(
            path,
            "the number of texels of all images",
            self.pixels,
            limits.total_pixels,
            "total_pixels",
        )?;
        self.images.push(decoded);
        self.known_images.insert(index, self.images.len() - 1);
        Ok(self.images.len() - 1)
    }
}

fn sampled(document: &Document<'_>, texture: &JsonTexture, image: usize) -> Texture {
    let sampler = texture.sampler.map(|sampler| &document.root.samplers[sampler.value()]);
    let wrap = |mode: Option<Checked<WrappingMode>>| match mode {
        Some(Checked::Valid(WrappingMode::ClampToEdge)) => Wrap::Clamp,
        Some(Checked::Valid(WrappingMode::MirroredRepeat)) => Wrap::Mirror,
        _ => Wrap::Repeat,
    };
    let magnify = sampler.and_then(|sampler| sampler.mag_filter);
    let minify = sampler.and_then(|sampler| sampler.min_filter);
    Texture {
        image,
        wrap_u: wrap(sampler.map(|sampler| sampler.wrap_s)),
        wrap_v: wrap(sampler.map(|sampler| sampler.wrap_t)),
        filter: match magnify {
            Some(Checked::Valid(MagFilter::Nearest)) => Filter::Nearest,
            _ => Filter::Linear,
        },
        mipmapped: !matches!(minify, Some(Checked::Valid(MinFilter::Nearest | MinFilter::Linear))),
    }
}

const IDENTITY: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Scale, then rotation (counter-clockwise as seen on the image, whose v axis points down), then offset.
fn matrix(place: &str, transform: &TextureTransform, warnings: &mut Vec<Warning>) -> [[f32; 3]; 2] {
    let (sin, cos) = f64::from(transform.rotation.0).sin_cos();
    let [scale_u, scale_v] = transform.scale.0.map(f64::from);
    let [offset_u, offset_v] = transform.offset.0.map(f64::from);
    let rows = [[cos * scale_u, sin * scale_v, offset_u], [-sin * scale_u, cos * scale_v, offset_v]];
    let rows = rows.map(|row| row.map(|x| x as f32));
    if rows.iter().flatten().all(|x| x.is_finite()) {
        return rows;
    }
    warnings.push(Warning {
        kind: "texture-transform",
        message: format!("{place}: its texture transform is not finite; none is applied"),
    });
    IDENTITY
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rotation and the combined quad of Khronos' texture transform test: where the marker of a
    /// correct result stands, the tip of the arrow is sampled.
    #[test]
    fn transforms_turn_the_right_way() {
        let tip = [0.7778, 0.7778];
        let cases = [
            (r#"{"rotation":0.39269908}"#, [0.42095, 1.01627], 1e-3),
            (r#"{"rotation":0.3,"scale":[1.5,1.5],"offset":[-0.2,-0.1]}"#, [0.43, 0.75], 4e-2),
        ];
        for (json, [u, v], tolerance) in cases {
            let transform: TextureTransform =
                ::gltf::json::deserialize::from_str(json).expect("a well-formed transform");
            let rows = matrix("material", &transform, &mut Vec::new());
            for (row, tip) in rows.iter().zip(tip) {
                let found = row[0] * u + row[1] * v + row[2];
                assert!((found - tip).abs() < tolerance, "{json}: {found} instead of {tip}");
            }
        }
    }

    #[test]
    fn a_transform_that_is_not_finite_is_not_applied() {
        let transform: TextureTransform =
            ::gltf::json::deserialize::from_str(r#"{"scale":[1e39,1]}"#).expect("a well-formed transform");
        let mut warnings = Vec::new();
        assert_eq!(matrix("material", &transform, &mut warnings), IDENTITY);
        assert_eq!(warnings.len(), 1);
    }
}
