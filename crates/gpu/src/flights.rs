//! Frames in flight: submissions that the host does not wait for at once.

use crate::device::Device;
use crate::error::{GpuError, Result};
use crate::one_time::OneTime;
use crate::recorder::{Completed, Recorder};
use crate::timers::{PassTiming, TIMED_PASSES, Timers, Timing};

/// A ring of command buffers that are submitted without waiting, one per frame in flight: the host records
/// the next frame while the device works on the last one.
///
/// Submissions run in the order in which they were made, each after all earlier ones have ended. Objects that
/// they use live until they are waited for. Dropping the ring waits for all submissions.
pub struct Flights {
    device: Device,
    slots: Vec<Slot>,
}

struct Slot {
    work: OneTime,
    timers: Option<Timers>,
    /// Recording of submitted work that the device may still be executing.
    pending: Option<Completed>,
}

impl std::fmt::Debug for Flights {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let pending = self.slots.iter().filter(|slot| slot.pending.is_some()).count();
        formatter
            .debug_struct("Flights")
            .field("slots", &self.slots.len())
            .field("pending", &pending)
            .finish_non_exhaustive()
    }
}

impl Flights {
    /// Makes a ring with `slots` slots, at least 1.
    ///
    /// # Errors
    /// [`GpuError::InvalidUse`] for [`Timing::Host`], which waits for every pass, and for a device without a
    /// queue; [`GpuError::FeatureNotEnabled`] for [`Timing::Device`] on a queue without timestamps, or an
    /// error that the driver reports.
    pub fn new(device: &Device, slots: u32, timing: Timing) -> Result<Self> {
        if timing == Timing::Host {
            return Err(GpuError::InvalidUse {
                name: "frames in flight".to_owned(),
                reason: "the host times passes by waiting for each, which frames in flight do not".to_owned(),
            });
        }
        let slot = |_| {
            let timers = match timing {
                Timing::Device => Some(device.create_timers(TIMED_PASSES)?),
                _ => None,
            };
            Ok(Slot { work: OneTime::create(device, device.timeout())?, timers, pending: None })
        };
        let slots = (0..slots.max(1)).map(slot).collect::<Result<_>>()?;
        Ok(Self { device: device.clone(), slots })
    }

    /// Returns the number of slots.
    pub fn slots(&self) -> u32 {
        self.slots.len() as u32
    }

    /// Returns true if a slot has a submission that was not waited for.
    pub fn is_pending(&self, slot: u32) -> bool {
        self.slots.get(slot as usize).is_some_and(|slot| slot.pending.is_some())
    }

    /// Returns true if [`Flights::wait`] would return at once.
    ///
    /// # Errors
    /// The slot does not exist, or the device is lost.
    pub fn is_done(&self, slot: u32) -> Result<bool> {
        let slot = self.slots.get(slot as usize).ok_or_else(|| missing(slot))?;
        match &slot.pending {
            Some(completed) => slot.work.is_done(&self.device, &completed.work()),
            None => Ok(true),
        }
    }

    /// Records commands and submits them; returns the value that `record` returned.
    ///
    /// # Errors
    /// The slot does not exist, or its last submission was not waited for; the first mistake of the
    /// recording, which then submits nothing; [`GpuError::Abandoned`], or an error that the driver reports.
    pub fn submit<R>(&mut self, slot: u32, record: impl FnOnce(&mut Recorder<'_>) -> R) -> Result<R> {
        let device = self.device.clone();
        let Slot { work, timers, pending } =
            self.slots.get_mut(slot as usize).ok_or_else(|| missing(slot))?;
        if pending.is_some() {
            return Err(misuse(format!("slot {slot} was not waited for since it was submitted")));
        }
        if let Some(timers) = timers {
            timers.clear();
        }
        let (value, completed) = work.record(&device, timers.as_ref(), false, record)?;
        work.submit(&device, &completed.work())?;
        *pending = Some(completed);
        Ok(value)
    }

    /// Waits, at most [`Device::timeout`], for the last submission of a slot, and returns the times of its
    /// passes, if the ring times them. `None` if nothing was submitted since the last wait.
    ///
    /// # Errors
    /// The slot does not exist; [`GpuError::Timeout`], after which the device is abandoned, or
    /// [`GpuError::DeviceLost`].
    pub fn wait(&mut self, slot: u32) -> Result<Option<Vec<PassTiming>>> {
        let Slot { work, timers, pending } =
            self.slots.get_mut(slot as usize).ok_or_else(|| missing(slot))?;
        let Some(completed) = pending.take() else { return Ok(None) };
        work.wait(&self.device, &completed.work())?;
        timers.as_ref().map_or(Ok(Vec::new()), |timers| completed.read(timers)).map(Some)
    }

    /// Waits for all submissions.
    ///
    /// # Errors
    /// As [`Flights::wait`].
    pub fn wait_all(&mut self) -> Result<()> {
        (0..self.slots()).try_for_each(|slot| self.wait(slot).map(drop))
    }
}

impl Drop for Flights {
    fn drop(&mut self) {
        for slot in 0..self.slots() {
            // A lost or abandoned device is not waited for any more.
            if let Err(error) = self.wait(slot) {
                tracing::warn!("a frame in flight did not end: {error}");
            }
        }
    }
}

fn missing(slot: u32) -> GpuError {
    misuse(format!("there is no slot {slot}"))
}

fn misuse(reason: String) -> GpuError {
    GpuError::InvalidUse { name: "frames in flight".to_owned(), reason }
}
