//! Posed triangles, the one input of every structure.

use std::mem::offset_of;

use bytemuck::bytes_of;
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferUsage, ComputePipeline, ComputePipelineDesc, Device,
    GpuError, MemoryLocation, Recorder, SetLayout,
};

use rasray_shaders_glsl::{ADS_GEOMETRY_BOUNDS, ADS_GEOMETRY_BOUNDS_END, ADS_GEOMETRY_CHECK, Shader};

use crate::passes::folded;
use crate::{AdsError, Draw, GeometryHeader};

/// Triangles that a workgroup of `ads/geometry_check` and `ads/geometry_bounds` looks at.
const TRIANGLES_PER_GROUP: u64 = 64;

/// Buffers of the geometry set.
const BINDINGS: u32 = 4;

/// Bytes of the keys of a corner of the bounds.
const KEY_BYTES: u64 = size_of::<[u32; 3]>() as u64;

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
    /// Lower and upper corner of all posed positions, metres; any finite value where there is none. They are written to
    /// the geometry's header on the device, where a pass of the host or [`BoundsPass`] may write others
    /// before a build; structures are planned by these, and built by those on the device. A build that meets a corner
    /// outside of these is not complete, and says how many triangles do.
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
    /// Makes the header buffer ([`GeometryHeader`], 64 bytes) and the binding set.
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
                lower_keys: [0; 3],
                upper_keys: [0; 3],
            }),
        )?;
        let layout = device.create_set_layout("geometry", BINDINGS)?;
        let set = device.create_binding_set(
            &layout,
            "geometry",
            &[&header, &desc.positions, &desc.indices, &desc.draws],
        )?;
        let check = pass(device, &layout, &ADS_GEOMETRY_CHECK)?;
        Ok(Self { desc, header, check, layout, set })
    }

    /// The header that shaders read: a [`GeometryHeader`]. A pass of the host that moves vertices writes `lower` and
    /// `upper` there, in order with the builds that follow; [`Geometry::bounds`] stays what was stated.
    pub fn header(&self) -> &Buffer {
        &self.header
    }

    /// Workgroups of one thread per triangle; none without triangles.
    fn groups(&self) -> Option<[u32; 3]> {
        folded(u64::from(self.desc.triangle_count).div_ceil(TRIANGLES_PER_GROUP))
    }

    /// Records the count of triangles that the bounds and the vertices do not allow for, visible to compute shaders,
    /// and its copy to four bytes of `target`.
    pub(crate) fn record_check(&self, recorder: &mut Recorder<'_>, target: &Buffer, offset: u64) {
        let count = offset_of!(GeometryHeader, outside) as u64;
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, count, 4, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
        if let Some(groups) = self.groups() {
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

    /// Lower and upper corner as they were stated, metres relative to the frame origin.
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

/// A pass over the triangles of a geometry.
fn pass(device: &Device, layout: &SetLayout, shader: &Shader) -> Result<ComputePipeline, GpuError> {
    device.create_compute_pipeline(&ComputePipelineDesc {
        name: shader.name,
        spirv: shader.words(),
        sets: &[layout],
        push_constant_bytes: 0,
        constants: &[],
    })
}

/// Measures the bounds of geometries on the device, for positions that the device moved.
#[derive(Debug)]
pub struct BoundsPass {
    measure: ComputePipeline,
    end: ComputePipeline,
}

impl BoundsPass {
    /// Makes the pipelines, for every geometry of the device.
    ///
    /// # Errors
    /// The device refuses one.
    pub fn new(device: &Device) -> Result<Self, AdsError> {
        let layout = device.create_set_layout("geometry", BINDINGS)?;
        let pass = |shader| pass(device, &layout, shader);
        Ok(Self { measure: pass(&ADS_GEOMETRY_BOUNDS)?, end: pass(&ADS_GEOMETRY_BOUNDS_END)? })
    }

    /// Records the measuring of the bounds of all triangles, in two dispatches that read every triangle once, into the
    /// header on the device. Positions and indices are visible to compute shaders; the bounds are visible to all that
    /// follows. Corners that are not finite are left out: the check of a build finds those that are infinite.
    pub fn record(&self, recorder: &mut Recorder<'_>, geometry: &Geometry) {
        let [lower, upper] = [offset_of!(GeometryHeader, lower_keys), offset_of!(GeometryHeader, upper_keys)]
            .map(|at| at as u64);
        recorder.begin_pass("ads/geometry_bounds");
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_WRITE);
        recorder.fill(&geometry.header, lower, KEY_BYTES, u32::MAX);
        recorder.fill(&geometry.header, upper, KEY_BYTES, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
        if let Some(groups) = geometry.groups() {
            recorder.bind_compute(&self.measure);
            recorder.bind_sets(0, &[&geometry.set]);
            recorder.dispatch(groups);
            recorder.barrier(Access::COMPUTE, Access::COMPUTE);
        }
        recorder.bind_compute(&self.end);
        recorder.bind_sets(0, &[&geometry.set]);
        recorder.dispatch([1; 3]);
        recorder.barrier(Access::COMPUTE_WRITE, Access::ALL);
        recorder.end_pass();
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
