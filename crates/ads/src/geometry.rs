//! Posed triangles, the one input of every structure.

use bytemuck::bytes_of;
use rasray_gpu::{BindingSet, Buffer, BufferDesc, BufferUsage, Device, MemoryLocation, SetLayout};

use crate::{AdsError, GeometryHeader};

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
    /// Lower and upper corner of all posed positions, metres; any finite value where there is none.
    pub bounds: [[f32; 3]; 2],
    /// What positions are relative to, metres, world.
    pub frame_origin: [f64; 3],
}

/// Posed triangles on the device, with the binding set that shaders read them through. Cheap to clone.
#[derive(Clone, Debug)]
pub struct Geometry {
    desc: GeometryDesc,
    layout: SetLayout,
    set: BindingSet,
}

impl Geometry {
    /// Makes the header buffer (12 bytes, written by the host) and the binding set.
    ///
    /// # Errors
    /// Out of memory, or a buffer exceeds what one binding can hold.
    pub fn new(device: &Device, desc: GeometryDesc) -> Result<Self, AdsError> {
        let header = device.create_buffer(&BufferDesc {
            name: "geometry header",
            size: size_of::<GeometryHeader>() as u64,
            usage: BufferUsage::STORAGE,
            location: MemoryLocation::Upload,
        })?;
        header.write(
            0,
            bytes_of(&GeometryHeader {
                vertex_count: desc.vertex_count,
                triangle_count: desc.triangle_count,
                draw_count: desc.draw_count,
            }),
        )?;
        let layout = device.create_set_layout("geometry", 4)?;
        let set = device.create_binding_set(
            &layout,
            "geometry",
            &[&header, &desc.positions, &desc.indices, &desc.draws],
        )?;
        Ok(Self { desc, layout, set })
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
