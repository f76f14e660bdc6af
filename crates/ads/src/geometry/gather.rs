//! Inputs of a geometry that the device computes before shaders read them: the number of triangles if only
//! the device knows it, and indices that are not read in place.

use rasray_gpu::{
    BindingSet, Buffer, BufferDesc, BufferRange, BufferUsage, ComputePipeline, ComputePipelineDesc, Device,
    GpuError, MemoryLocation, SetLayout,
};
use rasray_shaders_glsl::Shader;
use rasray_shaders_glsl::constants::ads::{GEOMETRY_DRAW_VIEWS, GEOMETRY_NOT_GATHERED};
use rasray_shaders_glsl::records::{GeometryCountConstants, GeometryGatherConstants};

use crate::{AdsError, GeometryDesc, Indexing};

/// Number of buffers in the set of gathered indices.
pub(crate) const GATHER_BINDINGS: u32 = 1;

/// Bytes of the indices of one triangle as shaders read them.
pub(crate) const TRIANGLE_INDEX_BYTES: u64 = size_of::<[u32; 3]>() as u64;

/// Bytes of the arguments of an indirect draw.
pub(crate) const DRAW_ARGUMENT_BYTES: u64 = 16;

/// Pipeline and buffers of `ads/geometry_count`.
#[derive(Clone, Debug)]
pub(crate) struct Count {
    pub(crate) pipeline: ComputePipeline,
    pub(crate) set: BindingSet,
    pub(crate) constants: GeometryCountConstants,
    /// Arguments of indirect draws of all triangles: the first draws onto one view, the second onto two, and
    /// so on.
    pub(crate) draw_arguments: Buffer,
}

/// Pipeline and buffers of `ads/geometry_gather`.
#[derive(Clone, Debug)]
pub(crate) struct Gather {
    pub(crate) pipeline: ComputePipeline,
    pub(crate) set: BindingSet,
    pub(crate) constants: GeometryGatherConstants,
    /// Absolute u32 indices that the pass writes.
    pub(crate) indices: Buffer,
}

impl Count {
    pub(crate) fn new(
        device: &Device,
        geometry: &SetLayout,
        desc: &GeometryDesc,
        (range, before): (BufferRange<'_>, u64),
        first_stamp: u32,
        gathers: bool,
    ) -> Result<Self, AdsError> {
        // The draws have no triangles until the device counts them.
        let draw_arguments = device.create_buffer_of_zeros(
            "geometry draw arguments",
            BufferUsage::STORAGE | BufferUsage::INDIRECT,
            DRAW_ARGUMENT_BYTES * u64::from(GEOMETRY_DRAW_VIEWS),
        )?;
        let layout = device.create_set_layout("geometry count", 2)?;
        let ranges = [range, whole(&draw_arguments)];
        let set = device.create_binding_set_of_ranges(&layout, "geometry count", &ranges)?;
        let shader = &rasray_shaders_glsl::ADS_GEOMETRY_COUNT;
        let pipeline = pipeline(device, shader, &[geometry, &layout], size_of::<GeometryCountConstants>())?;
        let constants = GeometryCountConstants {
            count_word: (before / 4) as u32,
            most_triangles: desc.triangle_count,
            first_stamp,
            // No pass gathers indices if there are no triangles.
            stamp_flags: if gathers && desc.triangle_count > 0 { GEOMETRY_NOT_GATHERED } else { 0 },
        };
        Ok(Self { pipeline, set, constants, draw_arguments })
    }
}

impl Gather {
    /// Makes a pass that gathers indices that are not absolute or not of 32 bits.
    pub(crate) fn new(
        device: &Device,
        geometry: &SetLayout,
        desc: &GeometryDesc,
        source: (BufferRange<'_>, u64),
    ) -> Result<Self, AdsError> {
        let (index_count, per_draw) = match desc.indices.indexing {
            // The host has checked that the buffer holds all indices, so the product does not overflow.
            Indexing::Absolute => (3 * desc.triangle_count, 0),
            Indexing::PerDraw { index_count } => (index_count, 1),
        };
        let index_bytes = desc.indices.format.bytes();
        Self::from(device, geometry, desc.triangle_count, source, [index_count, index_bytes, per_draw])
    }

    /// Makes a pass that gathers the indices of a part from those of the whole geometry, which has
    /// `triangles_of_whole` triangles.
    pub(crate) fn of_part(
        device: &Device,
        geometry: &SetLayout,
        desc: &GeometryDesc,
        source: (BufferRange<'_>, u64),
        triangles_of_whole: u32,
    ) -> Result<Self, AdsError> {
        let constants = [3 * triangles_of_whole, size_of::<u32>() as u32, 0];
        Self::from(device, geometry, desc.triangle_count, source, constants)
    }

    fn from(
        device: &Device,
        geometry: &SetLayout,
        triangle_count: u32,
        (range, before): (BufferRange<'_>, u64),
        [index_count, index_bytes, per_draw]: [u32; 3],
    ) -> Result<Self, AdsError> {
        let indices = device.create_buffer(&BufferDesc {
            name: "gathered indices",
            size: u64::from(triangle_count) * TRIANGLE_INDEX_BYTES,
            usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC,
            location: MemoryLocation::Device,
        })?;
        let layout = device.create_set_layout("geometry gather", GATHER_BINDINGS)?;
        let set = device.create_binding_set_of_ranges(&layout, "geometry gather", &[range])?;
        let shader = &rasray_shaders_glsl::ADS_GEOMETRY_GATHER;
        let pipeline = pipeline(device, shader, &[geometry, &layout], size_of::<GeometryGatherConstants>())?;
        let first_place = (before / u64::from(index_bytes)) as u32;
        let constants = GeometryGatherConstants { first_place, index_count, index_bytes, per_draw };
        Ok(Self { pipeline, set, constants, indices })
    }
}

/// Returns the range of a complete buffer.
pub(crate) fn whole(buffer: &Buffer) -> BufferRange<'_> {
    BufferRange { buffer, offset: 0, size: buffer.size() }
}

/// Makes the pipeline of a pass over a geometry.
pub(crate) fn pipeline(
    device: &Device,
    shader: &Shader,
    sets: &[&SetLayout],
    push_constant_bytes: usize,
) -> Result<ComputePipeline, GpuError> {
    device.create_compute_pipeline(&ComputePipelineDesc {
        name: shader.name,
        module: &shader.module(),
        sets,
        push_constant_bytes: push_constant_bytes as u32,
        constants: &[],
    })
}
