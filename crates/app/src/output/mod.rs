//! Results on disk: images by extension, rays and hits; they are encoded in memory and put in place in one
//! step.

mod cells;
mod destination;
mod exr;
mod exr_channels;
mod exr_header;
mod exr_part;
mod format;
mod levels;
mod png;
mod rows;
mod save_rays;
mod stamp;

pub use self::exr::{Metadata, PartOf, encode as encode_exr};
pub use self::png::encode as encode_png;
pub(crate) use cells::{CellLines, Cells, assembled, difference, read_cells, text_of};
pub use destination::Destination;
pub(crate) use exr_part::{PartFile, decode as decode_part};
pub use format::ImageFormat;
pub use levels::hint;
pub(crate) use png::encode_picture;
#[cfg(feature = "viewer")]
pub(crate) use png::encode_shown;
pub(crate) use rows::{Row, Rows, key_of_report, lines, read_rows};
pub(crate) use save_rays::{SaveTargets, save};
pub use stamp::{ImageState, KEY, image_key, standing};

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
