//! Compute and raster pipelines.

use std::sync::Arc;

use ash::vk;
use rasray_spirv::{TrustedModule, specialised, used_bindings};

use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};
use crate::features::Feature;
use crate::pipeline_desc::{ComputePipelineDesc, RasterPipelineDesc};
use crate::pipeline_store::{PipelineObjects, Recipe};
use crate::raster_options::RasterOptions;
use crate::set_layout::SetLayout;
use crate::set_parts::Mask;
use crate::shader_stage::{Module, Specialisation};

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
    recipe: Arc<Recipe>,
    pub(crate) raw: vk::Pipeline,
    pub(crate) layout: vk::PipelineLayout,
    pub(crate) sets: Vec<SetLayout>,
    /// Bindings of each set that the pipeline layout contains.
    pub(crate) used: Arc<[Mask]>,
    pub(crate) push_constant_bytes: u32,
    pub(crate) stages: vk::ShaderStageFlags,
    pub(crate) bind_point: vk::PipelineBindPoint,
    pub(crate) name: String,
    pub(crate) view_mask: u32,
}

impl PipelineInner {
    /// Returns how many sets stay bound, from set 0 up, if another pipeline is bound after this one.
    pub(crate) fn sets_kept_by(&self, next: &Self) -> usize {
        let constants =
            |pipeline: &Self| (pipeline.bind_point, pipeline.push_constant_bytes, pipeline.stages);
        if constants(self) != constants(next) {
            return 0;
        }
        self.layouts().zip(next.layouts()).take_while(|(before, after)| before == after).count()
    }

    /// Returns what tells the layouts of the sets apart: the number of buffers, and the bindings in use.
    fn layouts(&self) -> impl Iterator<Item = (u32, Mask)> {
        self.sets.iter().map(SetLayout::storage_buffers).zip(self.used.iter().copied())
    }
}

impl std::fmt::Debug for PipelineInner {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.name)
    }
}

impl ComputePipeline {
    /// Returns the name for errors and tools.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// Returns the Vulkan pipeline.
    pub fn raw(&self) -> vk::Pipeline {
        self.inner.raw
    }
}

impl RasterPipeline {
    /// Returns the name for errors and tools.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// Returns the Vulkan pipeline.
    pub fn raw(&self) -> vk::Pipeline {
        self.inner.raw
    }
}

impl Device {
    /// Makes a compute pipeline. The driver is handed what the constants leave of the module
    /// ([`rasray_spirv::specialised`]), and the layout has the bindings that are left. A further call with
    /// the same module, constants and layouts returns a handle to the same pipeline, as long as a handle to
    /// it exists or [`Device::keep_pipelines`] keeps it.
    ///
    /// # Errors
    /// [`GpuError::InvalidShader`] for words that are not a module, [`GpuError::LimitExceeded`] for too many
    /// sets, buffers or push constants, or an error that the driver reports, with the name of the pipeline.
    pub fn create_compute_pipeline(&self, desc: &ComputePipelineDesc<'_>) -> Result<ComputePipeline> {
        let asked = PipelineRequest {
            name: desc.name,
            sets: desc.sets,
            push_constant_bytes: desc.push_constant_bytes,
            stages: vk::ShaderStageFlags::COMPUTE,
            bind_point: vk::PipelineBindPoint::COMPUTE,
        };
        let recipe = asked.recipe(&[desc.module], desc.constants, RasterOptions::default());
        let inner = self.shared_pipeline(&asked, recipe, |layout, modules| {
            let module = Module::create(&self.core, desc.name, &modules[0])?;
            let values = Specialisation::new(desc.constants);
            let specialisation = values.info();
            let stage = module.stage(vk::ShaderStageFlags::COMPUTE, &specialisation);
            let info = vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout);
            // SAFETY: module and layout are alive and of this device; shader and layout agree (tests of
            // layout reflection ensure it, and the validation layer checks it).
            let made =
                unsafe { self.core.device.create_compute_pipelines(self.core.pipeline_cache, &[info], None) };
            first_pipeline(&self.core, made, "vkCreateComputePipelines", desc.name)
        })?;
        Ok(ComputePipeline { inner })
    }

    /// Makes a raster pipeline, shared in the same way as compute pipelines.
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
        let asked = PipelineRequest {
            name: desc.name,
            sets: desc.sets,
            push_constant_bytes: desc.push_constant_bytes,
            stages: vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT,
            bind_point: vk::PipelineBindPoint::GRAPHICS,
        };
        let recipe = asked.recipe(&[desc.vertex_module, desc.fragment_module], desc.constants, options);
        let inner = self.shared_pipeline(&asked, recipe, |layout, modules| {
            let vertex = Module::create(core, desc.name, &modules[0])?;
            let fragment = Module::create(core, desc.name, &modules[1])?;
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
                .layout(layout)
                .push_next(&mut rendering);
            // SAFETY: as for compute pipelines; the features for dynamic rendering and the options were
            // checked.
            let made = unsafe { core.device.create_graphics_pipelines(core.pipeline_cache, &[info], None) };
            first_pipeline(core, made, "vkCreateGraphicsPipelines", desc.name)
        })?;
        Ok(RasterPipeline { inner })
    }

    /// Keeps up to `count` pipelines without handles (0 by default), so that they need not be compiled again.
    /// Beyond that number, the pipelines that have been unused for longest are destroyed. The function serves
    /// programs that make structures repeatedly: for a change of options, or an experiment over many
    /// structures.
    pub fn keep_pipelines(&self, count: usize) {
        self.core.pipelines.keep(self.core.usable_device(), count);
    }

    /// Returns the pipeline that was made by the recipe before, or makes it with `compile` from its modules,
    /// in the recipe's order, as far as they run.
    fn shared_pipeline(
        &self,
        asked: &PipelineRequest<'_>,
        recipe: Recipe,
        compile: impl FnOnce(vk::PipelineLayout, &[Vec<u32>]) -> Result<vk::Pipeline>,
    ) -> Result<Arc<PipelineInner>> {
        let core = &self.core;
        self.check_pipeline(asked)?;
        let view_mask = recipe.options.view_mask;
        let (recipe, made) = match core.pipelines.find(&recipe) {
            Some(found) => found,
            None => {
                let modules = recipe.modules.iter().map(|words| specialised(words, &recipe.constants));
                let modules: Vec<Vec<u32>> = modules.collect();
                let used = self.used_bindings(asked, &modules)?;
                let layout = Layout::create(core, asked, &used)?;
                let raw = compile(layout.raw, &modules)?;
                core.name_object(raw, asked.name);
                let made = PipelineObjects { raw, layout: layout.into_raw(), used };
                core.pipelines.insert(&core.device, recipe, made)
            }
        };
        Ok(Arc::new(PipelineInner {
            core: core.clone(),
            recipe,
            raw: made.raw,
            layout: made.layout,
            sets: asked.sets.iter().map(|set| (*set).clone()).collect(),
            used: made.used,
            push_constant_bytes: asked.push_constant_bytes,
            stages: asked.stages,
            bind_point: asked.bind_point,
            name: asked.name.to_owned(),
            view_mask,
        }))
    }

    /// Returns the masks of the bindings of each set that the modules of a pipeline use.
    fn used_bindings(&self, asked: &PipelineRequest<'_>, modules: &[Vec<u32>]) -> Result<Arc<[Mask]>> {
        let name = asked.name;
        let mut used = vec![0; asked.sets.len()];
        for module in modules {
            let of_module = used_bindings(module).map_err(|error| GpuError::of_shader(name, error))?;
            for (set, mask) in of_module.into_iter().enumerate().filter(|(_, mask)| *mask != 0) {
                let known = asked.sets.get(set).map_or(0, |layout| layout.storage_buffers());
                let binding = Mask::BITS - 1 - mask.leading_zeros();
                if binding >= known {
                    let reason =
                        format!("its shader uses binding {binding} of set {set}, whose layout has {known}");
                    return Err(GpuError::InvalidUse { name: name.to_owned(), reason });
                }
                used[set] |= mask;
            }
        }
        let in_use = used.iter().map(|mask: &Mask| u64::from(mask.count_ones())).sum();
        let limit = self.core.limits.max_storage_buffers_per_stage.into();
        if in_use > limit {
            let what = "the number of storage buffers that its shader uses";
            return Err(GpuError::LimitExceeded { name: name.to_owned(), what, asked: in_use, limit });
        }
        Ok(used.into())
    }

    /// Checks the properties that both kinds of pipeline share.
    fn check_pipeline(&self, asked: &PipelineRequest<'_>) -> Result<()> {
        let PipelineRequest { name, sets, push_constant_bytes, .. } = *asked;
        let core = &self.core;
        let limits = &core.limits;
        let checks: [(&'static str, u64, u64); 2] = [
            ("the number of sets", sets.len() as u64, limits.max_bound_sets.into()),
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
        if sets.iter().any(|set| !set.is_of(core)) {
            return Err(invalid("a set layout belongs to another device"));
        }
        Ok(())
    }
}

/// Request for a pipeline of either kind.
struct PipelineRequest<'a> {
    name: &'a str,
    sets: &'a [&'a SetLayout],
    push_constant_bytes: u32,
    stages: vk::ShaderStageFlags,
    bind_point: vk::PipelineBindPoint,
}

impl PipelineRequest<'_> {
    fn recipe(&self, modules: &[&TrustedModule], constants: &[(u32, u32)], options: RasterOptions) -> Recipe {
        Recipe {
            modules: modules.iter().map(|module| module.words().into()).collect(),
            constants: constants.into(),
            sets: self.sets.iter().map(|set| set.storage_buffers()).collect(),
            push_constant_bytes: self.push_constant_bytes,
            options,
        }
    }
}

/// A pipeline layout that is destroyed unless its pipeline is made.
struct Layout<'a> {
    core: &'a Core,
    raw: vk::PipelineLayout,
}

impl<'a> Layout<'a> {
    /// Makes the layout of the bindings that are used.
    fn create(core: &'a Core, asked: &PipelineRequest<'_>, used: &[Mask]) -> Result<Self> {
        let parts = asked.sets.iter().zip(used).map(|(set, used)| set.part(*used));
        let layouts = parts.collect::<Result<Vec<_>>>()?;
        let range =
            vk::PushConstantRange::default().stage_flags(asked.stages).size(asked.push_constant_bytes);
        let ranges = if asked.push_constant_bytes == 0 { &[][..] } else { std::slice::from_ref(&range) };
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts).push_constant_ranges(ranges);
        // SAFETY: the layouts are of this device and within its limits.
        let raw = unsafe { core.device.create_pipeline_layout(&info, None) }
            .during("vkCreatePipelineLayout", asked.name)?;
        core.name_object(raw, asked.name);
        Ok(Self { core, raw })
    }

    /// Returns the Vulkan layout; the caller must destroy it.
    fn into_raw(self) -> vk::PipelineLayout {
        std::mem::ManuallyDrop::new(self).raw
    }
}

impl Drop for Layout<'_> {
    fn drop(&mut self) {
        // SAFETY: no pipeline was made with this layout.
        unsafe { self.core.device.destroy_pipeline_layout(self.raw, None) };
    }
}

impl Drop for PipelineInner {
    fn drop(&mut self) {
        self.core.pipelines.release(self.core.usable_device(), &self.recipe);
    }
}

/// Returns the only pipeline of a result of Vulkan.
fn first_pipeline(
    core: &Core,
    made: std::result::Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>,
    call: &'static str,
    name: &str,
) -> Result<vk::Pipeline> {
    match made {
        // A success without a pipeline is the driver's fault.
        Ok(pipelines) => {
            let none = || GpuError::from_vulkan(vk::Result::ERROR_UNKNOWN, call, name);
            pipelines.first().copied().ok_or_else(none)
        }
        Err((pipelines, result)) => {
            for pipeline in pipelines {
                // SAFETY: the pipeline was just made and is not used; null is ignored.
                unsafe { core.device.destroy_pipeline(pipeline, None) };
            }
            Err(GpuError::from_vulkan(result, call, name))
        }
    }
}
