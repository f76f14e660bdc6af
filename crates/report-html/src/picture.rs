//! Pictures inside the page, as PNG in data addresses.

use crate::error::{HtmlError, misfit};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use rasray_report::colour_scale::{Scale, colour};

/// Encodes a picture as PNG and returns it as a data address: three bytes per pixel, rows from the top.
///
/// # Errors
/// The number of bytes is not that of the pixels, or the encoder fails.
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

/// Draws the scale itself as a picture, for legends.
pub(super) fn ramp(scale: &Scale) -> Result<String, HtmlError> {
    let pixels: Vec<u8> = (0..256).flat_map(|step| colour(scale, f64::from(step) / 255.0)).collect();
    address(256, 1, &pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

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
