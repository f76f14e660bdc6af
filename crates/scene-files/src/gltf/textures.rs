//! Textures, samplers and images, read only where a material uses them.

use std::collections::HashMap;

use ::gltf::json::Value;
use ::gltf::json::deserialize::from_value;
use ::gltf::json::extensions::texture::TextureTransform;
use ::gltf::json::texture::{Info, MagFilter, MinFilter, Texture as JsonTexture, WrappingMode};
use ::gltf::json::validation::Checked;

use super::document::Document;
use super::uri::{Reference, decoded, is_data, resolve};
use crate::images::{Encoded, count_texels, read_image};
use crate::reference::{self, Place};
use rasray_scene::{Filter, Image, SceneError, Texture, TextureRef, Wrap};

/// Reference to a texture, from any of the typed structs.
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
    /// Makes the reference to a normal texture, whose transform the typed tree keeps as plain JSON.
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

/// Returns the image of a texture, that of `KHR_texture_basisu` before one that stands in for it; `None` if
/// only another extension names an image.
pub(super) fn source(texture: &JsonTexture) -> Option<usize> {
    let basis = texture.extensions.as_ref().and_then(|found| found.others.get("KHR_texture_basisu"));
    match basis.and_then(|found| found.get("source")).and_then(Value::as_u64) {
        Some(source) => Some(source as usize),
        // The typed tree stores an absent index as the largest one.
        None => Some(texture.source.value()).filter(|&source| source != u32::MAX as usize),
    }
}

/// Reader with the textures and images read so far.
pub(super) struct TextureReader<'a, 'd> {
    document: &'a Document<'d>,
    pub textures: Vec<Texture>,
    pub images: Vec<Image>,
    known_textures: HashMap<usize, Option<usize>>,
    known_images: HashMap<usize, Option<usize>>,
    pixels: u64,
}

impl<'a, 'd> TextureReader<'a, 'd> {
    /// Makes a reader that has read nothing.
    pub fn new(document: &'a Document<'d>) -> Self {
        Self {
            document,
            textures: Vec::new(),
            images: Vec::new(),
            known_textures: HashMap::new(),
            known_images: HashMap::new(),
            pixels: 0,
        }
    }

    /// Reads a texture that a material uses; `None`, with a warning, if it cannot be shown.
    pub fn read(&mut self, place: &str, wanted: Use<'_>) -> Result<Option<TextureRef>, SceneError> {
        let transform = wanted.transform.as_deref();
        let uv_set = transform.and_then(|transform| transform.tex_coord).unwrap_or(wanted.uv_set);
        if uv_set > 1 {
            let text = format!(
                "texture coordinates {uv_set} are not supported, only 0 and 1; the texture was dropped"
            );
            self.document.note("uv-set", place, text);
            return Ok(None);
        }
        let Some(texture) = self.texture(wanted.texture)? else { return Ok(None) };
        let uv_transform = transform.map_or(Some(IDENTITY), matrix).unwrap_or_else(|| {
            let text = "its texture transform is not finite; none is applied";
            self.document.note("texture-transform", place, text);
            IDENTITY
        });
        Ok(Some(TextureRef { texture, uv_set, uv_transform }))
    }

    fn texture(&mut self, index: usize) -> Result<Option<usize>, SceneError> {
        if let Some(&known) = self.known_textures.get(&index) {
            return Ok(known);
        }
        let texture = &self.document.root.textures[index];
        let read = match source(texture) {
            Some(image) if image >= self.document.root.images.len() => {
                let reason = format!("refers to images[{image}], which does not exist");
                return Err(self.document.invalid(format!("textures[{index}]"), reason));
            }
            Some(image) => self.image(image)?.map(|image| {
                self.textures.push(sampled(self.document, texture, image));
                self.textures.len() - 1
            }),
            None => {
                let text = "has no PNG, JPEG or KTX2 image; it was dropped";
                self.document.note("texture-without-image", format!("textures[{index}]"), text);
                None
            }
        };
        self.known_textures.insert(index, read);
        Ok(read)
    }

    /// Returns the index of an image in the scene; `None`, with a remark, if the image cannot be read.
    fn image(&mut self, index: usize) -> Result<Option<usize>, SceneError> {
        if let Some(&known) = self.known_images.get(&index) {
            return Ok(known);
        }
        let document = self.document;
        let (path, limits) = (document.path, document.limits);
        let image = &document.root.images[index];
        let place = format!("images[{index}]");
        let file_name = image.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
        let name = image.name.as_deref().or(file_name).unwrap_or(&place);
        let (data, file);
        let encoded = match (image.buffer_view, &image.uri) {
            (Some(view), _) => Encoded::Bytes(document.view(view.value())?),
            (None, Some(uri)) => match self.image_reference(&place, uri)? {
                Some(Reference::Data(bytes)) => {
                    data = bytes;
                    Encoded::Bytes(&data)
                }
                Some(Reference::File(found)) => {
                    file = found;
                    Encoded::File(&file)
                }
                None => {
                    self.known_images.insert(index, None);
                    return Ok(None);
                }
            },
            (None, None) => {
                return Err(document.invalid(place, "has neither a reference nor a buffer view"));
            }
        };
        let read = read_image(path, name, encoded, limits, &mut document.remarks.borrow_mut())?;
        let position = match read {
            Some(image) => {
                count_texels(path, &image, &mut self.pixels, limits)?;
                self.images.push(image);
                Some(self.images.len() - 1)
            }
            None => None,
        };
        self.known_images.insert(index, position);
        Ok(position)
    }
}

impl TextureReader<'_, '_> {
    /// Resolves the reference of an image. A reference that cannot be followed is a missing texture, which a
    /// scene does not need: `None`, with a remark, unless a file of its name stands in.
    fn image_reference(&self, place: &str, uri: &str) -> Result<Option<Reference>, SceneError> {
        let Document { path, limits, remarks, .. } = self.document;
        match resolve(path, place, uri, limits.file_bytes) {
            Ok(found) => Ok(Some(found)),
            Err(SceneError::UnsafeReference { reason, .. }) if is_data(uri) => {
                let text = format!("is not shown: its data: URI {reason}");
                remarks.borrow_mut().note("unreadable-texture", format!("texture {place}"), text);
                Ok(None)
            }
            Err(SceneError::UnsafeReference { reason, .. }) => {
                let (folder, name) = (path.parent().unwrap_or(std::path::Path::new("")), decoded(uri));
                let place = match reference::place(folder, &name) {
                    // The name is written with backslashes, or not escaped where a URI must be.
                    Place::Below(file) if file.is_file() && !name.contains(':') => {
                        Place::Outside { reason, beside: Some(file) }
                    }
                    _ => reference::outside(folder, &name, reason),
                };
                Ok(reference::texture(&place, &name, &mut remarks.borrow_mut()).map(Reference::File))
            }
            Err(error) => Err(error),
        }
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

/// Returns the matrix of scale, then rotation (counter-clockwise as seen on the image, whose v axis points
/// down), then offset. `None` if the matrix is not finite.
fn matrix(transform: &TextureTransform) -> Option<[[f32; 3]; 2]> {
    let (sin, cos) = f64::from(transform.rotation.0).sin_cos();
    let [scale_u, scale_v] = transform.scale.0.map(f64::from);
    let [offset_u, offset_v] = transform.offset.0.map(f64::from);
    let rows = [[cos * scale_u, sin * scale_v, offset_u], [-sin * scale_u, cos * scale_v, offset_v]];
    let rows = rows.map(|row| row.map(|x| x as f32));
    rows.iter().flatten().all(|x| x.is_finite()).then_some(rows)
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    /// The rotation and the combined quad of Khronos' texture transform test: at the marker of a correct
    /// result, the tip of the arrow is sampled.
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
            let rows = matrix(&transform).expect("a finite transform");
            for (row, tip) in rows.iter().zip(tip) {
                let found = row[0] * u + row[1] * v + row[2];
                assert_abs_diff_eq!(found, tip, epsilon = tolerance);
            }
        }
    }

    #[test]
    fn a_transform_that_is_not_finite_is_not_applied() {
        // The value is parsed as a file is: first as a plain tree, whose numbers are doubles.
        let value: ::gltf::json::Value =
            ::gltf::json::deserialize::from_str(r#"{"scale":[1e39,1]}"#).expect("a value");
        let transform: TextureTransform =
            ::gltf::json::deserialize::from_value(value).expect("a well-formed transform");
        assert_eq!(matrix(&transform), None);
    }
}
