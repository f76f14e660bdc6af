//! Submitting and waiting, for applications and tests.

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
    /// Timing of passes.
    pub timing: Timing,
    /// Longest wait for the device, at most an hour: every wait has an end. [`Device::timeout`] where absent.
    /// With [`Timing::Host`] it holds for each pass by itself.
    pub timeout: Option<Duration>,
}

/// Result of a finished submission.
#[derive(Debug, Clone, PartialEq)]
pub struct Submitted<R> {
    /// Value that the recording function returned.
    pub value: R,
    /// Times of the passes in order; empty with [`Timing::None`].
    pub passes: Vec<PassTiming>,
}

impl Device {
    /// Longest wait of submissions unless told: 60 seconds, and ten minutes on a software driver, whose
    /// passes take hundreds of times as long and hold up no display.
    pub fn timeout(&self) -> Duration {
        Duration::from_secs(if self.is_software() { 600 } else { 60 })
    }

    /// True if this crate may submit: an adopted device may come without a queue.
    pub fn has_queue(&self) -> bool {
        *self.core.queue.lock().unwrap_or_else(PoisonError::into_inner) != vk::Queue::null()
    }

    /// Records commands, submits them and waits up to [`Device::timeout`].
    ///
    /// # Errors
    /// The first mistake of the recording, [`GpuError::Timeout`](crate::GpuError::Timeout),
    /// [`GpuError::DeviceLost`](crate::GpuError::DeviceLost),
    /// [`GpuError::Abandoned`](crate::GpuError::Abandoned), or what the driver reports.
    pub fn submit<R>(&self, record: impl FnOnce(&mut Recorder<'_>) -> R) -> Result<Submitted<R>> {
        self.submit_passes(Timing::None, record)
    }

    /// As [`Device::submit`], with times of the passes.
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

    /// As [`Device::submit`], with options.
    ///
    /// With [`Timing::Host`] every pass becomes a submission of its own; bound pipeline, sets and push
    /// constants go on across it.
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
    /// Records what a submission does, after everything submitted before it and visible to the host at its
    /// end. What was submitted last was waited for. Returns what `record` did and what the recording left
    /// behind.
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
