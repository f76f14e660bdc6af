//! Commands that bind pipelines, sets and push constants.

use std::sync::Arc;

use ash::vk;

use super::Recorder;
use crate::binding::BindingSet;
use crate::error::GpuError;
use crate::pipeline::{ComputePipeline, PipelineInner, RasterPipeline};

impl Recorder<'_> {
    /// Binds a compute pipeline.
    pub fn bind_compute(&mut self, pipeline: &ComputePipeline) {
        self.bind_pipeline(&pipeline.inner);
    }

    /// Binds a raster pipeline.
    pub fn bind_raster(&mut self, pipeline: &RasterPipeline) {
        self.bind_pipeline(&pipeline.inner);
    }

    /// Binds sets from number `first` up, for the bound pipeline. If a pipeline with other set layouts or
    /// push constants before a set is bound later, Vulkan drops the set: sets must be bound after the
    /// pipeline.
    pub fn bind_sets(&mut self, first: u32, sets: &[&BindingSet]) {
        if !self.is_recording() || sets.is_empty() {
            return;
        }
        let Some(pipeline) = self.bound.pipeline.clone() else {
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
            if !set.inner.layout().is_like(layout) {
                let reason = format!("set `{}` has another layout than `{}`", set.name(), layout.name());
                return self.fail(GpuError::InvalidUse { name: pipeline.name.clone(), reason });
            }
        }
        if self.bound.sets.len() < start + sets.len() {
            self.bound.sets.resize(start + sets.len(), None);
        }
        for (slot, set) in self.bound.sets[start..].iter_mut().zip(sets) {
            *slot = Some((*set).clone());
        }
        for set in sets {
            self.keep(set.inner.clone());
        }
        let used = pipeline.used[start..].iter();
        let parts: Vec<_> = sets.iter().zip(used).map(|(set, used)| set.inner.part(*used)).collect();
        self.emit_sets(&pipeline, first, &parts);
    }

    /// Sets the push constants of the bound pipeline, from byte 0 on.
    pub fn push_constants(&mut self, bytes: &[u8]) {
        if !self.is_recording() || bytes.is_empty() {
            return;
        }
        let Some(pipeline) = self.bound.pipeline.clone() else {
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
        self.bound.constants.clear();
        self.bound.constants.extend_from_slice(bytes);
        self.emit_constants(&pipeline, bytes);
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
        self.bound.replace(pipeline);
        // SAFETY: the command buffer is being recorded; the pipeline is of this device.
        unsafe { self.raw_device().cmd_bind_pipeline(self.command, pipeline.bind_point, pipeline.raw) };
    }

    fn emit_sets(&self, pipeline: &PipelineInner, first: u32, sets: &[vk::DescriptorSet]) {
        // SAFETY: the command buffer is being recorded; sets and pipeline layout were found compatible, and
        // live as long as the caller promises (or as long as the submission, which keeps them).
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
        // SAFETY: the command buffer is being recorded; the bytes lie within the only range of the layout,
        // which has these stages.
        unsafe {
            self.raw_device().cmd_push_constants(self.command, pipeline.layout, pipeline.stages, 0, bytes);
        }
    }

    /// Binds the present state again, after the command buffer was replaced.
    pub(super) fn emit_state(&self) {
        let Some(pipeline) = &self.bound.pipeline else { return };
        // SAFETY: the command buffer is being recorded; the pipeline is of this device.
        unsafe { self.raw_device().cmd_bind_pipeline(self.command, pipeline.bind_point, pipeline.raw) };
        let wanted = pipeline.sets.iter().zip(pipeline.used.iter());
        for (number, (set, (layout, used))) in (0_u32..).zip(self.bound.sets.iter().zip(wanted)) {
            if let Some(set) = set
                && set.inner.layout().is_like(layout)
            {
                self.emit_sets(pipeline, number, &[set.inner.part(*used)]);
            }
        }
        if !self.bound.constants.is_empty() {
            self.emit_constants(pipeline, &self.bound.constants);
        }
    }
}
