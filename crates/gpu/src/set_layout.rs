//! Layouts of descriptor sets, and the parts of them that pipelines use.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use ash::vk;

use crate::binding::BindingSetInner;
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
    pub(crate) core: Arc<Core>,
    pub(crate) storage_buffers: u32,
    name: Arc<str>,
}

/// The parts of the layouts of a device, by their number of buffers. They live as long as the device: pipelines that are
/// kept without a handle to them are made of them.
#[derive(Default)]
pub(crate) struct SetLayouts(Mutex<BTreeMap<u32, Parts>>);

/// The parts of a layout that something was made of.
#[derive(Default)]
pub(crate) struct Parts {
    /// Of all bindings, and of those that pipelines use.
    pub(crate) layouts: BTreeMap<Mask, vk::DescriptorSetLayout>,
    /// Sets of the layout: each has a Vulkan set a part.
    pub(crate) sets: Vec<Weak<BindingSetInner>>,
}

impl std::fmt::Debug for SetLayout {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_tuple("SetLayout").field(&self.name).finish()
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
    pub(crate) fn lock(&self) -> MutexGuard<'_, BTreeMap<u32, Parts>> {
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

/// The bindings of a mask, in order.
pub(crate) fn bindings(mask: Mask) -> impl Iterator<Item = u32> {
    (0..MOST_BINDINGS).filter(move |binding| mask >> binding & 1 != 0)
}

/// The mask of the first `count` bindings.
pub(crate) fn all(count: u32) -> Mask {
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
}
