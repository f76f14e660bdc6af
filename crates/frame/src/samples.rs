//! Samples of an image to make.

use std::iter::StepBy;
use std::ops::Range;

/// Indices of samples, at the same distance from one to the next: all of an image, some that are added to it,
/// or a share of them. Random numbers depend on the index, so shares add up to the image.
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
    /// Every `step`th of these, from the first on; every one where `step` is 0.
    #[must_use]
    pub fn step_by(self, step: u32) -> Self {
        Self { step: step.max(1), ..self }
    }

    /// Number of samples.
    pub fn count(self) -> u32 {
        self.end.saturating_sub(self.first).div_ceil(self.step)
    }

    /// The index of the sample at a place, from 0; the last index there is for a place far beyond the end.
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
