//! Images that a scene refers to. An image that cannot be read or decoded is left out, with a warning: the
//! factors of its material are used without it.

use std::path::Path;

use crate::Limits;
use crate::decode::decode;
use crate::files::read_file;
use rasray_scene::remarks::Remarks;
use rasray_scene::text::reason;
use rasray_scene::{Image, SceneError};

/// Source of the encoded bytes of an image.
pub(crate) enum Encoded<'a> {
    Bytes(&'a [u8]),
    File(&'a Path),
}

/// Decodes the image called `name` of the scene at `path`; `None`, with a remark, if that fails.
///
/// # Errors
/// [`SceneError::TooLarge`] for files and images beyond a limit.
pub(crate) fn read_image(
    path: &Path,
    name: &str,
    encoded: Encoded<'_>,
    limits: &Limits,
    remarks: &mut Remarks,
) -> Result<Option<Image>, SceneError> {
    let read;
    let bytes = match encoded {
        Encoded::Bytes(bytes) => bytes,
        Encoded::File(file) => match read_file(file, limits.file_bytes) {
            Ok(bytes) => {
                remarks.files.push(file.to_owned());
                read = bytes;
                &read
            }
            Err(SceneError::Read { source, .. }) => {
                let place = format!("texture {}", file.display());
                remarks.note("missing-texture", place, format!("is not shown: {}", reason(&source)));
                return Ok(None);
            }
            Err(error) => return Err(error.of_scene(path)),
        },
    };
    match decode(path, name, bytes, limits, remarks) {
        Ok(image) => Ok(Some(image)),
        Err(SceneError::Image { reason: fault, .. }) => {
            remarks.note(
                "unreadable-texture",
                format!("texture {name}"),
                format!("is not shown: it {fault}"),
            );
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

/// Adds the texels of an image to those of a scene and checks the sum.
///
/// # Errors
/// [`SceneError::TooLarge`] beyond [`Limits::total_pixels`].
pub(crate) fn count_texels(
    path: &Path,
    image: &Image,
    total: &mut u64,
    limits: &Limits,
) -> Result<(), SceneError> {
    *total += u64::from(image.width) * u64::from(image.height);
    Limits::check(path, "the number of texels of all images", *total, limits.total_pixels, "total_pixels")
}
