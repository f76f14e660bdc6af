//! Build of the A-buffer: its pipelines, and its passes in the order they are recorded.

use std::mem::offset_of;

use rasray_ads::kit::{
    BuildPipelines, BuildTarget, LargePass, Lengths, ListSort, Pyramid, ViewDraw, Visit, Visits, workgroups,
};
use rasray_ads::{AdsError, SceneBinding};
use rasray_gpu::{Access, ComputePipeline, RasterPipeline, Recorder, Stage};

use crate::layout::{box_count, cell_count, draws, scratch};
use crate::{Bounds, Config, Coverage, Header, March, Pool, Storage};

/// Pipelines that find boxes around objects and draw them, which gives cells their depth bounds.
#[derive(Debug)]
struct Boxes {
    find: ComputePipeline,
    draw: RasterPipeline,
}

impl Boxes {
    fn new(pipelines: &BuildPipelines<'_>) -> Result<Self, AdsError> {
        Ok(Self {
            find: pipelines.compute("build_3_bounds.find")?,
            draw: pipelines.raster("build_raster.boxes", "build_3_bounds.boxes")?,
        })
    }

    fn record(
        &self,
        recorder: &mut Recorder<'_>,
        target: BuildTarget<'_>,
        draws: &[ViewDraw],
        triangles: u64,
    ) {
        let vertices = 3 * box_count(target.geometry.desc().draw_count);
        recorder.begin_pass(Stage::Build, "abuffer/build_3_bounds");
        target.dispatch(recorder, &self.find, workgroups(triangles), 0);
        recorder.barrier(Access::COMPUTE, Access::VERTEX_READ | Access::FRAGMENT);
        for draw in draws {
            target.draw_vertices(recorder, &self.draw, *draw, vertices);
        }
        recorder.barrier(Access::FRAGMENT, Access::COMPUTE | Access::FRAGMENT);
        recorder.end_pass();
    }
}

/// Pipelines of the build, which are the design of an [`ABuffer`](crate::ABuffer).
#[derive(Debug)]
pub struct Build {
    near: ComputePipeline,
    large: Option<LargePass>,
    bounds: Option<Visit>,
    boxes: Option<Boxes>,
    scale: Option<ComputePipeline>,
    lengths: Option<Lengths>,
    store: Visit,
    conservative: Option<Visit>,
    slices: Option<ComputePipeline>,
    lost: ComputePipeline,
    pyramid: Option<Pyramid>,
    sort: Option<ListSort>,
    status: ComputePipeline,
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
        let attributes = config.payload.needs_scene();
        if attributes {
            SceneBinding::for_payload(scene, config.payload.name())?;
        }
        let masked = SceneBinding::mask_suffix(scene);
        let stored = if attributes { ".attributes" } else { masked };
        let visits = Visits { pipelines, builder: config.builder, groups: offset_of!(Header, groups) };
        let covered = |name, variant| visits.visit("build_raster", name, variant);
        let scaled = config.has_buckets() && config.accept.needs_triangles();
        let lengths = || Lengths::new(pipelines, covered("build_5_count", masked)?, "build_6_scan");
        let boxed = config.bounds == Bounds::Boxes;
        let sorted = if config.storage == Storage::Paged { ".pages" } else { "" };
        let sort = || ListSort::new(pipelines, "build_12_sort", sorted, "build_13_sort_long");
        Ok(Self {
            near: pipelines.compute("build_1_near")?,
            large: visits.large("build_2_large")?,
            bounds: (config.has_bounds_pass() && !boxed)
                .then(|| covered("build_3_bounds", masked))
                .transpose()?,
            boxes: boxed.then(|| Boxes::new(pipelines)).transpose()?,
            scale: scaled.then(|| pipelines.compute("build_4_scale")).transpose()?,
            lengths: (config.storage == Storage::Sb).then(lengths).transpose()?,
            store: if config.tests_triangles() {
                visits.visit("build_raster.conservative", "build_7_store", ".conservative")?
            } else {
                covered("build_7_store", stored)?
            },
            conservative: (config.coverage == Coverage::EdgeOn)
                .then(|| visits.visit("build_raster.conservative", "build_8_conservative", ""))
                .transpose()?,
            slices: config
                .has_conservative_lists()
                .then(|| pipelines.compute("build_9_slices"))
                .transpose()?,
            lost: pipelines.compute("build_10_lost")?,
            pyramid: (config.march == March::Pyramid)
                .then(|| Pyramid::new(pipelines, "build_11_pyramid"))
                .transpose()?,
            sort: config.sort.then(sort).transpose()?,
            status: pipelines.compute("build_14_status")?,
        })
    }

    /// Records all passes of a build.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let cells = cell_count(config);
        let lists = cells * u64::from(config.lists());
        let triangles = u64::from(target.geometry.triangle_count());
        let draws = draws(config);
        let shaders = Access::COMPUTE | Access::FRAGMENT;

        // Backward links of new nodes and depths of unused slots have to be zero. The build writes all other
        // words of a node.
        let paged = config.storage == Storage::Paged;
        let cleared: &[Pool] = if config.storage.is_doubly_linked() || paged {
            &[Pool::Bounds, Pool::Lists, Pool::Nodes]
        } else {
            &[Pool::Bounds, Pool::Lists]
        };
        let readers = shaders | Access::VERTEX_READ;
        target.record_header(recorder, "abuffer/build_0_header", cleared, readers);
        target.items_pass(recorder, "abuffer/build_1_near", &self.near, triangles, 0, Access::COMPUTE);
        if let Some(large) = &self.large {
            large.record(recorder, target);
        }
        if let Some(bounds) = &self.bounds {
            bounds.record(recorder, target, &draws);
        }
        if let Some(boxes) = &self.boxes {
            boxes.record(recorder, target, &draws, triangles);
        }
        if let Some(scale) = &self.scale {
            target.items_pass(recorder, "abuffer/build_4_scale", scale, cells, 0, shaders);
        }
        if let Some(lengths) = &self.lengths {
            lengths.record(recorder, target, &draws, lists, shaders);
        }
        self.store.record(recorder, target, &draws);
        if let Some(conservative) = &self.conservative {
            conservative.record(recorder, target, &draws);
        }
        if let Some(slices) = &self.slices {
            target.items_pass(recorder, "abuffer/build_9_slices", slices, cells, 0, shaders);
        }
        let marks = triangles.div_ceil(32);
        target.items_pass(recorder, "abuffer/build_10_lost", &self.lost, marks, 0, Access::COMPUTE);
        if let Some(pyramid) = &self.pyramid {
            pyramid.record(recorder, target, "abuffer/build_11_pyramid", &draws, Access::COMPUTE);
        }
        if let Some(sort) = &self.sort {
            // Each page is sorted separately.
            let (sorted, linked) = match config.storage {
                Storage::Paged => (target.pools.sizes().elements_of(Pool::Nodes), false),
                Storage::Sb => (lists, false),
                _ => (lists, true),
            };
            let long = scratch(config).long_capacity(target.pools.sizes());
            sort.record(recorder, target, sorted, linked, long, Access::COMPUTE);
        }
        target.status_pass(recorder, "abuffer/build_14_status", &self.status);
    }
}
