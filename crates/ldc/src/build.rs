//! Build of the layered depth cube: its pipelines, and its passes in the order they are recorded.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, BuildTarget, LargePass, Lengths, ListSort, ViewDraw, Visit, Visits};
use rasray_ads::{AdsError, SceneBinding};
use rasray_gpu::{Access, ComputePipeline, RasterPipeline, Recorder, Stage};

use crate::layout::{cell_count, layer_capacity, scratch};
use crate::{Accept, Config, Depth, Header, Making, Payload, Pool};

/// Pipelines of the build, which are the design of [`LayeredDepthCube`](crate::LayeredDepthCube).
#[derive(Debug)]
pub struct Build {
    large: Option<LargePass>,
    lengths: Lengths,
    layers: Layers,
    conservative: Option<Visit>,
    attributes: Option<ComputePipeline>,
    status: ComputePipeline,
}

/// Pipelines of the passes that make the layers.
#[derive(Debug)]
enum Layers {
    Single {
        store: Visit,
        sort: ListSort,
    },
    /// Peeling, one layer after the other (`peel`), and a last draw that advances lists from their first
    /// place to their end (`grow`).
    Peel {
        peel: RasterPipeline,
        grow: RasterPipeline,
    },
}

impl Build {
    /// Makes the pipelines that a configuration needs.
    ///
    /// # Errors
    /// The configuration needs the scene's shaders and there is no scene, or the device refuses a pipeline.
    pub(crate) fn new(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let stored = config.payload == Payload::Attributes;
        if stored {
            SceneBinding::for_payload(scene, "attributes")?;
        }
        let masked = SceneBinding::mask_suffix(scene);
        let visits = Visits { pipelines, builder: config.builder, groups: offset_of!(Header, groups) };
        let proposed =
            if config.accept == Accept::Triangle { "build_raster.conservative" } else { "build_raster" };
        let covered = |name| visits.visit(proposed, name, masked);
        let draw = |name| pipelines.raster(proposed, &format!("{name}{masked}"));
        let layers = match config.making {
            Making::Single => Layers::Single {
                store: covered("build_4_store")?,
                sort: ListSort::new(pipelines, "build_7_sort", "", "build_8_sort_long")?,
            },
            Making::Peel => Layers::Peel { peel: draw("build_5_peel")?, grow: draw("build_2_count")? },
        };
        Ok(Self {
            large: visits.large("build_1_large")?,
            lengths: Lengths::new(pipelines, covered("build_2_count")?, "build_3_scan")?,
            layers,
            conservative: config
                .has_conservative_lists()
                .then(|| visits.visit("build_raster.conservative", "build_6_conservative", ""))
                .transpose()?,
            attributes: stored.then(|| pipelines.compute("build_9_attributes")).transpose()?,
            status: pipelines.compute("build_10_status")?,
        })
    }

    /// Records all passes of a build.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let cells = cell_count(config.resolution);
        let side = config.resolution + 2;
        let shaders = Access::COMPUTE | Access::FRAGMENT;

        // Two depths of 16 bits share a word and are stored one after the other, so their words start at
        // zero. Peeling counts its layers in the scratch pool.
        let cleared: &[Pool] = match (config.making, config.depth) {
            (Making::Single, Depth::Bits16) => &[Pool::Lists, Pool::Blocks, Pool::Heads, Pool::Depths],
            (Making::Single, Depth::Bits32) => &[Pool::Lists, Pool::Blocks, Pool::Heads],
            (Making::Peel, _) => &[Pool::Lists, Pool::Blocks, Pool::Heads, Pool::Scratch],
        };
        target.record_header(recorder, "ldc/build_0_header", cleared, shaders | Access::VERTEX_READ);
        if let Some(large) = &self.large {
            large.record(recorder, target);
        }
        let views = [ViewDraw { side, views: config.passes, first: 0 }];
        self.lengths.record(recorder, target, &views, cells, shaders);
        match &self.layers {
            Layers::Single { store, .. } => store.record(recorder, target, &views),
            Layers::Peel { peel, grow } => {
                let layers = layer_capacity(config, target.pools.sizes()) as u32;
                record_peeling(recorder, peel, grow, layers, views[0], target);
            }
        }
        if let Some(conservative) = &self.conservative {
            conservative.record(recorder, target, &views);
        }
        // Long lists are stored where the large-triangle queue was, so sorting follows all passes over
        // triangles.
        if let Layers::Single { sort, .. } = &self.layers {
            let long = scratch(config).long_capacity(target.pools.sizes());
            sort.record(recorder, target, cells, false, long, shaders);
        }
        if let Some(attributes) = &self.attributes {
            let fragments = target.pools.sizes().elements_of(Pool::Payload);
            target.items_pass(recorder, "ldc/build_9_attributes", attributes, fragments, 0, shaders);
        }
        target.status_pass(recorder, "ldc/build_10_status", &self.status);
    }
}

/// Records two draws per layer, and one that advances lists to their ends.
fn record_peeling(
    recorder: &mut Recorder<'_>,
    peel: &RasterPipeline,
    grow: &RasterPipeline,
    layers: u32,
    ViewDraw { side, views, .. }: ViewDraw,
    target: BuildTarget<'_>,
) {
    let shaders = Access::COMPUTE | Access::FRAGMENT;
    recorder.begin_pass(Stage::Build, "ldc/build_5_peel");
    recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
    for pool in [Pool::Depths, Pool::Payload].map(|pool| target.pools.pool(pool)) {
        recorder.fill(pool, 0, pool.size(), u32::MAX);
    }
    recorder.barrier(Access::TRANSFER_WRITE, shaders);
    for step in 0..2 * layers {
        target.draw(recorder, peel, side, views, step);
        recorder.barrier(Access::FRAGMENT, shaders);
    }
    target.draw(recorder, grow, side, views, 1);
    recorder.barrier(Access::FRAGMENT, shaders);
    recorder.end_pass();
}
