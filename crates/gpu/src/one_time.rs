//! A command buffer that this crate submits.

use std::sync::{Arc, PoisonError};
use std::time::{Duration, Instant};

use ash::vk;

use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};

/// Maximum duration of any wait.
const LONGEST_WAIT: Duration = Duration::from_secs(3600);

/// Name of the work in errors of calls before its passes are known.
const NEW_WORK: &str = "new work";

/// A command buffer that is recorded, submitted and waited for, once or repeatedly.
pub(crate) struct OneTime {
    core: Arc<Core>,
    pool: vk::CommandPool,
    command: vk::CommandBuffer,
    fence: vk::Fence,
    timeout: Duration,
}

impl OneTime {
    pub(crate) fn create(device: &Device, timeout: Duration) -> Result<Self> {
        let core = &device.core;
        if !core.is_usable() {
            return Err(GpuError::Abandoned { during: NEW_WORK.to_owned() });
        }
        if device.raw_queue() == vk::Queue::null() {
            return Err(GpuError::InvalidUse {
                name: device.name().to_owned(),
                reason: "was handed in without a queue, so nothing can be submitted to it".to_owned(),
            });
        }
        let info = vk::CommandPoolCreateInfo::default()
            .flags(vk::CommandPoolCreateFlags::TRANSIENT)
            .queue_family_index(core.queue_family);
        // SAFETY: the family exists.
        let pool = unsafe { core.device.create_command_pool(&info, None) }
            .during("vkCreateCommandPool", NEW_WORK)?;
        // From here on, dropping `work` destroys the objects made so far; null handles are ignored.
        let mut work = Self {
            core: core.clone(),
            pool,
            command: vk::CommandBuffer::null(),
            fence: vk::Fence::null(),
            timeout: timeout.min(LONGEST_WAIT),
        };
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .level(vk::CommandBufferLevel::PRIMARY)
            .command_buffer_count(1);
        // SAFETY: the pool is fresh.
        let commands = unsafe { core.device.allocate_command_buffers(&info) }
            .during("vkAllocateCommandBuffers", NEW_WORK)?;
        work.command = commands.first().copied().unwrap_or_default();
        // SAFETY: no conditions.
        work.fence = unsafe { core.device.create_fence(&vk::FenceCreateInfo::default(), None) }
            .during("vkCreateFence", NEW_WORK)?;
        Ok(work)
    }

    pub(crate) fn command(&self) -> vk::CommandBuffer {
        self.command
    }

    /// Starts recording; the command buffer must be new or waited for.
    pub(crate) fn begin(&self, device: &Device) -> Result<()> {
        let raw = device.raw();
        // SAFETY: no command buffer of the pool is pending, as the caller has waited for it.
        unsafe { raw.reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty()) }
            .during("vkResetCommandPool", NEW_WORK)?;
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the command buffer is in its initial state.
        unsafe { raw.begin_command_buffer(self.command, &info) }.during("vkBeginCommandBuffer", NEW_WORK)
    }

    /// Ends recording, submits and waits; returns the time from the submission to the end of the wait.
    /// `during` names the work in errors. After a timeout the device is abandoned.
    pub(crate) fn run(&self, device: &Device, during: &str) -> Result<Duration> {
        let start = self.submit(device, during)?;
        self.wait(device, during)?;
        Ok(start.elapsed())
    }

    /// Ends recording and submits; returns the time of the submission. The next call must be
    /// [`OneTime::wait`].
    pub(crate) fn submit(&self, device: &Device, during: &str) -> Result<Instant> {
        let raw = device.raw();
        if !self.core.is_usable() {
            return Err(GpuError::Abandoned { during: during.to_owned() });
        }
        // SAFETY: the command buffer is being recorded.
        unsafe { raw.end_command_buffer(self.command) }.during("vkEndCommandBuffer", during)?;
        let commands = [self.command];
        let submit = vk::SubmitInfo::default().command_buffers(&commands);
        let start = Instant::now();
        let queue = self.core.queue.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: the lock excludes other submissions of this crate, and the contract of adoption those of a
        // host; the fence is unsignalled; the recorder keeps the objects that the commands use.
        unsafe { raw.queue_submit(*queue, &[submit], self.fence) }.during("vkQueueSubmit", during)?;
        Ok(start)
    }

    /// Returns true if the device has finished the last submission.
    pub(crate) fn is_done(&self, device: &Device, during: &str) -> Result<bool> {
        // SAFETY: the fence belongs to the last submission.
        unsafe { device.raw().get_fence_status(self.fence) }.during("vkGetFenceStatus", during)
    }

    /// Waits for the last submission. After a timeout the device is abandoned.
    pub(crate) fn wait(&self, device: &Device, during: &str) -> Result<()> {
        let raw = device.raw();
        // An hour in nanoseconds fits into 64 bits.
        let timeout = self.timeout.as_nanos() as u64;
        // SAFETY: the fence belongs to the last submission.
        let wait = || unsafe { raw.wait_for_fences(&[self.fence], true, timeout) };
        match wait() {
            Ok(()) => {}
            Err(vk::Result::TIMEOUT) => {
                self.core.abandon();
                let seconds = self.timeout.as_secs_f64();
                return Err(GpuError::Timeout { pass: during.to_owned(), seconds });
            }
            Err(failed) => {
                // The wait failed, not the work. Objects that the work uses must not be destroyed while it
                // runs, so the function waits once more; a lost device runs nothing any more.
                let ended = failed == vk::Result::ERROR_DEVICE_LOST
                    || matches!(wait(), Ok(()) | Err(vk::Result::ERROR_DEVICE_LOST));
                if !ended {
                    self.core.abandon();
                }
                return Err(GpuError::from_vulkan(failed, "vkWaitForFences", during));
            }
        }
        // SAFETY: the fence is signalled, and nothing waits for it.
        unsafe { raw.reset_fences(&[self.fence]) }.during("vkResetFences", during)
    }
}

impl Drop for OneTime {
    fn drop(&mut self) {
        if self.core.is_usable() {
            // SAFETY: the work was waited for or never submitted. Null is ignored.
            unsafe {
                self.core.device.destroy_fence(self.fence, None);
                self.core.device.destroy_command_pool(self.pool, None);
            }
        }
    }
}
