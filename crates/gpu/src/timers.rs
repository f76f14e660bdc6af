//! Times of passes, by timestamps of the device or by the clock of the host.

use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;

use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};
use crate::stage::Stage;

/// Maximum number of passes of a submission that the device times.
pub(crate) const TIMED_PASSES: u32 = 1024;

/// Method by which passes are timed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Timing {
    /// Passes are not timed.
    #[default]
    None,
    /// Timestamps of the device measure all passes in one submission. Passes without a barrier between them
    /// overlap.
    Device,
    /// The clock of the host measures each pass, with a submission and a wait for every pass. A time includes
    /// the cost of a submission.
    Host,
}

/// Clock that measured a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TimerKind {
    /// Timestamps of the device.
    Device,
    /// The clock of the host, around submission and wait.
    Host,
}

/// Time of one pass.
#[derive(Debug, Clone, PartialEq)]
pub struct PassTiming {
    /// Part of a frame that the pass belongs to.
    pub stage: Stage,
    /// Label of the pass.
    pub label: String,
    /// Duration of the pass in milliseconds.
    pub milliseconds: f64,
    /// Clock that measured the duration.
    pub timer: TimerKind,
}

/// Timestamps for the passes of one recording. Clones are handles to the same timers.
#[derive(Clone)]
pub struct Timers {
    inner: Arc<TimersInner>,
}

struct TimersInner {
    core: Arc<Core>,
    pool: vk::QueryPool,
    capacity: u32,
    /// Stage and label of each pass recorded so far.
    passes: Mutex<Vec<(Stage, String)>>,
}

impl std::fmt::Debug for Timers {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Timers").field("capacity", &self.inner.capacity).finish_non_exhaustive()
    }
}

impl Device {
    /// Returns the timing method that gives correct times on this device: the host's clock on software
    /// drivers and on queues without timestamps, the device's timestamps elsewhere.
    pub fn best_timing(&self) -> Timing {
        if self.is_software() || self.limits().timestamp_valid_bits == 0 {
            Timing::Host
        } else {
            Timing::Device
        }
    }

    /// Makes timers for up to `capacity` passes; further passes are not timed.
    ///
    /// # Errors
    /// [`GpuError::FeatureNotEnabled`] if the queue has no timestamps, or an error that the driver reports.
    pub fn create_timers(&self, capacity: u32) -> Result<Timers> {
        let core = &self.core;
        if core.limits.timestamp_valid_bits == 0 {
            return Err(GpuError::FeatureNotEnabled {
                feature: crate::Feature::TimestampQueries,
                what: "timing by the device".to_owned(),
            });
        }
        let capacity = capacity.clamp(1, u32::MAX / 2);
        let info =
            vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(2 * capacity);
        // SAFETY: a pool of timestamps has no further conditions.
        let pool =
            unsafe { core.device.create_query_pool(&info, None) }.during("vkCreateQueryPool", "timers")?;
        core.name_object(pool, "timers");
        let passes = Mutex::new(Vec::new());
        Ok(Timers { inner: Arc::new(TimersInner { core: core.clone(), pool, capacity, passes }) })
    }
}

impl Timers {
    /// Returns the times of the passes recorded with these timers, in order, and forgets the passes. The
    /// caller has waited for the recorded commands.
    ///
    /// # Errors
    /// [`GpuError::Vulkan`] with `NOT_READY` if the commands were not submitted or not waited for.
    pub fn read(&self) -> Result<Vec<PassTiming>> {
        let inner = &self.inner;
        let mut passes = inner.passes.lock().unwrap_or_else(PoisonError::into_inner);
        if passes.is_empty() {
            return Ok(Vec::new());
        }
        let mut ticks = vec![0_u64; 2 * passes.len()];
        // SAFETY: every query read was recorded; the buffer holds one 64-bit value for each.
        unsafe {
            inner.core.device.get_query_pool_results(inner.pool, 0, &mut ticks, vk::QueryResultFlags::TYPE_64)
        }
        .during("vkGetQueryPoolResults", "timers")?;
        let limits = &inner.core.limits;
        let mask =
            if limits.timestamp_valid_bits >= 64 { u64::MAX } else { (1 << limits.timestamp_valid_bits) - 1 };
        let times = std::mem::take(&mut *passes).into_iter().zip(ticks.chunks_exact(2));
        Ok(times
            .map(|((stage, label), ticks)| {
                let elapsed = ticks[1].wrapping_sub(ticks[0]) & mask;
                let milliseconds = elapsed as f64 * f64::from(limits.timestamp_period) * 1e-6;
                PassTiming { stage, label, milliseconds, timer: TimerKind::Device }
            })
            .collect())
    }

    /// Forgets the passes recorded so far, for a recording that will not be submitted.
    pub fn clear(&self) {
        self.inner.passes.lock().unwrap_or_else(PoisonError::into_inner).clear();
    }

    /// Returns the handles that a submission keeps until the device has finished.
    pub(crate) fn kept(&self) -> Arc<dyn std::any::Any + Send + Sync> {
        self.inner.clone()
    }

    /// Records the start of a pass; `None` if all timers are taken.
    ///
    /// # Safety
    /// `command` is being recorded, outside of rendering.
    pub(crate) unsafe fn begin(&self, command: vk::CommandBuffer, stage: Stage, label: &str) -> Option<u32> {
        let inner = &self.inner;
        let mut passes = inner.passes.lock().unwrap_or_else(PoisonError::into_inner);
        let index = u32::try_from(passes.len()).ok().filter(|index| *index < inner.capacity)?;
        passes.push((stage, label.to_owned()));
        // SAFETY: the caller guarantees the command buffer; the queries lie within the pool.
        unsafe {
            inner.core.device.cmd_reset_query_pool(command, inner.pool, 2 * index, 2);
            inner.core.device.cmd_write_timestamp(
                command,
                vk::PipelineStageFlags::TOP_OF_PIPE,
                inner.pool,
                2 * index,
            );
        }
        Some(index)
    }

    /// Records the end of a pass.
    ///
    /// # Safety
    /// `command` is the one in which the pass was begun with this `index`, outside of rendering.
    pub(crate) unsafe fn end(&self, command: vk::CommandBuffer, index: u32) {
        // SAFETY: the caller guarantees the command buffer; the query lies within the pool and was reset.
        unsafe {
            self.inner.core.device.cmd_write_timestamp(
                command,
                vk::PipelineStageFlags::BOTTOM_OF_PIPE,
                self.inner.pool,
                2 * index + 1,
            );
        }
    }
}

impl Drop for TimersInner {
    fn drop(&mut self) {
        if self.core.is_usable() {
            // SAFETY: submissions that use the pool hold a handle to it, so none is pending; embedders keep
            // the objects that they record alive.
            unsafe { self.core.device.destroy_query_pool(self.pool, None) };
        }
    }
}
