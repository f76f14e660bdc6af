//! Noise taken out of pictures.

use crate::arguments::RenderArguments;
use crate::error::AppError;
use rasray_denoise::{DenoiseError, Denoiser, NoisyPicture};
use rasray_experiment::{Aov, RenderOutput};

/// The images that a denoiser is fed with, beside the colours.
pub(super) const FED: [Aov; 2] = [Aov::Albedo, Aov::Normal];

/// The denoiser, where one was asked for.
///
/// # Errors
/// There is none on this machine.
pub(super) fn denoiser(given: &RenderArguments) -> Result<Option<Denoiser>, AppError> {
    if !given.denoise {
        return Ok(None);
    }
    Denoiser::find().map(Some).map_err(|error| {
        let help = "get version 2 from openimagedenoise.org or with `pip install pyoidn`, and where it is not found name \
                    libOpenImageDenoise.so.2 in RASRAY_OIDN; or leave --denoise out";
        AppError::usage(format!("--denoise: {error}"), help)
    })
}

/// Takes the noise out of the colours of a picture that has the images of [`FED`].
///
/// # Errors
/// The library fails.
pub(super) fn denoise(denoiser: &Denoiser, output: &mut RenderOutput) -> Result<(), AppError> {
    let [albedo, normal] =
        FED.map(|aov| output.aovs.get(&aov).and_then(|image| image.triples()).unwrap_or_default());
    let size = [output.width as usize, output.height as usize];
    let picture = NoisyPicture { size, colour: &output.beauty, albedo: &albedo, normal: &normal };
    output.beauty = denoiser.denoise(&picture).map_err(|error: DenoiseError| {
        AppError::refused(format!("--denoise: {error}"), "nothing was written; leave --denoise out")
    })?;
    Ok(())
}
