//! Compute and raster pipelines.

use std::sync::Arc;

use ash::vk;

use crate::binding::SetLayout;
use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};
use crate::features::Feature;

/// A compute pipeline to be made. The entry point is `main`.
#[derive(Debug, Clone, Copy)]
pub struct ComputePipelineDesc<'a> {
    /// Name for errors and tools: the path of the shader.
    pub name: &'a str,
    /// The module, in words.
    pub spirv: &'a [u32],
    /// Layouts of sets 0 and up.
    pub sets: &'a [&'a SetLayout],
    /// Bytes of push constants, a multiple of 4.
    pub push_constant_bytes: u32,
    /// Specialisation constants: id, and bits of a 32-bit value (a boolean is 0 or 1).
    pub constants: &'a [(u32, u32)],
}

/// A raster pipeline to be made. It draws triangle lists without attachments, vertex input or culling; what
/// it produces is what its shaders store. Depth is 0 to 1, y is not flipped, viewport and scissor are dynamic.
#[derive(Debug, Clone, Copy)]
pub struct RasterPipelineDesc<'a> {
    /// Name for errors and tools: the path of the shaders.
    pub name: &'a str,
    /// The vertex module, in words.
    pub vertex_spirv: &'a [u32],
    /// The fragment module, in words.
    pub fragment_spirv: &'a [u32],
    /// Layouts of sets 0 and up.
    pub sets: &'a [&'a SetLayout],
    /// Bytes of push constants, a multiple of 4; both stages see them.
    pub push_constant_bytes: u32,
    /// Specialisation constants of both stages, as in [`ComputePipelineDesc::constants`].
    pub constants: &'a [(u32, u32)],
}

/// What a raster pipeline can do beyond the common case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RasterOptions {
    /// Cover every pixel a triangle touches; needs [`Feature::ConservativeRasterization`].
    pub conservative: bool,
    /// Views drawn at once, one bit each; 0 is off. Needs [`Feature::Multiview`] and
    /// [`crate::RenderArea::view_mask`] of the same value.
    pub view_mask: u32,
}

/// A compute pipeline. Clones are handles to the same pipeline.
#[derive(Clone, Debug)]
pub struct ComputePipeline {
    pub(crate) inner: Arc<PipelineInner>,
}

/// A raster pipeline. Clones are handles to the same pipeline.
#[derive(Clone, Debug)]
pub struct RasterPipeline {
    pub(crate) inner: Arc<PipelineInner>,
}

pub(crate) struct PipelineInner {
    pub(crate) core: Arc<Core>,
    pub(crate) raw: vk::Pipeline,
    pub(crate) layout: vk::PipelineLayout,
    pub(crate) sets: Vec<SetLayout>,
    pub(crate) push_constant_bytes: u32,
    pub(crate) stages: vk::ShaderStageFlags,
    pub(crate) bind_point: vk::PipelineBindPoint,
    pub(crate) name: String,
    pub(crate) view_mask: u32,
}

impl std::fmt::Debug for PipelineInner {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.name)
    }
}

impl ComputePipeline {
    /// Name for errors and tools.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// The Vulkan pipeline.
    pub fn raw(&self) -> vk::Pipeline {
        self.inner.raw
    }
}

impl RasterPipeline {
    /// Name for errors and tools.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// The Vulkan pipeline.
    pub fn raw(&self) -> vk::Pipeline {
        self.inner.raw
    }
}

impl Device {
    /// Makes a compute pipeline.
    ///
    /// # Errors
    /// [`GpuError::InvalidShader`] for words that are no module, [`GpuError::LimitExceeded`] for too many
    /// sets, buffers or push constants, or what the driver reports, with the name of the pipeline.
    pub fn create_compute_pipeline(&self, desc: &ComputePipelineDesc<'_>) -> Result<ComputePipeline> {
        let stages = vk::ShaderStageFlags::COMPUTE;
        let mut inner = self.begin_pipeline(desc.name, desc.sets, desc.push_constant_bytes, stages)?;
        let module = Module::create(&self.core, desc.name, desc.spirv)?;
        let values = Specialisation::new(desc.constants);
        let specialisation = values.info();
        let stage = module.stage(vk::ShaderStageFlags::COMPUTE, &specialisation);
        let info = vk::ComputePipelineCreateInfo::default().stage(stage).layout(inner.layout);
        // SAFETY: module and layout are alive and of this device; shader and layout agree (layout reflection
        // tests hold them together, and validation checks it).
        let made =
            unsafe { self.core.device.create_compute_pipelines(self.core.pipeline_cache, &[info], None) };
        inner.raw = first_pipeline(&self.core, made, "vkCreateComputePipelines", desc.name)?;
        self.core.name_object(inner.raw, desc.name);
        Ok(ComputePipeline { inner: Arc::new(inner) })
    }

    /// Makes a raster pipeline.
    ///
    /// # Errors
    /// As [`Device::create_compute_pipeline`], and [`GpuError::FeatureNotEnabled`] without
    /// [`Feature::DynamicRendering`].
    pub fn create_raster_pipeline(&self, desc: &RasterPipelineDesc<'_>) -> Result<RasterPipeline> {
        self.create_raster_pipeline_with(desc, RasterOptions::default())
    }

    /// Makes a raster pipeline with options.
    ///
    /// # Errors
    /// As [`Device::create_raster_pipeline`], and [`GpuError::FeatureNotEnabled`] without the feature of an
    /// option.
    pub fn create_raster_pipeline_with(
        &self,
        desc: &RasterPipelineDesc<'_>,
        options: RasterOptions,
    ) -> Result<RasterPipeline> {
        let core = &self.core;
        core.require(Feature::DynamicRendering, desc.name)?;
        if options.conservative {
            core.require(Feature::ConservativeRasterization, desc.name)?;
        }
        if options.view_mask != 0 {
            core.require(Feature::Multiview, desc.name)?;
        }
        let stages = vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT;
        let mut inner = self.begin_pipeline(desc.name, desc.sets, desc.push_constant_bytes, stages)?;
        inner.bind_point = vk::PipelineBindPoint::GRAPHICS;
        inner.view_mask = options.view_mask;
        let vertex = Module::create(core, desc.name, desc.vertex_spirv)?;
        let fragment = Module::create(core, desc.name, desc.fragment_spirv)?;
        let values = Specialisation::new(desc.constants);
        let specialisation = values.info();
        let stages = [
            vertex.stage(vk::ShaderStageFlags::VERTEX, &specialisation),
            fragment.stage(vk::ShaderStageFlags::FRAGMENT, &specialisation),
        ];
        let vertex_input = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
            .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let mut conservative = vk::PipelineRasterizationConservativeStateCreateInfoEXT::default()
            .conservative_rasterization_mode(vk::ConservativeRasterizationModeEXT::OVERESTIMATE);
        let mut rasterization = vk::PipelineRasterizationStateCreateInfo::default()
            .polygon_mode(vk::PolygonMode::FILL)
            .cull_mode(vk::CullModeFlags::NONE)
            .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
            .line_width(1.0);
        if options.conservative {
            rasterization = rasterization.push_next(&mut conservative);
        }
        let multisample = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(vk::SampleCountFlags::TYPE_1);
        let depth_stencil = vk::PipelineDepthStencilStateCreateInfo::default();
        let blend = vk::PipelineColorBlendStateCreateInfo::default();
        let dynamic = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic);
        let mut rendering = vk::PipelineRenderingCreateInfo::default().view_mask(options.view_mask);
        let info = vk::GraphicsPipelineCreateInfo::default()
            .stages(&stages)
            .vertex_input_state(&vertex_input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&rasterization)
            .multisample_state(&multisample)
            .depth_stencil_state(&depth_stencil)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(inner.layout)
            .push_next(&mut rendering);
        // SAFETY: as for compute; the features behind dynamic rendering and the options were checked.
        let made = unsafe { core.device.create_graphics_pipelines(core.pipeline_cache, &[info], None) };
        inner.raw = first_pipeline(core, made, "vkCreateGraphicsPipelines", desc.name)?;
        core.name_object(inner.raw, desc.name);
        Ok(RasterPipeline { inner: Arc::new(inner) })
    }

    /// Checks what both kinds share and makes the pipeline layout; the pipeline itself is null so far.
    fn begin_pipeline(
        &self,
        name: &str,
        sets: &[&SetLayout],
        push_constant_bytes: u32,
        stages: vk::ShaderStageFlags,
    ) -> Result<PipelineInner> {
        let core = &self.core;
        let limits = &core.limits;
        let buffers: u64 = sets.iter().map(|set| u64::from(set.inner.storage_buffers)).sum();
        let checks: [(&'static str, u64, u64); 3] = [
            ("the number of sets", sets.len() as u64, limits.max_bound_sets.into()),
            (
                "the number of storage buffers of all sets",
                buffers,
                limits.max_storage_buffers_per_stage.into(),
            ),
            ("the size of the push constants", push_constant_bytes.into(), limits.max_push_constants.into()),
        ];
        if let Some((what, asked, limit)) = checks.into_iter().find(|(_, asked, limit)| asked > limit) {
            return Err(GpuError::LimitExceeded { name: name.to_owned(), what, asked, limit });
        }
        let invalid =
            |reason: &str| GpuError::InvalidUse { name: name.to_owned(), reason: reason.to_owned() };
        if !push_constant_bytes.is_multiple_of(4) {
            return Err(invalid("the size of the push constants must be a multiple of 4"));
        }
        if sets.iter().any(|set| !Arc::ptr_eq(core, &set.inner.core)) {
            return Err(invalid("a set layout belongs to another device"));
        }
        let layouts: Vec<_> = sets.iter().map(|set| set.inner.raw).collect();
        let range = vk::PushConstantRange::default().stage_flags(stages).size(push_constant_bytes);
        let ranges = if push_constant_bytes == 0 { &[][..] } else { std::slice::from_ref(&range) };
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts).push_constant_ranges(ranges);
        // SAFETY: layouts of this device, within its limits.
        let layout = unsafe { core.device.create_pipeline_layout(&info, None) }
            .during("vkCreatePipelineLayout", name)?;
        core.name_object(layout, name);
        Ok(PipelineInner {
            core: core.clone(),
            raw: vk::Pipeline::null(),
            layout,
            sets: sets.iter().map(|set| (*set).clone()).collect(),
            push_constant_bytes,
            stages,
            bind_point: vk::PipelineBindPoint::COMPUTE,
            name: name.to_owned(),
            view_mask: 0,
        })
    }
}

impl Drop for PipelineInner {
    fn drop(&mut self) {
        if self.core.is_usable() {
            // SAFETY: submissions that use the pipeline hold a handle to it, so none is pending; embedders keep
            // what they record alive. Null is ignored.
            unsafe {
                self.core.device.destroy_pipeline(self.raw, None);
                self.core.device.destroy_pipeline_layout(self.layout, None);
            }
        }
    }
}

/// Takes the only pipeline out of what Vulkan returned.
fn first_pipeline(
    core: &Core,
    made: std::result::Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>,
    call: &'static str,
    name: &str,
) -> Result<vk::Pipeline> {
    match made {
        Ok(pipelines) => pipelines.first().copied().ok_or_else(|| GpuError::InvalidUse {
            name: name.to_owned(),
            reason: "the driver returned no pipeline".to_owned(),
        }),
        Err((pipelines, result)) => {
            for pipeline in pipelines {
                // SAFETY: just made, used by nothing; null is ignored.
                unsafe { core.device.destroy_pipeline(pipeline, None) };
            }
            Err(GpuError::from_vulkan(result, call, name))
        }
    }
}

/// A shader module, needed only until its pipeline is made.
struct Module<'a> {
    core: &'a Core,
    raw: vk::ShaderModule,
}

impl<'a> Module<'a> {
    fn create(core: &'a Core, name: &str, spirv: &[u32]) -> Result<Self> {
        const MAGIC: u32 = 0x0723_0203;
        const HEADER_WORDS: usize = 5;
        let reason = match spirv {
            [MAGIC, ..] if spirv.len() > HEADER_WORDS => None,
            [MAGIC, ..] => Some("it ends within its header"),
            [first, ..] if first.swap_bytes() == MAGIC => Some("its byte order is reversed"),
            _ => Some("its first word is not the SPIR-V number"),
        };
        if let Some(reason) = reason {
            return Err(GpuError::InvalidShader { name: name.to_owned(), reason });
        }
        let info = vk::ShaderModuleCreateInfo::default().code(spirv);
        // SAFETY: the words are a module at least by their header; the shader compiler vouches for the rest.
        let raw =
            unsafe { core.device.create_shader_module(&info, None) }.during("vkCreateShaderModule", name)?;
        core.name_object(raw, name);
        Ok(Self { core, raw })
    }

    fn stage<'b>(
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

/// Specialisation constants as Vulkan takes them.
struct Specialisation {
    entries: Vec<vk::SpecializationMapEntry>,
    words: Vec<u32>,
}

impl Specialisation {
    fn new(constants: &[(u32, u32)]) -> Self {
        let entries = (0_u32..)
            .zip(constants)
            .map(|(index, (id, _))| {
                vk::SpecializationMapEntry::default().constant_id(*id).offset(4 * index).size(4)
            })
            .collect();
        Self { entries, words: constants.iter().map(|(_, bits)| *bits).collect() }
    }

    fn info(&self) -> vk::SpecializationInfo<'_> {
        vk::SpecializationInfo::default().map_entries(&self.entries).data(bytemuck::cast_slice(&self.words))
    }
}
