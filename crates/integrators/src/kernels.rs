//! Pipelines over the slots of a wave, all made and recorded the same way.

use bytemuck::bytes_of;
use rasray_ads::{Domain, RayQueue};
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferUsage, ComputePipeline, ComputePipelineDesc, Device, Recorder,
    SetLayout, Stage,
};
use rasray_gpu_scene::GpuScene;
pub(crate) use rasray_shaders_glsl::records::WaveConstants;
use rasray_shaders_glsl::{Shader, constant_ids::integrators::PIXEL_CENTRES};

use crate::{IntegratorError, Wave};

/// Buffers in the integrators' set.
const BINDINGS: u32 = 9;

/// Constants of the camera rays: through random points of their pixels, or through the centres.
pub(crate) fn camera_constants(pixel_centres: bool) -> [(u32, u32); 1] {
    [(PIXEL_CENTRES, u32::from(pixel_centres))]
}

impl From<Wave> for WaveConstants {
    fn from(wave: Wave) -> Self {
        let Wave { first_pixel, pixel_count, sample } = wave;
        Self { first_pixel, pixel_count, sample_index: sample, ..Self::default() }
    }
}

/// A pipeline with its label: the shader's path.
#[derive(Debug)]
pub(crate) struct Kernel {
    stage: Stage,
    label: &'static str,
    pipeline: ComputePipeline,
}

impl Kernel {
    /// The same as a pass that does nothing but add to an image.
    pub fn of_film(self) -> Self {
        Self { stage: Stage::Film, ..self }
    }
}

/// The buffers of the integrators' set, in the order of its bindings; absent ones are not used by
/// the kernels that the set is bound for.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Storage<'a> {
    pub film: Option<&'a Buffer>,
    pub film_faults: Option<&'a Buffer>,
    pub path_states: Option<&'a Buffer>,
    pub pending: Option<&'a Buffer>,
    pub shadow: Option<&'a RayQueue>,
    pub aov: Option<&'a Buffer>,
    pub waiting: Option<&'a Buffer>,
}

/// The sets that the kernels of one integrator are bound to.
#[derive(Debug)]
pub(crate) struct Bindings {
    layouts: [SetLayout; 4],
    /// Geometry, storage, scene.
    sets: [BindingSet; 3],
}

impl Bindings {
    /// Sets 0 to 3: geometry, storage, queue, scene. The queue is given when a pass is recorded.
    ///
    /// # Errors
    /// Out of memory, or a buffer exceeds what one binding can hold.
    pub fn new(device: &Device, scene: &GpuScene, storage: &Storage<'_>) -> Result<Self, IntegratorError> {
        let placeholder = device_buffer(device, "unused binding", 16)?;
        let slots = [
            storage.film,
            storage.film_faults,
            storage.path_states,
            storage.pending,
            storage.shadow.map(RayQueue::rays),
            storage.shadow.map(RayQueue::header),
            storage.shadow.map(RayQueue::list),
            storage.aov,
            storage.waiting,
        ];
        let buffers = slots.map(|buffer| buffer.unwrap_or(&placeholder));
        let layout = device.create_set_layout("integrator", BINDINGS)?;
        let set = device.create_binding_set(&layout, "integrator", &buffers)?;
        Ok(Self {
            layouts: [
                scene.geometry().layout().clone(),
                layout,
                RayQueue::layout(device)?,
                scene.binding().layout.clone(),
            ],
            sets: [scene.geometry().set().clone(), set, scene.binding().set.clone()],
        })
    }

    /// Binds another scene from the next recording on.
    pub fn set_scene(&mut self, scene: &GpuScene) {
        self.sets[0] = scene.geometry().set().clone();
        self.sets[2] = scene.binding().set.clone();
    }

    /// Makes a pipeline over these sets.
    ///
    /// # Errors
    /// The device refuses it.
    pub fn kernel(
        &self,
        device: &Device,
        shader: &'static Shader,
        constants: &[(u32, u32)],
    ) -> Result<Kernel, IntegratorError> {
        let pipeline = device.create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            spirv: &shader.words(),
            sets: &self.layouts.each_ref(),
            push_constant_bytes: size_of::<WaveConstants>() as u32,
            constants,
        })?;
        Ok(Kernel { stage: Stage::Shade, label: shader.name, pipeline })
    }

    /// Records one pass over the slots of `domain` of a queue; its results are visible to compute shaders and
    /// transfers recorded after it.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        kernel: &Kernel,
        queue: &RayQueue,
        domain: Domain,
        constants: &WaveConstants,
    ) {
        let [geometry, storage, scene] = &self.sets;
        let constants = WaveConstants { domain: domain.word(), ..*constants };
        recorder.begin_pass(kernel.stage, kernel.label);
        recorder.bind_compute(&kernel.pipeline);
        recorder.bind_sets(0, &[geometry, storage, queue.set(), scene]);
        recorder.push_constants(bytes_of(&constants));
        queue.record_dispatch(recorder, domain);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER);
        recorder.end_pass();
    }
}

/// A device-local storage buffer, cleared where the device has a queue.
pub(crate) fn device_buffer(device: &Device, name: &str, size: u64) -> Result<Buffer, IntegratorError> {
    let usage = BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST;
    Ok(device.create_cleared_buffer(name, usage, size)?)
}
