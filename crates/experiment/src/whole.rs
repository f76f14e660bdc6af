//! Checks that a result is complete. An incomplete result is refused, since nobody could recognise it in a
//! picture or a table.

use crate::error::ExperimentError;
use crate::jobs::{AovImage, AovSelection, RenderOutput};
use rasray_report::Run;

/// Refuses the run of a structure with missing entries, or with rays left unanswered.
///
/// # Errors
/// [`ExperimentError::MissingEntries`] or [`ExperimentError::Unanswered`], naming the system.
pub fn check_run(run: &Run) -> Result<(), ExperimentError> {
    let Some(counters) = &run.counters else { return Ok(()) };
    let system = format!("{} {}", run.system, run.preset);
    if let Some(entries) = counters.overflow.filter(|count| *count > 0) {
        return Err(ExperimentError::MissingEntries { system, entries });
    }
    if let Some(rays) = counters.unfinished.filter(|count| *count > 0) {
        return Err(ExperimentError::Unanswered { system, rays });
    }
    Ok(())
}

impl RenderOutput {
    /// Refuses an output that lacks pixels or a wanted image.
    ///
    /// # Errors
    /// [`ExperimentError::MissingPixels`], naming the image that is not complete.
    pub fn check_images(&self, aovs: AovSelection) -> Result<(), ExperimentError> {
        let pixels = self.width as usize * self.height as usize;
        let length = |aov| self.aovs.get(&aov).map_or(0, AovImage::pixels);
        let wanted = aovs.iter().map(|aov| (aov.name(), length(aov)));
        for (name, length) in wanted.chain([("colours", self.beauty.len())]) {
            if length != pixels {
                return Err(ExperimentError::MissingPixels { image: name, pixels: length, expected: pixels });
            }
        }
        Ok(())
    }

    /// Returns the number of pixels of the colour image that are not finite.
    pub fn non_finite_pixels(&self) -> usize {
        self.beauty.iter().filter(|pixel| !pixel.iter().all(|value| value.is_finite())).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::Aov;
    use rasray_report::Counters;

    #[test]
    fn runs_with_holes_or_unanswered_rays_are_refused() {
        let run = |overflow, unfinished| Run {
            counters: Some(Counters { overflow, unfinished, ..Default::default() }),
            ..Default::default()
        };
        assert!(check_run(&Run::default()).is_ok());
        assert!(check_run(&run(Some(0), Some(0))).is_ok());
        for (bad, word) in [(run(Some(3), None), "3 entries"), (run(None, Some(2)), "2 rays")] {
            let error = check_run(&bad).expect_err(word);
            assert!(error.to_string().contains(word), "{error}");
        }
    }

    #[test]
    fn missing_pixels_are_refused() {
        let mut output =
            RenderOutput { width: 2, height: 1, beauty: vec![[0.0; 3]; 2], ..Default::default() };
        assert!(output.check_images(AovSelection::default()).is_ok());
        assert!(output.check_images(Aov::Depth.into()).is_err());
        output.beauty[1][2] = f32::NAN;
        assert_eq!(output.non_finite_pixels(), 1);
        output.beauty.pop();
        let error = output.check_images(AovSelection::default()).expect_err("a hole");
        assert!(matches!(error, ExperimentError::MissingPixels { pixels: 1, expected: 2, .. }), "{error:?}");
    }
}
