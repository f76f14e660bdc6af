//! Descriptor sets of storage buffers.

use std::sync::Arc;

use ash::vk;

use crate::buffer::{Buffer, BufferUsage};
use crate::device::Device;
use crate::error::{GpuError, Result};
use crate::set_layout::{SetLayout, add_part};
use crate::set_parts::{Mask, SetParts, all};

/// A range of a buffer to be bound.
#[derive(Debug, Clone, Copy)]
pub struct BufferRange<'a> {
    /// Buffer that contains the range.
    pub buffer: &'a Buffer,
    /// Start in bytes, a multiple of [`crate::Limits::min_storage_buffer_offset_alignment`].
    pub offset: u64,
    /// Length in bytes, at least 1.
    pub size: u64,
}

/// Set of buffers that are bound together. It keeps the buffers alive. Clones are handles to the same set.
#[derive(Clone)]
pub struct BindingSet {
    pub(crate) inner: Arc<BindingSetInner>,
}

pub(crate) struct BindingSetInner {
    layout: SetLayout,
    parts: Arc<SetParts>,
    /// Buffers of the set, kept as long as the set exists.
    _buffers: Vec<Buffer>,
}

impl std::fmt::Debug for BindingSet {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_tuple("BindingSet").field(&self.inner.parts.name).finish()
    }
}

impl BindingSet {
    /// Returns the name for errors and tools.
    pub fn name(&self) -> &str {
        &self.inner.parts.name
    }

    /// Returns the Vulkan set of all bindings.
    pub fn raw(&self) -> vk::DescriptorSet {
        self.inner.part(all(self.inner.layout.storage_buffers))
    }
}

impl BindingSetInner {
    pub(crate) fn layout(&self) -> &SetLayout {
        &self.layout
    }

    /// Returns the Vulkan set of some bindings: those of a pipeline that was made with this layout.
    ///
    /// # Panics
    /// No part of the layout has these bindings.
    pub(crate) fn part(&self, mask: Mask) -> vk::DescriptorSet {
        self.parts.lock()[&mask].raw
    }
}

impl Device {
    /// Makes a set that binds whole buffers, in the order of the bindings.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] with the name of a buffer that is too large for a binding,
    /// [`GpuError::InvalidUse`] for a wrong number of buffers, a buffer not made for storage or a layout of
    /// another device, or an error that the driver reports.
    pub fn create_binding_set(
        &self,
        layout: &SetLayout,
        name: &str,
        buffers: &[&Buffer],
    ) -> Result<BindingSet> {
        let ranges: Vec<_> =
            buffers.iter().map(|buffer| BufferRange { buffer, offset: 0, size: buffer.size() }).collect();
        self.create_binding_set_of_ranges(layout, name, &ranges)
    }

    /// Makes a set that binds ranges of buffers, in the order of the bindings.
    ///
    /// # Errors
    /// As [`Device::create_binding_set`], and [`GpuError::OutOfRange`] for a range that does not lie within
    /// its buffer.
    pub fn create_binding_set_of_ranges(
        &self,
        layout: &SetLayout,
        name: &str,
        ranges: &[BufferRange<'_>],
    ) -> Result<BindingSet> {
        self.check_ranges(layout, name, ranges)?;
        let bound = |range: &BufferRange<'_>| {
            vk::DescriptorBufferInfo::default()
                .buffer(range.buffer.raw())
                .offset(range.offset)
                .range(range.size)
        };
        let inner = Arc::new(BindingSetInner {
            layout: layout.clone(),
            parts: Arc::new(SetParts::new(name, ranges.iter().map(bound).collect())),
            _buffers: ranges.iter().map(|range| range.buffer.clone()).collect(),
        });
        // The lock must be released before a set that failed is dropped, because dropping takes the lock
        // again.
        let mut layouts = self.core.set_layouts.lock();
        let of_layout = layouts.entry(layout.storage_buffers).or_default();
        let mut made = of_layout.layouts.iter();
        made.try_for_each(|(mask, layout)| add_part(&self.core, &inner.parts, *mask, *layout))?;
        of_layout.sets.push(inner.parts.clone());
        drop(layouts);
        Ok(BindingSet { inner })
    }

    fn check_ranges(&self, layout: &SetLayout, name: &str, ranges: &[BufferRange<'_>]) -> Result<()> {
        let invalid = |reason: String| GpuError::InvalidUse { name: name.to_owned(), reason };
        if !layout.is_of(&self.core) {
            return Err(invalid("the layout belongs to another device".to_owned()));
        }
        let expected = layout.storage_buffers;
        if ranges.len() != expected as usize {
            return Err(invalid(format!(
                "{} buffers are given, but the layout `{}` has {expected} bindings",
                ranges.len(),
                layout.name()
            )));
        }
        let limits = self.limits();
        for range in ranges {
            let buffer = range.buffer;
            buffer.check_use(&self.core, BufferUsage::STORAGE, "storage")?;
            buffer.check_range(range.offset, range.size)?;
            let alignment = limits.min_storage_buffer_offset_alignment;
            if range.size == 0 || range.offset % alignment != 0 {
                return Err(invalid(format!(
                    "{} bytes at offset {} of buffer `{}` cannot be bound: the range must not be empty and \
                     the offset must be a multiple of {alignment}",
                    range.size,
                    range.offset,
                    buffer.name()
                )));
            }
            if range.size > limits.max_storage_buffer_range {
                return Err(GpuError::TooLarge {
                    name: buffer.name().to_owned(),
                    size: range.size,
                    limit: limits.max_storage_buffer_range,
                });
            }
        }
        Ok(())
    }
}

impl Drop for BindingSetInner {
    fn drop(&mut self) {
        let core = &self.layout.core;
        if let Some(of_layout) = core.set_layouts.lock().get_mut(&self.layout.storage_buffers) {
            of_layout.sets.retain(|set| !Arc::ptr_eq(set, &self.parts));
        }
        let Some(device) = core.usable_device() else { return };
        for part in self.parts.lock().values() {
            // SAFETY: submissions that use the set hold a handle to it, so none is pending; embedders keep
            // the objects that they record alive. The set was taken out of the layout, so no part is added to
            // it any more.
            unsafe { device.destroy_descriptor_pool(part.pool, None) };
        }
    }
}
