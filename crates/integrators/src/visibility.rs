//! Drawing that finds the first hits of camera rays.

use bytemuck::bytes_of;
use rasray_ads::{AdsError, Counters, Domain, Geometry, RayQueue, SceneBinding};
use rasray_gpu::{
    Access, BindingSet, Buffer, ComputePipeline, ComputePipelineDesc, Device, Feature, RasterPipeline,
    RasterPipelineDesc, Recorder, Requirements, Stage,
};
use rasray_gpu_scene::GpuScene;
use rasray_shaders_glsl::{
    INTEGRATORS_VISIBILITY, INTEGRATORS_VISIBILITY_ALPHA, INTEGRATORS_VISIBILITY_RASTER,
    INTEGRATORS_VISIBILITY_RESOLVE, Shader,
    constant_ids::contract::COUNTERS,
    constants::scene::{VISIBILITY_LOWEST, VISIBILITY_NEAREST},
    records::{Hit, VisibilityConstants, VisibilityCounts},
};

use crate::{IntegratorError, Wave, kernels::device_buffer};

/// Finds the first hits of camera rays by drawing the triangles, in place of a trace
/// ([`crate::Traced::primary`]).
///
/// The rasterizer proposes pixels, and the ray test of tracing decides on the ray of each pixel, so hits are
/// those of a structure that finds every triangle, bit for bit. Surfaces are those of triangles, whatever
/// structure later rays are traced through. Triangles are drawn through a pinhole: if the camera has a lens,
/// every ray is counted as not ready.
#[derive(Debug)]
pub struct Visibility {
    geometry: Geometry,
    /// Number of pixels per row of the image.
    width: u32,
    counts: Buffer,
    set: BindingSet,
    scene: SceneBinding,
    draw: RasterPipeline,
    resolve: ComputePipeline,
}

impl Visibility {
    /// Returns the requirements of a device: the common minimum, and stores of fragment shaders.
    pub fn requirements() -> Requirements {
        let mut requirements = Requirements::floor();
        requirements.required.push(Feature::FragmentStoresAndAtomics);
        requirements
    }

    /// Makes pipelines for the scene's triangles and its view. With counters, every triangle that is tested
    /// at a pixel is counted as a test of the queue.
    ///
    /// # Errors
    /// `CannotDraw` if the device lacks a feature or the image is larger than it can draw; out of memory, or
    /// the device refuses a pipeline.
    pub fn new(
        device: &Device,
        scene: &GpuScene,
        counters: impl Into<Counters>,
    ) -> Result<Self, IntegratorError> {
        let [width, height] = scene.image_size();
        check(device, width, height)?;
        let counts = device_buffer(device, "visibility counts", size_of::<VisibilityCounts>() as u64)?;
        let layout = device.create_set_layout("visibility", 1)?;
        let set = device.create_binding_set(&layout, "visibility", &[&counts])?;
        let queue_layout = RayQueue::layout(device)?;
        let (geometry, binding) = (scene.geometry(), scene.binding());
        let sets = [geometry.layout(), &layout, &queue_layout, &binding.layout];
        let push_constant_bytes = size_of::<VisibilityConstants>() as u32;
        let mut constants = vec![(COUNTERS, counters.into().constant())];
        constants.extend_from_slice(&binding.constants);
        let fragment: &Shader =
            if binding.alpha_masked { &INTEGRATORS_VISIBILITY_ALPHA } else { &INTEGRATORS_VISIBILITY };
        let draw = device.create_raster_pipeline(&RasterPipelineDesc {
            name: fragment.name,
            vertex_module: &INTEGRATORS_VISIBILITY_RASTER.module(),
            fragment_module: &fragment.module(),
            sets: &sets,
            push_constant_bytes,
            constants: &constants,
        })?;
        let resolve = device.create_compute_pipeline(&ComputePipelineDesc {
            name: INTEGRATORS_VISIBILITY_RESOLVE.name,
            module: &INTEGRATORS_VISIBILITY_RESOLVE.module(),
            sets: &sets,
            push_constant_bytes,
            constants: &constants,
        })?;
        Ok(Self { geometry: geometry.clone(), width, counts, set, scene: binding.clone(), draw, resolve })
    }

    /// Draws the triangles of another scene from the next recording on, into images of the same size.
    /// Pipelines stay. An error changes nothing.
    ///
    /// # Errors
    /// An error if the bindings of the two scenes differ in a property that pipelines are compiled for.
    pub fn set_scene(&mut self, scene: &GpuScene) -> Result<(), IntegratorError> {
        let binding = scene.binding();
        if let Some(what) = self.scene.difference(binding) {
            return Err(AdsError::OtherScene { structure: "visibility", what }.into());
        }
        self.geometry = scene.geometry().clone();
        self.scene = binding.clone();
        Ok(())
    }

    /// Records that counts start at 0; needed once before first use.
    pub fn record_reset(&self, recorder: &mut Recorder<'_>) {
        recorder.barrier(Access::FRAGMENT | Access::TRANSFER, Access::TRANSFER_WRITE);
        recorder.fill(&self.counts, 0, self.counts.size(), 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::FRAGMENT | Access::TRANSFER);
    }

    /// Records hits and surfaces of the rays of a wave, which must be the camera rays of its pixels.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, wave: Wave) {
        let hit_bytes = u64::from(wave.pixel_count) * size_of::<Hit>() as u64;
        recorder.begin_pass(Stage::Visible, "integrators/visibility");
        recorder.fill(queue.hits(), 0, hit_bytes, u32::MAX);
        recorder.barrier(Access::COMPUTE | Access::TRANSFER_WRITE, Access::VERTEX_READ | Access::FRAGMENT);
        for round in [VISIBILITY_NEAREST, VISIBILITY_LOWEST] {
            recorder.begin_rendering(self.width, rows(wave, self.width));
            recorder.bind_raster(&self.draw);
            self.bind(recorder, queue, wave, round);
            self.geometry.record_draw(recorder, 1);
            recorder.end_rendering();
            recorder.barrier(Access::FRAGMENT, Access::FRAGMENT | Access::COMPUTE);
        }
        recorder.end_pass();
        recorder.begin_pass(Stage::Visible, INTEGRATORS_VISIBILITY_RESOLVE.name);
        recorder.bind_compute(&self.resolve);
        self.bind(recorder, queue, wave, 0);
        queue.record_dispatch(recorder, Domain::First(wave.pixel_count));
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER);
        recorder.end_pass();
    }

    fn bind(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, wave: Wave, round: u32) {
        let Wave { first_pixel, pixel_count, .. } = wave;
        recorder.bind_sets(0, &[self.geometry.set(), &self.set, queue.set(), &self.scene.set]);
        recorder.push_constants(bytes_of(&VisibilityConstants { first_pixel, pixel_count, round }));
    }

    /// Returns the bytes of its own buffers; hits and surfaces belong to the queue.
    pub fn bytes(&self) -> u64 {
        self.counts.size()
    }

    /// Downloads the counts of all waves since the reset: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read_counts(&self, device: &Device) -> Result<VisibilityCounts, IntegratorError> {
        Ok(device.download_as(&self.counts, 0, 1)?.first().copied().unwrap_or_default())
    }
}

/// Returns an error unless the device can draw an image of this size.
fn check(device: &Device, width: u32, height: u32) -> Result<(), IntegratorError> {
    let missing = device.lacks(&Visibility::requirements());
    if !missing.is_empty() {
        let reason = format!("{} lacks {}", device.name(), missing.join(", "));
        return Err(IntegratorError::CannotDraw { reason });
    }
    let [most_columns, most_rows] = device.limits().max_framebuffer_size;
    if width > most_columns || height > most_rows {
        let reason = format!(
            "an image has {width} x {height} pixels, and {} draws {most_columns} x {most_rows} at most",
            device.name()
        );
        return Err(IntegratorError::CannotDraw { reason });
    }
    Ok(())
}

/// Returns the number of rows of the image in which a wave has pixels.
fn rows(wave: Wave, width: u32) -> u32 {
    (wave.first_pixel + wave.pixel_count - 1) / width - wave.first_pixel / width + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wave_is_drawn_in_the_rows_of_its_pixels() {
        for (first_pixel, pixel_count, expected) in
            [(0, 1, 1), (0, 10, 1), (9, 2, 2), (10, 10, 1), (5, 30, 4)]
        {
            assert_eq!(rows(Wave { first_pixel, pixel_count, sample: 0 }, 10), expected);
        }
    }
}
