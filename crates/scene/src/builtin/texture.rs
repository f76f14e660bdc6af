//! Pictures computed in code: tiles, cloth, a pierced screen.

use super::forms::turn;
use crate::{AlphaMode, Filter, Image, Material, Texture, TextureRef, Wrap};

/// Number of texels along a side of every picture of this module.
const SIDE: u32 = 256;

/// Fills a square image from a function of (u, v) in [0, 1)^2 that gives sRGB bytes and alpha.
fn paint(name: &str, texel: impl Fn(f64, f64) -> [u8; 4]) -> Image {
    let mut rgba8 = Vec::with_capacity((SIDE * SIDE * 4) as usize);
    for row in 0..SIDE {
        for column in 0..SIDE {
            let centre = |index: u32| (f64::from(index) + 0.5) / f64::from(SIDE);
            rgba8.extend(texel(centre(column), centre(row)));
        }
    }
    Image { name: name.to_owned(), width: SIDE, height: SIDE, rgba8 }
}

/// Returns a reproducible value in [0, 1] for each cell of a grid.
fn grain(x: u32, y: u32) -> f64 {
    let mut mixed = x.wrapping_mul(0x85EB_CA6B) ^ y.wrapping_mul(0xC2B2_AE35);
    mixed = (mixed ^ (mixed >> 15)).wrapping_mul(0x2C1B_3C6D);
    mixed = (mixed ^ (mixed >> 12)).wrapping_mul(0x297A_2D39);
    f64::from(mixed ^ (mixed >> 15)) / f64::from(u32::MAX)
}

fn shade(color: [f64; 3], factor: f64, alpha: u8) -> [u8; 4] {
    let [red, green, blue] = color.map(|channel| (channel * factor).clamp(0.0, 255.0).round() as u8);
    [red, green, blue, alpha]
}

/// Paints four by four tiles of light and dark stone with joints; repeats.
pub(super) fn tiles() -> Image {
    paint("tiles", |u, v| {
        let (x, y) = (u * 4.0, v * 4.0);
        let (column, row) = (x as u32, y as u32);
        let inset = (x.fract().min(1.0 - x.fract())).min(y.fract().min(1.0 - y.fract()));
        if inset < 0.03 {
            return shade([92.0, 86.0, 78.0], 1.0, 255);
        }
        let stone =
            if (column + row).is_multiple_of(2) { [206.0, 190.0, 162.0] } else { [128.0, 96.0, 78.0] };
        let speck = grain((u * 256.0) as u32, (v * 256.0) as u32);
        shade(stone, 0.88 + 0.08 * grain(column + 100, row) + 0.08 * speck, 255)
    })
}

/// Paints woven cloth with a stripe of another colour and a diamond pattern; repeats.
pub(super) fn cloth(name: &str, ground: [f64; 3], figure: [f64; 3]) -> Image {
    paint(name, |u, v| {
        let thread = if ((u * 128.0) as u32 + (v * 128.0) as u32).is_multiple_of(2) { 1.0 } else { 0.88 };
        let diamond = ((u * 4.0).fract() - 0.5).abs() + ((v * 4.0).fract() - 0.5).abs() < 0.24;
        let stripe = (v - 0.9).abs() < 0.04;
        shade(if diamond || stripe { figure } else { ground }, thread, 255)
    })
}

/// Paints eight by eight small glazed tiles in shades of blue; repeats.
pub(super) fn mosaic() -> Image {
    paint("mosaic", |u, v| {
        let (x, y) = (u * 8.0, v * 8.0);
        let inset = (x.fract().min(1.0 - x.fract())).min(y.fract().min(1.0 - y.fract()));
        if inset < 0.045 {
            return shade([214.0, 222.0, 220.0], 1.0, 255);
        }
        let tint = grain(x as u32 + 31, y as u32 + 17);
        shade([118.0, 190.0, 208.0], 0.84 + 0.24 * tint, 255)
    })
}

/// Paints wood with its grain along u; repeats.
pub(super) fn wood() -> Image {
    paint("wood", |u, v| {
        let bend = 0.012 * turn(u).0 + 0.006 * turn(3.0 * u + 0.4).0;
        let ring = 0.5 + 0.5 * turn(9.0 * v + 14.0 * bend * turn(v).0 + 20.0 * bend).0;
        let fibre = grain((u * 24.0) as u32, (v * 256.0) as u32);
        let pore = if grain((u * 48.0) as u32 + 7, (v * 128.0) as u32 + 3) > 0.94 { 0.82 } else { 1.0 };
        shade([146.0, 98.0, 58.0], (0.72 + 0.22 * ring * ring + 0.16 * fibre) * pore, 255)
    })
}

/// Paints a leaf with its foot at the bottom: alpha is 0 around it.
pub(super) fn leaf() -> Image {
    paint("leaf", |u, v| {
        let along = 1.0 - v;
        let wide = 2.6 * along.min(0.36) * (1.0 - along) * (1.0 + 0.7 * along);
        let out = (2.0 * u - 1.0).abs();
        let vein = ((along - 0.45 * out) * 9.0).fract() < 0.12 || out < 0.04;
        let shadow = if vein { 1.25 } else { 0.92 + 0.1 * grain((u * 64.0) as u32, (v * 64.0) as u32) };
        shade([122.0, 156.0, 66.0], shadow, u8::from(out < wide) * 255)
    })
}

/// Paints a bronze screen with round and square holes: alpha is 0 where it is pierced; repeats.
pub(super) fn screen() -> Image {
    paint("screen", |u, v| {
        let (x, y) = ((u * 4.0).fract() - 0.5, (v * 4.0).fract() - 0.5);
        let pierced =
            x.hypot(y) < 0.36 || x.abs().max(y.abs()) > 0.5 - 0.06 && (x.abs() - y.abs()).abs() < 0.05;
        shade(
            [150.0, 116.0, 62.0],
            0.9 + 0.1 * grain((u * 256.0) as u32, (v * 256.0) as u32),
            u8::from(!pierced) * 255,
        )
    })
}

/// Makes a repeating, filtered, mipmapped texture of the image with index `image`.
pub(super) fn repeating(image: usize) -> Texture {
    Texture { image, wrap_u: Wrap::Repeat, wrap_v: Wrap::Repeat, filter: Filter::Linear, mipmapped: true }
}

/// Returns `material` with texture `texture` as its base colour, on untransformed texture coordinates 0.
pub(super) fn textured(material: Material, texture: usize) -> Material {
    let uv_transform = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    Material {
        base_color: [1.0; 4],
        base_color_texture: Some(TextureRef { texture, uv_set: 0, uv_transform }),
        ..material
    }
}

/// Returns `material` with holes where alpha is below one half.
pub(super) fn pierced(material: Material) -> Material {
    Material { alpha_mode: AlphaMode::Mask { cutoff: 0.5 }, double_sided: true, ..material }
}
