//! Posed triangles, the one input of every structure.

use std::mem::offset_of;

use bytemuck::bytes_of;
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferUsage, ComputePipeline, ComputePipelineDesc, Device,
    MemoryLocation, Recorder, SetLayout,
};

use crate::passes::folded;
use crate::{AdsError, Draw, GeometryHeader};

/// Triangles that a workgroup of `ads/geometry_check` looks at.
const CHECKED_PER_GROUP: u64 = 64;

/// Buffers and counts to make a [`Geometry`] from. An embedder fills it from buffers of its own.
#[derive(Clone, Debug)]
pub struct GeometryDesc {
    /// Posed positions, f32x3 without padding, metres relative to `frame_origin`.
    pub positions: Buffer,
    /// Vertex indices, u32, three a triangle; all below `vertex_count`.
    pub indices: Buffer,
    /// [`crate::Draw`] records in order of their triangles.
    pub draws: Buffer,
    /// Vertices in `positions`.
    pub vertex_count: u32,
    /// Triangles in `indices`.
    pub triangle_count: u32,
    /// Records in `draws`.
    pub draw_count: u32,
    /// Lower and upper corner of all posed positions, metres; any finite value where there is none. A build that meets
    /// a corner outside of them is not complete, and says how many triangles do.
    pub bounds: [[f32; 3]; 2],
    /// What positions are relative to, metres, world.
    pub frame_origin: [f64; 3],
}

/// Posed triangles on the device, with the binding set that shaders read them through. Cheap to clone.
#[derive(Clone, Debug)]
pub struct Geometry {
    desc: GeometryDesc,
    header: Buffer,
    check: ComputePipeline,
    layout: SetLayout,
    set: BindingSet,
}

impl Geometry {
    /// Makes the header buffer (40 bytes, written by the host) and the binding set.
    ///
    /// # Errors
    /// Counts beyond what the buffers hold, bounds that are not finite or the wrong way round; out of memory, or a
    /// buffer exceeds what one binding can hold.
    pub fn new(device: &Device, desc: GeometryDesc) -> Result<Self, AdsError> {
        check_desc(&desc)?;
        let header = device.create_buffer(&BufferDesc {
            name: "geometry header",
            size: size_of::<GeometryHeader>() as u64,
            usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST,
            location: MemoryLocation::Upload,
        })?;
        header.write(
            0,
            bytes_of(&GeometryHeader {
                vertex_count: desc.vertex_count,
                triangle_count: desc.triangle_count,
                draw_count: desc.draw_count,
                outside: 0,
                lower: desc.bounds[0],
                upper: desc.bounds[1],
            }),
        )?;
        let layout = device.create_set_layout("geometry", 4)?;
        let set = device.create_binding_set(
            &layout,
            "geometry",
            &[&header, &desc.positions, &desc.indices, &desc.draws],
        )?;
        let shader = &rasray_shaders_glsl::ADS_GEOMETRY_CHECK;
        let check = device.create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            spirv: shader.words(),
            sets: &[&layout],
            push_constant_bytes: 0,
            constants: &[],
        })?;
        Ok(Self { desc, header, check, layout, set })
    }

    /// Records the count of triangles that the bounds and the vertices do not allow for, visible to compute shaders,
    /// and its copy to four bytes of `target`.
    pub(crate) fn record_check(&self, recorder: &mut Recorder<'_>, target: &Buffer, offset: u64) {
        let count = offset_of!(GeometryHeader, outside) as u64;
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, count, 4, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
        if let Some(groups) = folded(u64::from(self.desc.triangle_count).div_ceil(CHECKED_PER_GROUP)) {
            recorder.bind_compute(&self.check);
            recorder.bind_sets(0, &[&self.set]);
            recorder.dispatch(groups);
        }
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER_READ);
        recorder.copy(&self.header, count, target, offset, 4);
    }

    /// What it was made from.
    pub fn desc(&self) -> &GeometryDesc {
        &self.desc
    }

    /// Number of triangles.
    pub fn triangle_count(&self) -> u32 {
        self.desc.triangle_count
    }

    /// Lower and upper corner, metres relative to the frame origin.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        self.desc.bounds
    }

    /// Layout of the geometry set.
    pub fn layout(&self) -> &SetLayout {
        &self.layout
    }

    /// The geometry set.
    pub fn set(&self) -> &BindingSet {
        &self.set
    }
}

/// Whether the description is true of the buffers, as far as the host can see.
fn check_desc(desc: &GeometryDesc) -> Result<(), AdsError> {
    let wrong = |reason: String| Err(AdsError::Geometry { reason });
    let parts: [(&str, &Buffer, u32, usize); 3] = [
        ("vertices", &desc.positions, desc.vertex_count, size_of::<[f32; 3]>()),
        ("triangles", &desc.indices, desc.triangle_count, size_of::<[u32; 3]>()),
        ("draws", &desc.draws, desc.draw_count, size_of::<Draw>()),
    ];
    for (what, buffer, count, bytes) in parts {
        let needed = u64::from(count) * bytes as u64;
        if needed > buffer.size() {
            return wrong(format!(
                "{count} {what} are {needed} bytes, but buffer `{}` has {}",
                buffer.name(),
                buffer.size()
            ));
        }
    }
    let [lower, upper] = desc.bounds;
    let ordered =
        lower.iter().zip(&upper).all(|(low, high)| low.is_finite() && high.is_finite() && low <= high);
    if !ordered {
        return wrong(format!("bounds from {lower:?} to {upper:?} must be finite, the lower corner first"));
    }
    Ok(())
}
