//! Auxiliary images: distance, normal and primitive of what lies at the centre of every pixel.

use rasray_ads::{Domain, RayQueue};
use rasray_gpu::{Buffer, Device, Recorder};
use rasray_gpu_scene::GpuScene;
use rasray_shaders_glsl::{INTEGRATORS_AOV, INTEGRATORS_PRIMARY, records::AovPixel};

use crate::{
    IntegratorError, Traced, Wave,
    film::pixel_count,
    integrator::{check_capacity, check_wave},
    kernels::{Bindings, Kernel, WaveConstants, binding, camera_constants, device_buffer},
};

/// Traces the rays of pixel centres and keeps what they hit. One trace per wave; `Wave::sample` is
/// not used.
#[derive(Debug)]
pub struct AovPass {
    pixel_count: u32,
    pixels: Buffer,
    queue: RayQueue,
    bindings: Bindings,
    primary: Kernel,
    store: Kernel,
}

impl AovPass {
    /// Makes queue, image and kernels for the scene's view, with at most `wave_capacity` rays per wave.
    ///
    /// # Errors
    /// Sizes that do not fit, out of memory, or the device refuses a pipeline.
    pub fn new(device: &Device, scene: &GpuScene, wave_capacity: u32) -> Result<Self, IntegratorError> {
        let [width, height] = scene.image_size();
        let pixel_count = pixel_count(width, height)?;
        let capacity = check_capacity(wave_capacity)?;
        let pixels = device_buffer(device, "aov", u64::from(pixel_count) * size_of::<AovPixel>() as u64)?;
        let queue = RayQueue::new(device, "pixel centre rays", capacity, true)?;
        let bindings = Bindings::new(device, scene, &[(binding::AOV, &pixels)])?;
        Ok(Self {
            primary: bindings.kernel(device, &INTEGRATORS_PRIMARY, &camera_constants(true))?,
            store: bindings.kernel(device, &INTEGRATORS_AOV, &[])?.of_film(),
            pixel_count,
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
        check_wave(wave, self.queue.capacity(), self.pixel_count)?;
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

    /// Downloads all pixels, row by row from the top left: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read(&self, device: &Device) -> Result<Vec<AovPixel>, IntegratorError> {
        Ok(device.download_as(&self.pixels, 0, self.pixel_count as usize)?)
    }
}
