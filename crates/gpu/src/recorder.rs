//! Recording into a command buffer.

use std::any::Any;
use std::sync::Arc;

use ash::vk;

use crate::access::Access;
use crate::binding::BindingSet;
use crate::buffer::{Buffer, BufferUsage};
use crate::core::{Core, c_name};
use crate::device::Device;
use crate::error::{GpuError, Result};
use crate::features::Feature;
use crate::pipeline::{ComputePipeline, PipelineInner, RasterPipeline};
use crate::queue::OneTime;
use crate::timers::{PassTiming, TimerKind, Timers};

/// What is drawn into: a number of pixels, no images.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RenderArea {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Layers that the vertex shader can choose from; ignored with a view mask.
    pub layers: u32,
    /// Views drawn at once, one bit each; 0 is off.
    pub view_mask: u32,
}

/// Records commands into a command buffer. It never submits, waits or allocates device memory.
///
/// Mistakes (a range beyond a buffer, a dispatch without a pipeline …) do not end the program: the first one
/// is kept, nothing more is recorded, and [`Recorder::finish`] or the submission returns it.
pub struct Recorder<'a> {
    device: &'a Device,
    command: vk::CommandBuffer,
    error: Option<GpuError>,
    /// The pass being recorded, with its timer.
    pass: Option<(String, Option<u32>)>,
    rendering: Option<RenderArea>,
    state: State,
    timers: Option<Timers>,
    submission: Option<Submission<'a>>,
}

/// What is bound.
#[derive(Default)]
struct State {
    pipeline: Option<Arc<PipelineInner>>,
    sets: Vec<Option<BindingSet>>,
    constants: Vec<u8>,
}

/// What a recorder keeps for a submission of this crate.
struct Submission<'a> {
    work: &'a OneTime,
    /// Whether every pass is submitted by itself and timed by the host.
    split: bool,
    /// What must live until the device is done.
    kept: Vec<Arc<dyn Any + Send + Sync>>,
    labels: Vec<String>,
    timings: Vec<PassTiming>,
}

impl<'a> Recorder<'a> {
    /// Records into a command buffer of a host.
    ///
    /// # Safety
    /// - The command buffer was made from this device for its queue family, is being recorded, is outside of a
    ///   render pass or rendering, and is not used elsewhere while this value lives.
    /// - Every buffer, set, pipeline and timer recorded outlives the execution of the command buffer.
    /// - What is bound in the command buffer (pipelines, sets, push constants, viewport, scissor) may change.
    pub unsafe fn from_raw(device: &'a Device, command: vk::CommandBuffer) -> Recorder<'a> {
        Self {
            device,
            command,
            error: None,
            pass: None,
            rendering: None,
            state: State::default(),
            timers: None,
            submission: None,
        }
    }

    /// A recorder for a submission, whose command buffer is being recorded.
    pub(crate) fn for_submission(
        device: &'a Device,
        work: &'a OneTime,
        timers: Option<Timers>,
        split: bool,
    ) -> Recorder<'a> {
        let submission =
            Submission { work, split, kept: Vec::new(), labels: Vec::new(), timings: Vec::new() };
        Self {
            device,
            command: work.command(),
            error: None,
            pass: None,
            rendering: None,
            state: State::default(),
            timers,
            submission: Some(submission),
        }
    }

    /// The device recorded for.
    pub fn device(&self) -> &'a Device {
        self.device
    }

    /// The command buffer, for commands this type does not have. After it was used to bind something, bind
    /// pipeline, sets and push constants again.
    pub fn raw(&self) -> vk::CommandBuffer {
        self.command
    }

    /// Times the passes recorded from now on.
    pub fn set_timers(&mut self, timers: &Timers) {
        self.timers = Some(timers.clone());
    }

    /// Ends recording.
    ///
    /// # Errors
    /// The first mistake of the recording, a pass or rendering left open included.
    pub fn finish(mut self) -> Result<()> {
        self.check_closed();
        self.error.map_or(Ok(()), Err)
    }

    /// Begins a pass: a label in tools and a time in reports. Passes do not nest.
    pub fn begin_pass(&mut self, label: &str) {
        if !self.outside_rendering("begin_pass") {
            return;
        }
        if let Some((open, _)) = &self.pass {
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
        let timer = self.timers.as_ref().and_then(|timers| unsafe { timers.begin(self.command, label) });
        if let Some(timers) = &self.timers {
            self.keep(timers.kept());
        }
        self.pass = Some((label.to_owned(), timer));
    }

    /// Ends the pass.
    pub fn end_pass(&mut self) {
        if !self.outside_rendering("end_pass") {
            return;
        }
        let Some((label, timer)) = self.pass.take() else {
            return self.misuse("a pass was ended that was not begun");
        };
        if let (Some(timers), Some(index)) = (&self.timers, timer) {
            // SAFETY: the command buffer is being recorded, outside of rendering, and the pass was begun in it.
            unsafe { timers.end(self.command, index) };
        }
        if let Some(labels) = &self.core().labels {
            // SAFETY: a label was begun in this command buffer.
            unsafe { labels.cmd_end_debug_utils_label(self.command) };
        }
        self.split_here(Some(label));
    }

    /// Binds a compute pipeline.
    pub fn bind_compute(&mut self, pipeline: &ComputePipeline) {
        self.bind_pipeline(&pipeline.inner);
    }

    /// Binds a raster pipeline.
    pub fn bind_raster(&mut self, pipeline: &RasterPipeline) {
        self.bind_pipeline(&pipeline.inner);
    }

    /// Binds sets from number `first` up, for the bound pipeline. Binding a pipeline with other set layouts or
    /// push constants in front of a set makes Vulkan forget the set: bind sets after the pipeline.
    pub fn bind_sets(&mut self, first: u32, sets: &[&BindingSet]) {
        if !self.is_recording() || sets.is_empty() {
            return;
        }
        let Some(pipeline) = self.state.pipeline.clone() else {
            return self.misuse("sets were bound without a pipeline");
        };
        let start = first as usize;
        let fits = pipeline.sets.get(start..).and_then(|layouts| layouts.get(..sets.len()));
        let Some(layouts) = fits else {
            let reason = format!(
                "sets {first} to {} were bound, but the pipeline has {}",
                u64::from(first) + sets.len() as u64 - 1,
                pipeline.sets.len()
            );
            return self.fail(GpuError::InvalidUse { name: pipeline.name.clone(), reason });
        };
        for (set, layout) in sets.iter().zip(layouts) {
            // Layouts of the same content are compatible, even if made twice.
            let inner = &set.inner.layout.inner;
            let compatible = inner.storage_buffers == layout.inner.storage_buffers
                && Arc::ptr_eq(&inner.core, &layout.inner.core);
            if !compatible {
                let reason = format!("set `{}` has another layout than `{}`", set.name(), layout.inner.name);
                return self.fail(GpuError::InvalidUse { name: pipeline.name.clone(), reason });
            }
        }
        if self.state.sets.len() < start + sets.len() {
            self.state.sets.resize(start + sets.len(), None);
        }
        for (slot, set) in self.state.sets[start..].iter_mut().zip(sets) {
            *slot = Some((*set).clone());
        }
        for set in sets {
            self.keep(set.inner.clone());
        }
        self.emit_sets(&pipeline, first, &sets.iter().map(|set| set.inner.raw).collect::<Vec<_>>());
    }

    /// Sets the push constants of the bound pipeline, from byte 0 on.
    pub fn push_constants(&mut self, bytes: &[u8]) {
        if !self.is_recording() || bytes.is_empty() {
            return;
        }
        let Some(pipeline) = self.state.pipeline.clone() else {
            return self.misuse("push constants were set without a pipeline");
        };
        if bytes.len() > pipeline.push_constant_bytes as usize || !bytes.len().is_multiple_of(4) {
            let reason = format!(
                "{} bytes of push constants were given: it takes at most {}, in multiples of 4",
                bytes.len(),
                pipeline.push_constant_bytes
            );
            return self.fail(GpuError::InvalidUse { name: pipeline.name.clone(), reason });
        }
        self.state.constants.clear();
        self.state.constants.extend_from_slice(bytes);
        self.emit_constants(&pipeline, bytes);
    }

    /// Runs the bound compute pipeline on `groups` workgroups.
    pub fn dispatch(&mut self, groups: [u32; 3]) {
        if !self.outside_rendering("dispatch") || !self.has_pipeline(vk::PipelineBindPoint::COMPUTE) {
            return;
        }
        let limits = self.device.limits().max_workgroup_count;
        for (asked, limit) in groups.into_iter().zip(limits) {
            if asked > limit {
                return self.exceed("the number of workgroups", asked.into(), limit.into());
            }
        }
        // SAFETY: recording, outside of rendering, with a compute pipeline and within the limits; the caller has
        // bound what the shader reads (validation checks it).
        unsafe { self.raw_device().cmd_dispatch(self.command, groups[0], groups[1], groups[2]) };
    }

    /// Runs the bound compute pipeline on a number of workgroups read from three u32 in a buffer, at an offset
    /// that is a multiple of 4. The numbers must be within [`crate::Limits::max_workgroup_count`].
    pub fn dispatch_indirect(&mut self, buffer: &Buffer, offset: u64) {
        if !self.outside_rendering("dispatch_indirect") || !self.has_pipeline(vk::PipelineBindPoint::COMPUTE)
        {
            return;
        }
        if !self.indirect_arguments(buffer, offset, 12) {
            return;
        }
        // SAFETY: as for `dispatch`; the arguments lie within a buffer made for them.
        unsafe { self.raw_device().cmd_dispatch_indirect(self.command, buffer.raw(), offset) };
    }

    /// Begins to draw into `width` x `height` pixels of one layer. Viewport and scissor are set to all of it.
    pub fn begin_rendering(&mut self, width: u32, height: u32) {
        self.begin_rendering_area(RenderArea { width, height, layers: 1, view_mask: 0 });
    }

    /// Begins to draw into several layers or views.
    pub fn begin_rendering_area(&mut self, area: RenderArea) {
        if !self.outside_rendering("begin_rendering") {
            return;
        }
        let RenderArea { width, height, layers, view_mask } = area;
        let limits = self.device.limits();
        let views = u32::BITS - view_mask.leading_zeros();
        let checks: [(&'static str, u32, u32); 4] = [
            ("the width", width, limits.max_framebuffer_size[0]),
            ("the height", height, limits.max_framebuffer_size[1]),
            ("the number of layers", layers, limits.max_framebuffer_layers),
            ("the number of views", views, limits.max_multiview_views),
        ];
        if let Some((what, asked, limit)) = checks.into_iter().find(|(_, asked, limit)| asked > limit) {
            return self.exceed(what, asked.into(), limit.into());
        }
        if width == 0 || height == 0 || (layers == 0 && view_mask == 0) {
            return self.misuse("rendering needs at least one pixel and one layer");
        }
        let checked = if view_mask == 0 { Feature::DynamicRendering } else { Feature::Multiview };
        if let Err(error) = self.core().require(checked, "begin_rendering") {
            return self.fail(error);
        }
        let Some(begin) = self.core().commands.begin_rendering else {
            let what = "begin_rendering".to_owned();
            return self.fail(GpuError::FeatureNotEnabled { feature: Feature::DynamicRendering, what });
        };
        let extent = vk::Rect2D::default().extent(vk::Extent2D { width, height });
        let info =
            vk::RenderingInfo::default().render_area(extent).layer_count(layers.max(1)).view_mask(view_mask);
        let viewport =
            vk::Viewport::default().width(width as f32).height(height as f32).min_depth(0.0).max_depth(1.0);
        // SAFETY: recording, outside of rendering, on a device with dynamic rendering and within its limits.
        unsafe {
            begin(self.command, &info);
            self.raw_device().cmd_set_viewport(self.command, 0, &[viewport]);
            self.raw_device().cmd_set_scissor(self.command, 0, &[extent]);
        }
        self.rendering = Some(area);
    }

    /// Draws `vertices` vertices `instances` times, with the bound raster pipeline.
    pub fn draw(&mut self, vertices: u32, instances: u32, first_instance: u32) {
        if !self.can_draw() {
            return;
        }
        // SAFETY: recording, within rendering, with a raster pipeline of the same views; the caller has bound
        // what the shaders read (validation checks it).
        unsafe { self.raw_device().cmd_draw(self.command, vertices, instances, 0, first_instance) };
    }

    /// Draws with four u32 read from a buffer (vertices, instances, 0, 0), at an offset that is a multiple of 4.
    pub fn draw_indirect(&mut self, buffer: &Buffer, offset: u64) {
        if !self.can_draw() || !self.indirect_arguments(buffer, offset, 16) {
            return;
        }
        // SAFETY: as for `draw`; the arguments lie within a buffer made for them.
        unsafe { self.raw_device().cmd_draw_indirect(self.command, buffer.raw(), offset, 1, 16) };
    }

    /// Ends drawing.
    pub fn end_rendering(&mut self) {
        if !self.is_recording() {
            return;
        }
        if self.rendering.take().is_none() {
            return self.misuse("rendering was ended that was not begun");
        }
        if let Some(end) = self.core().commands.end_rendering {
            // SAFETY: recording, within rendering begun by this recorder.
            unsafe { end(self.command) };
        }
    }

    /// Fills part of a buffer with a value. Offset and size are in bytes and multiples of 4.
    pub fn fill(&mut self, buffer: &Buffer, offset: u64, size: u64, value: u32) {
        if !self.outside_rendering("fill") || size == 0 {
            return;
        }
        let usage = buffer.check_usage(BufferUsage::TRANSFER_DST, "being filled");
        if let Err(error) = usage.and_then(|()| buffer.check_range(offset, size)) {
            return self.fail(error);
        }
        if offset % 4 != 0 || size % 4 != 0 {
            let reason =
                format!("{size} bytes at offset {offset} cannot be filled: both must be multiples of 4");
            return self.fail(GpuError::InvalidUse { name: buffer.name().to_owned(), reason });
        }
        self.keep(buffer.inner.clone());
        // SAFETY: recording, outside of rendering; range, alignment and usage were checked.
        unsafe { self.raw_device().cmd_fill_buffer(self.command, buffer.raw(), offset, size, value) };
    }

    /// Copies bytes between buffers, or within one if the ranges do not overlap.
    pub fn copy(
        &mut self,
        source: &Buffer,
        source_offset: u64,
        target: &Buffer,
        target_offset: u64,
        size: u64,
    ) {
        if !self.outside_rendering("copy") || size == 0 {
            return;
        }
        let checked = source
            .check_usage(BufferUsage::TRANSFER_SRC, "being copied from")
            .and_then(|()| target.check_usage(BufferUsage::TRANSFER_DST, "being copied to"))
            .and_then(|()| source.check_range(source_offset, size))
            .and_then(|()| target.check_range(target_offset, size));
        if let Err(error) = checked {
            return self.fail(error);
        }
        let apart = source_offset.abs_diff(target_offset) >= size;
        if source.raw() == target.raw() && !apart {
            let reason = "source and target of a copy overlap".to_owned();
            return self.fail(GpuError::InvalidUse { name: source.name().to_owned(), reason });
        }
        self.keep(source.inner.clone());
        self.keep(target.inner.clone());
        let region = vk::BufferCopy::default().src_offset(source_offset).dst_offset(target_offset).size(size);
        // SAFETY: recording, outside of rendering; ranges, usages and overlap were checked.
        unsafe { self.raw_device().cmd_copy_buffer(self.command, source.raw(), target.raw(), &[region]) };
    }

    /// Makes `to` wait for `from` and see what it wrote, for all memory.
    pub fn barrier(&mut self, from: Access, to: Access) {
        if self.outside_rendering("barrier") {
            self.emit_barrier(from, to);
        }
    }

    /// Closes a recording for a submission: hands out what it collected, or the first mistake.
    pub(crate) fn complete(mut self) -> Completed {
        self.check_closed();
        let (kept, labels, timings) = match self.submission.take() {
            Some(submission) => (submission.kept, submission.labels, submission.timings),
            None => Default::default(),
        };
        Completed { error: self.error, _kept: kept, labels, timings }
    }

    /// The device outlives the recorder, so this borrow is independent of it.
    fn core(&self) -> &'a Core {
        &self.device.core
    }

    fn raw_device(&self) -> &'a ash::Device {
        &self.core().device
    }

    fn keep(&mut self, value: Arc<dyn Any + Send + Sync>) {
        if let Some(submission) = &mut self.submission {
            submission.kept.push(value);
        }
    }

    fn is_recording(&self) -> bool {
        self.error.is_none()
    }

    fn fail(&mut self, error: GpuError) {
        self.error.get_or_insert(error);
    }

    /// The thing a mistake is blamed on: the pass, else the recording.
    fn place(&self) -> String {
        self.pass.as_ref().map_or_else(|| "recording".to_owned(), |(label, _)| label.clone())
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

    /// Whether a command that is forbidden within rendering may be recorded.
    fn outside_rendering(&mut self, command: &str) -> bool {
        if self.rendering.is_some() {
            self.misuse(&format!("{command} was called between begin_rendering and end_rendering"));
        }
        self.is_recording()
    }

    fn has_pipeline(&mut self, bind_point: vk::PipelineBindPoint) -> bool {
        if self.is_recording()
            && self.state.pipeline.as_ref().is_none_or(|bound| bound.bind_point != bind_point)
        {
            self.misuse(match bind_point {
                vk::PipelineBindPoint::COMPUTE => "a dispatch was recorded without a compute pipeline",
                _ => "a draw was recorded without a raster pipeline",
            });
        }
        self.is_recording()
    }

    fn can_draw(&mut self) -> bool {
        if !self.has_pipeline(vk::PipelineBindPoint::GRAPHICS) {
            return false;
        }
        let view_mask = self.state.pipeline.as_ref().map_or(0, |pipeline| pipeline.view_mask);
        match self.rendering {
            None => self.misuse("a draw was recorded outside of begin_rendering and end_rendering"),
            Some(area) if area.view_mask != view_mask => {
                self.misuse("pipeline and rendering have different view masks");
            }
            Some(_) => {}
        }
        self.is_recording()
    }

    fn indirect_arguments(&mut self, buffer: &Buffer, offset: u64, size: u64) -> bool {
        let usage = buffer.check_usage(BufferUsage::INDIRECT, "indirect arguments");
        if let Err(error) = usage.and_then(|()| buffer.check_range(offset, size)) {
            self.fail(error);
        } else if !offset.is_multiple_of(4) {
            self.misuse("the offset of indirect arguments must be a multiple of 4");
        }
        self.keep(buffer.inner.clone());
        self.is_recording()
    }

    fn bind_pipeline(&mut self, pipeline: &Arc<PipelineInner>) {
        if !self.is_recording() {
            return;
        }
        if !Arc::ptr_eq(&pipeline.core, &self.device.core) {
            let reason = "belongs to another device".to_owned();
            return self.fail(GpuError::InvalidUse { name: pipeline.name.clone(), reason });
        }
        self.keep(pipeline.clone());
        self.state.pipeline = Some(pipeline.clone());
        self.state.constants.clear();
        // SAFETY: recording; a pipeline of this device.
        unsafe { self.raw_device().cmd_bind_pipeline(self.command, pipeline.bind_point, pipeline.raw) };
    }

    fn emit_sets(&self, pipeline: &PipelineInner, first: u32, sets: &[vk::DescriptorSet]) {
        // SAFETY: recording; sets and pipeline layout were found compatible, and live as the caller promises (or
        // as long as the submission, which keeps them).
        unsafe {
            self.raw_device().cmd_bind_descriptor_sets(
                self.command,
                pipeline.bind_point,
                pipeline.layout,
                first,
                sets,
                &[],
            );
        }
    }

    fn emit_constants(&self, pipeline: &PipelineInner, bytes: &[u8]) {
        // SAFETY: recording; the bytes lie within the only range of the layout, which has these stages.
        unsafe {
            self.raw_device().cmd_push_constants(self.command, pipeline.layout, pipeline.stages, 0, bytes);
        }
    }

    pub(crate) fn emit_barrier(&mut self, from: Access, to: Access) {
        let core = self.core();
        let geometry = core.enabled.contains(&Feature::GeometryShader);
        let (from_stages, from_access) = from.scope(core.graphics, geometry);
        let (to_stages, to_access) = to.scope(core.graphics, geometry);
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(from_stages)
            .src_access_mask(from_access)
            .dst_stage_mask(to_stages)
            .dst_access_mask(to_access)];
        let info = vk::DependencyInfo::default().memory_barriers(&barriers);
        // SAFETY: recording, outside of rendering, stages known to the queue.
        unsafe { (core.commands.pipeline_barrier)(self.command, &info) };
    }

    /// Makes everything recorded visible to the host once the submission was waited for.
    pub(crate) fn emit_host_barrier(&mut self) {
        if self.is_recording() && self.rendering.is_none() {
            self.emit_barrier(Access::ALL, Access::HOST_READ);
        }
    }

    /// Where passes are submitted one by one: submits what was recorded, waits, notes the time under `label`, and goes
    /// on with the same state bound. True if that failed.
    fn split_here(&mut self, label: Option<String>) -> bool {
        if !self.submission.as_ref().is_some_and(|submission| submission.split) {
            return false;
        }
        self.emit_host_barrier();
        let Some(submission) = self.submission.as_mut() else { return false };
        let during = label.clone().unwrap_or_else(|| "work between passes".to_owned());
        let restarted = submission.work.run(self.device, &during).and_then(|elapsed| {
            if let Some(label) = label {
                let milliseconds = elapsed.as_secs_f64() * 1e3;
                submission.timings.push(PassTiming { label, milliseconds, timer: TimerKind::Host });
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

    /// Binds again what was bound before the command buffer was replaced.
    fn emit_state(&self) {
        let Some(pipeline) = &self.state.pipeline else { return };
        // SAFETY: recording; a pipeline of this device.
        unsafe { self.raw_device().cmd_bind_pipeline(self.command, pipeline.bind_point, pipeline.raw) };
        for (number, (set, layout)) in (0_u32..).zip(self.state.sets.iter().zip(&pipeline.sets)) {
            if let Some(set) = set
                && set.inner.layout.inner.storage_buffers == layout.inner.storage_buffers
            {
                self.emit_sets(pipeline, number, &[set.inner.raw]);
            }
        }
        if !self.state.constants.is_empty() {
            self.emit_constants(pipeline, &self.state.constants);
        }
    }
}

/// What a recording for a submission left behind.
pub(crate) struct Completed {
    pub(crate) error: Option<GpuError>,
    /// Lives until the device is done.
    _kept: Vec<Arc<dyn Any + Send + Sync>>,
    pub(crate) labels: Vec<String>,
    pub(crate) timings: Vec<PassTiming>,
}
