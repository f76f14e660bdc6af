//! Auxiliary images: distance, normal and primitive of what lies at the centre of every pixel.

use rasray_ads::{Domain, RayQueue};
use rasray_gpu::{Buffer, Device, Recorder};
use rasray_gpu_scene::GpuScene;
use rasray_shaders_glsl::{INTEGRATORS_AOV, INTEGRATORS_PRIMARY, records::AovPixel};

use crate::{
    Bands, IntegratorError, Traced, Wave,
    integrator::check_capacity,
    kernels::{Bindings, Kernel, OfPixels, WaveConstants, binding, camera_constants, device_buffer},
};

/// Traces the rays of pixel centres and keeps what they hit, of one band at a time. One trace per wave; `Wave::sample` is
/// not used.
#[derive(Debug)]
pub struct AovPass {
    /// Of the band that was traced last.
    pixels: Buffer,
    queue: RayQueue,
    bindings: Bindings,
    primary: Kernel,
    store: Kernel,
}

impl AovPass {
    /// Makes queue, image and kernels for the scene's view in these bands, with at most `wave_capacity` rays per wave.
    ///
    /// # Errors
    /// `SizesDiffer` where bands and view have not as many pixels, sizes that do not fit, out of memory, or the device refuses
    /// a pipeline.
    pub fn new(
        device: &Device,
        scene: &GpuScene,
        bands: Bands,
        wave_capacity: u32,
    ) -> Result<Self, IntegratorError> {
        let view = scene.image_size();
        if Bands::one(view)?.pixel_count() != bands.pixel_count() {
            return Err(IntegratorError::SizesDiffer { film: [bands.pixel_count(), 1], view });
        }
        let capacity = check_capacity(wave_capacity)?;
        let bytes = u64::from(bands.most()) * size_of::<AovPixel>() as u64;
        let pixels = device_buffer(device, "aov", bytes)?;
        let queue = RayQueue::new(device, "pixel centre rays", capacity, true)?;
        let bound = bands.ranges().map(|_| vec![(binding::AOV, &pixels)]).collect();
        let bindings = Bindings::new(device, scene, &OfPixels { bands, bound }, &[])?;
        Ok(Self {
            primary: bindings.kernel(device, &INTEGRATORS_PRIMARY, &camera_constants(true))?,
            store: bindings.kernel(device, &INTEGRATORS_AOV, &[])?.of_film(),
            pixels,
            queue,
            bindings,
        })
    }

    /// Records that the queue's counters start at 0; once before the first wave.
    pub fn record_reset(&self, recorder: &mut Recorder<'_>) {
        self.queue.record_reset(recorder);
    }

    /// Records the pixels of a wave.
    ///
    /// # Errors
    /// The wave does not fit the queue or the image, or the structure was made without a scene.
    pub fn record_wave(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        self.bindings.check(&self.queue, wave)?;
        let (constants, all) = (WaveConstants::from(wave), Domain::First(wave.pixel_count));
        self.bindings.record(recorder, &self.primary, &self.queue, all, &constants);
        traced.record_primary(recorder, &self.queue, wave)?;
        self.bindings.record(recorder, &self.store, &self.queue, all, &constants);
        Ok(())
    }

    /// The queue, for its counters.
    pub fn queue(&self) -> &RayQueue {
        &self.queue
    }

    /// Bytes of all buffers.
    pub fn bytes(&self) -> u64 {
        self.pixels.size() + self.queue.bytes()
    }

    /// Downloads the pixels of the band whose waves were traced last, `count` of them: submits and waits.
    ///
    /// # Errors
    /// More pixels than a band has; the device is lost or out of memory.
    pub fn read(&self, device: &Device, count: u32) -> Result<Vec<AovPixel>, IntegratorError> {
        Ok(device.download_as(&self.pixels, 0, count as usize)?)
    }
}
