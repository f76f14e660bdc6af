//! Descriptor sets of storage buffers.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use ash::vk;

use crate::buffer::{Buffer, BufferUsage};
use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};

/// Bindings of one set at most: a bit of a [`Mask`] each.
const MOST_BINDINGS: u32 = u64::BITS;

/// Some of a set's bindings, one bit each.
pub(crate) type Mask = u64;

/// Layout of a set: storage buffers at bindings 0, 1, 2 …, seen by vertex, fragment and compute shaders.
/// Clones are handles to the same layout, and so are layouts of the same number of buffers of one device.
///
/// A pipeline is made with those bindings alone that its modules use, so that what a device lets a stage see is
/// compared with what a stage does see.
#[derive(Clone)]
pub struct SetLayout {
    core: Arc<Core>,
    storage_buffers: u32,
    name: Arc<str>,
}

/// The parts of the layouts of a device, by their number of buffers. They live as long as the device: pipelines that are
/// kept without a handle to them are made of them.
#[derive(Default)]
pub(crate) struct SetLayouts(Mutex<BTreeMap<u32, Parts>>);

/// The parts of a layout that something was made of.
#[derive(Default)]
struct Parts {
    /// Of all bindings, and of those that pipelines use.
    layouts: BTreeMap<Mask, vk::DescriptorSetLayout>,
    /// Sets of the layout: each has a Vulkan set a part.
    sets: Vec<Weak<BindingSetInner>>,
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

impl std::fmt::Debug for SetLayout {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_tuple("SetLayout").field(&self.name).finish()
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
        self.storage_buffers
    }

    /// The Vulkan layout of all bindings.
    pub fn raw(&self) -> vk::DescriptorSetLayout {
        self.core.set_layouts.lock()[&self.storage_buffers].layouts[&all(self.storage_buffers)]
    }

    /// Name for errors and tools.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Whether it is of this device.
    pub(crate) fn is_of(&self, core: &Arc<Core>) -> bool {
        Arc::ptr_eq(&self.core, core)
    }

    /// Whether sets of the one can be bound as sets of the other.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        self.is_of(&other.core) && self.storage_buffers == other.storage_buffers
    }

    /// The Vulkan layout of some bindings. Every set of this layout, of now and of later, has that part from here on.
    pub(crate) fn part(&self, mask: Mask) -> Result<vk::DescriptorSetLayout> {
        let mut layouts = self.core.set_layouts.lock();
        let parts = layouts.entry(self.storage_buffers).or_default();
        if let Some(layout) = parts.layouts.get(&mask) {
            return Ok(*layout);
        }
        let layout = create_layout(&self.core, &self.name, mask)?;
        let sets: Vec<_> = parts.sets.iter().filter_map(Weak::upgrade).collect();
        if let Err(error) = sets.iter().try_for_each(|set| set.add_part(mask, layout)) {
            // Sets that have the part keep it: those of the same bindings are alike.
            // SAFETY: a layout may go before the sets made with it, which are updated no more.
            unsafe { self.core.device.destroy_descriptor_set_layout(layout, None) };
            return Err(error);
        }
        parts.layouts.insert(mask, layout);
        Ok(layout)
    }
}

impl SetLayouts {
    fn lock(&self) -> MutexGuard<'_, BTreeMap<u32, Parts>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Destroys all.
    ///
    /// # Safety
    /// Nothing uses a layout any more: sets and pipelines are gone.
    pub(crate) unsafe fn clear(&self, device: &ash::Device) {
        for parts in std::mem::take(&mut *self.lock()).into_values() {
            for layout in parts.layouts.into_values() {
                // SAFETY: the caller vouches for it.
                unsafe { device.destroy_descriptor_set_layout(layout, None) };
            }
        }
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

    fn add_part(&self, mask: Mask, layout: vk::DescriptorSetLayout) -> Result<()> {
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

/// The bindings of a mask, in order.
fn bindings(mask: Mask) -> impl Iterator<Item = u32> {
    (0..MOST_BINDINGS).filter(move |binding| mask >> binding & 1 != 0)
}

/// The mask of the first `count` bindings.
fn all(count: u32) -> Mask {
    Mask::MAX.checked_shr(MOST_BINDINGS - count).unwrap_or(0)
}

fn create_layout(core: &Core, name: &str, mask: Mask) -> Result<vk::DescriptorSetLayout> {
    let mut stages = vk::ShaderStageFlags::COMPUTE;
    if core.graphics {
        stages |= vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT;
    }
    let bindings: Vec<_> = bindings(mask)
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
    Ok(raw)
}

impl Device {
    /// A layout of `storage_buffers` storage buffers at bindings 0 and up.
    ///
    /// # Errors
    /// [`GpuError::LimitExceeded`] if a shader stage cannot reach that many, or what the driver reports.
    pub fn create_set_layout(&self, name: &str, storage_buffers: u32) -> Result<SetLayout> {
        let core = &self.core;
        // A pipeline may use few bindings of each set, but some pipeline uses every binding.
        let limit = core.limits.max_storage_buffers_per_stage.min(MOST_BINDINGS);
        if storage_buffers > limit {
            return Err(GpuError::LimitExceeded {
                name: name.to_owned(),
                what: "the number of storage buffers",
                asked: storage_buffers.into(),
                limit: limit.into(),
            });
        }
        let layout = SetLayout { core: core.clone(), storage_buffers, name: name.into() };
        layout.part(all(storage_buffers))?;
        Ok(layout)
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
                layout.name
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
