//! Stamps of images: a key, by which a later run recognises the image, tone and denoiser.

use super::exr_header;
use super::format::ImageFormat;
use crate::error::AppError;
use rasray_experiment::Shard;
use rasray_metrics::{Tone, ToneCurve};
use rasray_scene_source::KeyHash;
use std::io::{Cursor, ErrorKind};
use std::path::Path;

/// Name of the key of an image: an attribute of an EXR, a tEXt chunk of a PNG. The key belongs to the whole
/// file, including the form in which it shows the picture.
pub const KEY: &str = "rasrayKey";

/// Name of the tone of a PNG, a tEXt chunk: the curve, and the stops of exposure before it.
pub const TONE: &str = "rasrayTone";

/// Name of the denoiser of an image, such as `Open Image Denoise 2.5.1`: an attribute of an EXR, a tEXt chunk
/// of a PNG.
pub const DENOISED: &str = "rasrayDenoised";

/// Writes the tone in words: `agx, exposure 1`.
pub fn tone_text(tone: Tone) -> String {
    match tone.curve {
        ToneCurve::Exposure => format!("exposure {}", tone.exposure),
        curve => format!("{}, exposure {}", curve.name(), tone.exposure),
    }
}

/// Computes the key of a file that shows the picture with the key `picture`: as a PNG in a certain tone, as
/// an EXR, or as an EXR of a share of the samples.
pub fn image_key(picture: &str, format: ImageFormat, tone: Tone, shard: Option<Shard>) -> String {
    let hash = KeyHash::default().with("picture", picture);
    match (format, shard) {
        (_, Some(shard)) => hash.with("part", shard.to_string()),
        (ImageFormat::Exr, None) => hash.with("exr", ""),
        // The exposures -0 and 0 are equal.
        (ImageFormat::Png, None) => {
            let exposed = hash.with("png", (tone.exposure + 0.0).to_le_bytes());
            match tone.curve {
                ToneCurve::Exposure => exposed,
                curve => exposed.with("tone", curve.name()),
            }
        }
    }
    .finish()
}

/// State of a file that should hold an image with a certain key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageState {
    /// The file is the wanted image, whole.
    Same,
    /// There is no file.
    Missing,
    /// The file has another key, or none.
    Other,
    /// The file is cut short or changed.
    Damaged,
    /// The file is the wanted image, but the report that was asked for is missing.
    Unreported,
}

impl ImageState {
    /// All states, in their order.
    pub const ALL: [Self; 5] = [Self::Same, Self::Missing, Self::Other, Self::Damaged, Self::Unreported];

    /// Returns the reason for which the image is made; `None` if it is not made.
    pub fn reason(self) -> Option<&'static str> {
        match self {
            Self::Same => None,
            Self::Missing => Some("missing"),
            Self::Other => Some("of something else"),
            Self::Damaged => Some("damaged"),
            Self::Unreported => Some("without a report"),
        }
    }
}

/// Reads the file at `path` and tells whether it is the image with this key. Its pixels are only checked if
/// the key is equal.
///
/// # Errors
/// The file exists but cannot be read.
pub fn standing(path: &Path, format: ImageFormat, key: &str) -> Result<ImageState, AppError> {
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(ImageState::Missing),
        Err(error) => {
            let help = "leave --resume out to replace it, or see that you may read it";
            return Err(AppError::input(path, format!("cannot be read: {error}"), help));
        }
    };
    let (readable, found) = match format {
        ImageFormat::Exr => {
            (exr_header::is_readable(&bytes), exr_header::text(&bytes, KEY).map(str::to_owned))
        }
        ImageFormat::Png => match png_key(&bytes) {
            Ok(found) => (true, found),
            Err(_) => (false, None),
        },
    };
    if !readable {
        return Ok(ImageState::Damaged);
    }
    if found.as_deref() != Some(key) {
        return Ok(ImageState::Other);
    }
    let whole = match format {
        ImageFormat::Exr => exr_header::is_whole(&bytes),
        ImageFormat::Png => png_is_whole(&bytes),
    };
    Ok(if whole { ImageState::Same } else { ImageState::Damaged })
}

/// Reads the key of a PNG from the chunks before its pixels.
fn png_key(bytes: &[u8]) -> Result<Option<String>, png::DecodingError> {
    let reader = png::Decoder::new(Cursor::new(bytes)).read_info()?;
    Ok(png_text(reader.info(), KEY).map(str::to_owned))
}

/// Returns a text of a PNG. A chunk with a wrong checksum does not count.
fn png_text<'a>(info: &'a png::Info<'_>, name: &str) -> Option<&'a str> {
    let mut texts = info.uncompressed_latin1_text.iter();
    texts.find(|chunk| chunk.keyword == name).map(|chunk| chunk.text.as_str())
}

/// Bytes at the end of every PNG: a chunk without content, and its checksum.
const PNG_END: [u8; 12] = *b"\0\0\0\0IEND\xaeB`\x82";

/// True if all chunks have their stated checksums and all pixels exist.
fn png_is_whole(bytes: &[u8]) -> bool {
    let read = || {
        let mut options = png::DecodeOptions::default();
        options.set_skip_ancillary_crc_failures(false);
        let mut reader = png::Decoder::new_with_options(Cursor::new(bytes), options).read_info().ok()?;
        let mut pixels = vec![0; reader.output_buffer_size()?];
        reader.next_frame(&mut pixels).ok()?;
        reader.finish().ok()
    };
    bytes.ends_with(&PNG_END) && read().is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{Metadata, encode_exr, encode_png};
    use rasray_experiment::RenderOutput;

    fn image() -> RenderOutput {
        let beauty = (0..96).map(|i| [i as f32 / 96.0, 0.5, 1.0 / (1.0 + i as f32)]).collect();
        RenderOutput { width: 12, height: 8, beauty, ..RenderOutput::default() }
    }

    #[test]
    fn a_file_is_known_by_its_key_unless_a_bit_of_it_has_changed() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("image");
        for format in [ImageFormat::Png, ImageFormat::Exr] {
            let key = image_key("picture", format, Tone::default(), None);
            let encode = |key: Option<&String>| match format {
                ImageFormat::Png => encode_png(
                    &image(),
                    Tone::default(),
                    &Metadata { key: key.cloned(), ..Metadata::default() },
                ),
                ImageFormat::Exr => {
                    encode_exr(&image(), &Metadata { key: key.cloned(), ..Metadata::default() })
                }
            };
            let put = |bytes: &[u8]| {
                std::fs::write(&path, bytes).expect("a file");
                standing(&path, format, &key).expect("it can be read")
            };
            _ = std::fs::remove_file(&path);
            assert_eq!(standing(&path, format, &key).expect("no file"), ImageState::Missing);
            let whole = encode(Some(&key)).expect("a small image");
            assert_eq!(put(&whole), ImageState::Same);
            assert_eq!(put(&encode(None).expect("a small image")), ImageState::Other);
            assert_eq!(put(&encode(Some(&"0".repeat(64))).expect("a small image")), ImageState::Other);
            for cut in (0..whole.len()).step_by(7).chain([whole.len() - 1]) {
                assert_ne!(put(&whole[..cut]), ImageState::Same, "{format:?} cut at {cut}");
            }
            assert_eq!(put(&whole[..whole.len() - 1]), ImageState::Damaged);
            for place in 0..whole.len() {
                let mut changed = whole.clone();
                changed[place] ^= 0x10;
                assert_ne!(put(&changed), ImageState::Same, "{format:?} changed at {place}");
            }
        }
        assert!(standing(folder.path(), ImageFormat::Png, "key").is_err(), "a folder");
    }

    #[test]
    fn every_way_to_show_a_picture_has_a_key_of_its_own() {
        let key = |format, exposure: f32, shard| image_key("picture", format, exposure.into(), shard);
        let curve = |curve| image_key("picture", ImageFormat::Png, Tone { curve, exposure: 1.0 }, None);
        let keys = [
            key(ImageFormat::Png, 0.0, None),
            curve(ToneCurve::Exposure),
            curve(ToneCurve::Agx),
            curve(ToneCurve::Aces),
            key(ImageFormat::Exr, 0.0, None),
            key(ImageFormat::Exr, 0.0, Shard::new(1, 2)),
            key(ImageFormat::Exr, 0.0, Shard::new(2, 2)),
            image_key("another", ImageFormat::Exr, Tone::default(), None),
        ];
        let different: std::collections::BTreeSet<_> = keys.iter().collect();
        assert_eq!(different.len(), keys.len());
        assert_eq!(key(ImageFormat::Png, -0.0, None), keys[0]);
        assert_eq!(key(ImageFormat::Png, 1.0, None), keys[1]);
    }
}
