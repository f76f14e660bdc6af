//! Recorder of commands into a command buffer.

mod bind;
mod bound;
mod commands_of_pass;
mod compute;
mod driver_tree;
mod ownership;
mod raster;
mod render_area;
mod transfer;

use std::any::Any;
use std::sync::Arc;

use ash::vk;

use crate::access::Access;
use crate::buffer::{Buffer, BufferUsage};
use crate::device::Device;
use crate::device_core::{Core, c_name};
use crate::driver_tree::DriverTree;
use crate::error::{GpuError, Result};
use crate::one_time::OneTime;
use crate::stage::Stage;
use crate::timers::{PassTiming, TimerKind, Timers};

use self::bound::Bound;
pub use self::commands_of_pass::PassCommands;
pub use self::render_area::RenderArea;

/// Recorder of commands into one command buffer: of [`Device::submit`], of [`Flights`](crate::Flights), or of
/// a host ([`Recorder::from_raw`]). It never submits, waits or allocates device memory, except in a
/// submission of this crate whose passes the host times one by one.
///
/// Mistakes (a range beyond a buffer, a dispatch without a pipeline …) do not end the program: the recorder
/// keeps the first one and ignores all later commands, and [`Recorder::finish`] or the submission returns it.
///
/// Recorded resources stay alive until the device has finished with them, even if their owner drops or
/// replaces them earlier: a submission of this crate keeps them, and [`Recorded`] keeps them for command
/// buffers of a host.
pub struct Recorder<'a> {
    device: &'a Device,
    command: vk::CommandBuffer,
    error: Option<GpuError>,
    /// Pass that is being recorded, with its timer.
    pass: Option<(Stage, String, Option<u32>)>,
    /// Counts of the commands in each pass so far.
    passes: Vec<PassCommands>,
    rendering: Option<RenderArea>,
    bound: Bound,
    timers: Option<Timers>,
    /// Handles that must live until the device has finished.
    kept: Vec<Arc<dyn Any + Send + Sync>>,
    submission: Option<Submission<'a>>,
}

/// Resources that a command buffer of a host uses. The host keeps it until the device has executed the
/// command buffer for the last time, so that no recorded resource is destroyed too early, whatever happens to
/// its owners.
#[must_use = "what was recorded may be destroyed once this is dropped: keep it until the device is done"]
pub struct Recorded {
    kept: Vec<Arc<dyn Any + Send + Sync>>,
}

impl std::fmt::Debug for Recorded {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Recorded").field("kept", &self.kept.len()).finish()
    }
}

/// State that a recorder keeps for a submission of this crate.
struct Submission<'a> {
    work: &'a OneTime,
    /// True if every pass is submitted separately and timed by the host.
    split: bool,
    labels: Vec<String>,
    timings: Vec<PassTiming>,
}

impl<'a> Recorder<'a> {
    /// Makes a recorder into a command buffer of a host.
    ///
    /// # Safety
    /// - The command buffer was made from this device for its queue family, is being recorded, is outside of
    ///   a render pass or rendering, and is not used elsewhere while this value lives.
    /// - When the [`Recorded`] that [`Recorder::finish`] returns is dropped, the device has executed the
    ///   command buffer, or never will. If `finish` was not called or failed, the command buffer is not
    ///   submitted.
    /// - The bindings of the command buffer (pipelines, sets, push constants, viewport, scissor) may change.
    pub unsafe fn from_raw(device: &'a Device, command: vk::CommandBuffer) -> Recorder<'a> {
        Self {
            device,
            command,
            error: None,
            pass: None,
            passes: Vec::new(),
            rendering: None,
            bound: Bound::default(),
            timers: None,
            kept: Vec::new(),
            submission: None,
        }
    }

    /// Makes a recorder for a submission, whose command buffer is being recorded.
    pub(crate) fn for_submission(
        device: &'a Device,
        work: &'a OneTime,
        timers: Option<Timers>,
        split: bool,
    ) -> Recorder<'a> {
        let submission = Submission { work, split, labels: Vec::new(), timings: Vec::new() };
        Self {
            device,
            command: work.command(),
            error: None,
            pass: None,
            passes: Vec::new(),
            rendering: None,
            bound: Bound::default(),
            timers,
            kept: Vec::new(),
            submission: Some(submission),
        }
    }

    /// Returns the device recorded for.
    pub fn device(&self) -> &'a Device {
        self.device
    }

    /// Returns the command buffer, for commands that this type does not have. After binding an object through
    /// it, pipeline, sets and push constants must be bound again.
    pub fn raw(&self) -> vk::CommandBuffer {
        self.command
    }

    /// Times the passes that are recorded from now on.
    pub fn set_timers(&mut self, timers: &Timers) {
        self.timers = Some(timers.clone());
    }

    /// Ends recording.
    ///
    /// # Errors
    /// The first mistake of the recording; a pass or rendering that was left open is also a mistake.
    pub fn finish(mut self) -> Result<Recorded> {
        self.check_closed();
        self.error.map_or(Ok(Recorded { kept: self.kept }), Err)
    }

    /// Keeps a buffer that shaders reach by its address alive until the device has finished.
    pub fn keep_buffer(&mut self, buffer: &Buffer) {
        self.keep(buffer.inner.clone());
    }

    /// Keeps a tree that ray queries of shaders use alive until the device has finished.
    pub fn keep_driver_tree(&mut self, tree: &DriverTree) {
        self.keep(tree.kept());
    }

    /// Refuses a request of the caller: it counts as a mistake of the recording, and no later command is
    /// recorded.
    pub fn refuse(&mut self, reason: &str) {
        self.misuse(reason);
    }

    /// Begins a pass, which has a label in tools and, as part of a stage, a time in reports. Passes do not
    /// nest.
    pub fn begin_pass(&mut self, stage: Stage, label: &str) {
        if !self.outside_rendering("begin_pass") {
            return;
        }
        if let Some((_, open, _)) = &self.pass {
            let reason = format!("a pass was begun within the pass `{open}`");
            return self.fail(GpuError::InvalidUse { name: label.to_owned(), reason });
        }
        if self.split_here(None) {
            return;
        }
        if let Some(submission) = &mut self.submission {
            submission.labels.push(label.to_owned());
        }
        if let Some(labels) = &self.core().labels {
            let name = c_name(label);
            let info = vk::DebugUtilsLabelEXT::default().label_name(&name);
            // SAFETY: the command buffer is being recorded and the extension is enabled.
            unsafe { labels.cmd_begin_debug_utils_label(self.command, &info) };
        }
        // SAFETY: the command buffer is being recorded, outside of rendering.
        let timer =
            self.timers.as_ref().and_then(|timers| unsafe { timers.begin(self.command, stage, label) });
        if let Some(timers) = &self.timers {
            self.keep(timers.kept());
        }
        self.passes.push(PassCommands::of(stage, label));
        self.pass = Some((stage, label.to_owned(), timer));
    }

    /// Ends the open pass.
    pub fn end_pass(&mut self) {
        if !self.outside_rendering("end_pass") {
            return;
        }
        let Some((stage, label, timer)) = self.pass.take() else {
            return self.misuse("a pass was ended that was not begun");
        };
        if let (Some(timers), Some(index)) = (&self.timers, timer) {
            // SAFETY: the command buffer is being recorded, outside of rendering, and the pass was begun in
            // it.
            unsafe { timers.end(self.command, index) };
        }
        if let Some(labels) = &self.core().labels {
            // SAFETY: a label was begun in this command buffer.
            unsafe { labels.cmd_end_debug_utils_label(self.command) };
        }
        self.split_here(Some((stage, label)));
    }

    /// Makes accesses `to` wait for accesses `from` and see their writes, for all memory.
    pub fn barrier(&mut self, from: Access, to: Access) {
        if self.outside_rendering("barrier") {
            self.emit_barrier(from, to);
        }
    }

    /// Returns the counts of the commands recorded so far in each pass, in order. Commands outside of passes
    /// are not counted.
    pub fn passes(&self) -> &[PassCommands] {
        &self.passes
    }

    /// Counts a command in the open pass, if there is one.
    fn count(&mut self, command: impl FnOnce(&mut PassCommands)) {
        if self.pass.is_some()
            && let Some(pass) = self.passes.last_mut()
        {
            command(pass);
        }
    }

    /// Ends a recording for a submission: returns the data that it collected, or the first mistake.
    pub(crate) fn complete(mut self) -> Completed {
        self.check_closed();
        let (labels, timings) = match self.submission.take() {
            Some(submission) => (submission.labels, submission.timings),
            None => Default::default(),
        };
        Completed { error: self.error, _kept: self.kept, labels, timings }
    }

    /// Returns the shared state of the device. The device outlives the recorder, so this borrow does not
    /// depend on the recorder.
    fn core(&self) -> &'a Core {
        &self.device.core
    }

    fn raw_device(&self) -> &'a ash::Device {
        &self.core().device
    }

    fn keep(&mut self, value: Arc<dyn Any + Send + Sync>) {
        self.kept.push(value);
    }

    fn is_recording(&self) -> bool {
        self.error.is_none()
    }

    fn fail(&mut self, error: GpuError) {
        self.error.get_or_insert(error);
    }

    /// Returns the name that an error gives for a mistake: the pass, or the recording outside of a pass.
    fn place(&self) -> String {
        self.pass.as_ref().map_or_else(|| "recording".to_owned(), |(_, label, _)| label.clone())
    }

    fn misuse(&mut self, reason: &str) {
        let name = self.place();
        self.fail(GpuError::InvalidUse { name, reason: reason.to_owned() });
    }

    fn exceed(&mut self, what: &'static str, asked: u64, limit: u64) {
        let name = self.place();
        self.fail(GpuError::LimitExceeded { name, what, asked, limit });
    }

    fn check_closed(&mut self) {
        if self.rendering.is_some() {
            self.misuse("rendering was not ended");
        }
        if self.pass.is_some() {
            self.misuse("the pass was not ended");
        }
    }

    /// Returns true if a command that is forbidden within rendering may be recorded.
    fn outside_rendering(&mut self, command: &str) -> bool {
        if self.rendering.is_some() {
            self.misuse(&format!("{command} was called between begin_rendering and end_rendering"));
        }
        self.is_recording()
    }

    fn has_pipeline(&mut self, bind_point: vk::PipelineBindPoint) -> bool {
        if self.is_recording()
            && self.bound.pipeline.as_ref().is_none_or(|bound| bound.bind_point != bind_point)
        {
            self.misuse(match bind_point {
                vk::PipelineBindPoint::COMPUTE => "a dispatch was recorded without a compute pipeline",
                _ => "a draw was recorded without a raster pipeline",
            });
        } else if let Some(missing) = self.bound.missing() {
            self.misuse(&missing);
        }
        self.is_recording()
    }

    fn indirect_arguments(&mut self, buffer: &Buffer, offset: u64, size: u64) -> bool {
        let usage = buffer.check_use(&self.device.core, BufferUsage::INDIRECT, "indirect arguments");
        if let Err(error) = usage.and_then(|()| buffer.check_range(offset, size)) {
            self.fail(error);
        } else if !offset.is_multiple_of(4) {
            self.misuse("the offset of indirect arguments must be a multiple of 4");
        }
        self.keep(buffer.inner.clone());
        self.is_recording()
    }

    pub(crate) fn emit_barrier(&mut self, from: Access, to: Access) {
        let core = self.core();
        let (from_stages, from_access) = from.scope(core.graphics);
        let (to_stages, to_access) = to.scope(core.graphics);
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(from_stages)
            .src_access_mask(from_access)
            .dst_stage_mask(to_stages)
            .dst_access_mask(to_access)];
        let info = vk::DependencyInfo::default().memory_barriers(&barriers);
        // SAFETY: the command buffer is being recorded, outside of rendering, and the queue supports the
        // stages.
        unsafe { (core.commands.pipeline_barrier)(self.command, &info) };
    }

    /// Makes all recorded results visible to the host once the submission has been waited for.
    pub(crate) fn emit_host_barrier(&mut self) {
        if self.is_recording() && self.rendering.is_none() {
            self.emit_barrier(Access::ALL, Access::HOST_READ);
        }
    }

    /// If passes are submitted separately, submits the commands recorded so far, waits, notes the time of
    /// `pass`, and continues with the same state bound. Returns true if that failed.
    fn split_here(&mut self, pass: Option<(Stage, String)>) -> bool {
        if !self.submission.as_ref().is_some_and(|submission| submission.split) {
            return false;
        }
        self.emit_host_barrier();
        let Some(submission) = self.submission.as_mut() else { return false };
        let during = pass.as_ref().map_or("work between passes", |(_, label)| label);
        let restarted = submission.work.run(self.device, during).and_then(|elapsed| {
            if let Some((stage, label)) = &pass {
                let milliseconds = elapsed.as_secs_f64() * 1e3;
                let (stage, label) = (*stage, label.clone());
                submission.timings.push(PassTiming { stage, label, milliseconds, timer: TimerKind::Host });
            }
            submission.work.begin(self.device)
        });
        if let Err(error) = restarted {
            self.fail(error);
            return true;
        }
        self.emit_barrier(Access::ALL, Access::ALL);
        self.emit_state();
        false
    }
}

/// Outcome of a recording for a submission.
pub(crate) struct Completed {
    pub(crate) error: Option<GpuError>,
    /// Resources that live until the device has finished.
    _kept: Vec<Arc<dyn Any + Send + Sync>>,
    pub(crate) labels: Vec<String>,
    pub(crate) timings: Vec<PassTiming>,
}

impl Completed {
    /// Returns the labels of the passes in words, for errors.
    pub(crate) fn work(&self) -> String {
        if self.labels.is_empty() { "work without a pass".to_owned() } else { self.labels.join(", ") }
    }

    /// Returns the times of the passes, after the device has finished.
    pub(crate) fn read(&self, timers: &Timers) -> Result<Vec<PassTiming>> {
        let passes = timers.read()?;
        if passes.len() < self.labels.len() {
            let (left, all) = (self.labels.len() - passes.len(), self.labels.len());
            tracing::warn!("{left} of {all} passes were not timed");
        }
        Ok(passes)
    }
}
