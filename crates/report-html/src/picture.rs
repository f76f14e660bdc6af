//! Pictures inside the page: PNG as data, and colours for numbers.

use super::misfit;
use crate::HtmlError;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

/// A scale of colours from dark to light, even to the eye and readable without colour: stops at equal
/// distances, linear in sRGB between them.
pub(super) type Scale = [[u8; 3]];

/// Dark blue over green to yellow: stops of viridis, for counts.
pub(super) const VIRIDIS: &Scale = &[
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3e, 0x49, 0x89],
    [0x31, 0x68, 0x8e],
    [0x26, 0x82, 0x8e],
    [0x1f, 0x9e, 0x89],
    [0x35, 0xb7, 0x79],
    [0x6e, 0xce, 0x58],
    [0xb5, 0xde, 0x2b],
    [0xfd, 0xe7, 0x25],
];

/// Black over purple to pale yellow: stops of magma, as is usual for FLIP.
pub(super) const MAGMA: &Scale = &[
    [0x00, 0x00, 0x04],
    [0x18, 0x0f, 0x3d],
    [0x44, 0x0f, 0x76],
    [0x72, 0x1f, 0x81],
    [0x9e, 0x2f, 0x7f],
    [0xcd, 0x40, 0x71],
    [0xf1, 0x60, 0x5d],
    [0xfd, 0x96, 0x68],
    [0xfe, 0xca, 0x8d],
    [0xfc, 0xfd, 0xbf],
];

/// The colour of `value` in [0, 1]; values outside take the nearest end, not-a-number the dark one.
pub(super) fn colour(scale: &Scale, value: f64) -> [u8; 3] {
    let last = scale.len() - 1;
    let place = if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) * last as f64 };
    let below = (place as usize).min(last - 1);
    let part = place - below as f64;
    std::array::from_fn(|channel| {
        let (low, high) = (f64::from(scale[below][channel]), f64::from(scale[below + 1][channel]));
        (low + part * (high - low)).round() as u8
    })
}

/// A PNG as the address of an image: three bytes per pixel, rows from the top.
///
/// # Errors
/// Not as many bytes as pixels need, or what the encoder says.
pub(super) fn address(width: u32, height: u32, rgb: &[u8]) -> Result<String, HtmlError> {
    if width == 0 || height == 0 || rgb.len() != 3 * width as usize * height as usize {
        return Err(misfit(format!("a picture of {width}x{height} has {} bytes", rgb.len())));
    }
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive)
        .write_image(rgb, width, height, ExtendedColorType::Rgb8)
        .map_err(|error| misfit(error.to_string()))?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(png)))
}

/// The scale itself as a picture, for legends.
pub(super) fn ramp(scale: &Scale) -> Result<String, HtmlError> {
    let pixels: Vec<u8> = (0..256).flat_map(|step| colour(scale, f64::from(step) / 255.0)).collect();
    address(256, 1, &pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_begin_and_end_with_their_stops_and_grow_brighter() {
        for scale in [VIRIDIS, MAGMA] {
            assert_eq!(colour(scale, 0.0), scale[0]);
            assert_eq!(colour(scale, 1.0), scale[scale.len() - 1]);
            assert_eq!(colour(scale, f64::NAN), scale[0]);
            assert_eq!(colour(scale, 7.0), scale[scale.len() - 1]);
            let luma = |value: f64| {
                let [red, green, blue] = colour(scale, value).map(f64::from);
                0.2126 * red + 0.7152 * green + 0.0722 * blue
            };
            assert!((0..100).all(|step| luma(f64::from(step + 1) / 100.0) > luma(f64::from(step) / 100.0)));
        }
    }

    #[test]
    fn a_picture_reads_back_and_one_with_a_hole_is_refused() {
        let pixels = [255, 0, 0, 0, 255, 0, 0, 0, 255, 1, 2, 3];
        let text = address(2, 2, &pixels).expect("a picture");
        let data = text.strip_prefix("data:image/png;base64,").expect("PNG");
        let png = STANDARD.decode(data).expect("base64");
        assert_eq!(image::load_from_memory(&png).expect("an image").to_rgb8().into_raw(), pixels);
        assert!(address(2, 2, &pixels[..9]).expect_err("a hole").to_string().contains("2x2"));
        assert!(address(0, 2, &[]).is_err());
    }
}
