//! Descriptor sets of storage buffers.

use std::sync::Arc;

use ash::vk;

use crate::buffer::{Buffer, BufferUsage};
use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};

/// Layout of a set: storage buffers at bindings 0, 1, 2 …, seen by vertex, fragment and compute shaders.
/// Clones are handles to the same layout.
#[derive(Clone)]
pub struct SetLayout {
    pub(crate) inner: Arc<SetLayoutInner>,
}

pub(crate) struct SetLayoutInner {
    pub(crate) core: Arc<Core>,
    pub(crate) raw: vk::DescriptorSetLayout,
    pub(crate) name: String,
    pub(crate) storage_buffers: u32,
}

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
    /// One pool a set: sets are few, and each can be dropped by itself.
    pool: vk::DescriptorPool,
    pub(crate) raw: vk::DescriptorSet,
    pub(crate) layout: SetLayout,
    name: String,
    /// Dropped after the set.
    _buffers: Vec<Buffer>,
}

impl std::fmt::Debug for SetLayout {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_tuple("SetLayout").field(&self.inner.name).finish()
    }
}

impl std::fmt::Debug for BindingSet {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_tuple("BindingSet").field(&self.inner.name).finish()
    }
}

impl SetLayout {
    /// Number of storage buffers.
    pub fn storage_buffers(&self) -> u32 {
        self.inner.storage_buffers
    }

    /// The Vulkan layout.
    pub fn raw(&self) -> vk::DescriptorSetLayout {
        self.inner.raw
    }
}

impl BindingSet {
    /// Name for errors and tools.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// The Vulkan set.
    pub fn raw(&self) -> vk::DescriptorSet {
        self.inner.raw
    }
}

impl Device {
    /// A layout of `storage_buffers` storage buffers at bindings 0 and up.
    ///
    /// # Errors
    /// [`GpuError::LimitExceeded`] if a shader stage cannot reach that many, or what the driver reports.
    pub fn create_set_layout(&self, name: &str, storage_buffers: u32) -> Result<SetLayout> {
        let core = &self.core;
        let limit = core.limits.max_storage_buffers_per_stage;
        if storage_buffers > limit {
            return Err(GpuError::LimitExceeded {
                name: name.to_owned(),
                what: "the number of storage buffers",
                asked: storage_buffers.into(),
                limit: limit.into(),
            });
        }
        let mut stages = vk::ShaderStageFlags::COMPUTE;
        if core.graphics {
            stages |= vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT;
        }
        let bindings: Vec<_> = (0..storage_buffers)
            .map(|binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                    .descriptor_count(1)
                    .stage_flags(stages)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: distinct bindings of a type every device has, within its limit.
        let raw = unsafe { core.device.create_descriptor_set_layout(&info, None) }
            .during("vkCreateDescriptorSetLayout", name)?;
        core.name_object(raw, name);
        let inner = SetLayoutInner { core: core.clone(), raw, name: name.to_owned(), storage_buffers };
        Ok(SetLayout { inner: Arc::new(inner) })
    }

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
        let core = &self.core;
        self.check_ranges(layout, name, ranges)?;
        let count = layout.inner.storage_buffers;
        let sizes = [vk::DescriptorPoolSize::default()
            .ty(vk::DescriptorType::STORAGE_BUFFER)
            // A pool without descriptors is not allowed; a set without them is.
            .descriptor_count(count.max(1))];
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: one set of a known type.
        let pool = unsafe { core.device.create_descriptor_pool(&info, None) }
            .during("vkCreateDescriptorPool", name)?;
        let layouts = [layout.inner.raw];
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
        let infos: Vec<_> = ranges
            .iter()
            .map(|range| {
                [vk::DescriptorBufferInfo::default()
                    .buffer(range.buffer.raw())
                    .offset(range.offset)
                    .range(range.size)]
            })
            .collect();
        let writes: Vec<_> = (0..count)
            .zip(&infos)
            .map(|(binding, info)| {
                vk::WriteDescriptorSet::default()
                    .dst_set(raw)
                    .dst_binding(binding)
                    .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                    .buffer_info(info)
            })
            .collect();
        // SAFETY: the set is fresh, the buffers are storage buffers of this device, and the ranges were checked.
        unsafe { core.device.update_descriptor_sets(&writes, &[]) };
        let inner = BindingSetInner {
            pool,
            raw,
            layout: layout.clone(),
            name: name.to_owned(),
            _buffers: ranges.iter().map(|range| range.buffer.clone()).collect(),
        };
        Ok(BindingSet { inner: Arc::new(inner) })
    }

    fn check_ranges(&self, layout: &SetLayout, name: &str, ranges: &[BufferRange<'_>]) -> Result<()> {
        let invalid = |reason: String| GpuError::InvalidUse { name: name.to_owned(), reason };
        if !Arc::ptr_eq(&self.core, &layout.inner.core) {
            return Err(invalid("the layout belongs to another device".to_owned()));
        }
        let expected = layout.inner.storage_buffers;
        if ranges.len() != expected as usize {
            return Err(invalid(format!(
                "{} buffers are given, but the layout `{}` has {expected} bindings",
                ranges.len(),
                layout.inner.name
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

impl Drop for SetLayoutInner {
    fn drop(&mut self) {
        if self.core.is_usable() {
            // SAFETY: sets and pipelines of this layout hold handles to it, so none is left.
            unsafe { self.core.device.destroy_descriptor_set_layout(self.raw, None) };
        }
    }
}

impl Drop for BindingSetInner {
    fn drop(&mut self) {
        let core = &self.layout.inner.core;
        if core.is_usable() {
            // SAFETY: submissions that use the set hold a handle to it, so none is pending; embedders keep what
            // they record alive.
            unsafe { core.device.destroy_descriptor_pool(self.pool, None) };
        }
    }
}
