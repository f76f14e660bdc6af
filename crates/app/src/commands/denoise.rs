//! Noise taken out of pictures.

use crate::error::AppError;
use crate::hints;
use rasray_denoise::{Denoiser, NoisyPicture};
use rasray_experiment::{Aov, RenderOutput};
use rasray_scene_source::KeyHash;

/// The denoiser, where one is `wanted`.
///
/// # Errors
/// There is none on this machine.
pub(super) fn denoiser(wanted: bool) -> Result<Option<Denoiser>, AppError> {
    if !wanted {
        return Ok(None);
    }
    Denoiser::find()
        .map(Some)
        .map_err(|error| AppError::usage(hints::message_of_denoiser(&error), hints::help_of_denoiser(&error)))
}

/// Takes the noise out of the colours of a picture that has the images of [`Aov::FOR_DENOISING`].
///
/// # Errors
/// The library fails.
pub(super) fn denoise(denoiser: &Denoiser, output: &mut RenderOutput) -> Result<(), AppError> {
    let [albedo, normal] = Aov::FOR_DENOISING
        .map(|aov| output.aovs.get(&aov).and_then(|image| image.triples()).unwrap_or_default());
    let size = [output.width as usize, output.height as usize];
    let picture = NoisyPicture { size, colour: &output.beauty, albedo: &albedo, normal: &normal };
    output.beauty = denoiser.denoise(&picture).map_err(|error| {
        let help = format!("nothing was written; {}", hints::help_of_denoiser(&error));
        AppError::refused(hints::message_of_denoiser(&error), help)
    })?;
    Ok(())
}

/// The key of a picture with this key where it is denoised, if it is.
pub(super) fn key_of_denoised(key: String, denoiser: Option<&Denoiser>) -> String {
    match denoiser {
        Some(denoiser) => {
            KeyHash::default().with("picture", key).with("denoised", denoiser.version()).finish()
        }
        None => key,
    }
}
