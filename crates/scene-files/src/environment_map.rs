//! Reader of environment maps: radiance from outside in a latitude-longitude map.

use std::io::Cursor;
use std::panic::catch_unwind;
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader};

use crate::Limits;
use crate::decode::panic_message;
use crate::files::read_file;
use rasray_scene::{Environment, SceneError};

/// Largest number of pixels of a map; 16384 x 8192 fits.
const PIXEL_LIMIT: u64 = 1 << 27;

/// Reads a Radiance `.hdr` file of at most 2^27 pixels.
///
/// # Errors
/// [`SceneError::Read`] and [`SceneError::TooLarge`] for a file that cannot be read whole,
/// [`SceneError::Syntax`] for one that is no such map, is too large, or has pixels that are no radiance.
pub fn load_environment(path: &Path) -> Result<Environment, SceneError> {
    let bytes = read_file(path, Limits::default().file_bytes)?;
    let map = catch_unwind(|| decode(&bytes))
        .map_err(|panic| SceneError::Internal { path: path.to_owned(), reason: panic_message(&*panic) })?
        .map_err(|reason| SceneError::syntax(path, reason))?;
    let (width, height) = (map.width(), map.height());
    let map = map.into_rgb32f();
    let radiance: Vec<[f32; 3]> = map.pixels().map(|pixel| pixel.0).collect();
    let valid = |channel: &f32| channel.is_finite() && *channel >= 0.0;
    if let Some(position) = radiance.iter().position(|pixel| !pixel.iter().all(valid)) {
        let (x, y) = (position % width as usize, position / width as usize);
        return Err(SceneError::syntax(path, format!("pixel {x},{y} is negative or not finite")));
    }
    Ok(Environment::LatLong { width, height, radiance })
}

fn decode(bytes: &[u8]) -> Result<DynamicImage, String> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Hdr);
    let mut limits = image::Limits::default();
    // Decoders also count the memory that they use besides the pixels.
    limits.max_alloc = Some(PIXEL_LIMIT * 16);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(|error| error.to_string())?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > PIXEL_LIMIT || width == 0 || height == 0 {
        return Err(format!("the map is {width}x{height} pixels"));
    }
    DynamicImage::from_decoder(decoder).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_reads_back_and_a_broken_one_is_refused_by_name() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("sky.hdr");
        let pixels: Vec<_> = (0..8).map(|i| image::Rgb([i as f32, 0.5, 4.0])).collect();
        let mut bytes = Vec::new();
        image::codecs::hdr::HdrEncoder::new(&mut bytes).encode(&pixels, 4, 2).expect("a map");
        std::fs::write(&path, &bytes).expect("a file");
        match load_environment(&path).expect("a map") {
            Environment::LatLong { width, height, radiance } => {
                assert_eq!((width, height), (4, 2));
                assert_eq!(radiance[5], [5.0, 0.5, 4.0]);
            }
            other => panic!("{other:?}"),
        }
        for length in [0, 5, bytes.len() / 2, bytes.len() - 1] {
            std::fs::write(&path, &bytes[..length]).expect("a file");
            let error = load_environment(&path).expect_err("truncated");
            assert!(error.to_string().contains("sky.hdr"), "{error}");
        }
        assert!(
            load_environment(Path::new("missing.hdr"))
                .expect_err("no file")
                .to_string()
                .contains("missing.hdr")
        );
    }

    /// The pipe is refused at once, without waiting for a writer.
    #[cfg(unix)]
    #[test]
    fn a_pipe_is_refused_at_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("sky.hdr");
        let made = std::process::Command::new("mkfifo").arg(&path).status().expect("mkfifo runs");
        assert!(made.success());
        let error = load_environment(&path).expect_err("a pipe");
        assert!(error.to_string().contains("not a regular file"), "{error}");
    }
}
