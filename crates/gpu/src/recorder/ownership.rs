//! Transfers of buffers between queue families.

use ash::vk;

use super::Recorder;
use crate::access::Access;
use crate::binding::BufferRange;

impl Recorder<'_> {
    /// Takes ranges of buffers over from another queue family, for accesses `to` after it: the second half of a transfer
    /// of ownership. The first half, over the same ranges, is recorded for a queue of that family, and a semaphore
    /// orders the two. No byte is in two ranges. Nothing is recorded where the family is
    /// that of the device.
    pub fn acquire(&mut self, ranges: &[BufferRange<'_>], from_family: u32, to: Access) {
        let own = self.core().queue_family;
        let (stages, access) = to.scope(self.core().graphics);
        // All stages before: whichever the semaphore is waited for in.
        let half = vk::BufferMemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .dst_stage_mask(stages)
            .dst_access_mask(access);
        self.transfer(ranges, half.src_queue_family_index(from_family).dst_queue_family_index(own));
    }

    /// Hands ranges of buffers over to another queue family, after accesses `from` to them: the first half of a transfer
    /// of ownership. The second half, over the same ranges, is recorded for a queue of that family, and a semaphore
    /// orders the two. No byte is in two ranges. Nothing is recorded where the family is
    /// that of the device.
    pub fn release(&mut self, ranges: &[BufferRange<'_>], to_family: u32, from: Access) {
        let own = self.core().queue_family;
        let (stages, access) = from.scope(self.core().graphics);
        let half = vk::BufferMemoryBarrier2::default()
            .src_stage_mask(stages)
            .src_access_mask(access)
            .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS);
        self.transfer(ranges, half.src_queue_family_index(own).dst_queue_family_index(to_family));
    }

    fn transfer(&mut self, ranges: &[BufferRange<'_>], half: vk::BufferMemoryBarrier2<'_>) {
        if !self.outside_rendering("a transfer of ownership") {
            return;
        }
        for range in ranges {
            if let Err(error) = range.buffer.check_range(range.offset, range.size) {
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
        // SAFETY: recording, outside of rendering; the ranges lie within their buffers, the stages are known to the queue.
        // That the families exist and the other half is recorded is the caller's to see to (validation checks it).
        unsafe { (self.core().commands.pipeline_barrier)(self.command, &info) };
    }
}

/// A barrier for each range that is not empty; none within one family.
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

    use super::*;

    fn half(from: u32, to: u32) -> vk::BufferMemoryBarrier2<'static> {
        vk::BufferMemoryBarrier2::default()
            .src_queue_family_index(from)
            .dst_queue_family_index(to)
            .dst_access_mask(vk::AccessFlags2::SHADER_STORAGE_READ)
    }

    #[test]
    fn a_transfer_names_the_bytes_and_the_families() {
        let [first, second] = [1, 2].map(vk::Buffer::from_raw);
        let ranges = [(second, 64, 12), (first, 100, 50), (second, 0, 0)];
        let found = barriers(ranges.into_iter(), half(3, 1));
        let bytes: Vec<_> =
            found.iter().map(|barrier| (barrier.buffer, barrier.offset, barrier.size)).collect();
        assert_eq!(bytes, ranges[..2]);
        for barrier in found {
            assert_eq!((barrier.src_queue_family_index, barrier.dst_queue_family_index), (3, 1));
            assert_eq!(barrier.dst_access_mask, vk::AccessFlags2::SHADER_STORAGE_READ);
        }
    }

    #[test]
    fn within_one_family_nothing_is_transferred() {
        let range = (vk::Buffer::from_raw(1), 0, 40);
        assert!(barriers([range].into_iter(), half(2, 2)).is_empty());
        assert_eq!(barriers([range].into_iter(), half(2, 1)).len(), 1);
    }
}
