//! The build: pipelines, and the passes in the order they are recorded.

use rasray_ads::{AdsError, BuildPipelines, BuildTarget, Scan};
use rasray_gpu::{Access, ComputePipeline, RasterPipeline, Recorder};
use rasray_shaders_glsl::constants::primitive::PRIMITIVE_GROUP_SIZE;

use crate::layout::cell_count;
use crate::{Config, Storage};

/// Faces of the cube.
const VIEWS: u32 = 6;

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
    scan: Scan,
}

impl Build {
    pub(crate) fn new(pipelines: &BuildPipelines<'_>, config: &Config) -> Result<Self, AdsError> {
        let raster = |name| pipelines.raster("build_raster", name);
        let lengths = || -> Result<Lengths, AdsError> {
            Ok(Lengths { count: raster("build_4_count")?, scan: Scan::new(pipelines, "build_5_scan")? })
        };
        Ok(Self {
            near: pipelines.compute("build_1_near")?,
            bounds: raster("build_2_bounds")?,
            scale: (config.buckets > 1).then(|| pipelines.compute("build_3_scale")).transpose()?,
            lengths: (config.storage == Storage::Contiguous).then(lengths).transpose()?,
            store: raster("build_6_store")?,
            status: pipelines.compute("build_7_status")?,
        })
    }

    /// Records all passes.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let cells = cell_count(config.tiles());
        let lists = cells * u64::from(config.buckets);
        let triangles = u64::from(target.geometry.triangle_count());
        let group = u64::from(PRIMITIVE_GROUP_SIZE);
        let side = config.tiles() + 2;
        let shaders = Access::COMPUTE | Access::FRAGMENT;

        let readers = shaders | Access::VERTEX_READ;
        target.pools.record_header(recorder, "primitive/build_0_clear", &["bounds", "lists"], readers);
        target.compute_pass(
            recorder,
            "primitive/build_1_near",
            &self.near,
            triangles.div_ceil(group),
            0,
            Access::COMPUTE,
        );
        target.raster_pass(recorder, "primitive/build_2_bounds", &self.bounds, side, VIEWS);
        if let Some(scale) = &self.scale {
            let groups = cells.div_ceil(group);
            target.compute_pass(recorder, "primitive/build_3_scale", scale, groups, 0, shaders);
        }
        if let Some(lengths) = &self.lengths {
            target.raster_pass(recorder, "primitive/build_4_count", &lengths.count, side, VIEWS);
            lengths.scan.record(recorder, target, "primitive/build_5_scan", lists, 0, shaders);
        }
        target.raster_pass(recorder, "primitive/build_6_store", &self.store, side, VIEWS);
        target.status_pass(recorder, "primitive/build_7_status", &self.status);
    }
}
