//! Posed triangles, the input of every structure.

pub(crate) mod bounds_pass;
pub(crate) mod desc;
pub(crate) mod extent;
mod gather;
pub(crate) mod parts;
mod record;
mod stamp;

use std::mem::offset_of;

use bytemuck::{Pod, Zeroable, bytes_of, cast_slice, pod_read_unaligned};
use rasray_gpu::{
    BindingSet, Buffer, BufferDesc, BufferRange, BufferUsage, ComputePipeline, Device, GpuError,
    MemoryLocation, SetLayout,
};

use rasray_shaders_glsl::constants::ads::{
    GEOMETRY_COUNT_STAMPS, GEOMETRY_HEADER_BYTES, GEOMETRY_RIGID_BYTES, GEOMETRY_RUN_BYTES,
};
use rasray_shaders_glsl::constants::contract::STATUS_FLAGS;

use crate::geometry::gather::{Count, Gather, TRIANGLE_INDEX_BYTES, pipeline, whole};
use crate::geometry::stamp::{STAMP_STEP, new_stamps};
use crate::{AdsError, GeometryDesc, GeometryExtent, GeometryHeader, GeometryRigid, IndexRange};

/// Number of buffers in the geometry set.
pub(crate) const BINDINGS: u32 = 4;

/// Triangles on the device that structures build from, at their positions at one moment, with the binding set
/// through which shaders read them. [`Geometry::new`] makes it from buffers of a host, which it reads in
/// place if their layout allows.
///
/// Clones are cheap handles to the same buffers.
#[derive(Clone, Debug)]
pub struct Geometry {
    pub(crate) desc: GeometryDesc,
    pub(crate) header: Buffer,
    pub(crate) check: ComputePipeline,
    layout: SetLayout,
    pub(crate) set: BindingSet,
    /// Stamp in the status of a structure that was built for these triangles. It is the first of several if
    /// only the device knows the number of triangles.
    pub(crate) stamp: u32,
    /// Count buffer, if only the device knows the number of triangles.
    pub(crate) count: Option<Count>,
    /// Copy of the indices, if they are not read in place.
    pub(crate) gather: Option<Gather>,
    /// Geometry of which this one is a part.
    pub(crate) whole: Option<Box<Self>>,
    space: Space,
}

/// Space in which the triangles of a geometry are given.
#[derive(Clone, Debug)]
pub(crate) enum Space {
    /// World space: the triangles are as posed.
    World,
    /// A space of the triangles' own, from which a map takes them to the world.
    Own,
    /// World space, with the same triangles also given in a space of their own.
    Mapped(Box<Geometry>),
}

/// Value for a part without a map to the space that the part was built in: its rays are then tested against
/// all triangles of the part.
pub const NO_MAP: GeometryRigid = GeometryRigid {
    x: [0.0; 3],
    y: [0.0; 3],
    z: [0.0; 3],
    centre: [0.0; 3],
    offset: [0.0; 3],
    stretch: 0.0,
    reach: 0.0,
    error: f32::INFINITY,
};

/// Returns the byte at which a header with room for `bound_runs` runs holds the map of a part.
fn rigid_place(bound_runs: usize) -> usize {
    const { assert!(size_of::<GeometryHeader>() == GEOMETRY_HEADER_BYTES as usize) };
    const { assert!(size_of::<Run>() == GEOMETRY_RUN_BYTES as usize) };
    const { assert!(size_of::<GeometryRigid>() == GEOMETRY_RIGID_BYTES as usize) };
    (size_of::<GeometryHeader>() + bound_runs * size_of::<Run>()).next_multiple_of(size_of::<GeometryRigid>())
}

/// Returns true if a pass gathers the indices that shaders read, those of the whole geometry included.
pub(crate) fn gathers(gather: Option<&Gather>, whole: Option<&Geometry>) -> bool {
    gather.is_some() || whole.is_some_and(|whole| whole.gather.is_some())
}

/// A run of consecutive triangles of a part.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Run {
    /// Index of the run's first triangle in the part.
    pub first: u32,
    /// Index of the run's first triangle in the whole geometry.
    pub id: u32,
}

impl Geometry {
    /// Makes the header buffer ([`GeometryHeader`], 112 bytes, and 8 for each run of a part, at least one; 72
    /// for a part with a space of its own), if needed a buffer for gathered indices (12 bytes per triangle)
    /// and one for draws (96 bytes), and the binding set.
    ///
    /// # Errors
    /// Ranges beyond their buffers, offsets or a stride that are not aligned, bounds that are not finite or
    /// that have lower and upper corner exchanged; out of memory, or a range exceeds the maximum size of a
    /// binding.
    pub fn new(device: &Device, desc: GeometryDesc) -> Result<Self, AdsError> {
        Self::made(device, desc, None, Space::World)
    }

    /// Makes the part of `whole` that consists of the triangles of `runs`. The part reads absolute indices:
    /// in place if the triangles are one run, else gathered.
    pub(crate) fn part_of(
        device: &Device,
        whole: &Self,
        (runs, triangle_count): (&[Run], u32),
        bounds: [[f32; 3]; 2],
        space: Space,
    ) -> Result<Self, AdsError> {
        let mut indices = match &whole.gather {
            Some(gather) => IndexRange::from(gather.indices.clone()),
            None => whole.desc.indices.clone(),
        };
        if let [run] = runs {
            indices.offset += u64::from(run.id) * TRIANGLE_INDEX_BYTES;
        }
        let desc = GeometryDesc { indices, triangle_count, bounds, ..whole.desc.clone() };
        Self::made(device, desc, Some((whole, runs)), space)
    }

    fn made(
        device: &Device,
        desc: GeometryDesc,
        part: Option<(&Self, &[Run])>,
        space: Space,
    ) -> Result<Self, AdsError> {
        desc.check(device)?;
        let runs = part.map_or(&[][..], |(_, runs)| runs);
        let bound_runs = if runs.len() > 1 { runs.len() } else { 1 };
        let header = device.create_buffer(&BufferDesc {
            name: "geometry header",
            size: match space {
                Space::World => (size_of::<GeometryHeader>() + bound_runs * size_of::<Run>()) as u64,
                Space::Own | Space::Mapped(_) => {
                    (rigid_place(bound_runs) + size_of::<GeometryRigid>()) as u64
                }
            },
            usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST,
            location: MemoryLocation::Upload,
        })?;
        let bindings = desc.bindings(device);
        let [(positions, before_positions), (indices, before_indices), (draws, _)] = bindings[..3] else {
            unreachable!("positions, indices and draws are always bound")
        };
        let layout = device.create_set_layout("geometry", BINDINGS)?;
        let gather = match part {
            Some((of, runs)) if runs.len() > 1 => {
                let source = match &of.gather {
                    Some(gather) => (whole(&gather.indices), 0),
                    None => of.desc.bindings(device)[1],
                };
                Some(Gather::of_part(device, &layout, &desc, source, of.desc.triangle_count)?)
            }
            None if desc.indices.is_gathered() => {
                Some(Gather::new(device, &layout, &desc, (indices, before_indices))?)
            }
            _ => None,
        };
        // A structure of triangles in a space of their own is traced with the posed triangles, so both share
        // a stamp.
        let stamp = match &space {
            Space::Mapped(rest) => rest.stamp,
            Space::World | Space::Own => {
                new_stamps(if desc.count.is_some() { GEOMETRY_COUNT_STAMPS } else { 1 })
            }
        };
        let count = match bindings.get(3) {
            Some((range, before)) => {
                Some(Count::new(device, &layout, &desc, (*range, *before), stamp, gather.is_some())?)
            }
            None => None,
        };
        let is_in_place = count.is_none() && !gathers(gather.as_ref(), part.map(|(whole, _)| whole));
        let around = part.map_or(desc.bounds, |(whole, _)| whole.desc.bounds);
        header.write(
            0,
            bytes_of(&GeometryHeader {
                vertex_count: desc.vertex_count,
                // The number is 0 until the device has counted the triangles.
                triangle_count: if count.is_some() { 0 } else { desc.triangle_count },
                draw_count: desc.draw_count,
                outside: 0,
                lower: desc.bounds[0],
                upper: desc.bounds[1],
                position_word: (before_positions / 4) as u32,
                position_words: desc.positions.stride / 4,
                index_word: if gather.is_some() { 0 } else { (before_indices / 4) as u32 },
                lower_keys: [0; 3],
                upper_keys: [0; 3],
                first_id: if let [run] = runs { run.id } else { 0 },
                run_count: if runs.len() > 1 { runs.len() as u32 } else { 0 },
                around_lower: around[0],
                around_upper: around[1],
                stamp: if is_in_place { stamp } else { 0 },
            }),
        )?;
        if runs.len() > 1 {
            header.write(size_of::<GeometryHeader>() as u64, cast_slice(runs))?;
        }
        if !matches!(space, Space::World) {
            header.write(rigid_place(bound_runs) as u64, bytes_of(&NO_MAP))?;
        }
        let read = gather.as_ref().map_or(indices, |gather| whole(&gather.indices));
        let ranges = [whole(&header), positions, read, draws];
        let set = device.create_binding_set_of_ranges(&layout, "geometry", &ranges)?;
        let check = pipeline(device, &rasray_shaders_glsl::ADS_GEOMETRY_CHECK, &[&layout], 0)?;
        let whole = part.map(|(whole, _)| Box::new(whole.clone()));
        Ok(Self { desc, header, check, layout, set, stamp, count, gather, whole, space })
    }

    /// Returns the triangles in a space of their own, where they do not move; a structure that is built for
    /// them is traced with the part.
    pub(crate) fn rest(&self) -> Option<&Self> {
        match &self.space {
            Space::Mapped(rest) => Some(rest),
            Space::World | Space::Own => None,
        }
    }

    /// Returns header and byte of the map of a part with a space of its own, also for the triangles in that
    /// space.
    pub(crate) fn map_place(&self) -> Option<(&Buffer, u64)> {
        let place = || (&self.header, self.header.size() - size_of::<GeometryRigid>() as u64);
        (!matches!(self.space, Space::World)).then(place)
    }

    /// Returns true if a structure with this status was built for these triangles, as far as the host knows
    /// their number.
    pub(crate) fn is_of(&self, status: u32) -> bool {
        let stamps = if self.count.is_some() { GEOMETRY_COUNT_STAMPS } else { 1 };
        (status & !STATUS_FLAGS).wrapping_sub(self.stamp) < stamps * STAMP_STEP
    }

    /// Returns true if triangles cannot be read before [`Geometry::record_gather`].
    pub(crate) fn is_gathered(&self) -> bool {
        self.count.is_some() || gathers(self.gather.as_ref(), self.whole.as_deref())
    }

    /// Returns the ranges that are read of the buffers handed in, in bytes: positions, indices, draws and
    /// count. No byte is in two ranges: ranges that overlap or touch are joined.
    pub fn ranges(&self, device: &Device) -> Vec<BufferRange<'_>> {
        self.desc.ranges(device)
    }

    /// Downloads the positions, metres relative to the frame origin, and the absolute indices, three per
    /// triangle, as shaders read them. Submits and waits.
    ///
    /// # Errors
    /// The device fails, or a buffer was not made for [`BufferUsage::TRANSFER_SRC`].
    pub fn download(&self, device: &Device) -> Result<(Vec<[f32; 3]>, Vec<u32>), GpuError> {
        device.submit(|recorder| self.record_gather(recorder))?;
        let count = 3 * self.download_count(device)? as usize;
        let (buffer, offset) = match &self.gather {
            Some(gather) => (&gather.indices, 0),
            None => (&self.desc.indices.buffer, self.desc.indices.offset),
        };
        let indices = device.download_as::<u32>(buffer, offset, count)?;
        let positions = &self.desc.positions;
        let position_bytes = size_of::<[f32; 3]>();
        let stride = positions.stride as usize;
        let bytes = match self.desc.vertex_count as usize {
            0 => Vec::new(),
            count => {
                let size = (count - 1) * stride + position_bytes;
                device.download(&positions.buffer, positions.offset, size as u64)?
            }
        };
        let positions = bytes.chunks(stride).map(|vertex| pod_read_unaligned(&vertex[..position_bytes]));
        Ok((positions.collect(), indices))
    }

    /// Downloads the number of triangles of the last build, which only the device knows if `count` was given.
    ///
    /// # Errors
    /// The device fails.
    pub fn download_count(&self, device: &Device) -> Result<u32, GpuError> {
        let place = offset_of!(GeometryHeader, triangle_count) as u64;
        Ok(device.download_as::<u32>(&self.header, place, 1)?[0])
    }

    /// Returns the header that shaders read: a [`GeometryHeader`]. A pass of the host that moves vertices
    /// writes `lower` and `upper` there, ordered with the builds that follow; [`Geometry::bounds`] does not
    /// change. Shaders trust all other words, so nothing else may write them.
    pub fn header(&self) -> &Buffer {
        &self.header
    }

    /// Returns true for a part of another geometry ([`Geometry::parts`]): its triangles are numbered from 0
    /// in its indices, and hits on them have the ids of the whole geometry.
    pub fn is_part(&self) -> bool {
        self.whole.is_some()
    }

    /// Returns the geometry of which this one is a part, else this geometry.
    pub fn whole(&self) -> &Self {
        self.whole.as_deref().unwrap_or(self)
    }

    /// Returns the description that the geometry was made from.
    pub fn desc(&self) -> &GeometryDesc {
        &self.desc
    }

    /// Returns the number and the bounds of the triangles, from which structures plan their sizes.
    pub fn extent(&self) -> GeometryExtent {
        GeometryExtent {
            triangle_count: self.triangle_count(),
            bounds: self.bounds(),
            around: self.whole().bounds(),
        }
    }

    /// Returns the number of triangles, or their maximum if the device counts them.
    pub fn triangle_count(&self) -> u32 {
        self.desc.triangle_count
    }

    /// Returns the lower and upper corner as stated by the host, metres relative to the frame origin.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        self.desc.bounds
    }

    /// Returns the layout of the geometry set.
    pub fn layout(&self) -> &SetLayout {
        &self.layout
    }

    /// Returns the geometry set.
    pub fn set(&self) -> &BindingSet {
        &self.set
    }
}
