//! Denoising of pictures.

use crate::error::AppError;
use crate::hints;
use rasray_denoise::{Denoiser, NoisyPicture};
use rasray_experiment::{Aov, RenderOutput};
use rasray_scene_source::KeyHash;

/// Returns the denoiser, if one is `wanted`.
///
/// # Errors
/// This machine has no denoiser.
pub(super) fn denoiser(wanted: bool) -> Result<Option<Denoiser>, AppError> {
    if !wanted {
        return Ok(None);
    }
    Denoiser::find()
        .map(Some)
        .map_err(|error| AppError::usage(hints::message_of_denoiser(&error), hints::help_of_denoiser(&error)))
}

/// Denoises the colours of a picture that has the images of [`Aov::FOR_DENOISING`].
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

/// Returns the key of a picture after denoising, if there is a denoiser, otherwise the key itself.
pub(super) fn key_of_denoised(key: String, denoiser: Option<&Denoiser>) -> String {
    match denoiser {
        Some(denoiser) => {
            KeyHash::default().with("picture", key).with("denoised", denoiser.version()).finish()
        }
        None => key,
    }
}
