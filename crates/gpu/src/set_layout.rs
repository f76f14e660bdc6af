//! Layouts of descriptor sets, and the parts of them that pipelines use.

use std::sync::Arc;

use ash::vk;

use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};
use crate::set_parts::{MOST_BINDINGS, Mask, SetPart, SetParts, all, bindings};

/// Layout of a set: storage buffers at bindings 0, 1, 2 …, seen by vertex, fragment and compute shaders.
/// Clones are handles to the same layout, and so are layouts of the same number of buffers of one device.
///
/// A pipeline is made with those bindings alone that its modules use, so that what a device lets a stage see
/// is compared with what a stage does see.
#[derive(Clone)]
pub struct SetLayout {
    pub(crate) core: Arc<Core>,
    pub(crate) storage_buffers: u32,
    name: Arc<str>,
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

    /// True if it is of this device.
    pub(crate) fn is_of(&self, core: &Arc<Core>) -> bool {
        Arc::ptr_eq(&self.core, core)
    }

    /// True if sets of the one can be bound as sets of the other.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        self.is_of(&other.core) && self.storage_buffers == other.storage_buffers
    }

    /// The Vulkan layout of some bindings. Every set of this layout, of now and of later, has that part from
    /// here on.
    pub(crate) fn part(&self, mask: Mask) -> Result<vk::DescriptorSetLayout> {
        let mut layouts = self.core.set_layouts.lock();
        let parts = layouts.entry(self.storage_buffers).or_default();
        if let Some(layout) = parts.layouts.get(&mask) {
            return Ok(*layout);
        }
        let layout = create_layout(&self.core, &self.name, mask)?;
        let mut sets = parts.sets.iter();
        if let Err(error) = sets.try_for_each(|set| add_part(&self.core, set, mask, layout)) {
            // Sets that have the part keep it: those of the same bindings are alike.
            // SAFETY: a layout may go before the sets made with it, which are updated no more.
            unsafe { self.core.device.destroy_descriptor_set_layout(layout, None) };
            return Err(error);
        }
        parts.layouts.insert(mask, layout);
        Ok(layout)
    }
}

/// Makes the Vulkan set of a part, unless the set has it.
pub(crate) fn add_part(
    core: &Core,
    set: &SetParts,
    mask: Mask,
    layout: vk::DescriptorSetLayout,
) -> Result<()> {
    let mut parts = set.lock();
    if parts.contains_key(&mask) {
        return Ok(());
    }
    let name = set.name.as_str();
    let sizes = [vk::DescriptorPoolSize::default()
        .ty(vk::DescriptorType::STORAGE_BUFFER)
        // A pool without descriptors is not allowed; a set without them is.
        .descriptor_count(mask.count_ones().max(1))];
    let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
    // SAFETY: one set of a known type.
    let pool =
        unsafe { core.device.create_descriptor_pool(&info, None) }.during("vkCreateDescriptorPool", name)?;
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
        .zip(set.buffers.iter().enumerate().filter(|(binding, _)| mask >> binding & 1 != 0))
        .map(|(binding, (_, bound))| (binding, [*bound]))
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
    parts.insert(mask, SetPart { pool, raw });
    Ok(())
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
