//! PNG: 8-bit sRGB. Colours times 2^exposure, clamped to [0, 1], then the sRGB curve, rounded to the
//! nearest step. No further tone mapping and no dithering: other programs can reproduce every value.

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use rasray_experiment::RenderOutput;
use rasray_metrics::tone_map;

/// The bytes of a PNG file of the colours.
///
/// # Errors
/// What the encoder says, in words.
pub fn encode(output: &RenderOutput, exposure: f32) -> Result<Vec<u8>, String> {
    encode_bytes(&tone_map(&output.beauty, exposure), [output.width, output.height])
}

/// The bytes of a PNG file of pixels of three bytes each, rows from the top; the size in pixels.
///
/// # Errors
/// What the encoder says, in words.
pub(crate) fn encode_bytes(pixels: &[u8], [width, height]: [u32; 2]) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(pixels, width, height, ExtendedColorType::Rgb8)
        .map_err(|error| error.to_string())?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_reads_back_row_by_row() {
        let output = RenderOutput {
            width: 2,
            height: 2,
            beauty: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.5; 3]],
            ..Default::default()
        };
        let bytes = encode(&output, 0.0).expect("a small image");
        let read = image::load_from_memory(&bytes).expect("a valid file").to_rgb8();
        assert_eq!((read.width(), read.height()), (2, 2));
        assert_eq!(read.into_raw(), [255, 0, 0, 0, 255, 0, 0, 0, 255, 188, 188, 188]);
    }
}
