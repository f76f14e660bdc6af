//! The build: pipelines, and the passes in the order they are recorded.

use bytemuck::bytes_of;
use rasray_ads::{AdsError, Geometry, SceneBinding};
use rasray_gpu::{
    Access, BindingSet, Buffer, ComputePipeline, ComputePipelineDesc, Device, RasterPipeline,
    RasterPipelineDesc, Recorder, SetLayout,
};
use rasray_shaders_glsl::Shader;
use rasray_shaders_glsl::constants::primitive::{PRIMITIVE_GROUP_SIZE, PRIMITIVE_SCAN_BLOCK};

use crate::layout::cell_count;
use crate::{Addressing, Config, Storage};

/// Finds the module of a name for a configuration's addressing.
fn find(config: &Config, name: &str) -> Option<&'static Shader> {
    let suffix = match config.addressing {
        Addressing::Descriptor => "",
        Addressing::Address => ".address",
    };
    rasray_shaders_glsl::shader(&format!("primitive/{name}{suffix}"))
}

/// The same, where a module is missing only because the scene's shaders are not compiled in.
fn module(config: &Config, name: &str) -> Result<&'static Shader, AdsError> {
    find(config, name).ok_or(AdsError::NoScene { structure: "dirt" })
}

/// Modules of the trace: closest, occluded, surfaces.
pub(crate) struct TraceModules {
    pub(crate) closest: &'static Shader,
    pub(crate) occluded: &'static Shader,
    pub(crate) surfaces: Option<&'static Shader>,
}

/// Finds the modules that trace.
///
/// # Errors
/// Masks are to be tested and the scene's shaders are not compiled in.
pub(crate) fn trace_modules(config: &Config, scene: Option<&SceneBinding>) -> Result<TraceModules, AdsError> {
    let alpha = scene.is_some_and(|scene| scene.alpha_masked);
    Ok(TraceModules {
        closest: module(config, if alpha { "trace_closest.alpha" } else { "trace_closest" })?,
        occluded: module(config, if alpha { "trace_occluded.alpha" } else { "trace_occluded" })?,
        surfaces: find(config, "surfaces"),
    })
}

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    near: ComputePipeline,
    bounds: RasterPipeline,
    scale: Option<ComputePipeline>,
    lengths: Option<Lengths>,
    store: RasterPipeline,
    status: ComputePipeline,
}

/// What contiguous lists need before they are stored.
#[derive(Debug)]
struct Lengths {
    count: RasterPipeline,
    blocks: ComputePipeline,
    sums: ComputePipeline,
    places: ComputePipeline,
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
}

impl Build {
    pub(crate) fn new(
        device: &Device,
        config: &Config,
        geometry: &Geometry,
        structure: &SetLayout,
    ) -> Result<Self, AdsError> {
        let sets = [geometry.layout(), structure];
        let constants = config.constants();
        let compute = |name: &str| -> Result<ComputePipeline, AdsError> {
            let shader = module(config, name)?;
            Ok(device.create_compute_pipeline(&ComputePipelineDesc {
                name: shader.name,
                spirv: shader.words(),
                sets: &sets,
                push_constant_bytes: 8,
                constants: &constants,
            })?)
        };
        let vertex = module(config, "build_raster")?;
        let raster = |name: &str| -> Result<RasterPipeline, AdsError> {
            let shader = module(config, name)?;
            Ok(device.create_raster_pipeline(&RasterPipelineDesc {
                name: shader.name,
                vertex_spirv: vertex.words(),
                fragment_spirv: shader.words(),
                sets: &sets,
                push_constant_bytes: 8,
                constants: &constants,
            })?)
        };
        let lengths = || -> Result<Lengths, AdsError> {
            Ok(Lengths {
                count: raster("build_4_count")?,
                blocks: compute("build_5_scan_blocks")?,
                sums: compute("build_5_scan_sums")?,
                places: compute("build_5_scan_places")?,
            })
        };
        Ok(Self {
            near: compute("build_1_near")?,
            bounds: raster("build_2_bounds")?,
            scale: (config.buckets > 1).then(|| compute("build_3_scale")).transpose()?,
            lengths: (config.storage == Storage::Contiguous).then(lengths).transpose()?,
            store: raster("build_6_store")?,
            status: compute("build_7_status")?,
        })
    }

    /// Records all passes. The host has written `header_source`.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, target: &Target<'_>) {
        let cells = cell_count(target.config.tiles());
        let lists = cells * u64::from(target.config.buckets);
        let triangles = u64::from(target.geometry.triangle_count());
        let group = u64::from(PRIMITIVE_GROUP_SIZE);

        recorder.begin_pass("primitive/build_0_clear");
        recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
        recorder.copy(target.header_source, 0, target.header, 0, target.header.size());
        for pool in [target.bounds, target.lists] {
            recorder.fill(pool, 0, pool.size(), 0);
        }
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::VERTEX_READ | Access::FRAGMENT);
        recorder.end_pass();

        recorder.begin_pass("primitive/build_1_near");
        self.dispatch(recorder, &self.near, target, triangles.div_ceil(group));
        recorder.end_pass();

        recorder.begin_pass("primitive/build_2_bounds");
        self.draw(recorder, &self.bounds, target);
        recorder.barrier(Access::FRAGMENT, Access::COMPUTE | Access::FRAGMENT);
        recorder.end_pass();

        if let Some(scale) = &self.scale {
            recorder.begin_pass("primitive/build_3_scale");
            self.dispatch(recorder, scale, target, cells.div_ceil(group));
            recorder.barrier(Access::COMPUTE, Access::FRAGMENT | Access::COMPUTE);
            recorder.end_pass();
        }

        if let Some(lengths) = &self.lengths {
            recorder.begin_pass("primitive/build_4_count");
            self.draw(recorder, &lengths.count, target);
            recorder.barrier(Access::FRAGMENT, Access::COMPUTE);
            recorder.end_pass();

            recorder.begin_pass("primitive/build_5_scan");
            self.dispatch(recorder, &lengths.blocks, target, lists.div_ceil(u64::from(PRIMITIVE_SCAN_BLOCK)));
            recorder.barrier(Access::COMPUTE, Access::COMPUTE);
            self.dispatch(recorder, &lengths.sums, target, 1);
            recorder.barrier(Access::COMPUTE, Access::COMPUTE);
            self.dispatch(recorder, &lengths.places, target, lists.div_ceil(group));
            recorder.barrier(Access::COMPUTE, Access::FRAGMENT | Access::COMPUTE);
            recorder.end_pass();
        }

        recorder.begin_pass("primitive/build_6_store");
        self.draw(recorder, &self.store, target);
        recorder.barrier(Access::FRAGMENT, Access::COMPUTE);
        recorder.end_pass();

        recorder.begin_pass("primitive/build_7_status");
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
        recorder.push_constants(bytes_of(&target.address));
    }

    /// More groups than one dimension holds go to the second.
    fn dispatch(
        &self,
        recorder: &mut Recorder<'_>,
        pipeline: &ComputePipeline,
        target: &Target<'_>,
        groups: u64,
    ) {
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
        let side = target.config.tiles() + 2;
        recorder.begin_rendering(side, side);
        recorder.bind_raster(pipeline);
        self.bind(recorder, target);
        recorder.draw(3 * triangles, 6, 0);
        recorder.end_rendering();
    }
}
