//! Results on disk: images by extension, rays and hits; encoded in memory, put in place in one step.

mod destination;
mod exr;
mod levels;
mod png;
mod save_rays;

pub use self::exr::{Metadata, encode as encode_exr};
pub use destination::Destination;
pub use levels::hint;
pub use png::encode as encode_png;
pub(crate) use save_rays::{SaveTargets, save};

use crate::backend::{AovSelection, RenderOutput};
use crate::error::AppError;
use std::path::Path;

/// How an image is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ImageFormat {
    /// 8-bit sRGB
    Png,
    /// Linear 32-bit floats, with further images next to the colours
    Exr,
}

impl ImageFormat {
    /// The format that a file's extension names.
    ///
    /// # Errors
    /// An extension that is neither `.png` nor `.exr`.
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

/// Refuses an output that lacks pixels or a wanted image.
///
/// # Errors
/// Names the image that is not whole.
pub fn check_complete(output: &RenderOutput, aovs: AovSelection) -> Result<(), AppError> {
    let pixels = output.width as usize * output.height as usize;
    let lengths = [
        ("colours", true, Some(output.beauty.len())),
        ("depth", aovs.depth, output.depth.as_ref().map(Vec::len)),
        ("normal", aovs.normal, output.normal.as_ref().map(Vec::len)),
        ("primitive", aovs.primitive, output.primitive.as_ref().map(Vec::len)),
    ];
    for (name, wanted, length) in lengths {
        if wanted && length != Some(pixels) {
            return Err(AppError::refused(
                format!("the image '{name}' has {} of {pixels} pixels", length.unwrap_or(0)),
                "nothing was written; this is a defect of the renderer, please report it with the command line",
            ));
        }
    }
    Ok(())
}

/// Pixels of the colour image that are not finite.
pub fn non_finite_pixels(output: &RenderOutput) -> usize {
    output.beauty.iter().filter(|pixel| !pixel.iter().all(|value| value.is_finite())).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_decides() {
        assert_eq!(ImageFormat::of(Path::new("a/b.PNG")).ok(), Some(ImageFormat::Png));
        assert_eq!(ImageFormat::of(Path::new("b.exr")).ok(), Some(ImageFormat::Exr));
        for bad in ["a.jpg", "a", ".png", "a.exr.bak"] {
            let error = ImageFormat::of(Path::new(bad)).expect_err(bad);
            assert_eq!(error.exit_code(), 2);
            assert!(error.to_string().starts_with(bad), "{error}");
        }
    }

    #[test]
    fn missing_pixels_are_refused() {
        let mut output =
            RenderOutput { width: 2, height: 1, beauty: vec![[0.0; 3]; 2], ..Default::default() };
        assert!(check_complete(&output, AovSelection::default()).is_ok());
        assert!(check_complete(&output, AovSelection { depth: true, ..Default::default() }).is_err());
        output.beauty.pop();
        assert_eq!(check_complete(&output, AovSelection::default()).expect_err("a hole").exit_code(), 4);
    }
}
