//! Results on disk: images by extension, rays and hits; encoded in memory, put in place in one step.

mod destination;
mod exr;
mod format;
mod levels;
mod png;
mod save_rays;

pub use self::exr::{Metadata, encode as encode_exr};
pub use destination::Destination;
pub use format::ImageFormat;
pub use levels::hint;
pub use png::encode as encode_png;
#[cfg(feature = "viewer")]
pub(crate) use png::encode_bytes as encode_png_bytes;
pub(crate) use save_rays::{SaveTargets, save};

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

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
}
