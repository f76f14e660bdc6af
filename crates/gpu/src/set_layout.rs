//! Layouts of descriptor sets, and the parts of them that pipelines use.

use std::sync::Arc;

use ash::vk;

use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};
use crate::set_parts::{MOST_BINDINGS, Mask, SetPart, SetParts, all, bindings};

/// Layout of a set: storage buffers at bindings 0, 1, 2 …, visible to vertex, fragment and compute shaders.
/// Clones are handles to the same layout, and so are layouts with the same number of buffers on one device.
///
/// A pipeline is made with only those bindings that its modules use, so that the limit of buffers per stage
/// applies to the buffers that a stage really uses.
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
    /// Returns the number of storage buffers.
    pub fn storage_buffers(&self) -> u32 {
        self.storage_buffers
    }

    /// Returns the Vulkan layout of all bindings.
    pub fn raw(&self) -> vk::DescriptorSetLayout {
        self.core.set_layouts.lock()[&self.storage_buffers].layouts[&all(self.storage_buffers)]
    }

    /// Returns the name for errors and tools.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Returns true if the layout is of this device.
    pub(crate) fn is_of(&self, core: &Arc<Core>) -> bool {
        Arc::ptr_eq(&self.core, core)
    }

    /// Returns true if sets of either layout can be bound as sets of the other.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        self.is_of(&other.core) && self.storage_buffers == other.storage_buffers
    }

    /// Returns the Vulkan layout of some bindings. From now on, every set of this layout, existing or made
    /// later, has a Vulkan set for that part.
    pub(crate) fn part(&self, mask: Mask) -> Result<vk::DescriptorSetLayout> {
        let mut layouts = self.core.set_layouts.lock();
        let parts = layouts.entry(self.storage_buffers).or_default();
        if let Some(layout) = parts.layouts.get(&mask) {
            return Ok(*layout);
        }
        let layout = create_layout(&self.core, &self.name, mask)?;
        let mut sets = parts.sets.iter();
        if let Err(error) = sets.try_for_each(|set| add_part(&self.core, set, mask, layout)) {
            // Sets that already have the part keep it, because parts of the same bindings are alike.
            // SAFETY: a layout may be destroyed before the sets made with it, which are not updated any more.
            unsafe { self.core.device.destroy_descriptor_set_layout(layout, None) };
            return Err(error);
        }
        parts.layouts.insert(mask, layout);
        Ok(layout)
    }
}

/// Makes the Vulkan set of a part, unless the set already has it.
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
        // Vulkan forbids a pool without descriptors, but permits a set without them.
        .descriptor_count(mask.count_ones().max(1))];
    let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
    // SAFETY: the pool is for one set of a known type.
    let pool =
        unsafe { core.device.create_descriptor_pool(&info, None) }.during("vkCreateDescriptorPool", name)?;
    let layouts = [layout];
    let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
    // SAFETY: the pool is new and has room for one set of this layout.
    let allocated =
        unsafe { core.device.allocate_descriptor_sets(&info) }.during("vkAllocateDescriptorSets", name);
    let raw = match allocated.as_deref() {
        Ok([raw, ..]) => *raw,
        other => {
            // SAFETY: nothing was allocated from the pool.
            unsafe { core.device.destroy_descriptor_pool(pool, None) };
            return Err(match other {
                Err(error) => error.clone(),
                // A success without a set.
                Ok(_) => GpuError::from_vulkan(vk::Result::ERROR_UNKNOWN, "vkAllocateDescriptorSets", name),
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
    // SAFETY: the set is new, the buffers are storage buffers of this device, and the ranges were checked.
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
    // SAFETY: the bindings are distinct, of a type that every device has, and within its limit.
    let raw = unsafe { core.device.create_descriptor_set_layout(&info, None) }
        .during("vkCreateDescriptorSetLayout", name)?;
    core.name_object(raw, name);
    Ok(raw)
}

impl Device {
    /// Makes a layout of `storage_buffers` storage buffers at bindings 0 and up.
    ///
    /// # Errors
    /// [`GpuError::LimitExceeded`] if a shader stage cannot access that many buffers, or an error that the
    /// driver reports.
    pub fn create_set_layout(&self, name: &str, storage_buffers: u32) -> Result<SetLayout> {
        let core = &self.core;
        // A pipeline may use few bindings of each set, but some pipeline uses all bindings of one.
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
