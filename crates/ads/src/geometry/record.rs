//! What a geometry records: its passes over triangles, draws, and transfers of ownership.

use std::mem::offset_of;

use bytemuck::bytes_of;
use rasray_gpu::{Access, BindingSet, Buffer, ComputePipeline, Recorder};

use crate::geometry::gather::{Count, DRAW_ARGUMENT_BYTES, Gather};
use crate::geometry::gathers;
use crate::kit::groups::folded;
use crate::{Geometry, GeometryHeader, GeometryRigid};

/// Triangles per workgroup of `ads/geometry_check`, `ads/geometry_gather` and `ads/geometry_bounds`.
const TRIANGLES_PER_GROUP: u64 = 64;

/// Accesses of the readers of data that passes of a geometry write.
const READERS: Access = Access::COMPUTE
    .union(Access::VERTEX_READ)
    .union(Access::FRAGMENT_READ)
    .union(Access::INDIRECT_READ)
    .union(Access::TRANSFER_READ);

impl Geometry {
    /// Records the map that poses a part with a space of its own from here on; the caller records the
    /// barriers around this transfer write. Does nothing for any other geometry.
    pub fn record_map(&self, recorder: &mut Recorder<'_>, map: &GeometryRigid) {
        for (header, place) in [Some(self), self.rest()].into_iter().flatten().filter_map(Self::map_place) {
            recorder.update(header, place, bytes_of(map));
        }
    }

    /// Records the input that shaders do not read in place: the number of triangles if only the device knows
    /// it, and gathered indices, visible to all who read them. Records nothing if neither is needed.
    pub(crate) fn record_gather(&self, recorder: &mut Recorder<'_>) {
        self.record_count(recorder);
        let groups = self.groups();
        if let (Some(Gather { pipeline, set, constants, .. }), Some(groups)) = (&self.gather, groups) {
            recorder.barrier(READERS, Access::COMPUTE);
            self.record(recorder, pipeline, Some(set), bytes_of(constants), groups);
            recorder.barrier(Access::COMPUTE, READERS);
        }
        // If the device counts the triangles, the count pass writes the stamp.
        if self.count.is_none() && gathers(self.gather.as_ref(), self.whole.as_deref()) {
            recorder.barrier(READERS, Access::TRANSFER_WRITE);
            recorder.fill(&self.header, offset_of!(GeometryHeader, stamp) as u64, 4, self.stamp);
            recorder.barrier(Access::TRANSFER_WRITE, READERS);
        }
    }

    /// Records the number of triangles if only the device knows it. For a part, also records the gathering of
    /// the indices of the whole, from which the part's indices come. Both are visible to all who read them.
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

    /// Records one pass over all triangles that reads the indices at their source: `in_place`, or `gathered`
    /// for indices that a pass gathers, with their set and constants. Returns false if there are no
    /// triangles.
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

    /// Records [`Geometry::record_gather`], the count of triangles that violate the bounds, the number of
    /// vertices or the maximum, visible to all who read it, and the copy of the count to four bytes of
    /// `target`.
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

    /// Returns the workgroups of one thread per triangle; absent if there are no triangles.
    pub(crate) fn groups(&self) -> Option<[u32; 3]> {
        folded(u64::from(self.desc.triangle_count).div_ceil(TRIANGLES_PER_GROUP))
    }

    /// Records one dispatch that reads or writes the geometry.
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

    /// Draws all triangles onto `views` views, at most
    /// [`GEOMETRY_DRAW_VIEWS`](rasray_shaders_glsl::constants::ads::GEOMETRY_DRAW_VIEWS), within a rendering:
    /// three vertices per triangle and one instance per view.
    pub fn record_draw(&self, recorder: &mut Recorder<'_>, views: u32) {
        match &self.count {
            // An offset beyond the arguments is a mistake of the recording.
            Some(count) => {
                let place = u64::from(views.wrapping_sub(1)) * DRAW_ARGUMENT_BYTES;
                recorder.draw_indirect(&count.draw_arguments, place);
            }
            None => recorder.draw(3 * self.desc.triangle_count, views, 0),
        }
    }

    /// Takes the buffers handed in over from the queue family that wrote them, for the queue family of the
    /// device. It records the second half of a transfer of ownership, after a semaphore that the first half
    /// signals. If both families are equal, no transfer is needed and nothing is recorded. Data that the same
    /// family writes to a buffer later needs no other transfer.
    ///
    /// Not tested on a device with two queue families: tests check the recorded barriers alone.
    pub fn record_acquire(&self, recorder: &mut Recorder<'_>, from_family: u32) {
        let ranges = self.ranges(recorder.device());
        recorder.acquire(&ranges, from_family, READERS);
    }

    /// Hands the buffers over to a queue family that writes them next. It records the first half of a
    /// transfer of ownership; the other family records the second half, over [`Geometry::ranges`]. If both
    /// families are equal, no transfer is needed and nothing is recorded.
    ///
    /// Not tested on a device with two queue families, as [`Geometry::record_acquire`].
    pub fn record_release(&self, recorder: &mut Recorder<'_>, to_family: u32) {
        let ranges = self.ranges(recorder.device());
        recorder.release(&ranges, to_family, READERS);
    }
}
