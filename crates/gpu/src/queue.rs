//! Submissions that wait, for applications and tests.

use std::sync::PoisonError;
use std::time::Duration;

use ash::vk;

use crate::access::Access;
use crate::device::Device;
use crate::error::Result;
use crate::one_time::OneTime;
use crate::recorder::{Completed, Recorder};
use crate::timers::{PassTiming, TIMED_PASSES, Timers, Timing};

/// Options of a submission.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SubmitOptions {
    /// Method by which passes are timed.
    pub timing: Timing,
    /// Maximum wait for the device, at most an hour, so that every wait ends. If absent, [`Device::timeout`].
    /// With [`Timing::Host`] it applies to each pass separately.
    pub timeout: Option<Duration>,
}

/// Result of a finished submission.
#[derive(Debug, Clone, PartialEq)]
pub struct Submitted<R> {
    /// Value that the recording function returned.
    pub value: R,
    /// Times of the passes, in order; empty with [`Timing::None`].
    pub passes: Vec<PassTiming>,
}

impl Device {
    /// Returns the default maximum wait of submissions: 60 seconds, or ten minutes on a software driver,
    /// whose passes take hundreds of times as long and block no display.
    pub fn timeout(&self) -> Duration {
        Duration::from_secs(if self.is_software() { 600 } else { 60 })
    }

    /// Returns true if this crate may submit; an adopted device may come without a queue.
    pub fn has_queue(&self) -> bool {
        *self.core.queue.lock().unwrap_or_else(PoisonError::into_inner) != vk::Queue::null()
    }

    /// Records commands, submits them and waits for at most [`Device::timeout`].
    ///
    /// # Errors
    /// The first mistake of the recording, [`GpuError::Timeout`](crate::GpuError::Timeout),
    /// [`GpuError::DeviceLost`](crate::GpuError::DeviceLost),
    /// [`GpuError::Abandoned`](crate::GpuError::Abandoned), or an error that the driver reports.
    pub fn submit<R>(&self, record: impl FnOnce(&mut Recorder<'_>) -> R) -> Result<Submitted<R>> {
        self.submit_passes(Timing::None, record)
    }

    /// Submits as [`Device::submit`] does, and measures the times of the passes.
    ///
    /// # Errors
    /// As [`Device::submit`], and [`GpuError::FeatureNotEnabled`](crate::GpuError::FeatureNotEnabled) for
    /// [`Timing::Device`] on a queue without timestamps.
    pub fn submit_passes<R>(
        &self,
        timing: Timing,
        record: impl FnOnce(&mut Recorder<'_>) -> R,
    ) -> Result<Submitted<R>> {
        self.submit_with(&SubmitOptions { timing, timeout: None }, record)
    }

    /// Submits as [`Device::submit`] does, with options.
    ///
    /// With [`Timing::Host`] every pass becomes a submission of its own; bound pipeline, sets and push
    /// constants persist across passes.
    ///
    /// # Errors
    /// As [`Device::submit_passes`].
    pub fn submit_with<R>(
        &self,
        options: &SubmitOptions,
        record: impl FnOnce(&mut Recorder<'_>) -> R,
    ) -> Result<Submitted<R>> {
        let timers = match options.timing {
            Timing::Device => Some(self.create_timers(TIMED_PASSES)?),
            Timing::None | Timing::Host => None,
        };
        let work = OneTime::create(self, options.timeout.unwrap_or_else(|| self.timeout()))?;
        let split = options.timing == Timing::Host;
        let (value, mut completed) = work.record(self, timers.as_ref(), split, record)?;
        let during = if split { "work after the last pass".to_owned() } else { completed.work() };
        work.run(self, &during)?;
        let passes = match &timers {
            Some(timers) => completed.read(timers)?,
            None => std::mem::take(&mut completed.timings),
        };
        Ok(Submitted { value, passes })
    }
}

impl OneTime {
    /// Records the commands of a submission: they run after all earlier submissions, and their results are
    /// visible to the host at its end. The last submission must have been waited for. Returns the value of
    /// `record` and the objects that the recording collected.
    pub(crate) fn record<R>(
        &self,
        device: &Device,
        timers: Option<&Timers>,
        split: bool,
        record: impl FnOnce(&mut Recorder<'_>) -> R,
    ) -> Result<(R, Completed)> {
        self.begin(device)?;
        let mut recorder = Recorder::for_submission(device, self, timers.cloned(), split);
        recorder.emit_barrier(Access::ALL, Access::ALL);
        let value = record(&mut recorder);
        recorder.emit_host_barrier();
        let mut completed = recorder.complete();
        match completed.error.take() {
            Some(error) => Err(error),
            None => Ok((value, completed)),
        }
    }
}
