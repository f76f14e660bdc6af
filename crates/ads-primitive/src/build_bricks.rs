//! The build of bricks: pipelines, and the passes in the order they are recorded.

use std::mem::offset_of;

use rasray_ads::{AdsError, BuildPipelines, BuildTarget, Scan};
use rasray_gpu::{Access, ComputePipeline, Recorder};
use rasray_shaders_glsl::constants::primitive::PRIMITIVE_GROUP_SIZE;

use crate::layout::brick_count;
use crate::{Config, Header};

/// What the steps of the scan run over.
const SCAN_LISTS: u32 = 0;
const SCAN_BRICKS: u32 = 1;

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct BuildBricks {
    near: ComputePipeline,
    slices: ComputePipeline,
    bin: ComputePipeline,
    bin_many: ComputePipeline,
    mark: ComputePipeline,
    cells: ComputePipeline,
    scan: Scan,
    count: ComputePipeline,
    store: ComputePipeline,
    reaches: Option<[(&'static str, ComputePipeline); 3]>,
    triangles: Option<ComputePipeline>,
    status: ComputePipeline,
}

impl BuildBricks {
    pub(crate) fn new(pipelines: &BuildPipelines<'_>, config: &Config) -> Result<Self, AdsError> {
        let reach = |label, name| Ok::<_, AdsError>((label, pipelines.compute(name)?));
        let reaches = || -> Result<_, AdsError> {
            Ok([
                reach("primitive/bricks_10_reach_slices", "bricks_10_reach_slices")?,
                reach("primitive/bricks_10_reach_columns", "bricks_10_reach_columns")?,
                reach("primitive/bricks_10_reach_rows", "bricks_10_reach_rows")?,
            ])
        };
        Ok(Self {
            near: pipelines.compute("build_1_near")?,
            slices: pipelines.compute("bricks_2_slices")?,
            bin: pipelines.compute("bricks_3_bin")?,
            bin_many: pipelines.compute("bricks_3_bin_many")?,
            mark: pipelines.compute("bricks_4_mark")?,
            cells: pipelines.compute("bricks_5_cells")?,
            scan: Scan::new(pipelines, "build_5_scan")?,
            count: pipelines.compute("bricks_7_count")?,
            store: pipelines.compute("bricks_9_store")?,
            reaches: config.skip.then(reaches).transpose()?,
            triangles: config
                .keeps_corners()
                .then(|| pipelines.compute("bricks_11_triangles"))
                .transpose()?,
            status: pipelines.compute("build_7_status")?,
        })
    }

    /// Records all passes.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let sizes = target.pools.sizes();
        let triangles = u64::from(target.geometry.triangle_count());
        let (bricks, records, lists) =
            (brick_count(config), sizes.elements("records"), sizes.elements("lists"));
        let pass = |recorder: &mut Recorder<'_>, label, pipeline, invocations: u64, readers| {
            let groups = invocations.div_ceil(PRIMITIVE_GROUP_SIZE.into());
            target.compute_pass(recorder, label, pipeline, groups, 0, readers);
        };
        let compute = Access::COMPUTE;

        target.pools.record_header(recorder, "primitive/bricks_0_clear", &["lists", "bricks"], compute);
        pass(recorder, "primitive/build_1_near", &self.near, triangles, compute);
        pass(recorder, "primitive/bricks_2_slices", &self.slices, 1, compute);
        let arguments = compute | Access::INDIRECT_READ;
        pass(recorder, "primitive/bricks_3_bin", &self.bin, triangles, arguments);
        let groups = offset_of!(Header, groups) as u64;
        target.indirect_pass(recorder, "primitive/bricks_3_bin_many", &self.bin_many, groups, compute);
        pass(recorder, "primitive/bricks_4_mark", &self.mark, records, compute);
        pass(recorder, "primitive/bricks_5_cells", &self.cells, bricks, compute);
        self.scan.record(recorder, target, "primitive/bricks_6_scan", bricks, SCAN_BRICKS, compute);
        pass(recorder, "primitive/bricks_7_count", &self.count, records, compute);
        self.scan.record(recorder, target, "primitive/bricks_8_scan", lists, SCAN_LISTS, compute);
        pass(recorder, "primitive/bricks_9_store", &self.store, records, compute);
        for (label, reach) in self.reaches.iter().flatten() {
            pass(recorder, label, reach, bricks, compute);
        }
        if let Some(copy) = &self.triangles {
            pass(recorder, "primitive/bricks_11_triangles", copy, triangles, compute);
        }
        target.status_pass(recorder, "primitive/build_7_status", &self.status);
    }
}
