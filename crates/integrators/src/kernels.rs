//! Pipelines over the slots of a wave, all made and recorded alike.

use bytemuck::bytes_of;
use rasray_ads::{Domain, RayQueue};
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferUsage, ComputePipeline, ComputePipelineDesc, Device, Recorder,
    SetLayout, Stage,
};
use rasray_gpu_scene::GpuScene;
pub(crate) use rasray_shaders_glsl::records::WaveConstants;
use rasray_shaders_glsl::{
    Shader,
    constant_ids::integrators::{PIXEL_CENTRES, WAVE_IS_LISTED},
};

use crate::{Bands, Film, IntegratorError, Wave};

/// Bindings of the integrators' set that several integrators have, as `integrators/storage.glsl` declares
/// them. Bindings 9 to 14 belong to single integrators, which declare them in their own files.
pub(crate) mod binding {
    pub const FILM: u32 = 0;
    pub const FILM_FAULTS: u32 = 1;
    pub const PATH_STATES: u32 = 2;
    pub const PENDING: u32 = 3;
    pub const SHADOW_RAYS: u32 = 4;
    pub const SHADOW_HEADER: u32 = 5;
    pub const SHADOW_LIST: u32 = 6;
    pub const AOV: u32 = 7;
    pub const WAITING: u32 = 8;
    pub const WAVE_PIXELS: u32 = 15;
}

/// Binding of the integrators' set with its buffer.
pub(crate) type Bound<'a> = (u32, &'a Buffer);

/// Buffers of each band of an image that kernels bind.
pub(crate) struct OfPixels<'a> {
    pub bands: Bands,
    pub bound: Vec<Vec<Bound<'a>>>,
}

/// Returns the film as kernels bind it.
pub(crate) fn film(film: &Film) -> OfPixels<'_> {
    let of_band = |(number, pixels)| {
        let list = film.list().and_then(|lists| lists.get(number));
        let all = [(binding::FILM, pixels), (binding::FILM_FAULTS, film.faults())];
        all.into_iter().chain(list.map(|list| (binding::WAVE_PIXELS, list))).collect()
    };
    OfPixels { bands: film.bands(), bound: film.pixels().iter().enumerate().map(of_band).collect() }
}

/// Returns a second queue as the passes that fill it bind it.
pub(crate) fn shadow_queue(queue: &RayQueue) -> [Bound<'_>; 3] {
    [
        (binding::SHADOW_RAYS, queue.rays()),
        (binding::SHADOW_HEADER, queue.header()),
        (binding::SHADOW_LIST, queue.list()),
    ]
}

/// Returns the constants of the camera rays: through random points of their pixels, or through the centres.
pub(crate) fn camera_constants(pixel_centres: bool) -> [(u32, u32); 1] {
    [(PIXEL_CENTRES, u32::from(pixel_centres))]
}

impl From<Wave> for WaveConstants {
    fn from(wave: Wave) -> Self {
        let Wave { first_pixel, pixel_count, sample } = wave;
        Self { first_pixel, pixel_count, sample_index: sample, ..Self::default() }
    }
}

/// Pipeline with its label, the path of its shader.
#[derive(Debug)]
pub(crate) struct Kernel {
    stage: Stage,
    label: &'static str,
    pipeline: ComputePipeline,
}

impl Kernel {
    /// Marks the kernel as a pass that only adds to an image.
    pub fn of_film(self) -> Self {
        Self { stage: Stage::Film, ..self }
    }
}

/// Binding sets of the kernels of one integrator.
#[derive(Debug)]
pub(crate) struct Bindings {
    layouts: [SetLayout; 4],
    geometry: BindingSet,
    scene: BindingSet,
    bands: Bands,
    /// Binding set of each band's storage.
    storage: Vec<BindingSet>,
    /// True if waves take pixels from a list.
    is_listed: bool,
}

impl Bindings {
    /// Makes sets 0 to 3: geometry, storage, queue, scene. The queue is given when a pass is recorded.
    /// Kernels use only storage bindings that are bound: those of the band's pixels, and the integrator's
    /// own.
    ///
    /// # Errors
    /// Out of memory, or a buffer exceeds one binding.
    pub fn new(
        device: &Device,
        scene: &GpuScene,
        pixels: &OfPixels<'_>,
        own: &[Bound<'_>],
    ) -> Result<Self, IntegratorError> {
        let placeholder = device_buffer(device, "unused binding", 16)?;
        let count = binding::WAVE_PIXELS + 1;
        let layout = device.create_set_layout("integrator", count)?;
        let of_band = |of_pixels: &Vec<Bound<'_>>| {
            let find = |binding| of_pixels.iter().chain(own).find(|(known, _)| *known == binding);
            let buffer = |binding| find(binding).map_or(&placeholder, |(_, buffer)| *buffer);
            device.create_binding_set(&layout, "integrator", &(0..count).map(buffer).collect::<Vec<_>>())
        };
        let storage = pixels.bound.iter().map(of_band).collect::<Result<_, _>>()?;
        Ok(Self {
            layouts: [
                scene.geometry().layout().clone(),
                layout,
                RayQueue::layout(device)?,
                scene.binding().layout.clone(),
            ],
            geometry: scene.geometry().set().clone(),
            scene: scene.binding().set.clone(),
            bands: pixels.bands,
            storage,
            is_listed: pixels.bound.iter().flatten().any(|(known, _)| *known == binding::WAVE_PIXELS),
        })
    }

    /// Binds another scene from the next recording on.
    pub fn set_scene(&mut self, scene: &GpuScene) {
        self.geometry = scene.geometry().set().clone();
        self.scene = scene.binding().set.clone();
    }

    /// Makes a pipeline over these sets.
    ///
    /// # Errors
    /// The device refuses the pipeline.
    pub fn kernel(
        &self,
        device: &Device,
        shader: &'static Shader,
        constants: &[(u32, u32)],
    ) -> Result<Kernel, IntegratorError> {
        let constants = [constants, &[(WAVE_IS_LISTED, self.is_listed.into())]].concat();
        let pipeline = device.create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            module: &shader.module(),
            sets: &self.layouts.each_ref(),
            push_constant_bytes: size_of::<WaveConstants>() as u32,
            constants: &constants,
        })?;
        Ok(Kernel { stage: Stage::Shade, label: shader.name, pipeline })
    }

    /// Returns an error for a wave that does not fit the queue or the image.
    pub fn check(&self, queue: &RayQueue, wave: Wave) -> Result<(), IntegratorError> {
        self.bands.check(wave, queue.capacity())
    }

    /// Records the camera rays of a wave, with the kernel that makes them.
    ///
    /// # Errors
    /// An error if the wave does not fit the queue or the image.
    pub fn record_camera_rays(
        &self,
        recorder: &mut Recorder<'_>,
        primary: &Kernel,
        queue: &RayQueue,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        self.check(queue, wave)?;
        self.record(recorder, primary, queue, Domain::First(wave.pixel_count), &wave.into());
        Ok(())
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
        let band = self.bands.of(constants.first_pixel);
        let band_first = band as u32 * self.bands.most();
        let constants = WaveConstants { domain: domain.word(), band_first, ..*constants };
        recorder.begin_pass(kernel.stage, kernel.label);
        recorder.bind_compute(&kernel.pipeline);
        recorder.bind_sets(0, &[&self.geometry, &self.storage[band], queue.set(), &self.scene]);
        recorder.push_constants(bytes_of(&constants));
        queue.record_dispatch(recorder, domain);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER);
        recorder.end_pass();
    }
}

/// Makes a device-local storage buffer, cleared if the device has a queue.
pub(crate) fn device_buffer(device: &Device, name: &str, size: u64) -> Result<Buffer, IntegratorError> {
    let usage = BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST;
    Ok(device.create_cleared_buffer(name, usage, size)?)
}
