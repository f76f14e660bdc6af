//! Decoder of KTX2 images with texels of Basis Universal, ETC1S or UASTC, to RGBA8.
//!
//! The crate `basisu` decodes. It uses the offsets and lengths of a file unchecked in sums and allocations,
//! so they are checked here before.

use basisu::{DecodeFlags, SourceFormat, TargetFormat, Transcoder};
use image::RgbaImage;
use ktx2::{Header, LevelIndex, SupercompressionScheme};

/// True if bytes begin with the signature of a KTX2 file.
pub(crate) fn is_ktx2(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xABKTX 20\xBB\r\n\x1A\n")
}

/// Bytes of a block of 4x4 texels of UASTC.
const BLOCK_BYTES: u64 = 16;

/// Faults of an image, as words that follow its name.
const DAMAGED: &str = "is damaged or cut short";
const OTHER: &str = "is a KTX2 file of another kind than glTF has: one picture of ETC1S or UASTC texels; encode it anew with \
                     npx @gltf-transform/cli etc1s (or uastc)";

/// Reads width and height in texels from the header.
pub(crate) fn size(bytes: &[u8]) -> Result<(u32, u32), &'static str> {
    let header = header(bytes)?;
    Ok((header.pixel_width, header.pixel_height))
}

/// Decodes the largest level, whose size the caller has found within limits.
pub(crate) fn decode(bytes: &[u8]) -> Result<RgbaImage, &'static str> {
    let header = header(bytes)?;
    let level = bytes.get(Header::LENGTH..).and_then(|rest| rest.first_chunk()).ok_or(DAMAGED)?;
    let level = LevelIndex::from_bytes(level);
    let within =
        |from: u64, length: u64| from.checked_add(length).is_some_and(|end| end <= bytes.len() as u64);
    let (width, height) = (header.pixel_width, header.pixel_height);
    let blocks = u64::from(width.div_ceil(4)) * u64::from(height.div_ceil(4));
    let inflated = match header.supercompression_scheme {
        Some(SupercompressionScheme::Zstandard) => level.uncompressed_byte_length,
        _ => 0,
    };
    let index = header.index;
    if !within(level.byte_offset, level.byte_length)
        || !within(index.sgd_byte_offset, index.sgd_byte_length)
        || inflated > blocks * BLOCK_BYTES
    {
        return Err(DAMAGED);
    }
    let image = Transcoder::new(bytes).map_err(|_| DAMAGED)?;
    if !matches!(image.source_format(), SourceFormat::Etc1s | SourceFormat::UastcLdr) || image.is_video() {
        return Err(OTHER);
    }
    let texels = image.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE).map_err(|_| DAMAGED)?;
    RgbaImage::from_raw(width, height, texels).ok_or(DAMAGED)
}

/// Reads the header of a file with one picture that may be of Basis Universal.
fn header(bytes: &[u8]) -> Result<Header, &'static str> {
    let header = Header::from_bytes(bytes.first_chunk().ok_or(DAMAGED)?).map_err(|_| DAMAGED)?;
    let single = header.layer_count == 0 && header.face_count == 1 && header.pixel_depth == 0;
    // A header that names a format of Vulkan has texels of another kind.
    if single && header.pixel_height > 0 && header.format.is_none() { Ok(header) } else { Err(OTHER) }
}
