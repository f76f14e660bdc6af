//! Transfers of buffers between queue families.

use ash::vk;

use super::Recorder;
use crate::access::Access;
use crate::binding::BufferRange;
use crate::buffer::BufferUsage;

impl Recorder<'_> {
    /// Takes ranges of buffers over from another queue family, for accesses `to` after it. It records the
    /// second half of a transfer of ownership. The first half, over the same ranges, is recorded for a queue
    /// of the other family, and a semaphore orders the two halves. No byte may be in two ranges. If the other
    /// family is that of the device, nothing is recorded.
    pub fn acquire(&mut self, ranges: &[BufferRange<'_>], from_family: u32, to: Access) {
        let half = acquiring(from_family, self.core().queue_family, to, self.core().graphics);
        self.transfer(ranges, half);
    }

    /// Hands ranges of buffers over to another queue family, after accesses `from` to them. It records the
    /// first half of a transfer of ownership. The second half, over the same ranges, is recorded for a queue
    /// of the other family, and a semaphore orders the two halves. No byte may be in two ranges. If the other
    /// family is that of the device, nothing is recorded.
    pub fn release(&mut self, ranges: &[BufferRange<'_>], to_family: u32, from: Access) {
        let half = releasing(self.core().queue_family, to_family, from, self.core().graphics);
        self.transfer(ranges, half);
    }

    fn transfer(&mut self, ranges: &[BufferRange<'_>], half: vk::BufferMemoryBarrier2<'_>) {
        if !self.outside_rendering("a transfer of ownership") {
            return;
        }
        for range in ranges {
            let checked = range
                .buffer
                .check_use(&self.device.core, BufferUsage::default(), "transfers")
                .and_then(|()| range.buffer.check_range(range.offset, range.size));
            if let Err(error) = checked {
                return self.fail(error);
            }
            self.keep(range.buffer.inner.clone());
        }
        let ranges = ranges.iter().map(|range| (range.buffer.raw(), range.offset, range.size));
        let barriers = barriers(ranges, half);
        if barriers.is_empty() {
            return;
        }
        let info = vk::DependencyInfo::default().buffer_memory_barriers(&barriers);
        // SAFETY: the command buffer is being recorded, outside of rendering; the ranges lie within their
        // buffers, and the queue supports the stages. The caller ensures that the families exist and that the
        // other half is recorded (the validation layer checks it).
        unsafe { (self.core().commands.pipeline_barrier)(self.command, &info) };
    }
}

/// Returns the barrier with which a queue of family `own` takes a range over from another family. The other
/// half states the accesses before it.
fn acquiring(from: u32, own: u32, to: Access, graphics: bool) -> vk::BufferMemoryBarrier2<'static> {
    let (stages, access) = scope_of_queue(to, graphics);
    // The barrier waits for all stages, because the semaphore may be waited for in any of them.
    vk::BufferMemoryBarrier2::default()
        .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .dst_stage_mask(stages)
        .dst_access_mask(access)
        .src_queue_family_index(from)
        .dst_queue_family_index(own)
}

/// Returns the barrier with which a queue of family `own` hands a range over to another family. The other
/// half states the accesses after it.
fn releasing(own: u32, to: u32, from: Access, graphics: bool) -> vk::BufferMemoryBarrier2<'static> {
    let (stages, access) = scope_of_queue(from, graphics);
    vk::BufferMemoryBarrier2::default()
        .src_stage_mask(stages)
        .src_access_mask(access)
        .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .src_queue_family_index(own)
        .dst_queue_family_index(to)
}

/// Returns the stages and accesses without those of the host, which a transfer between families must not
/// contain.
fn scope_of_queue(access: Access, graphics: bool) -> (vk::PipelineStageFlags2, vk::AccessFlags2) {
    let (stages, flags) = access.scope(graphics);
    let of_host = vk::AccessFlags2::HOST_READ | vk::AccessFlags2::HOST_WRITE;
    (stages & !vk::PipelineStageFlags2::HOST, flags & !of_host)
}

/// Returns a barrier for each range that is not empty; none within one family.
fn barriers<'a>(
    ranges: impl Iterator<Item = (vk::Buffer, u64, u64)>,
    half: vk::BufferMemoryBarrier2<'a>,
) -> Vec<vk::BufferMemoryBarrier2<'a>> {
    let moves = half.src_queue_family_index != half.dst_queue_family_index;
    ranges
        .filter(|(.., size)| moves && *size > 0)
        .map(|(buffer, offset, size)| half.buffer(buffer).offset(offset).size(size))
        .collect()
}

#[cfg(test)]
mod tests {
    use ash::vk::Handle;
    use vk::{AccessFlags2 as Flags, PipelineStageFlags2 as Stages};

    use super::*;

    const READ: Access = Access::COMPUTE_READ.union(Access::VERTEX_READ).union(Access::TRANSFER_READ);

    /// Returns the barriers of both halves of a transfer from family 3 to family 1; the queue of the first
    /// half can draw.
    fn halves(ranges: &[(vk::Buffer, u64, u64)]) -> [Vec<vk::BufferMemoryBarrier2<'static>>; 2] {
        [releasing(3, 1, Access::COMPUTE_WRITE, true), acquiring(3, 1, READ, false)]
            .map(|half| barriers(ranges.iter().copied(), half))
    }

    fn ranges() -> [(vk::Buffer, u64, u64); 3] {
        let [first, second] = [1, 2].map(vk::Buffer::from_raw);
        [(second, 64, 12), (first, 100, 50), (second, 0, 0)]
    }

    /// Both halves of a transfer must name the same bytes and the same families, or Vulkan performs no
    /// transfer.
    #[test]
    fn halves_of_a_transfer_match() {
        let [released, acquired] = halves(&ranges());
        assert_eq!((released.len(), acquired.len()), (2, 2));
        for ((out, back), range) in released.iter().zip(&acquired).zip(ranges()) {
            for barrier in [out, back] {
                assert_eq!((barrier.buffer, barrier.offset, barrier.size), range);
                assert_eq!((barrier.src_queue_family_index, barrier.dst_queue_family_index), (3, 1));
            }
        }
    }

    /// The first half makes writes available and nothing visible; the second half does the opposite. All
    /// stages of both halves are ordered with the semaphore between them.
    #[test]
    fn each_half_has_the_accesses_of_its_side() {
        let [released, acquired] = halves(&ranges());
        for barrier in released {
            assert_eq!(barrier.src_stage_mask, Stages::COMPUTE_SHADER);
            assert_eq!(barrier.src_access_mask, Flags::SHADER_STORAGE_READ | Flags::SHADER_STORAGE_WRITE);
            assert_eq!(
                (barrier.dst_stage_mask, barrier.dst_access_mask),
                (Stages::ALL_COMMANDS, Flags::NONE)
            );
        }
        for barrier in acquired {
            assert_eq!(
                (barrier.src_stage_mask, barrier.src_access_mask),
                (Stages::ALL_COMMANDS, Flags::NONE)
            );
            // The queue of the second half does not draw.
            assert_eq!(barrier.dst_stage_mask, Stages::COMPUTE_SHADER | Stages::ALL_TRANSFER);
            assert_eq!(barrier.dst_access_mask, Flags::SHADER_STORAGE_READ | Flags::TRANSFER_READ);
        }
        let drawn = acquiring(3, 1, READ, true);
        assert!(drawn.dst_stage_mask.contains(Stages::VERTEX_SHADER));
    }

    /// VUID-VkBufferMemoryBarrier2-srcStageMask-03851: a transfer must not contain host accesses.
    #[test]
    fn the_host_takes_no_part() {
        for access in [Access::ALL, READ | Access::HOST_READ | Access::HOST_WRITE] {
            let (out, back) = (releasing(0, 1, access, true), acquiring(0, 1, access, true));
            for (stages, flags) in
                [(out.src_stage_mask, out.src_access_mask), (back.dst_stage_mask, back.dst_access_mask)]
            {
                assert!(!stages.contains(Stages::HOST) && !stages.is_empty() && !flags.is_empty());
                assert!(!flags.intersects(Flags::HOST_READ | Flags::HOST_WRITE));
            }
        }
    }

    #[test]
    fn within_one_family_nothing_is_transferred() {
        let range = (vk::Buffer::from_raw(1), 0, 40);
        assert!(barriers([range].into_iter(), acquiring(2, 2, READ, true)).is_empty());
        assert!(barriers([range].into_iter(), releasing(2, 2, READ, true)).is_empty());
        assert_eq!(barriers([range].into_iter(), acquiring(2, 1, READ, true)).len(), 1);
    }
}
