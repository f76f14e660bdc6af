//! Rounds of a wave whose rays continue behind their hits, any number of times.

use std::sync::atomic::{AtomicU32, Ordering};

use rasray_ads::{Domain, RayQueue};
use rasray_gpu::Recorder;
use rasray_shaders_glsl::constants::scene::{WAVE_ROUND_LAST, WAVE_ROUND_RESUMES};

use crate::{IntegratorError, Traced, Wave, kernels::WaveConstants};

/// Number of closest-hit rounds in one recording of a wave. Rays that have not ended after these rounds count
/// in [`FilmFaults::unended`](crate::FilmFaults) and are the rest of the wave.
#[derive(Debug)]
pub(crate) struct Rounds {
    now: AtomicU32,
    limit: u32,
    is_masked: bool,
}

impl Rounds {
    /// Makes a number that is `first` at first, and at most `limit`.
    pub fn new(first: u32, limit: u32) -> Self {
        Self { now: first.min(limit).into(), limit, is_masked: false }
    }

    /// Makes passes work on all slots of the wave, also those whose ray is inactive, if `is_masked`.
    pub fn masked(self, is_masked: bool) -> Self {
        Self { is_masked, ..self }
    }

    /// Returns the slots on which passes over rays of `wave` work after the first round.
    pub fn later(&self, wave: Wave) -> Domain {
        if self.is_masked { Domain::First(wave.pixel_count) } else { Domain::Selected }
    }

    /// Returns the number of rounds that are recorded.
    pub fn now(&self) -> u32 {
        self.now.load(Ordering::Relaxed)
    }

    /// Doubles the number from the next recording on; returns false if there cannot be more.
    pub fn allow_more(&self) -> bool {
        let now = self.now();
        self.now.store(now.saturating_mul(2).min(self.limit), Ordering::Relaxed);
        now < self.limit
    }

    /// Records the rounds of a new wave, whose camera rays are in the queue, or of the rest of one. A round
    /// is a trace, then `shade`, which gets the slots that were traced, and selects those that have another
    /// ray.
    ///
    /// # Errors
    /// An error if the structure was made without a scene.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        (traced, wave): (Traced<'_>, Wave),
        queue: &RayQueue,
        is_rest: bool,
        mut shade: impl FnMut(&mut Recorder<'_>, Domain, WaveConstants),
    ) -> Result<(), IntegratorError> {
        let mut live = if is_rest { self.later(wave) } else { Domain::First(wave.pixel_count) };
        let first = u32::from(is_rest);
        let end = first + self.now();
        for round in first..end {
            let mut marks = if is_rest && round == first { WAVE_ROUND_RESUMES } else { 0 };
            marks |= if round + 1 == end { WAVE_ROUND_LAST } else { 0 };
            if round == 0 {
                traced.record_primary(recorder, queue, wave)?;
            } else {
                traced.record_closest(recorder, queue, live)?;
            }
            shade(recorder, live, WaveConstants { round, marks, ..WaveConstants::from(wave) });
            queue.record_take(recorder);
            live = self.later(wave);
        }
        Ok(())
    }
}
