//! A geometry in parts: triangles that do not move, and groups of triangles that move together.

use std::mem::offset_of;
use std::ops::Range;

use bytemuck::bytes_of;
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferUsage, ComputePipeline, Device, GpuError, MemoryLocation,
    Recorder, SetLayout, Stage,
};
use rasray_shaders_glsl::constants::contract::PARTS_MOST;
use rasray_shaders_glsl::records::QueueMeetConstants;
use rasray_shaders_glsl::{ADS_QUEUE_MEET, ADS_QUEUE_NOTE};

use crate::geometry::gather::pipeline;
use crate::geometry::{Run, Space};
use crate::kit::kernels::record_first_round;
use crate::{
    AdsError, Domain, Geometry, GeometryDesc, GeometryHeader, PositionRange, QueueHeader, RayQueue, TraceMode,
};

/// A group of triangles that move together.
#[derive(Clone, Debug)]
pub struct MovingPart {
    /// Ids of the triangles, in any order. [`GeometryParts::moving`] returns them in ascending order, without
    /// empty ranges and with ranges that touch joined.
    pub ids: Vec<Range<u32>>,
    /// Lower and upper corner of all positions of the triangles, metres relative to the frame origin.
    pub bounds: [[f32; 3]; 2],
    /// The triangles in a space of their own, if an affine map takes them from there to their pose; each pose
    /// states the map ([`Geometry::record_map`]).
    pub rest: Option<Rest>,
}

/// Triangles of a part in a space of their own.
#[derive(Clone, Debug)]
pub struct Rest {
    /// As many positions as the whole geometry has; only the positions of the part's vertices are read.
    pub positions: PositionRange,
    /// Lower and upper corner of these positions, metres.
    pub bounds: [[f32; 3]; 2],
}

/// Parts of a geometry that share its buffers; each triangle is in exactly one part. One part is static; the
/// others, one or several, move. Hits on any part have the ids of the whole geometry.
#[derive(Clone, Debug)]
pub struct GeometryParts {
    moving: Vec<MovingPart>,
    /// Geometries of the parts, the static part first.
    parts: Vec<Geometry>,
    /// Copies of the headers of all parts, from which the bounds of the whole are computed.
    headers: Buffer,
    set: BindingSet,
    note: ComputePipeline,
    meet: ComputePipeline,
    /// Status of the structure over each part, as of its last trace.
    statuses: Buffer,
    statuses_set: BindingSet,
}

/// The rays of a queue that meet the bounds of a part.
#[derive(Clone, Copy, Debug)]
pub struct PartRays<'a> {
    parts: &'a GeometryParts,
    part: usize,
}

impl PartRays<'_> {
    /// Records that the queue lists the rays of `domain` that meet the part as paused, except rays that are
    /// finished in `mode`. If the structure with this header was not built, it lists all rays that have an
    /// answer. The next command must be the trace of the part.
    pub(crate) fn record(
        &self,
        recorder: &mut Recorder<'_>,
        header: &Buffer,
        queue: &RayQueue,
        domain: Domain,
        mode: TraceMode,
    ) {
        let GeometryParts { parts, meet, statuses, statuses_set, .. } = self.parts;
        let constants = QueueMeetConstants {
            domain: domain.word(),
            any_hit: (mode == TraceMode::Occluded).into(),
            part: self.part as u32,
        };
        recorder.begin_pass(Stage::Trace(mode), ADS_QUEUE_MEET.name);
        recorder.barrier(Access::COMPUTE | Access::TRANSFER_WRITE, Access::TRANSFER);
        recorder.copy(header, 0, statuses, 4 * self.part as u64, 4);
        record_first_round(recorder, queue);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
        recorder.bind_compute(meet);
        recorder.bind_sets(0, &[parts[self.part].set(), queue.set(), statuses_set]);
        recorder.push_constants(bytes_of(&constants));
        queue.record_dispatch(recorder, domain);
        recorder.end_pass();
    }
}

impl GeometryParts {
    pub(crate) fn layout(device: &Device) -> Result<SetLayout, GpuError> {
        device.create_set_layout("geometry parts", 1)
    }

    /// Returns all parts: the static part first, then the moving parts in the requested order.
    pub fn parts(&self) -> &[Geometry] {
        &self.parts
    }

    /// Returns the part of the triangles that do not move.
    pub fn static_part(&self) -> &Geometry {
        &self.parts[0]
    }

    /// Returns the triangles of each moving part.
    pub fn moving(&self) -> &[MovingPart] {
        &self.moving
    }

    /// Returns the geometry that the parts belong to.
    pub fn whole(&self) -> &Geometry {
        self.parts[0].whole()
    }

    /// Divides another geometry with the same number of triangles into the same parts, within the bounds that
    /// it states.
    ///
    /// # Errors
    /// As [`Geometry::in_parts`].
    pub(crate) fn of(&self, device: &Device, geometry: &Geometry) -> Result<Self, AdsError> {
        let bounds = geometry.bounds();
        let moving: Vec<MovingPart> =
            self.moving.iter().map(|part| MovingPart { bounds, rest: None, ..part.clone() }).collect();
        geometry.in_parts(device, &moving, bounds)
    }

    /// Records that the bounds of the whole geometry become the union of those of all parts, with the
    /// pipeline `unite`, and copies them to each part as the bounds in which rays may start.
    pub(crate) fn record_unite(&self, recorder: &mut Recorder<'_>, unite: &ComputePipeline) {
        let whole = self.whole();
        let header = size_of::<GeometryHeader>() as u64;
        recorder.barrier(Access::COMPUTE, Access::TRANSFER);
        for (place, part) in (0..).zip(&self.parts) {
            recorder.copy(part.header(), 0, &self.headers, place * header, header);
        }
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
        whole.record(recorder, unite, Some(&self.set), &[], [1; 3]);
        recorder.barrier(Access::COMPUTE, Access::TRANSFER);
        let [from, to] =
            [offset_of!(GeometryHeader, lower), offset_of!(GeometryHeader, around_lower)].map(|at| at as u64);
        for part in &self.parts {
            recorder.copy(whole.header(), from, part.header(), to, size_of::<[[f32; 3]; 2]>() as u64);
        }
        recorder.barrier(Access::TRANSFER_WRITE, Access::ALL);
    }

    /// Returns the rays that meet a part.
    pub(crate) fn rays_of(&self, part: usize) -> PartRays<'_> {
        PartRays { parts: self, part }
    }

    /// Records that a queue adds the faults found in part `part - 1` to those of the parts before it; `part`
    /// is at least 1.
    pub(crate) fn record_note(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, part: usize) {
        let [noted, before] = [offset_of!(QueueHeader, corrupted), offset_of!(QueueHeader, corrupted_before)]
            .map(|at| at as u64);
        if part == 1 {
            recorder.barrier(Access::COMPUTE | Access::TRANSFER_WRITE, Access::TRANSFER);
            recorder.copy(queue.header(), noted, queue.header(), before, 4);
            recorder.barrier(Access::TRANSFER, Access::COMPUTE | Access::TRANSFER);
        } else {
            recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
            recorder.bind_compute(&self.note);
            recorder.bind_sets(0, &[queue.set()]);
            recorder.dispatch([1; 3]);
            recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER);
        }
    }
}

impl Geometry {
    /// Divides the geometry into two parts: the triangles with ids in `moving`, in any order, and all other
    /// triangles. `static_bounds` contain all positions of the other triangles, `moving_bounds` those of the
    /// moving ones. Otherwise it does the same as [`Geometry::in_parts`].
    ///
    /// # Errors
    /// As [`Geometry::in_parts`].
    pub fn parts(
        &self,
        device: &Device,
        moving: &[Range<u32>],
        [static_bounds, moving_bounds]: [[[f32; 3]; 2]; 2],
    ) -> Result<GeometryParts, AdsError> {
        let moving = MovingPart { ids: moving.to_vec(), bounds: moving_bounds, rest: None };
        self.in_parts(device, &[moving], static_bounds)
    }

    /// Divides the geometry into one part for each of `moving`, which may have no triangle, and a static part
    /// with all other triangles, within `static_bounds`. A pass of the host or
    /// [`BoundsPass::record_parts`](crate::BoundsPass::record_parts) may write other bounds for the moving
    /// parts, as for any geometry.
    ///
    /// A part whose triangles follow one another reads the indices of the whole geometry. Any other part
    /// takes 12 bytes per triangle and 8 per run, and gathers its indices in each build.
    ///
    /// # Errors
    /// Ids beyond the triangles, or in two ranges; no moving part, or 65,536 or more; a number of triangles
    /// that only the device knows; a geometry that is a part itself; bounds that are not finite or that have
    /// lower and upper corner exchanged; out of memory.
    pub fn in_parts(
        &self,
        device: &Device,
        moving: &[MovingPart],
        static_bounds: [[f32; 3]; 2],
    ) -> Result<GeometryParts, AdsError> {
        let wrong = |reason: String| Err(AdsError::Geometry { reason });
        if self.is_part() {
            return wrong("a part of a geometry has no parts".to_owned());
        }
        if self.desc().count.is_some() {
            return wrong("triangles that only the device counts cannot be in parts".to_owned());
        }
        if moving.is_empty() || moving.len() >= PARTS_MOST as usize {
            return wrong(format!("{} parts are to move: 1 to {}", moving.len(), PARTS_MOST - 1));
        }
        let count = self.triangle_count();
        let mut all: Vec<(Range<u32>, usize)> = Vec::new();
        for (part, MovingPart { ids, .. }) in moving.iter().enumerate() {
            all.extend(ids.iter().filter(|ids| !ids.is_empty()).map(|ids| (ids.clone(), part)));
        }
        all.sort_by_key(|(ids, _)| ids.start);
        let mut joined = vec![Vec::<Range<u32>>::new(); moving.len() + 1];
        let mut end = 0;
        for (ids, part) in all {
            if ids.end > count {
                return wrong(format!("triangles {ids:?} are to move, of {count}"));
            }
            if ids.start < end {
                return wrong(format!("triangles {ids:?} are to move, which overlap others that do"));
            }
            append(&mut joined[0], end..ids.start);
            end = ids.end;
            append(&mut joined[part + 1], ids);
        }
        append(&mut joined[0], end..count);
        let stated = std::iter::once((static_bounds, None));
        let stated = stated.chain(moving.iter().map(|part| (part.bounds, part.rest.as_ref())));
        let part = |(ids, (bounds, rest)): (&Vec<Range<u32>>, (_, Option<&Rest>))| {
            let (mut runs, mut first) = (Vec::with_capacity(ids.len()), 0);
            for ids in ids {
                runs.push(Run { first, id: ids.start });
                first += ids.end - ids.start;
            }
            let runs = (&runs[..], first);
            let space = match rest.cloned() {
                None => Space::World,
                Some(Rest { positions, bounds }) => {
                    let desc = GeometryDesc { positions, bounds, ..self.desc().clone() };
                    let whole = Self::new(device, desc)?;
                    Space::Mapped(Box::new(Self::part_of(device, &whole, runs, bounds, Space::Own)?))
                }
            };
            Self::part_of(device, self, runs, bounds, space)
        };
        let parts = joined.iter().zip(stated).map(part).collect::<Result<Vec<_>, _>>()?;
        let headers = device.create_buffer(&BufferDesc {
            name: "geometry parts",
            size: (parts.len() * size_of::<GeometryHeader>()) as u64,
            usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_DST,
            location: MemoryLocation::Device,
        })?;
        let set =
            device.create_binding_set(&GeometryParts::layout(device)?, "geometry parts", &[&headers])?;
        let (queue, statuses_layout) =
            (RayQueue::layout(device)?, device.create_set_layout("part statuses", 1)?);
        let note = pipeline(device, &ADS_QUEUE_NOTE, &[&queue], 0)?;
        let sets = [self.layout(), &queue, &statuses_layout];
        let meet = pipeline(device, &ADS_QUEUE_MEET, &sets, size_of::<QueueMeetConstants>())?;
        let usage = BufferUsage::STORAGE | BufferUsage::TRANSFER_DST;
        let statuses = device.create_buffer_of_zeros("part statuses", usage, 4 * parts.len() as u64)?;
        let statuses_set = device.create_binding_set(&statuses_layout, "part statuses", &[&statuses])?;
        let moving = joined.drain(1..).zip(moving);
        let moving = moving.map(|(ids, part)| MovingPart { ids, ..part.clone() }).collect();
        Ok(GeometryParts { moving, parts, headers, set, note, meet, statuses, statuses_set })
    }
}

/// Appends a range of ids that is above all others, joined with the last range if both touch.
fn append(ranges: &mut Vec<Range<u32>>, ids: Range<u32>) {
    match ranges.last_mut() {
        _ if ids.is_empty() => {}
        Some(last) if last.end == ids.start => last.end = ids.end,
        _ => ranges.push(ids),
    }
}

#[cfg(test)]
mod tests {
    use super::append;

    #[test]
    fn ids_that_touch_are_one_range() {
        let mut ranges = Vec::new();
        for ids in [0..0, 1..2, 2..2, 2..5, 7..9] {
            append(&mut ranges, ids);
        }
        assert_eq!(ranges, [1..5, 7..9]);
    }
}
