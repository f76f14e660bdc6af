//! Posed triangles, the one input of every structure.

use std::mem::offset_of;
use std::sync::atomic::{AtomicU32, Ordering};

use bytemuck::{Pod, Zeroable, bytes_of, cast_slice, pod_read_unaligned};
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferRange, BufferUsage, ComputePipeline, Device, GpuError,
    MemoryLocation, Recorder, SetLayout,
};

use rasray_shaders_glsl::constants::ads::{
    GEOMETRY_COUNT_STAMPS, GEOMETRY_HEADER_BYTES, GEOMETRY_RIGID_BYTES, GEOMETRY_RUN_BYTES,
};
use rasray_shaders_glsl::constants::contract::STATUS_FLAGS;

use crate::geometry_gather::{Count, DRAW_ARGUMENT_BYTES, Gather, TRIANGLE_INDEX_BYTES, pipeline, whole};
use crate::groups::folded;
use crate::{AdsError, GeometryDesc, GeometryExtent, GeometryHeader, GeometryRigid, IndexRange};

/// Buffers of the geometry set.
pub(crate) const BINDINGS: u32 = 4;

/// Triangles of a workgroup of `ads/geometry_check`, `ads/geometry_gather` and `ads/geometry_bounds`.
const TRIANGLES_PER_GROUP: u64 = 64;

/// Readers of what the passes here write.
const READERS: Access = Access::COMPUTE
    .union(Access::VERTEX_READ)
    .union(Access::FRAGMENT_READ)
    .union(Access::INDIRECT_READ)
    .union(Access::TRANSFER_READ);

/// Triangles on the device that structures build from, at their positions of one moment, with the binding set
/// that shaders read them through. [`Geometry::new`] makes it from buffers of a host, which it reads in place
/// where their layout allows.
///
/// Clones are cheap handles to the same buffers.
#[derive(Clone, Debug)]
pub struct Geometry {
    desc: GeometryDesc,
    header: Buffer,
    check: ComputePipeline,
    layout: SetLayout,
    set: BindingSet,
    /// Number in the status of a structure built for these triangles; the first of several where only the
    /// device knows their number.
    stamp: u32,
    /// Count buffer of a geometry whose number of triangles only the device knows.
    count: Option<Count>,
    /// Copy of indices that are not read in place.
    gather: Option<Gather>,
    /// Geometry that this is a part of.
    whole: Option<Box<Self>>,
    space: Space,
}

/// Space of the triangles of a geometry.
#[derive(Clone, Debug)]
pub(crate) enum Space {
    /// The world: they are as posed.
    World,
    /// A space of their own, to which a map takes them.
    Own,
    /// The world, and the same triangles in a space of their own.
    Mapped(Box<Geometry>),
}

/// From one stamp to the next: flags of a status lie below.
const STAMP_STEP: u32 = STATUS_FLAGS + 1;

/// Stamps that no geometry of this process has yet, in steps; 0 is none.
static NEXT_STAMP: AtomicU32 = AtomicU32::new(1);

/// Range of that many stamps if `next` is the next one that is free: all in one word. Begins anew after 2^28.
fn stamps_from(next: u32, count: u32) -> u32 {
    if next > u32::MAX / STAMP_STEP - count { 1 } else { next }
}

/// The first of that many stamps in a row which no other geometry has.
fn new_stamps(count: u32) -> u32 {
    let after = |next| Some(stamps_from(next, count) + count);
    let next =
        NEXT_STAMP.fetch_update(Ordering::Relaxed, Ordering::Relaxed, after).unwrap_or_else(|next| next);
    stamps_from(next, count) * STAMP_STEP
}

/// No map to the space that a part was built in: its rays are tested against all of its triangles.
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

/// Place in a header of the map of a part that has room for so many runs.
fn rigid_place(bound_runs: usize) -> usize {
    const { assert!(size_of::<GeometryHeader>() == GEOMETRY_HEADER_BYTES as usize) };
    const { assert!(size_of::<Run>() == GEOMETRY_RUN_BYTES as usize) };
    const { assert!(size_of::<GeometryRigid>() == GEOMETRY_RIGID_BYTES as usize) };
    (size_of::<GeometryHeader>() + bound_runs * size_of::<Run>()).next_multiple_of(size_of::<GeometryRigid>())
}

/// True if shaders read indices that a pass gathers, those of the whole included.
fn gathers(gather: Option<&Gather>, whole: Option<&Geometry>) -> bool {
    gather.is_some() || whole.is_some_and(|whole| whole.gather.is_some())
}

/// Consecutive triangles of a part.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Run {
    /// Index of the first triangle, in the part.
    pub first: u32,
    /// Index of the first triangle, in the whole.
    pub id: u32,
}

impl Geometry {
    /// Makes the header buffer ([`GeometryHeader`], 112 bytes, and 8 for each run of a part, at least one; 72
    /// for a part with a space of its own), where they are needed one for gathered indices (12 bytes per
    /// triangle) and one for draws (96 bytes), and the binding set.
    ///
    /// # Errors
    /// Ranges beyond their buffers, offsets or a stride that are not aligned, bounds that are not finite or
    /// the wrong way round; out of memory, or a range exceeds what one binding can hold.
    pub fn new(device: &Device, desc: GeometryDesc) -> Result<Self, AdsError> {
        Self::made(device, desc, None, Space::World)
    }

    /// The triangles of `runs` of `whole`, which reads absolute indices: in place where they are one run,
    /// else gathered.
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
        // A structure of triangles in a space of their own is traced with these.
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
                // Until the device has counted there is none.
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

    /// The triangles in a space of their own, where they do not move: a structure of these is traced with the
    /// part.
    pub(crate) fn rest(&self) -> Option<&Self> {
        match &self.space {
            Space::Mapped(rest) => Some(rest),
            Space::World | Space::Own => None,
        }
    }

    /// Records where a part with a space of its own is posed from here on; the caller sees to barriers around
    /// this write of a transfer. Nothing for any other geometry.
    pub fn record_map(&self, recorder: &mut Recorder<'_>, map: &GeometryRigid) {
        for (header, place) in [Some(self), self.rest()].into_iter().flatten().filter_map(Self::map_place) {
            recorder.update(header, place, bytes_of(map));
        }
    }

    /// Place of the map of a part with a space of its own, also among the triangles there.
    pub(crate) fn map_place(&self) -> Option<(&Buffer, u64)> {
        let place = || (&self.header, self.header.size() - size_of::<GeometryRigid>() as u64);
        (!matches!(self.space, Space::World)).then(place)
    }

    /// Records what shaders do not read in place: the number of triangles where only the device knows it, and
    /// indices that are gathered, visible to all who read them. Nothing where neither is needed.
    pub(crate) fn record_gather(&self, recorder: &mut Recorder<'_>) {
        self.record_count(recorder);
        let groups = self.groups();
        if let (Some(Gather { pipeline, set, constants, .. }), Some(groups)) = (&self.gather, groups) {
            recorder.barrier(READERS, Access::COMPUTE);
            self.record(recorder, pipeline, Some(set), bytes_of(constants), groups);
            recorder.barrier(Access::COMPUTE, READERS);
        }
        // Where the device counts, that gives a stamp.
        if self.count.is_none() && gathers(self.gather.as_ref(), self.whole.as_deref()) {
            recorder.barrier(READERS, Access::TRANSFER_WRITE);
            recorder.fill(&self.header, offset_of!(GeometryHeader, stamp) as u64, 4, self.stamp);
            recorder.barrier(Access::TRANSFER_WRITE, READERS);
        }
    }

    /// True if a structure with this status was built for these triangles, as far as the host knows their
    /// number.
    pub(crate) fn is_of(&self, status: u32) -> bool {
        let stamps = if self.count.is_some() { GEOMETRY_COUNT_STAMPS } else { 1 };
        (status & !STATUS_FLAGS).wrapping_sub(self.stamp) < stamps * STAMP_STEP
    }

    /// True if triangles cannot be read before [`Geometry::record_gather`].
    pub(crate) fn is_gathered(&self) -> bool {
        self.count.is_some() || gathers(self.gather.as_ref(), self.whole.as_deref())
    }

    /// Records the number of triangles where only the device knows it, and for a part the indices of the
    /// whole, from which those of the part come, visible to all who read them.
    pub(crate) fn record_count(&self, recorder: &mut Recorder<'_>) {
        if let Some(whole) = &self.whole {
            whole.record_gather(recorder);
        }
        if let Some(Count { pipeline, set, constants, .. }) = &self.count {
            recorder.barrier(READERS, Access::COMPUTE);
            self.record(recorder, pipeline, Some(set), bytes_of(constants), [1; 3]);
            recorder.barrier(Access::COMPUTE, READERS);
        }
    }

    /// Records one pass over all triangles that reads indices where the host has them: `in_place`, or for
    /// those that are gathered the other one, which sees their set and constants. False without triangles.
    pub(crate) fn record_measure(
        &self,
        recorder: &mut Recorder<'_>,
        in_place: &ComputePipeline,
        gathered: &ComputePipeline,
    ) -> bool {
        let Some(groups) = self.groups() else { return false };
        match &self.gather {
            None => self.record(recorder, in_place, None, &[], groups),
            Some(Gather { set, constants, .. }) => {
                self.record(recorder, gathered, Some(set), bytes_of(constants), groups);
            }
        }
        true
    }

    /// Records [`Geometry::record_gather`], the count of triangles that the bounds, the vertices and the
    /// maximum do not allow for, visible to all who read it, and its copy to four bytes of `target`.
    pub(crate) fn record_check(&self, recorder: &mut Recorder<'_>, target: &Buffer, offset: u64) {
        let count = offset_of!(GeometryHeader, outside) as u64;
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, count, 4, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
        self.record_gather(recorder);
        if let Some(groups) = self.groups() {
            self.record(recorder, &self.check, None, &[], groups);
        }
        recorder.barrier(Access::COMPUTE, READERS);
        recorder.copy(&self.header, count, target, offset, 4);
    }

    /// Workgroups of one thread per triangle; none without triangles.
    pub(crate) fn groups(&self) -> Option<[u32; 3]> {
        folded(u64::from(self.desc.triangle_count).div_ceil(TRIANGLES_PER_GROUP))
    }

    /// One dispatch that reads or writes the geometry.
    pub(crate) fn record(
        &self,
        recorder: &mut Recorder<'_>,
        pipeline: &ComputePipeline,
        more: Option<&BindingSet>,
        constants: &[u8],
        groups: [u32; 3],
    ) {
        recorder.bind_compute(pipeline);
        recorder.bind_sets(0, &[&self.set]);
        if let Some(more) = more {
            recorder.bind_sets(1, &[more]);
        }
        if !constants.is_empty() {
            recorder.push_constants(constants);
        }
        recorder.dispatch(groups);
    }

    /// Draws all triangles onto that many views, at most
    /// [`GEOMETRY_DRAW_VIEWS`](rasray_shaders_glsl::constants::ads::GEOMETRY_DRAW_VIEWS), within a rendering:
    /// three vertices per triangle and one instance per view.
    pub fn record_draw(&self, recorder: &mut Recorder<'_>, views: u32) {
        match &self.count {
            // A place beyond the arguments is a mistake of the recording.
            Some(count) => {
                let place = u64::from(views.wrapping_sub(1)) * DRAW_ARGUMENT_BYTES;
                recorder.draw_indirect(&count.draw_arguments, place);
            }
            None => recorder.draw(3 * self.desc.triangle_count, views, 0),
        }
    }

    /// Takes the buffers handed in over from the queue family that wrote them, for the one of the device: the
    /// second half of a transfer of ownership, after a semaphore that the first half signals. Families that
    /// are equal need none, and nothing is recorded. What is written of a buffer by the same family later
    /// needs no other transfer.
    ///
    /// Not tested on a device with two queue families: tests check the recorded barriers alone.
    pub fn record_acquire(&self, recorder: &mut Recorder<'_>, from_family: u32) {
        let ranges = self.ranges(recorder.device());
        recorder.acquire(&ranges, from_family, READERS);
    }

    /// Hands the buffers over to a queue family that writes them next: the first half of a transfer of
    /// ownership. The other family records the second one, over [`Geometry::ranges`]. Families that are equal
    /// need none, and nothing is recorded.
    ///
    /// Not tested on a device with two queue families, as [`Geometry::record_acquire`].
    pub fn record_release(&self, recorder: &mut Recorder<'_>, to_family: u32) {
        let ranges = self.ranges(recorder.device());
        recorder.release(&ranges, to_family, READERS);
    }

    /// Ranges read of the buffers handed in, in bytes: positions, indices, draws and count. No byte is in two
    /// ranges: those that overlap or touch are joined.
    pub fn ranges(&self, device: &Device) -> Vec<BufferRange<'_>> {
        self.desc.ranges(device)
    }

    /// Positions, metres relative to the frame origin, and absolute indices, three a triangle, as shaders
    /// read them. Submits and waits.
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

    /// Number of triangles of the last build, which where `count` was given only the device knows.
    ///
    /// # Errors
    /// The device fails.
    pub fn download_count(&self, device: &Device) -> Result<u32, GpuError> {
        let place = offset_of!(GeometryHeader, triangle_count) as u64;
        Ok(device.download_as::<u32>(&self.header, place, 1)?[0])
    }

    /// The header that shaders read: a [`GeometryHeader`]. A pass of the host that moves vertices writes
    /// `lower` and `upper` there, in order with the builds that follow; [`Geometry::bounds`] stays what was
    /// stated.
    pub fn header(&self) -> &Buffer {
        &self.header
    }

    /// True for a part of another geometry ([`Geometry::parts`]): its triangles are numbered from 0 in its
    /// indices, hits on them have the ids of the whole.
    pub fn is_part(&self) -> bool {
        self.whole.is_some()
    }

    /// The geometry that it is a part of, else itself.
    pub fn whole(&self) -> &Self {
        self.whole.as_deref().unwrap_or(self)
    }

    /// Description that it was made from.
    pub fn desc(&self) -> &GeometryDesc {
        &self.desc
    }

    /// Number and bounds of the triangles, which plans of structures are made for.
    pub fn extent(&self) -> GeometryExtent {
        GeometryExtent {
            triangle_count: self.triangle_count(),
            bounds: self.bounds(),
            around: self.whole().bounds(),
        }
    }

    /// Number of triangles, or their maximum where the device counts them.
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
