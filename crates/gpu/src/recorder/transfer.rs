//! Commands that fill, update and copy buffers.

use ash::vk;

use super::Recorder;
use crate::buffer::{Buffer, BufferUsage};
use crate::error::GpuError;

impl Recorder<'_> {
    /// Fills a range of a buffer with a value. Offset and size are in bytes and multiples of 4.
    pub fn fill(&mut self, buffer: &Buffer, offset: u64, size: u64, value: u32) {
        if !self.outside_rendering("fill") || size == 0 {
            return;
        }
        let usage = buffer.check_use(&self.device.core, BufferUsage::TRANSFER_DST, "being filled");
        if let Err(error) = usage.and_then(|()| buffer.check_range(offset, size)) {
            return self.fail(error);
        }
        if !offset.is_multiple_of(4) || !size.is_multiple_of(4) {
            let reason =
                format!("{size} bytes at offset {offset} cannot be filled: both must be multiples of 4");
            return self.fail(GpuError::InvalidUse { name: buffer.name().to_owned(), reason });
        }
        self.keep(buffer.inner.clone());
        // SAFETY: the command buffer is being recorded, outside of rendering; range, alignment and usage were
        // checked.
        unsafe { self.raw_device().cmd_fill_buffer(self.command, buffer.raw(), offset, size, value) };
        self.count(|pass| pass.transfers += 1);
    }

    /// Writes bytes to a buffer. The bytes are stored in the command buffer, so each recording has its own;
    /// offset and length are multiples of 4, and the length is at most 65,536.
    pub fn update(&mut self, buffer: &Buffer, offset: u64, bytes: &[u8]) {
        const MOST: usize = 65_536;
        if !self.outside_rendering("update") || bytes.is_empty() {
            return;
        }
        let usage =
            buffer.check_use(&self.device.core, BufferUsage::TRANSFER_DST, "being written by commands");
        if let Err(error) = usage.and_then(|()| buffer.check_range(offset, bytes.len() as u64)) {
            return self.fail(error);
        }
        if bytes.len() > MOST || !bytes.len().is_multiple_of(4) || !offset.is_multiple_of(4) {
            let reason = format!(
                "{} bytes at offset {offset} cannot be written by commands: multiples of 4, and at most {MOST}",
                bytes.len()
            );
            return self.fail(GpuError::InvalidUse { name: buffer.name().to_owned(), reason });
        }
        self.keep(buffer.inner.clone());
        // SAFETY: the command buffer is being recorded, outside of rendering; range, alignment, length and
        // usage were checked.
        unsafe { self.raw_device().cmd_update_buffer(self.command, buffer.raw(), offset, bytes) };
        self.count(|pass| pass.transfers += 1);
    }

    /// Copies bytes between buffers, or within one buffer if the ranges do not overlap.
    pub fn copy(
        &mut self,
        source: &Buffer,
        source_offset: u64,
        target: &Buffer,
        target_offset: u64,
        size: u64,
    ) {
        if !self.outside_rendering("copy") || size == 0 {
            return;
        }
        let core = &self.device.core;
        let checked = source
            .check_use(core, BufferUsage::TRANSFER_SRC, "being copied from")
            .and_then(|()| target.check_use(core, BufferUsage::TRANSFER_DST, "being copied to"))
            .and_then(|()| source.check_range(source_offset, size))
            .and_then(|()| target.check_range(target_offset, size));
        if let Err(error) = checked {
            return self.fail(error);
        }
        let apart = source_offset.abs_diff(target_offset) >= size;
        if source.raw() == target.raw() && !apart {
            let reason = "source and target of a copy overlap".to_owned();
            return self.fail(GpuError::InvalidUse { name: source.name().to_owned(), reason });
        }
        self.keep(source.inner.clone());
        self.keep(target.inner.clone());
        let region = vk::BufferCopy::default().src_offset(source_offset).dst_offset(target_offset).size(size);
        // SAFETY: the command buffer is being recorded, outside of rendering; ranges, usages and overlap were
        // checked.
        unsafe { self.raw_device().cmd_copy_buffer(self.command, source.raw(), target.raw(), &[region]) };
        self.count(|pass| pass.transfers += 1);
    }
}
