//! Decoding of encoded images to texels, within limits.

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader};

use crate::recognise::recognise;
use crate::{Limits, basis};
use rasray_scene::remarks::Remarks;
use rasray_scene::{Image, SceneError, Warning};

/// Longest side of an image, texels.
const MAX_SIDE: u32 = 1 << 16;

/// Fault of an image with a longer side.
const TOO_LARGE: &str = "is too large to be decoded";

/// Decodes a PNG, JPEG or KTX2 image (ETC1S or UASTC), recognised by its first bytes, to RGBA8 with the first
/// row at the top. Channels of more than 8 bits are rounded, with a warning; an image without alpha is
/// opaque; grey becomes three equal channels. Values are taken as stored: no colour profile is applied.
///
/// `path` is the scene file, for messages; `name` names the image.
///
/// # Errors
/// [`SceneError::Image`] if the bytes are of another format or broken, [`SceneError::TooLarge`] if
/// the size in its header exceeds `limits.image_pixels`.
pub fn decode_image(
    path: &Path,
    name: &str,
    bytes: &[u8],
    limits: &Limits,
    warnings: &mut Vec<Warning>,
) -> Result<Image, SceneError> {
    let mut remarks = Remarks::default();
    let image = decode(path, name, bytes, limits, &mut remarks)?;
    warnings.extend(remarks.into_warnings());
    Ok(image)
}

/// Decodes an image as [`decode_image`] does.
pub(crate) fn decode(
    path: &Path,
    name: &str,
    bytes: &[u8],
    limits: &Limits,
    remarks: &mut Remarks,
) -> Result<Image, SceneError> {
    let failed = |reason: String| SceneError::Image { path: path.to_owned(), image: name.to_owned(), reason };
    let format = match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => Some(format),
        _ if basis::is_ktx2(bytes) => None,
        found => {
            let format = found
                .ok()
                .and_then(|format| format.extensions_str().first())
                .map(|name| format!("a .{name} image"));
            let what = format.or_else(|| recognise(bytes).map(|found| found.what.to_owned()));
            return Err(failed(format!(
                "is {}; only PNG, JPEG and KTX2 are read",
                what.as_deref().unwrap_or("of an unknown format")
            )));
        }
    };
    // Last safety net: the decoders promise not to panic, and hostile files test that promise.
    let decoded = catch_unwind(AssertUnwindSafe(|| match format {
        Some(format) => decode_as(path, name, bytes, format, limits),
        None => {
            let failed = |reason: &str| failed(reason.to_owned());
            let (width, height) = basis::size(bytes).map_err(failed)?;
            if width.max(height) > MAX_SIDE {
                return Err(failed(TOO_LARGE));
            }
            check_size(path, name, width, height, limits)?;
            basis::decode(bytes).map(DynamicImage::ImageRgba8).map_err(failed)
        }
    }))
    .map_err(|panic| SceneError::Internal { path: path.to_owned(), reason: panic_message(&*panic) })??;
    let deep = !matches!(
        decoded,
        DynamicImage::ImageLuma8(_)
            | DynamicImage::ImageLumaA8(_)
            | DynamicImage::ImageRgb8(_)
            | DynamicImage::ImageRgba8(_)
    );
    if deep {
        let text = "has more than 8 bits a channel; it was rounded to 8";
        remarks.note("image-depth", format!("image {name}"), text);
    }
    let texels = decoded.into_rgba8();
    Ok(Image {
        name: name.to_owned(),
        width: texels.width(),
        height: texels.height(),
        rgba8: texels.into_raw(),
    })
}

fn decode_as(
    path: &Path,
    name: &str,
    bytes: &[u8],
    format: ImageFormat,
    limits: &Limits,
) -> Result<DynamicImage, SceneError> {
    // Messages about the inner state of a decoder do not help a user who has only the file.
    let failed = |error: image::ImageError| SceneError::Image {
        path: path.to_owned(),
        image: name.to_owned(),
        reason: match error {
            image::ImageError::Unsupported(_) => {
                "is of a kind of its format that is not supported".to_owned()
            }
            image::ImageError::Limits(_) => TOO_LARGE.to_owned(),
            _ => "is damaged or cut short".to_owned(),
        },
    };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut bounds = image::Limits::default();
    bounds.max_image_width = Some(MAX_SIDE);
    bounds.max_image_height = Some(MAX_SIDE);
    // 16 bytes per texel: four channels of f32, the widest output of a decoder.
    bounds.max_alloc = Some(limits.image_pixels.saturating_mul(16).saturating_add(1 << 20));
    reader.limits(bounds);
    let decoder = reader.into_decoder().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    check_size(path, name, width, height, limits)?;
    DynamicImage::from_decoder(decoder).map_err(failed)
}

/// Refuses an image of more texels than the limits allow.
fn check_size(path: &Path, name: &str, width: u32, height: u32, limits: &Limits) -> Result<(), SceneError> {
    let pixels = u64::from(width) * u64::from(height);
    let what = format!("the size in texels of image {name}");
    Limits::check(path, &what, pixels, limits.image_pixels, "image_pixels")
}

/// Returns the message of a caught panic.
pub(crate) fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    panic
        .downcast_ref::<String>()
        .cloned()
        .or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()))
        .unwrap_or_else(|| "panic without a message".to_owned())
}
