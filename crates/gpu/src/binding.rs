//! Descriptor sets of storage buffers.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;

use crate::buffer::{Buffer, BufferUsage};
use crate::device::Device;
use crate::error::{During, GpuError, Result};
use crate::set_layout::{Mask, SetLayout, all, bindings};

/// A part of a buffer to be bound.
#[derive(Debug, Clone, Copy)]
pub struct BufferRange<'a> {
    /// The buffer.
    pub buffer: &'a Buffer,
    /// Start in bytes, a multiple of [`crate::Limits::min_storage_buffer_offset_alignment`].
    pub offset: u64,
    /// Length in bytes, at least 1.
    pub size: u64,
}

/// Buffers bound together. It keeps them alive. Clones are handles to the same set.
#[derive(Clone)]
pub struct BindingSet {
    pub(crate) inner: Arc<BindingSetInner>,
}

pub(crate) struct BindingSetInner {
    layout: SetLayout,
    name: String,
    buffers: Vec<BoundBuffer>,
    /// A set a part of the layout.
    parts: Mutex<BTreeMap<Mask, Part>>,
}

/// What is bound, as long as the set is there.
struct BoundBuffer {
    buffer: Buffer,
    offset: u64,
    size: u64,
}

#[derive(Clone, Copy)]
struct Part {
    /// One pool a set: sets are few, and each can be dropped by itself.
    pool: vk::DescriptorPool,
    raw: vk::DescriptorSet,
}

impl std::fmt::Debug for BindingSet {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_tuple("BindingSet").field(&self.inner.name).finish()
    }
}

impl BindingSet {
    /// Name for errors and tools.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// The Vulkan set of all bindings.
    pub fn raw(&self) -> vk::DescriptorSet {
        self.inner.part(all(self.inner.layout.storage_buffers))
    }
}

impl BindingSetInner {
    pub(crate) fn layout(&self) -> &SetLayout {
        &self.layout
    }

    fn parts(&self) -> MutexGuard<'_, BTreeMap<Mask, Part>> {
        self.parts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The Vulkan set of some bindings: those of a pipeline that was made with this layout.
    ///
    /// # Panics
    /// No part of the layout has them.
    pub(crate) fn part(&self, mask: Mask) -> vk::DescriptorSet {
        self.parts()[&mask].raw
    }

    pub(crate) fn add_part(&self, mask: Mask, layout: vk::DescriptorSetLayout) -> Result<()> {
        let mut parts = self.parts();
        if parts.contains_key(&mask) {
            return Ok(());
        }
        let (core, name) = (&self.layout.core, self.name.as_str());
        let sizes = [vk::DescriptorPoolSize::default()
            .ty(vk::DescriptorType::STORAGE_BUFFER)
            // A pool without descriptors is not allowed; a set without them is.
            .descriptor_count(mask.count_ones().max(1))];
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: one set of a known type.
        let pool = unsafe { core.device.create_descriptor_pool(&info, None) }
            .during("vkCreateDescriptorPool", name)?;
        let layouts = [layout];
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
        // SAFETY: the pool is fresh and holds what one set of this layout needs.
        let allocated =
            unsafe { core.device.allocate_descriptor_sets(&info) }.during("vkAllocateDescriptorSets", name);
        let raw = match allocated.as_deref() {
            Ok([raw, ..]) => *raw,
            other => {
                // SAFETY: nothing was allocated from the pool.
                unsafe { core.device.destroy_descriptor_pool(pool, None) };
                return Err(match other {
                    Err(error) => error.clone(),
                    Ok(_) => GpuError::InvalidUse {
                        name: name.to_owned(),
                        reason: "the driver returned no descriptor set".to_owned(),
                    },
                });
            }
        };
        core.name_object(raw, name);
        let infos: Vec<_> = bindings(mask)
            .zip(self.buffers.iter().enumerate().filter(|(binding, _)| mask >> binding & 1 != 0))
            .map(|(binding, (_, bound))| {
                let info = vk::DescriptorBufferInfo::default()
                    .buffer(bound.buffer.raw())
                    .offset(bound.offset)
                    .range(bound.size);
                (binding, [info])
            })
            .collect();
        let writes: Vec<_> = infos
            .iter()
            .map(|(binding, info)| {
                vk::WriteDescriptorSet::default()
                    .dst_set(raw)
                    .dst_binding(*binding)
                    .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                    .buffer_info(info)
            })
            .collect();
        // SAFETY: the set is fresh, the buffers are storage buffers of this device, and the ranges were checked.
        unsafe { core.device.update_descriptor_sets(&writes, &[]) };
        parts.insert(mask, Part { pool, raw });
        Ok(())
    }
}

impl Device {
    /// Binds whole buffers, in the order of the bindings.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] with the name of a buffer that is too large for a binding,
    /// [`GpuError::InvalidUse`] for a wrong number of buffers, a buffer not made for storage or a layout of
    /// another device, or what the driver reports.
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

    /// Binds parts of buffers, in the order of the bindings.
    ///
    /// # Errors
    /// As [`Device::create_binding_set`], and [`GpuError::OutOfRange`] for a part beyond its buffer.
    pub fn create_binding_set_of_ranges(
        &self,
        layout: &SetLayout,
        name: &str,
        ranges: &[BufferRange<'_>],
    ) -> Result<BindingSet> {
        self.check_ranges(layout, name, ranges)?;
        let bound = |range: &BufferRange<'_>| BoundBuffer {
            buffer: range.buffer.clone(),
            offset: range.offset,
            size: range.size,
        };
        let inner = Arc::new(BindingSetInner {
            layout: layout.clone(),
            name: name.to_owned(),
            buffers: ranges.iter().map(bound).collect(),
            parts: Mutex::default(),
        });
        let mut layouts = self.core.set_layouts.lock();
        let parts = layouts.entry(layout.storage_buffers).or_default();
        let made = parts.layouts.iter().try_for_each(|(mask, layout)| inner.add_part(*mask, *layout));
        made?;
        parts.sets.retain(|set| set.strong_count() > 0);
        parts.sets.push(Arc::downgrade(&inner));
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
            if !Arc::ptr_eq(&self.core, &buffer.inner.core) {
                return Err(invalid(format!("buffer `{}` belongs to another device", buffer.name())));
            }
            buffer.check_usage(BufferUsage::STORAGE, "storage")?;
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
        if !core.is_usable() {
            return;
        }
        let parts = self.parts.get_mut().unwrap_or_else(PoisonError::into_inner);
        for part in parts.values() {
            // SAFETY: submissions that use the set hold a handle to it, so none is pending; embedders keep what
            // they record alive.
            unsafe { core.device.destroy_descriptor_pool(part.pool, None) };
        }
    }
}
