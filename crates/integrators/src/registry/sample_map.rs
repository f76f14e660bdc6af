//! State of integrators that use a map of the scene, made anew for each sample.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::Wave;

/// Sample of the current map.
#[derive(Debug, Default)]
pub(super) struct SampleMap {
    /// Number of the sample whose map was made last, plus 1; 0 if there is none.
    sample: AtomicU64,
}

impl SampleMap {
    /// True if a wave needs a new map: the current one is of another sample, or the scene may have moved.
    pub(super) fn is_needed(&self, wave: Wave) -> bool {
        self.sample.load(Ordering::Relaxed) != number_of(wave) || wave.first_pixel == 0
    }

    /// Notes that the current map is the wave's.
    pub(super) fn was_made(&self, wave: Wave) {
        self.sample.store(number_of(wave), Ordering::Relaxed);
    }

    /// Forgets the map, since the scene is another one.
    pub(super) fn forget(&mut self) {
        *self.sample.get_mut() = 0;
    }
}

/// Returns the wave's sample, plus 1.
fn number_of(wave: Wave) -> u64 {
    u64::from(wave.sample) + 1
}
