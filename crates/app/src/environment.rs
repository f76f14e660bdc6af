//! `--environment`: radiance from outside, as one colour or a latitude-longitude map.

use crate::arguments::values;
use crate::error::AppError;
use image::{ImageDecoder, ImageFormat, ImageReader, Limits};
use rasray_scene::Environment;
use std::path::Path;

/// Most pixels of a map; 16384 x 8192 fits.
const PIXEL_LIMIT: u64 = 1 << 27;

/// Reads `R,G,B` (linear, W/(sr m^2)) or the name of a `.hdr` file.
///
/// # Errors
/// Negative colours, files that cannot be read, and pixels that are no radiance.
pub fn read(value: &str) -> Result<Environment, AppError> {
    let path = Path::new(value);
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("hdr")) {
        return read_map(path);
    }
    let color = values::point(value).map_err(|_| {
        AppError::usage(
            format!("--environment {value} is neither a .hdr file nor a colour"),
            "write --environment sky.hdr, or three linear values such as --environment 0.5,0.7,1",
        )
    })?;
    let color = color.map(|channel| channel as f32);
    if !color.iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
        return Err(AppError::usage(
            format!("--environment {value} has a negative or too large value"),
            "radiance is at least 0 and at most 3e38",
        ));
    }
    Ok(Environment::Constant(color))
}

fn read_map(path: &Path) -> Result<Environment, AppError> {
    let fix = "give a Radiance .hdr file of at most 2^27 pixels";
    let failed = |error: &dyn std::fmt::Display| AppError::input(path, error, fix);
    // Opening a pipe would wait for its writer.
    if std::fs::metadata(path).is_ok_and(|found| !found.is_file()) {
        return Err(failed(&"it is not a regular file but a folder, a pipe, a socket or a device"));
    }
    let mut reader = ImageReader::open(path).map_err(|error| failed(&error))?;
    reader.set_format(ImageFormat::Hdr);
    let mut limits = Limits::default();
    // Decoders count what they keep besides the pixels as well.
    limits.max_alloc = Some(PIXEL_LIMIT * 16);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(|error| failed(&error))?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > PIXEL_LIMIT || width == 0 || height == 0 {
        return Err(failed(&format!("the map is {width}x{height} pixels")));
    }
    let map = image::DynamicImage::from_decoder(decoder).map_err(|error| failed(&error))?.into_rgb32f();
    let radiance: Vec<[f32; 3]> = map.pixels().map(|pixel| pixel.0).collect();
    let valid = |channel: &f32| channel.is_finite() && *channel >= 0.0;
    if let Some(position) = radiance.iter().position(|pixel| !pixel.iter().all(valid)) {
        let (x, y) = (position % width as usize, position / width as usize);
        return Err(failed(&format!("pixel {x},{y} is negative or not finite")));
    }
    Ok(Environment::LatLong { width, height, radiance })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour() {
        match read("1, 0.5,0").expect("a colour") {
            Environment::Constant(color) => assert_eq!(color, [1.0, 0.5, 0.0]),
            other => panic!("{other:?}"),
        }
        for bad in ["white", "1,2", "-1,0,0", "1e39,0,0", "nan,0,0", "sky.png"] {
            assert_eq!(read(bad).expect_err(bad).exit_code(), 2);
        }
    }

    #[test]
    fn a_map_reads_back_and_a_broken_one_is_refused_by_name() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("sky.hdr");
        let pixels: Vec<_> = (0..8).map(|i| image::Rgb([i as f32, 0.5, 4.0])).collect();
        let mut bytes = Vec::new();
        image::codecs::hdr::HdrEncoder::new(&mut bytes).encode(&pixels, 4, 2).expect("a map");
        std::fs::write(&path, &bytes).expect("a file");
        match read(&path.to_string_lossy()).expect("a map") {
            Environment::LatLong { width, height, radiance } => {
                assert_eq!((width, height), (4, 2));
                assert_eq!(radiance[5], [5.0, 0.5, 4.0]);
            }
            other => panic!("{other:?}"),
        }
        for length in [0, 5, bytes.len() / 2, bytes.len() - 1] {
            std::fs::write(&path, &bytes[..length]).expect("a file");
            let error = read(&path.to_string_lossy()).expect_err("truncated");
            assert!(error.to_string().contains("sky.hdr"), "{error}");
        }
        assert!(read("missing.hdr").expect_err("no file").to_string().contains("missing.hdr"));
    }

    /// Not after a wait for whoever writes into it.
    #[cfg(unix)]
    #[test]
    fn a_pipe_is_refused_at_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("sky.hdr");
        let made = std::process::Command::new("mkfifo").arg(&path).status().expect("mkfifo runs");
        assert!(made.success());
        let error = read(&path.to_string_lossy()).expect_err("a pipe");
        assert!(error.to_string().contains("not a regular file"), "{error}");
    }
}
