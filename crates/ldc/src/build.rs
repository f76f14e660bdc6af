//! The build: pipelines, and the passes in the order they are recorded.

use rasray_ads::{AdsError, BuildPipelines, BuildTarget, Scan, SceneBinding};
use rasray_gpu::{Access, ComputePipeline, RasterPipeline, Recorder};
use rasray_shaders_glsl::constants::ads::LONG_LIST_ROUNDS;
use rasray_shaders_glsl::constants::ldc::LDC_GROUP_SIZE;

use crate::layout::{cell_count, layer_capacity, long_capacity};
use crate::{Config, Coverage, Depth, Making, Payload};

/// The view of a triangle is chosen by the vertex stage, so every triangle is drawn once.
const DRAWS: u32 = 1;

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    count: RasterPipeline,
    scan: Scan,
    layers: Layers,
    fringe: Option<RasterPipeline>,
    attributes: Option<ComputePipeline>,
    status: ComputePipeline,
}

/// What makes the layers.
#[derive(Debug)]
enum Layers {
    Single { store: RasterPipeline, sort: ComputePipeline, sort_long: ComputePipeline },
    Peel { peel: RasterPipeline },
}

impl Build {
    /// # Errors
    /// The configuration needs the scene's shaders and there is no scene, or the device refuses a pipeline.
    pub(crate) fn new(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let alpha = scene.is_some_and(|scene| scene.alpha_masked);
        let stored = config.payload == Payload::Attributes;
        if stored {
            SceneBinding::for_attributes(scene)?;
        }
        let (count, store, peel) = if alpha {
            ("build_1_count.alpha", "build_3_store.alpha", "build_3_peel.alpha")
        } else {
            ("build_1_count", "build_3_store", "build_3_peel")
        };
        let layers = match config.making {
            Making::Single => Layers::Single {
                store: pipelines.raster("build_raster", store)?,
                sort: pipelines.compute("build_4_sort")?,
                sort_long: pipelines.compute("build_5_sort_long")?,
            },
            Making::Peel => Layers::Peel { peel: pipelines.raster("build_raster", peel)? },
        };
        let kept = config.coverage == Coverage::Conservative;
        Ok(Self {
            count: pipelines.raster("build_raster", count)?,
            scan: Scan::new(pipelines, "build_2_scan")?,
            layers,
            fringe: kept.then(|| pipelines.raster("build_raster.fringe", "build_6_fringe")).transpose()?,
            attributes: stored.then(|| pipelines.compute("build_7_attributes")).transpose()?,
            status: pipelines.compute("build_8_status")?,
        })
    }

    /// Records all passes.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let cells = cell_count(config.resolution);
        let side = config.resolution + 2;
        let shaders = Access::COMPUTE | Access::FRAGMENT;

        // Depths that share a word are put into it one after the other; layers that are peeled are counted.
        let cleared: &[&str] = match (config.making, config.depth) {
            (Making::Single, Depth::Bits16) => &["lists", "blocks", "heads", "depths"],
            (Making::Single, Depth::Bits32) => &["lists", "blocks", "heads"],
            (Making::Peel, _) => &["lists", "blocks", "heads", "scratch"],
        };
        target.pools.record_header(recorder, "ldc/build_0_clear", cleared, shaders | Access::VERTEX_READ);
        target.raster_pass(recorder, "ldc/build_1_count", &self.count, side, DRAWS);
        self.scan.record(recorder, target, "ldc/build_2_scan", cells, 0, shaders);
        match &self.layers {
            Layers::Single { store, sort, sort_long } => {
                target.raster_pass(recorder, "ldc/build_3_store", store, side, DRAWS);
                let groups = |items: u64| items.div_ceil(u64::from(LDC_GROUP_SIZE));
                target.compute_pass(recorder, "ldc/build_4_sort", sort, groups(cells), 0, shaders);
                let long = groups(long_capacity(config, target.pools.sizes()));
                let rounds = LONG_LIST_ROUNDS;
                target.rounds_pass(recorder, "ldc/build_5_sort_long", sort_long, long, rounds, shaders);
            }
            Layers::Peel { peel } => {
                let layers = layer_capacity(config, target.pools.sizes()) as u32;
                self.record_peeling(recorder, peel, layers, side, target);
            }
        }
        if let Some(fringe) = &self.fringe {
            target.raster_pass(recorder, "ldc/build_6_fringe", fringe, side, DRAWS);
        }
        if let Some(attributes) = &self.attributes {
            let groups = target.pools.sizes().elements("payload").div_ceil(u64::from(LDC_GROUP_SIZE));
            target.compute_pass(recorder, "ldc/build_7_attributes", attributes, groups, 0, shaders);
        }
        target.status_pass(recorder, "ldc/build_8_status", &self.status);
    }

    /// Two draws a layer, and one in which lists grow to where they end.
    fn record_peeling(
        &self,
        recorder: &mut Recorder<'_>,
        peel: &RasterPipeline,
        layers: u32,
        side: u32,
        target: BuildTarget<'_>,
    ) {
        let shaders = Access::COMPUTE | Access::FRAGMENT;
        recorder.begin_pass("ldc/build_3_peel");
        recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
        for pool in ["depths", "payload"].map(|name| target.pools.pool(name)) {
            recorder.fill(pool, 0, pool.size(), u32::MAX);
        }
        recorder.barrier(Access::TRANSFER_WRITE, shaders);
        for step in 0..2 * layers {
            target.draw(recorder, peel, side, DRAWS, step);
            recorder.barrier(Access::FRAGMENT, shaders);
        }
        target.draw(recorder, &self.count, side, DRAWS, 1);
        recorder.barrier(Access::FRAGMENT, shaders);
        recorder.end_pass();
    }
}
