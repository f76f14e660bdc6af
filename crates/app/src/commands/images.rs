//! Writes an image.

use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{self, Destination, ImageFormat, Metadata};
use crate::terminal;
use rasray_experiment::RenderOutput;
use rasray_metrics::Tone;

/// Returns a place in words.
pub(super) fn named(place: &Destination) -> String {
    if place.is_stdout() { "standard output".to_owned() } else { place.named().display().to_string() }
}

/// Encodes an image and puts it in its place; reports faults of the image.
pub(super) fn write_image(
    (place, format): (&Destination, ImageFormat),
    output: &RenderOutput,
    metadata: &Metadata,
    tone: Tone,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let non_finite = output.non_finite_pixels();
    if non_finite > 0 {
        terminal::warn(&format!(
            "{non_finite} pixels are not finite numbers; please report the scene (non-finite)"
        ));
    }
    let encoded = match format {
        ImageFormat::Png => output::encode_png(output, tone, metadata),
        ImageFormat::Exr => output::encode_exr(output, metadata),
    };
    let bytes = encoded.map_err(|error| {
        AppError::refused(
            format!("{}: the image could not be encoded: {error}", named(place)),
            "nothing was written; choose the other format",
        )
    })?;
    place.write(&bytes, interrupt)?;
    output::hint(output, format, tone).iter().for_each(|text| terminal::note(text));
    Ok(())
}
