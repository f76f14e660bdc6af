//! PNG with 8-bit sRGB: colours times 2^exposure, clamped to [0, 1] or through the curve that was asked for,
//! then the sRGB curve, rounded to the nearest step. There is no dithering, so that other programs can
//! reproduce every value.

use super::exr::Metadata;
use super::stamp::{DENOISED, KEY, TONE, tone_text};
use crate::error::AppError;
use rasray_experiment::RenderOutput;
use rasray_metrics::{Tone, tone_map};
use std::io::Write;

/// Returns the bytes of a PNG file of the colours, with the tone in which they are shown, and with key and
/// denoiser if the image has them.
///
/// # Errors
/// The message of the encoder.
pub fn encode(output: &RenderOutput, tone: Tone, metadata: &Metadata) -> Result<Vec<u8>, String> {
    let rows = output.beauty.chunks(output.width.max(1) as usize);
    let shown = tone_text(tone);
    let texts =
        [(KEY, metadata.key.as_deref()), (TONE, Some(&*shown)), (DENOISED, metadata.denoised.as_deref())];
    encode_rows(rows.map(|row| tone_map(row, tone)), [output.width, output.height], texts)
}

/// Returns the bytes of a PNG file of pixels of three bytes each, rows from the top; the size is in pixels.
///
/// # Errors
/// [`AppError::Refused`] with the message of the encoder.
pub(crate) fn encode_picture(pixels: &[u8], size: [u32; 2]) -> Result<Vec<u8>, AppError> {
    encode_shown(pixels, size, None, None)
}

/// Encodes as [`encode_picture`], with the tone of linear colours and the denoiser, if there are any.
///
/// # Errors
/// As for [`encode_picture`].
pub(crate) fn encode_shown(
    pixels: &[u8],
    size: [u32; 2],
    tone: Option<Tone>,
    denoised: Option<&str>,
) -> Result<Vec<u8>, AppError> {
    let rows = pixels.chunks(3 * size[0].max(1) as usize);
    let shown = tone.map(tone_text);
    encode_rows(rows, size, [(TONE, shown.as_deref()), (DENOISED, denoised)])
        .map_err(|error| AppError::refused(format!("the picture could not be encoded: {error}"), ""))
}

/// Encodes rows, with the given texts, each under its name. Errors are in words.
fn encode_rows<'a>(
    rows: impl Iterator<Item = impl AsRef<[u8]>>,
    size: [u32; 2],
    texts: impl IntoIterator<Item = (&'a str, Option<&'a str>)>,
) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    write_rows(&mut bytes, rows, size, texts).map_err(|error| error.to_string())?;
    Ok(bytes)
}

fn write_rows<'a>(
    bytes: &mut Vec<u8>,
    rows: impl Iterator<Item = impl AsRef<[u8]>>,
    [width, height]: [u32; 2],
    texts: impl IntoIterator<Item = (&'a str, Option<&'a str>)>,
) -> Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    for (name, text) in texts.into_iter().filter_map(|(name, text)| Some((name, text?))) {
        encoder.add_text_chunk(name.to_owned(), text.to_owned())?;
    }
    let mut writer = encoder.write_header()?;
    let mut pixels = writer.stream_writer()?;
    for row in rows {
        pixels.write_all(row.as_ref())?;
    }
    pixels.finish()?;
    writer.finish()
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
        let bytes = encode(&output, 0.0.into(), &Metadata::default()).expect("a small image");
        let read = image::load_from_memory(&bytes).expect("a valid file").to_rgb8();
        assert_eq!((read.width(), read.height()), (2, 2));
        assert_eq!(read.into_raw(), [255, 0, 0, 0, 255, 0, 0, 0, 255, 188, 188, 188]);
    }
}
