//! PNG: 8-bit sRGB. Colours times 2^exposure, clamped to [0, 1], then the sRGB curve, rounded to the
//! nearest step. No further tone mapping and no dithering: other programs can reproduce every value.

use crate::backend::RenderOutput;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

/// The 8-bit value of a linear one in [0, 1] or outside of it; not-a-number becomes 0, as conversion to
/// an integer makes it.
fn srgb8(linear: f32) -> u8 {
    let linear = linear.clamp(0.0, 1.0);
    let curved = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (curved * 255.0 + 0.5) as u8
}

/// Three bytes per pixel: colours times 2^`exposure`, clamped, on the sRGB curve.
pub fn tone_map(beauty: &[[f32; 3]], exposure: f32) -> Vec<u8> {
    let scale = exposure.exp2();
    beauty.iter().flatten().map(|value| srgb8(value * scale)).collect()
}

/// The bytes of a PNG file of the colours.
///
/// # Errors
/// What the encoder says, in words.
pub fn encode(output: &RenderOutput, exposure: f32) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(
            &tone_map(&output.beauty, exposure),
            output.width,
            output.height,
            ExtendedColorType::Rgb8,
        )
        .map_err(|error| error.to_string())?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_srgb() {
        let values = [f32::NAN, -1.0, 0.0, 0.002, 0.214_041_14, 0.5, 1.0, 2.0, f32::INFINITY];
        assert_eq!(values.map(srgb8), [0, 0, 0, 7, 128, 188, 255, 255, 255]);
    }

    #[test]
    fn a_stop_doubles() {
        assert_eq!(tone_map(&[[0.25, 0.1, 0.3]], 1.0), tone_map(&[[0.5, 0.2, 0.6]], 0.0));
        assert_eq!(tone_map(&[[0.5; 3]], -1.0), tone_map(&[[0.25; 3]], 0.0));
    }

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
