//! Textures sampled texel by texel: wrapping, nearest, bilinear and trilinear filtering.

use std::collections::HashMap;

use glam::{DVec2, Vec2, Vec3, Vec4};
use rasray_scene::{Filter, Image, Scene, TextureRef, Wrap};

/// Encoding of the red, green and blue of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Use {
    /// sRGB encoding.
    Color,
    /// Linear encoding: values as stored.
    Linear,
}

/// All levels of the images that materials use.
#[derive(Clone, Debug)]
pub struct TextureTable<'a> {
    scene: &'a Scene,
    levels: HashMap<(usize, Use), Vec<Level>>,
}

#[derive(Clone, Debug)]
struct Level {
    width: i32,
    height: i32,
    rgba8: Vec<u8>,
}

/// Decodes sRGB by the exact inverse of its curve.
pub fn srgb_decode(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

fn srgb_encode(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

impl<'a> TextureTable<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, levels: HashMap::new() }
    }

    /// Makes the levels of a texture. Indices must have been checked.
    pub fn prepare(&mut self, reference: TextureRef, usage: Use) {
        let image = &self.scene.images[self.scene.textures[reference.texture].image];
        self.levels
            .entry((self.scene.textures[reference.texture].image, usage))
            .or_insert_with(|| levels(image, usage));
    }

    /// Returns the RGBA of a texture, colour decoded to linear; white without a texture.
    pub fn sample(&self, reference: Option<&TextureRef>, usage: Use, uv: Vec2, level: f32) -> Vec4 {
        let Some(reference) = reference else { return Vec4::ONE };
        let texture = &self.scene.textures[reference.texture];
        let levels = &self.levels[&(texture.image, usage)];
        let place = uv.extend(1.0);
        let [row_u, row_v] = reference.uv_transform.map(Vec3::from);
        let u = reduce(row_u.dot(place), texture.wrap_u);
        let v = reduce(row_v.dot(place), texture.wrap_v);
        let last = if texture.mipmapped { (levels.len() - 1) as f32 } else { 0.0 };
        let used = if level > 0.0 { level.min(last) } else { 0.0 };
        let at = |level: usize| sample_level(&levels[level], texture, usage, Vec2::new(u, v));
        if texture.filter == Filter::Nearest {
            return at((used + 0.5) as usize);
        }
        let lower = used.floor();
        let value = at(lower as usize);
        if used > lower { value.lerp(at(lower as usize + 1), used - lower) } else { value }
    }

    /// Returns the level for a footprint of `footprint` metres across on a surface whose texture coordinates
    /// (before the transform) cover `uv_area` per square metre.
    pub fn level(&self, reference: Option<&TextureRef>, uv_area: f32, footprint: f32) -> f32 {
        let Some(reference) = reference else { return 0.0 };
        if !(footprint > 0.0) {
            return 0.0;
        }
        let image = &self.scene.images[self.scene.textures[reference.texture].image];
        let [[a, b, _], [c, d, _]] = reference.uv_transform;
        let texels = uv_area * (a * d - b * c).abs() * image.width as f32 * image.height as f32;
        if texels > 0.0 { 0.5 * texels.log2() + footprint.log2() } else { 0.0 }
    }

    /// Returns the numbers of texels of level 0 across and down.
    pub fn size(&self, reference: &TextureRef) -> DVec2 {
        let image = &self.scene.images[self.scene.textures[reference.texture].image];
        DVec2::new(f64::from(image.width), f64::from(image.height))
    }

    /// Returns the texel of level 0 at a position, for any filter; `uv` has been transformed.
    pub fn nearest(&self, reference: &TextureRef, usage: Use, uv: DVec2) -> Vec3 {
        let texture = &self.scene.textures[reference.texture];
        let level = &self.levels[&(texture.image, usage)][0];
        let place = (uv * self.size(reference)).floor();
        let column = wrap_texel(place.x as i32, level.width, texture.wrap_u);
        let row = wrap_texel(place.y as i32, level.height, texture.wrap_v);
        decode(level, (row * level.width + column) as usize, usage).truncate()
    }
}

fn decode(level: &Level, texel: usize, usage: Use) -> Vec4 {
    let bytes: [u8; 4] = std::array::from_fn(|channel| level.rgba8[4 * texel + channel]);
    let [r, g, b, a] = bytes.map(|byte| f32::from(byte) * (1.0 / 255.0));
    match usage {
        Use::Color => Vec4::new(srgb_decode(r), srgb_decode(g), srgb_decode(b), a),
        Use::Linear => Vec4::new(r, g, b, a),
    }
}

fn levels(image: &Image, usage: Use) -> Vec<Level> {
    let mut levels =
        vec![Level { width: image.width as i32, height: image.height as i32, rgba8: image.rgba8.clone() }];
    loop {
        let above = &levels[levels.len() - 1];
        if above.width == 1 && above.height == 1 {
            return levels;
        }
        let (width, height) = ((above.width / 2).max(1), (above.height / 2).max(1));
        let mut rgba8 = Vec::with_capacity(4 * (width * height) as usize);
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let mut sum = Vec4::ZERO;
            for (a, b) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let (column, row) = ((2 * x + a).min(above.width - 1), (2 * y + b).min(above.height - 1));
                sum += decode(above, (row * above.width + column) as usize, usage);
            }
            let mean = (sum * 0.25).to_array();
            rgba8.extend((0..4).map(|channel| {
                let encoded = usage == Use::Color && channel < 3;
                let value = if encoded { srgb_encode(mean[channel]) } else { mean[channel] };
                (value.clamp(0.0, 1.0) * 255.0 + 0.5).floor() as u8
            }));
        }
        levels.push(Level { width, height, rgba8 });
    }
}

/// Brings a coordinate near [0, 1] (mirror: [0, 2)), so that integers are exact afterwards.
fn reduce(u: f32, wrap: Wrap) -> f32 {
    if !(u.abs() < 1.0e9) {
        return 0.0;
    }
    match wrap {
        Wrap::Repeat => u - u.floor(),
        Wrap::Mirror => u - 2.0 * (u * 0.5).floor(),
        Wrap::Clamp => u.clamp(-0.5, 1.5),
    }
}

fn wrap_texel(x: i32, size: i32, wrap: Wrap) -> i32 {
    let wrapped = match wrap {
        Wrap::Repeat => x.rem_euclid(size),
        Wrap::Mirror => {
            let turned = x.rem_euclid(2 * size);
            if turned >= size { 2 * size - 1 - turned } else { turned }
        }
        Wrap::Clamp => x,
    };
    wrapped.clamp(0, size - 1)
}

fn sample_level(level: &Level, texture: &rasray_scene::Texture, usage: Use, uv: Vec2) -> Vec4 {
    let fetch = |x: i32, y: i32| {
        let column = wrap_texel(x, level.width, texture.wrap_u);
        let row = wrap_texel(y, level.height, texture.wrap_v);
        decode(level, (row * level.width + column) as usize, usage)
    };
    let place = uv * Vec2::new(level.width as f32, level.height as f32);
    if texture.filter == Filter::Nearest {
        return fetch(place.x.floor() as i32, place.y.floor() as i32);
    }
    let place = place - 0.5;
    let corner = place.floor();
    let share = place - corner;
    let (x, y) = (corner.x as i32, corner.y as i32);
    let top = fetch(x, y).lerp(fetch(x + 1, y), share.x);
    let bottom = fetch(x, y + 1).lerp(fetch(x + 1, y + 1), share.x);
    top.lerp(bottom, share.y)
}
