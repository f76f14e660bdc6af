//! Fetch of the surfaces of hits by drawing.

use std::mem::offset_of;

use bytemuck::bytes_of;
use rasray_ads::{AdsError, Domain, Geometry, RayQueue, SceneBinding, StructureKind};
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferUsage, ComputePipeline, ComputePipelineDesc, Device, Feature,
    RasterPipeline, RasterPipelineDesc, Recorder, Requirements, SetLayout, Stage,
};
use rasray_gpu_scene::GpuScene;
use rasray_shaders_glsl::{
    INTEGRATORS_FETCH, INTEGRATORS_FETCH_LISTS, INTEGRATORS_FETCH_RASTER,
    constants::contract::QUEUE_GROUP_SIZE,
    constants::integrators::{FETCH_COUNT, FETCH_PLACE, FETCH_STORE},
    records::{FetchConstants, FetchHeader},
};

use crate::{IntegratorError, WAVE_LIMIT, integrator::check_capacity, kernels::device_buffer};

/// Counts of surfaces that were fetched by drawing, summed over all fetches since the reset, modulo 2^32.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FetchCounts {
    /// Number of hits whose surface was fetched.
    pub hits: u32,
    /// Number of triangles with a hit, each once per fetch; the other triangles are not drawn.
    pub triangles: u32,
    /// Number of pixels of the cube with a hit, each once per fetch.
    pub pixels: u32,
    /// Number of hits of the longest list.
    pub longest: u32,
}

/// Fetches the surfaces of hits by drawing the scene against lists of hits, in place of
/// [`Structure::record_surfaces`](rasray_ads::Structure::record_surfaces): hits are listed by pixel of a cube
/// around the camera, triangles with hits are drawn onto it, and each fragment writes the surfaces of those
/// hits of its pixel that are on its triangle.
///
/// Surfaces are those of the triangles' ids. A hit counts as not ready until its surface is fetched, so that
/// a missing surface is always reported.
#[derive(Debug)]
pub struct Fetch {
    device: Device,
    geometry: Geometry,
    scene: SceneBinding,
    /// Number of pixels along a side of a face.
    side: u32,
    header: Buffer,
    pixels: Buffer,
    slots: Buffer,
    lists: Buffer,
    mask: Buffer,
    layout: SetLayout,
    set: BindingSet,
    steps: ComputePipeline,
    draw: RasterPipeline,
}

impl Fetch {
    /// Returns the requirements of a device: the common minimum, and stores of fragment shaders.
    pub fn requirements() -> Requirements {
        let mut requirements = Requirements::floor();
        requirements.required.push(Feature::FragmentStoresAndAtomics);
        requirements
    }

    /// Makes pipelines for the scene's triangles, and lists for `capacity` hits.
    ///
    /// # Errors
    /// `CannotFetch` if the device lacks a feature or the faces are larger than it can draw; out of memory,
    /// or the device refuses a pipeline.
    pub fn new(device: &Device, scene: &GpuScene, capacity: u32) -> Result<Self, IntegratorError> {
        let side = side(check_capacity(capacity)?);
        check(device, side)?;
        let usage = BufferUsage::STORAGE
            | BufferUsage::INDIRECT
            | BufferUsage::TRANSFER_SRC
            | BufferUsage::TRANSFER_DST;
        let header = device.create_cleared_buffer("fetch header", usage, size_of::<FetchHeader>() as u64)?;
        let words = |name, words: u64| device_buffer(device, name, 4 * words);
        let pixels = words("fetch pixels", 2 * pixels(side))?;
        let slots = words("fetch slots", 2 * u64::from(capacity))?;
        let lists = words("fetch lists", capacity.into())?;
        let (geometry, binding) = (scene.geometry(), scene.binding());
        let mask = words("fetch mask", mask_words(geometry))?;
        let layout = device.create_set_layout("fetch", 5)?;
        let set = device.create_binding_set(&layout, "fetch", &[&header, &pixels, &slots, &lists, &mask])?;
        let queue_layout = RayQueue::layout(device)?;
        let sets = [geometry.layout(), &layout, &queue_layout, &binding.layout];
        let push_constant_bytes = size_of::<FetchConstants>() as u32;
        let steps = device.create_compute_pipeline(&ComputePipelineDesc {
            name: INTEGRATORS_FETCH_LISTS.name,
            module: &INTEGRATORS_FETCH_LISTS.module(),
            sets: &sets,
            push_constant_bytes,
            constants: &binding.constants,
        })?;
        let draw = device.create_raster_pipeline(&RasterPipelineDesc {
            name: INTEGRATORS_FETCH.name,
            vertex_module: &INTEGRATORS_FETCH_RASTER.module(),
            fragment_module: &INTEGRATORS_FETCH.module(),
            sets: &sets,
            push_constant_bytes,
            constants: &binding.constants,
        })?;
        let (geometry, scene) = (geometry.clone(), binding.clone());
        let device = device.clone();
        Ok(Self {
            device,
            geometry,
            scene,
            side,
            header,
            pixels,
            slots,
            lists,
            mask,
            layout,
            set,
            steps,
            draw,
        })
    }

    /// Fetches surfaces of another scene from the next recording on. Pipelines stay. An error changes
    /// nothing.
    ///
    /// # Errors
    /// An error if the bindings of the two scenes differ in a property that pipelines are compiled for; out
    /// of memory.
    pub fn set_scene(&mut self, scene: &GpuScene) -> Result<(), IntegratorError> {
        let binding = scene.binding();
        if let Some(what) = self.scene.difference(binding) {
            return Err(AdsError::OtherScene { structure: "fetch", what }.into());
        }
        let words = mask_words(scene.geometry());
        if 4 * words > self.mask.size() {
            let mask = device_buffer(&self.device, "fetch mask", 4 * words)?;
            let buffers = [&self.header, &self.pixels, &self.slots, &self.lists, &mask];
            self.set = self.device.create_binding_set(&self.layout, "fetch", &buffers)?;
            self.mask = mask;
        }
        self.geometry = scene.geometry().clone();
        self.scene = binding.clone();
        Ok(())
    }

    /// Records that counts start at 0; needed once before first use.
    pub fn record_reset(&self, recorder: &mut Recorder<'_>) {
        recorder.barrier(Access::COMPUTE | Access::TRANSFER, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, 0, self.header.size(), 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
    }

    /// Records the surfaces of the slots of `domain`, whose hits a structure of this kind found.
    ///
    /// # Errors
    /// An error if the structure's hits are not on triangles.
    pub(crate) fn record(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        kind: StructureKind,
    ) -> Result<(), AdsError> {
        if !kind.finds_triangles() {
            let expected = "hits of this structure are fragments, and what is drawn are triangles";
            return Err(AdsError::Option { option: "fetch", value: "raster".to_owned(), expected });
        }
        recorder.begin_pass(Stage::Surfaces, INTEGRATORS_FETCH_LISTS.name);
        let counted = offset_of!(FetchHeader, hits) as u64;
        recorder.fill(&self.header, 0, counted, 0);
        recorder.fill(&self.pixels, 0, self.pixels.size(), 0);
        recorder.fill(&self.mask, 0, self.mask.size(), 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
        recorder.bind_compute(&self.steps);
        for step in [FETCH_COUNT, FETCH_PLACE, FETCH_STORE] {
            self.bind(recorder, queue, domain, step);
            if step == FETCH_PLACE {
                recorder.dispatch([pixels(self.side).div_ceil(QUEUE_GROUP_SIZE.into()) as u32, 1, 1]);
            } else {
                queue.record_dispatch(recorder, domain);
            }
            recorder.barrier(Access::COMPUTE, Access::COMPUTE);
        }
        let drawing = Access::INDIRECT_READ | Access::VERTEX_READ | Access::FRAGMENT;
        recorder.barrier(Access::COMPUTE, drawing);
        recorder.end_pass();
        recorder.begin_pass(Stage::Surfaces, INTEGRATORS_FETCH.name);
        recorder.begin_rendering(self.side + 2, self.side + 2);
        recorder.bind_raster(&self.draw);
        self.bind(recorder, queue, domain, 0);
        recorder.draw_indirect(&self.header, 0);
        recorder.end_rendering();
        recorder.barrier(Access::FRAGMENT, Access::COMPUTE | Access::TRANSFER);
        recorder.end_pass();
        Ok(())
    }

    fn bind(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, domain: Domain, step: u32) {
        recorder.bind_sets(0, &[self.geometry.set(), &self.set, queue.set(), &self.scene.set]);
        let constants = FetchConstants { domain: domain.word(), side: self.side, step };
        recorder.push_constants(bytes_of(&constants));
    }

    /// Returns the bytes of the fetch's own buffers; hits and surfaces belong to the queue.
    pub fn bytes(&self) -> u64 {
        [&self.header, &self.pixels, &self.slots, &self.lists, &self.mask]
            .iter()
            .map(|buffer| buffer.size())
            .sum()
    }

    /// Downloads the counts since the reset: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read_counts(&self, device: &Device) -> Result<FetchCounts, IntegratorError> {
        let header: FetchHeader =
            device.download_as(&self.header, 0, 1)?.first().copied().unwrap_or_default();
        let FetchHeader { hits, triangles, pixels, longest, .. } = header;
        Ok(FetchCounts { hits, triangles, pixels, longest })
    }
}

/// Returns the number of pixels along a side of a face, such that all faces have about as many pixels as
/// there can be hits.
fn side(capacity: u32) -> u32 {
    (1..).find(|side| pixels(*side) >= capacity.min(WAVE_LIMIT).into()).unwrap_or(1)
}

/// Returns the number of pixels of all faces.
fn pixels(side: u32) -> u64 {
    6 * u64::from(side) * u64::from(side)
}

/// Returns the number of words of a mask with a bit per triangle, at least one.
fn mask_words(geometry: &Geometry) -> u64 {
    u64::from(geometry.triangle_count()).div_ceil(32).max(1)
}

/// Returns an error unless the device can draw faces of this size.
fn check(device: &Device, side: u32) -> Result<(), IntegratorError> {
    let missing = device.lacks(&Fetch::requirements());
    if !missing.is_empty() {
        let reason = format!("{} lacks {}", device.name(), missing.join(", "));
        return Err(IntegratorError::CannotFetch { reason });
    }
    let most = device.limits().max_framebuffer_size.into_iter().min().unwrap_or(0);
    if side + 2 > most {
        let reason =
            format!("faces have {} pixels a side, and {} draws {most} at most", side + 2, device.name());
        return Err(IntegratorError::CannotFetch { reason });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cube_has_about_a_pixel_per_hit() {
        for (capacity, expected) in [(1, 1), (6, 1), (7, 2), (131_072, 148), (WAVE_LIMIT, 419)] {
            assert_eq!(side(capacity), expected, "{capacity}");
        }
    }
}
