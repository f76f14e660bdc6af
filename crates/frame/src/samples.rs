//! Indices of the samples of an image.

use std::iter::StepBy;
use std::ops::Range;

/// Indices of samples at equal steps: all samples of an image, samples that are added to an image, or a share
/// of the samples. Random numbers depend on the index, so the shares add up to the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    first: u32,
    end: u32,
    step: u32,
}

impl From<Range<u32>> for Samples {
    fn from(range: Range<u32>) -> Self {
        Self { first: range.start, end: range.end, step: 1 }
    }
}

impl Samples {
    /// Returns every `step`th of these samples, from the first on; every one if `step` is 0.
    #[must_use]
    pub fn step_by(self, step: u32) -> Self {
        Self { step: step.max(1), ..self }
    }

    /// Returns the number of samples.
    pub fn count(self) -> u32 {
        self.end.saturating_sub(self.first).div_ceil(self.step)
    }

    /// Returns the index of the sample at a position, counted from 0; the largest `u32` for a position far
    /// beyond the end.
    pub fn index(self, place: u32) -> u32 {
        self.first.saturating_add(place.saturating_mul(self.step))
    }
}

impl IntoIterator for Samples {
    type Item = u32;
    type IntoIter = StepBy<Range<u32>>;

    fn into_iter(self) -> Self::IntoIter {
        (self.first..self.end).step_by(self.step as usize)
    }
}
