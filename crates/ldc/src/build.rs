//! The build: pipelines, and the passes in the order they are recorded.

use rasray_ads::{AdsError, BuildPipelines, BuildTarget, Scan, SceneBinding};
use rasray_gpu::{Access, ComputePipeline, RasterPipeline, Recorder};
use rasray_shaders_glsl::constants::ads::LONG_LIST_ROUNDS;
use rasray_shaders_glsl::constants::ldc::LDC_GROUP_SIZE;

use crate::layout::{cell_count, long_capacity};
use crate::{Config, Coverage};

/// The view of a triangle is chosen by the vertex stage, so every triangle is drawn once.
const DRAWS: u32 = 1;

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    count: RasterPipeline,
    scan: Scan,
    store: RasterPipeline,
    sort: ComputePipeline,
    sort_long: ComputePipeline,
    fringe: Option<RasterPipeline>,
    status: ComputePipeline,
}

impl Build {
    pub(crate) fn new(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let alpha = scene.is_some_and(|scene| scene.alpha_masked);
        let (count, store) = if alpha {
            ("build_1_count.alpha", "build_3_store.alpha")
        } else {
            ("build_1_count", "build_3_store")
        };
        let kept = config.coverage == Coverage::Conservative;
        Ok(Self {
            count: pipelines.raster("build_raster", count)?,
            scan: Scan::new(pipelines, "build_2_scan")?,
            store: pipelines.raster("build_raster", store)?,
            sort: pipelines.compute("build_4_sort")?,
            sort_long: pipelines.compute("build_5_sort_long")?,
            fringe: kept.then(|| pipelines.raster("build_raster.fringe", "build_6_fringe")).transpose()?,
            status: pipelines.compute("build_7_status")?,
        })
    }

    /// Records all passes.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let cells = cell_count(config.resolution);
        let side = config.resolution + 2;
        let shaders = Access::COMPUTE | Access::FRAGMENT;

        // Depths that share a word are put into it one after the other.
        let cleared: &[&str] = match config.depth {
            crate::Depth::Bits16 => &["lists", "blocks", "heads", "depths"],
            crate::Depth::Bits32 => &["lists", "blocks", "heads"],
        };
        target.pools.record_header(recorder, "ldc/build_0_clear", cleared, shaders | Access::VERTEX_READ);
        target.raster_pass(recorder, "ldc/build_1_count", &self.count, side, DRAWS);
        self.scan.record(recorder, target, "ldc/build_2_scan", cells, 0, shaders);
        target.raster_pass(recorder, "ldc/build_3_store", &self.store, side, DRAWS);
        let groups = |items: u64| items.div_ceil(u64::from(LDC_GROUP_SIZE));
        target.compute_pass(recorder, "ldc/build_4_sort", &self.sort, groups(cells), 0, shaders);
        let long = groups(long_capacity(config, target.pools.sizes()));
        let rounds = LONG_LIST_ROUNDS;
        target.rounds_pass(recorder, "ldc/build_5_sort_long", &self.sort_long, long, rounds, shaders);
        if let Some(fringe) = &self.fringe {
            target.raster_pass(recorder, "ldc/build_6_fringe", fringe, side, DRAWS);
        }
        target.status_pass(recorder, "ldc/build_7_status", &self.status);
    }
}
