//! The build: pipelines, and the passes in the order they are recorded.

use bytemuck::bytes_of;
use rasray_ads::{AdsError, Geometry, SceneBinding};
use rasray_gpu::{
    Access, BindingSet, Buffer, ComputePipeline, ComputePipelineDesc, Device, RasterPipeline,
    RasterPipelineDesc, Recorder, SetLayout,
};
use rasray_shaders_glsl::Shader;
use rasray_shaders_glsl::constants::abuffer::ABUFFER_GROUP_SIZE;

use crate::layout::cell_count;
use crate::{Accept, Addressing, Config, Payload};

/// Modules of one addressing.
pub(crate) struct Modules {
    near: &'static Shader,
    raster: &'static Shader,
    bounds: &'static Shader,
    scale: &'static Shader,
    store: &'static Shader,
    reorder: &'static Shader,
    status: &'static Shader,
    pub(crate) closest: &'static Shader,
    pub(crate) occluded: &'static Shader,
    pub(crate) surfaces: Option<&'static Shader>,
}

/// Finds the modules for a configuration.
///
/// # Errors
/// The configuration needs the scene's shaders and there is no scene.
pub(crate) fn modules(config: &Config, scene: Option<&SceneBinding>) -> Result<Modules, AdsError> {
    let suffix = match config.addressing {
        Addressing::Descriptor => "",
        Addressing::Address => ".address",
    };
    let alpha = scene.is_some_and(|scene| scene.alpha_masked);
    let find = |name: &str| {
        rasray_shaders_glsl::shader(&format!("abuffer/{name}{suffix}"))
            .ok_or(AdsError::NoScene { structure: "mmrt" })
    };
    let attributes = config.payload == Payload::Attributes;
    if attributes && scene.is_none() {
        return Err(AdsError::Option {
            option: "payload",
            value: "attributes".to_owned(),
            expected: "attributes are read from a scene; without one use `index`",
        });
    }
    Ok(Modules {
        near: find("build_1_near")?,
        raster: find("build_raster")?,
        bounds: find(if alpha { "build_2_bounds.alpha" } else { "build_2_bounds" })?,
        scale: find("build_3_scale")?,
        store: find(if attributes {
            "build_4_store.attributes"
        } else if alpha {
            "build_4_store.alpha"
        } else {
            "build_4_store"
        })?,
        reorder: find("build_5_reorder")?,
        status: find("build_6_status")?,
        closest: find(if alpha { "trace_closest.alpha" } else { "trace_closest" })?,
        occluded: find(if alpha { "trace_occluded.alpha" } else { "trace_occluded" })?,
        surfaces: find("surfaces").ok(),
    })
}

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    near: ComputePipeline,
    bounds: RasterPipeline,
    scale: Option<ComputePipeline>,
    store: RasterPipeline,
    reorder: Option<ComputePipeline>,
    status: ComputePipeline,
    scene: Option<BindingSet>,
}

/// What one recording of the build works on.
pub(crate) struct Target<'a> {
    pub(crate) config: &'a Config,
    pub(crate) geometry: &'a Geometry,
    pub(crate) set: Option<&'a BindingSet>,
    pub(crate) address: u64,
    pub(crate) header_source: &'a Buffer,
    pub(crate) header: &'a Buffer,
    pub(crate) header_readback: &'a Buffer,
    pub(crate) bounds: &'a Buffer,
    pub(crate) lists: &'a Buffer,
    pub(crate) nodes: &'a Buffer,
}

impl Build {
    pub(crate) fn new(
        device: &Device,
        config: &Config,
        modules: &Modules,
        geometry: &Geometry,
        structure: &SetLayout,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let mut sets = vec![geometry.layout(), structure];
        if let Some(scene) = scene {
            sets.push(&scene.layout);
        }
        let constants = config.constants();
        let compute = |shader: &Shader| {
            device.create_compute_pipeline(&ComputePipelineDesc {
                name: shader.name,
                spirv: shader.words(),
                sets: &sets,
                push_constant_bytes: 8,
                constants: &constants,
            })
        };
        let raster = |shader: &Shader| {
            device.create_raster_pipeline(&RasterPipelineDesc {
                name: shader.name,
                vertex_spirv: modules.raster.words(),
                fragment_spirv: shader.words(),
                sets: &sets,
                push_constant_bytes: 8,
                constants: &constants,
            })
        };
        Ok(Self {
            near: compute(modules.near)?,
            bounds: raster(modules.bounds)?,
            scale: (config.accept == Accept::Plane).then(|| compute(modules.scale)).transpose()?,
            store: raster(modules.store)?,
            reorder: config.sort.then(|| compute(modules.reorder)).transpose()?,
            status: compute(modules.status)?,
            scene: scene.map(|scene| scene.set.clone()),
        })
    }

    /// Records all passes. The host has written `header_source`.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, target: &Target<'_>) {
        let cells = cell_count(target.config.resolution);
        let triangles = target.geometry.triangle_count();

        recorder.begin_pass("abuffer/build_0_clear");
        recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
        recorder.copy(target.header_source, 0, target.header, 0, target.header.size());
        for pool in [target.bounds, target.lists, target.nodes] {
            recorder.fill(pool, 0, pool.size(), 0);
        }
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::VERTEX_READ | Access::FRAGMENT);
        recorder.end_pass();

        recorder.begin_pass("abuffer/build_1_near");
        self.dispatch(recorder, &self.near, target, u64::from(triangles));
        recorder.end_pass();

        recorder.begin_pass("abuffer/build_2_bounds");
        self.draw(recorder, &self.bounds, target);
        recorder.barrier(Access::FRAGMENT, Access::COMPUTE | Access::FRAGMENT);
        recorder.end_pass();

        if let Some(scale) = &self.scale {
            recorder.begin_pass("abuffer/build_3_scale");
            self.dispatch(recorder, scale, target, cells);
            recorder.barrier(Access::COMPUTE, Access::FRAGMENT | Access::COMPUTE);
            recorder.end_pass();
        }

        recorder.begin_pass("abuffer/build_4_store");
        self.draw(recorder, &self.store, target);
        recorder.barrier(Access::FRAGMENT, Access::COMPUTE);
        recorder.end_pass();

        if let Some(reorder) = &self.reorder {
            recorder.begin_pass("abuffer/build_5_reorder");
            self.dispatch(recorder, reorder, target, cells * u64::from(target.config.buckets));
            recorder.barrier(Access::COMPUTE, Access::COMPUTE);
            recorder.end_pass();
        }

        recorder.begin_pass("abuffer/build_6_status");
        recorder.barrier(Access::COMPUTE, Access::COMPUTE);
        self.dispatch(recorder, &self.status, target, 1);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER_READ);
        recorder.copy(target.header, 0, target.header_readback, 0, target.header.size());
        recorder.barrier(Access::TRANSFER_WRITE, Access::HOST_READ);
        recorder.end_pass();
    }

    fn bind(&self, recorder: &mut Recorder<'_>, target: &Target<'_>) {
        recorder.bind_sets(0, &[target.geometry.set()]);
        if let Some(set) = target.set {
            recorder.bind_sets(1, &[set]);
        }
        if let Some(scene) = &self.scene {
            recorder.bind_sets(2, &[scene]);
        }
        recorder.push_constants(bytes_of(&target.address));
    }

    /// One invocation per item; more groups than one dimension holds go to the second.
    fn dispatch(
        &self,
        recorder: &mut Recorder<'_>,
        pipeline: &ComputePipeline,
        target: &Target<'_>,
        items: u64,
    ) {
        let groups = items.div_ceil(u64::from(ABUFFER_GROUP_SIZE));
        if groups == 0 {
            return;
        }
        let rows = groups.div_ceil(32_768);
        recorder.bind_compute(pipeline);
        self.bind(recorder, target);
        recorder.dispatch([groups.div_ceil(rows) as u32, rows as u32, 1]);
    }

    fn draw(&self, recorder: &mut Recorder<'_>, pipeline: &RasterPipeline, target: &Target<'_>) {
        let triangles = target.geometry.triangle_count();
        if triangles == 0 {
            return;
        }
        let side = target.config.resolution + 2;
        recorder.begin_rendering(side, side);
        recorder.bind_raster(pipeline);
        self.bind(recorder, target);
        recorder.draw(3 * triangles, 6, 0);
        recorder.end_rendering();
    }
}
