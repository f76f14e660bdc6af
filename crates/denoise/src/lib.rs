//! Denoising of pictures by [Open Image Denoise](https://www.openimagedenoise.org), for `rasray render
//! --denoise` and the viewer.
//!
//! - [`Denoiser`] loads the library at run time: nothing is linked, and programs run where it is not
//!   installed.
//! - [`NoisyPicture`] is its input.
//! - [`DenoiseError`] names the library that is missing or the image that has the wrong size.

mod library;

use library::Functions;
use std::ffi::OsString;
use std::path::Path;

/// Name of the environment variable with the file of the library, which replaces the installed one.
pub const LIBRARY_VARIABLE: &str = "RASRAY_OIDN";

/// Names under which the installed library is looked up on this system.
const NAMES: &[&str] = if cfg!(target_os = "windows") {
    &["OpenImageDenoise.dll"]
} else if cfg!(target_os = "macos") {
    &["libOpenImageDenoise.2.dylib", "libOpenImageDenoise.dylib"]
} else {
    &["libOpenImageDenoise.so.2", "libOpenImageDenoise.so"]
};

/// Error of denoising a picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DenoiseError {
    /// No library has that name, or a library that it needs is missing.
    #[error("Open Image Denoise is not installed: {reason}")]
    Missing {
        /// Message of the dynamic linker.
        reason: String,
    },
    /// The library has another version than 2, with other functions.
    #[error("{} is not version 2 of Open Image Denoise: {reason}", name.display())]
    Unsuitable {
        /// Name of the library.
        name: OsString,
        /// Function that the library lacks, or its version.
        reason: String,
    },
    /// The library refused the picture or this processor.
    #[error("Open Image Denoise failed: {0}")]
    Failed(String),
    /// An image does not have as many pixels as the picture.
    #[error("{name} has {pixels} pixels in place of {expected}")]
    Size {
        /// Name of the image.
        name: &'static str,
        /// Number of pixels of the image.
        pixels: usize,
        /// Number of pixels of the picture.
        expected: usize,
    },
}

/// Picture and its features: one entry per pixel, rows from the top.
#[derive(Clone, Copy, Debug)]
pub struct NoisyPicture<'a> {
    /// Pixels per row and number of rows.
    pub size: [usize; 2],
    /// Linear colours, without an upper limit.
    pub colour: &'a [[f32; 3]],
    /// Base colours, each channel from 0 to 1.
    pub albedo: &'a [[f32; 3]],
    /// Unit normals in any coordinate system; zero where there is none.
    pub normal: &'a [[f32; 3]],
}

/// Loaded library, ready for pictures.
#[derive(Debug)]
pub struct Denoiser {
    functions: Functions,
    version: String,
}

impl Denoiser {
    /// Loads the library that [`LIBRARY_VARIABLE`] names, or else the installed one.
    ///
    /// # Errors
    /// [`DenoiseError::Missing`], or [`DenoiseError::Unsuitable`].
    pub fn find() -> Result<Self, DenoiseError> {
        match std::env::var_os(LIBRARY_VARIABLE).filter(|name| !name.is_empty()) {
            Some(name) => Self::load(Path::new(&name)),
            None => {
                let first = Self::load(Path::new(NAMES[0]));
                let others = NAMES[1..].iter().map(|name| Self::load(Path::new(name)));
                // The error of the name with a version describes best which library is missing.
                others.fold(first, |found, other| found.or_else(|error| other.map_err(|_| error)))
            }
        }
    }

    /// Loads a library by its file, or by a name that the system looks up.
    ///
    /// # Errors
    /// [`DenoiseError::Missing`], or [`DenoiseError::Unsuitable`].
    pub fn load(name: &Path) -> Result<Self, DenoiseError> {
        let functions = Functions::load(name.as_os_str())?;
        let device = functions.device()?;
        let version = device.number(c"version");
        let [major, minor, patch] = [version / 10_000, version / 100 % 100, version % 100];
        drop(device);
        if major != 2 {
            let reason = format!("it says that it is {major}.{minor}.{patch}");
            return Err(DenoiseError::Unsuitable { name: name.into(), reason });
        }
        Ok(Self { functions, version: format!("Open Image Denoise {major}.{minor}.{patch}") })
    }

    /// Name and version of the library: `Open Image Denoise 2.5.1`.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Returns the picture without noise, in the same linear scale.
    ///
    /// # Errors
    /// [`DenoiseError::Size`], or [`DenoiseError::Failed`] with the library's message.
    pub fn denoise(&self, picture: &NoisyPicture<'_>) -> Result<Vec<[f32; 3]>, DenoiseError> {
        let NoisyPicture { size: [width, height], colour, albedo, normal } = *picture;
        let expected = width.saturating_mul(height);
        for (name, image) in [("the picture", colour), ("its albedo", albedo), ("its normal", normal)] {
            if image.len() != expected {
                return Err(DenoiseError::Size { name, pixels: image.len(), expected });
            }
        }
        if expected == 0 {
            return Ok(Vec::new());
        }
        self.functions.device()?.filtered([width, height], [colour, albedo, normal])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_library_is_missing_and_named() {
        for name in ["/nowhere/libOpenImageDenoise.so.2", "libNoSuchLibrary.so.7"] {
            let error = Denoiser::load(Path::new(name)).expect_err("there is none");
            assert!(
                matches!(error, DenoiseError::Missing { .. }) && error.to_string().contains(name),
                "{error}"
            );
        }
    }

    /// The test loads another library: its own C library.
    #[cfg(target_os = "linux")]
    #[test]
    fn another_library_is_unsuitable() {
        let error = Denoiser::load(Path::new("libc.so.6")).expect_err("not a denoiser");
        assert!(matches!(error, DenoiseError::Unsuitable { .. }), "{error}");
    }

    #[test]
    fn noise_is_taken_out_and_sizes_are_checked() {
        let denoiser = match Denoiser::find() {
            Ok(denoiser) => denoiser,
            Err(error) => return eprintln!("skipped: {error}"),
        };
        assert!(denoiser.version().starts_with("Open Image Denoise 2."), "{}", denoiser.version());
        let size = [48, 32];
        // The picture is a grey wall twice as bright as a screen, with reproducible noise.
        let noisy: Vec<_> = (0..48 * 32_u32)
            .map(|pixel| [2.0 + ((pixel.wrapping_mul(2_654_435_761) >> 16) as f32 / 32_768.0 - 1.0); 3])
            .collect();
        let (albedo, normal) = (vec![[0.5; 3]; noisy.len()], vec![[0.0, 0.0, 1.0]; noisy.len()]);
        let picture = NoisyPicture { size, colour: &noisy, albedo: &albedo, normal: &normal };
        let clean = denoiser.denoise(&picture).expect("it works");
        let error = |pixels: &[[f32; 3]]| pixels.iter().map(|pixel| (pixel[0] - 2.0).abs()).sum::<f32>();
        assert!(error(&clean) < 0.2 * error(&noisy), "{} of {}", error(&clean), error(&noisy));
        let short = NoisyPicture { albedo: &albedo[1..], ..picture };
        assert!(matches!(denoiser.denoise(&short), Err(DenoiseError::Size { name: "its albedo", .. })));
        let empty = NoisyPicture { size: [0, 5], colour: &[], albedo: &[], normal: &[] };
        assert!(denoiser.denoise(&empty).expect("nothing to do").is_empty());
    }
}
