//! Stage of a pipeline: a module and its specialisation constants.

use ash::vk;

use crate::device_core::Core;
use crate::error::{During, GpuError, Result};

/// A shader module that exists only until its pipeline is made.
pub(crate) struct Module<'a> {
    core: &'a Core,
    raw: vk::ShaderModule,
}

impl<'a> Module<'a> {
    pub(crate) fn create(core: &'a Core, name: &str, words: &[u32]) -> Result<Self> {
        rasray_spirv::check_header(words).map_err(|error| GpuError::of_shader(name, error))?;
        let info = vk::ShaderModuleCreateInfo::default().code(words);
        // SAFETY: the words are what the pipeline's constants leave of a module that its maker vouches for.
        let raw =
            unsafe { core.device.create_shader_module(&info, None) }.during("vkCreateShaderModule", name)?;
        core.name_object(raw, name);
        Ok(Self { core, raw })
    }

    pub(crate) fn stage<'b>(
        &self,
        stage: vk::ShaderStageFlags,
        specialisation: &'b vk::SpecializationInfo<'b>,
    ) -> vk::PipelineShaderStageCreateInfo<'b> {
        vk::PipelineShaderStageCreateInfo::default()
            .stage(stage)
            .module(self.raw)
            .name(c"main")
            .specialization_info(specialisation)
    }
}

impl Drop for Module<'_> {
    fn drop(&mut self) {
        // SAFETY: a pipeline does not need its modules once it is made.
        unsafe { self.core.device.destroy_shader_module(self.raw, None) };
    }
}

/// Specialisation constants in the form that Vulkan takes.
pub(crate) struct Specialisation {
    entries: Vec<vk::SpecializationMapEntry>,
    words: Vec<u32>,
}

impl Specialisation {
    pub(crate) fn new(constants: &[(u32, u32)]) -> Self {
        let entries = (0_u32..)
            .zip(constants)
            .map(|(index, (id, _))| {
                vk::SpecializationMapEntry::default().constant_id(*id).offset(4 * index).size(4)
            })
            .collect();
        Self { entries, words: constants.iter().map(|(_, bits)| *bits).collect() }
    }

    pub(crate) fn info(&self) -> vk::SpecializationInfo<'_> {
        vk::SpecializationInfo::default().map_entries(&self.entries).data(bytemuck::cast_slice(&self.words))
    }
}
