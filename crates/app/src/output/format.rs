//! Formats of images.

use crate::error::AppError;
use std::path::Path;

/// Format of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ImageFormat {
    /// 8-bit sRGB
    Png,
    /// Linear 32-bit floats, with further images in addition to the colours
    Exr,
}

impl ImageFormat {
    /// Returns the format that a file's extension names.
    ///
    /// # Errors
    /// The extension is neither `.png` nor `.exr`.
    pub fn of(path: &Path) -> Result<Self, AppError> {
        let extension = path.extension().and_then(|text| text.to_str()).map(str::to_ascii_lowercase);
        match extension.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            Some(other) => Err(AppError::input(
                path,
                format!("images are not written as .{other}"),
                "end the name in .png (8-bit sRGB) or .exr (linear floats)",
            )),
            None => Err(AppError::input(
                path,
                "the name has no extension that says how to write the image",
                "end the name in .png (8-bit sRGB) or .exr (linear floats)",
            )),
        }
    }
}
