//! Auxiliary images of the first hits at pixel centres: distance, normal and primitive, and on request the
//! properties of materials and meshes.

use rasray_ads::{Domain, RayQueue};
use rasray_gpu::{Buffer, Device, Recorder};
use rasray_gpu_scene::GpuScene;
use rasray_shaders_glsl::{
    INTEGRATORS_AOV, INTEGRATORS_AOV_SURFACE, INTEGRATORS_PRIMARY,
    records::{AovPixel, AovSurface},
};

use crate::{
    Bands, IntegratorError, Traced, Wave,
    integrator::check_capacity,
    kernels::{Bindings, Kernel, OfPixels, WaveConstants, binding, camera_constants, device_buffer},
};

/// Traces the rays of pixel centres and keeps their hits, for one band at a time. One trace per wave;
/// `Wave::sample` is not used.
#[derive(Debug)]
pub struct AovPass {
    bands: Bands,
    /// Pixels of the band that was traced last.
    pixels: Buffer,
    queue: RayQueue,
    bindings: Bindings,
    primary: Kernel,
    store: Kernel,
    /// Buffer and kernel of the materials and meshes of hits, if these are requested.
    surfaces: Option<(Buffer, Kernel)>,
}

/// Binding of the [`AovSurface`] per pixel of the band, if these are requested.
const SURFACES: u32 = 9;

impl AovPass {
    /// Makes queue, image and kernels for the scene's view in these bands, with at most `wave_capacity` rays
    /// per wave.
    ///
    /// # Errors
    /// `SizesDiffer` if bands and view have different numbers of pixels; an error for sizes that do not fit,
    /// out of memory, or if the device refuses a pipeline.
    pub fn new(
        device: &Device,
        scene: &GpuScene,
        bands: Bands,
        wave_capacity: u32,
    ) -> Result<Self, IntegratorError> {
        Self::make(device, scene, (bands, false), wave_capacity)
    }

    /// Makes the pass with materials and meshes of each pixel, in bands that are small enough for these
    /// records.
    ///
    /// # Errors
    /// Errors of [`AovPass::new`].
    pub fn with_surfaces(
        device: &Device,
        scene: &GpuScene,
        bands: Bands,
        wave_capacity: u32,
    ) -> Result<Self, IntegratorError> {
        let bands = bands.of_records(device, size_of::<AovSurface>() as u64);
        Self::make(device, scene, (bands, true), wave_capacity)
    }

    fn make(
        device: &Device,
        scene: &GpuScene,
        (bands, has_surfaces): (Bands, bool),
        wave_capacity: u32,
    ) -> Result<Self, IntegratorError> {
        let view = scene.image_size();
        if Bands::one(view)?.pixel_count() != bands.pixel_count() {
            return Err(IntegratorError::SizesDiffer { film: [bands.pixel_count(), 1], view });
        }
        let capacity = check_capacity(wave_capacity)?;
        let buffer = |name, bytes: usize| device_buffer(device, name, u64::from(bands.most()) * bytes as u64);
        let pixels = buffer("aov", size_of::<AovPixel>())?;
        let queue = RayQueue::new(device, "pixel centre rays", capacity, true)?;
        let surfaces = match has_surfaces {
            true => Some(buffer("aov surfaces", size_of::<AovSurface>())?),
            false => None,
        };
        let of_surfaces = surfaces.iter().map(|buffer| (SURFACES, buffer));
        let of_band: Vec<_> = [(binding::AOV, &pixels)].into_iter().chain(of_surfaces).collect();
        let bound = vec![of_band; bands.ranges().count()];
        let bindings = Bindings::new(device, scene, &OfPixels { bands, bound }, &[])?;
        let surfaces = match surfaces {
            Some(buffer) => Some((buffer, bindings.kernel(device, &INTEGRATORS_AOV_SURFACE, &[])?.of_film())),
            None => None,
        };
        Ok(Self {
            primary: bindings.kernel(device, &INTEGRATORS_PRIMARY, &camera_constants(true))?,
            store: bindings.kernel(device, &INTEGRATORS_AOV, &[])?.of_film(),
            bands,
            pixels,
            queue,
            bindings,
            surfaces,
        })
    }

    /// Records that the queue's counters start at 0; once before the first wave.
    pub fn record_reset(&self, recorder: &mut Recorder<'_>) {
        self.queue.record_reset(recorder);
    }

    /// Records the pixels of a wave.
    ///
    /// # Errors
    /// An error if the wave does not fit the queue or the image, or the structure was made without a scene.
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
        if let Some((_, kernel)) = &self.surfaces {
            self.bindings.record(recorder, kernel, &self.queue, all, &constants);
        }
        Ok(())
    }

    /// Returns the bands that the pass traces one after the other: those of the caller, or smaller ones.
    pub fn bands(&self) -> Bands {
        self.bands
    }

    /// Returns the queue, for its counters.
    pub fn queue(&self) -> &RayQueue {
        &self.queue
    }

    /// Returns the bytes of all buffers.
    pub fn bytes(&self) -> u64 {
        self.pixels.size()
            + self.surfaces.as_ref().map_or(0, |(buffer, _)| buffer.size())
            + self.queue.bytes()
    }

    /// Downloads the pixels of the band whose waves were traced last, `count` of them: submits and waits.
    ///
    /// # Errors
    /// An error if `count` is larger than a band, or the device is lost or out of memory.
    pub fn read(&self, device: &Device, count: u32) -> Result<Vec<AovPixel>, IntegratorError> {
        Ok(device.download_as(&self.pixels, 0, count as usize)?)
    }

    /// Downloads the materials and meshes of the same pixels; empty if they were not requested. Submits and
    /// waits.
    ///
    /// # Errors
    /// Errors of [`AovPass::read`].
    pub fn read_surfaces(&self, device: &Device, count: u32) -> Result<Vec<AovSurface>, IntegratorError> {
        match &self.surfaces {
            Some((buffer, _)) => Ok(device.download_as(buffer, 0, count as usize)?),
            None => Ok(Vec::new()),
        }
    }
}
