//! Build of the bricks: its pipelines, and its passes in the order they are recorded.

use std::mem::offset_of;

use rasray_ads::AdsError;
use rasray_ads::kit::{BuildPipelines, BuildTarget, Scan, ViewDraw, Visit, Visits};
use rasray_gpu::{Access, ComputePipeline, Recorder};

use crate::layout::bricks_of;
use crate::{Config, Header, Pool, Views};

/// Bytes of the group counts of an indirect dispatch.
const GROUP_BYTES: u64 = 12;

/// Pass that runs once per level, over the bricks of that level.
#[derive(Debug)]
struct OfLevel {
    label: String,
    pipeline: ComputePipeline,
    /// Offset in the header of the group counts of the first level.
    groups: usize,
}

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    /// Passes of [`Views::Cube`] that find the near region, and the slices of faces from depths. Views along
    /// axes have neither.
    depths: Option<[(String, ComputePipeline); 2]>,
    records: Visit,
    /// Passes that run for each level.
    level: [OfLevel; 2],
    /// Passes that divide cells of a level; `None` if no cell is divided.
    divide: Option<[OfLevel; 2]>,
    scan: Scan,
    store: ComputePipeline,
    reaches: Option<[(String, ComputePipeline); 3]>,
    triangles: Option<ComputePipeline>,
    status: ComputePipeline,
}

impl Build {
    pub(crate) fn new(pipelines: &BuildPipelines<'_>, config: &Config) -> Result<Self, AdsError> {
        let named = |name| -> Result<_, AdsError> { Ok((pipelines.label(name), pipelines.compute(name)?)) };
        let depths = || -> Result<_, AdsError> { Ok([named("build_1_near")?, named("build_2_slices")?]) };
        let reaches = || -> Result<_, AdsError> {
            Ok([
                named("build_10_reach_slices")?,
                named("build_11_reach_columns")?,
                named("build_12_reach_rows")?,
            ])
        };
        let (of_bricks, of_records) = (offset_of!(Header, brick_groups), offset_of!(Header, record_groups));
        let of_level = |name, groups| -> Result<_, AdsError> {
            Ok(OfLevel { label: pipelines.label(name), pipeline: pipelines.compute(name)?, groups })
        };
        let divide = || -> Result<_, AdsError> {
            Ok([of_level("build_6_divide", of_bricks)?, of_level("build_7_refine", of_records)?])
        };
        Ok(Self {
            depths: (config.views == Views::Cube).then(depths).transpose()?,
            records: Visits { pipelines, builder: config.builder, groups: offset_of!(Header, groups) }
                .visit("build_raster", "build_3_records", "")?,
            level: [of_level("build_4_cells", of_bricks)?, of_level("build_5_count", of_records)?],
            divide: config.divides().then(divide).transpose()?,
            scan: Scan::new(pipelines, "build_8_scan")?,
            store: pipelines.compute("build_9_store")?,
            reaches: config.skip.then(reaches).transpose()?,
            triangles: config.corners.then(|| pipelines.compute("build_13_triangles")).transpose()?,
            status: pipelines.compute("build_14_status")?,
        })
    }

    /// Records all passes of a build; `cells` are the columns, rows and slices of a view.
    pub(crate) fn record(
        &self,
        recorder: &mut Recorder<'_>,
        config: &Config,
        cells: [u32; 3],
        target: BuildTarget<'_>,
    ) {
        let sizes = target.pools.sizes();
        let triangles = u64::from(target.geometry.triangle_count());
        let (records, lists) = (sizes.elements_of(Pool::Records), sizes.elements_of(Pool::Lists));
        let (along, bricks) = bricks_of(config.views, cells);
        let pass = |recorder: &mut Recorder<'_>, label, pipeline, invocations: u64, readers| {
            target.items_pass(recorder, label, pipeline, invocations, 0, readers);
        };
        let compute = Access::COMPUTE;
        // The passes before count the workgroups of indirect passes.
        let counted = compute | Access::INDIRECT_READ;

        let readers = counted | Access::FRAGMENT | Access::VERTEX_READ;
        target.record_header(recorder, "bricks/build_0_header", &[Pool::Lists, Pool::Bricks], readers);
        if let Some([(near_label, near), (slices_label, slices)]) = &self.depths {
            pass(recorder, near_label, near, triangles, compute);
            pass(recorder, slices_label, slices, 1, compute | Access::FRAGMENT);
        }
        let views = ViewDraw { side: cells[0].max(cells[1]) + 2, views: config.views.count(), first: 0 };
        self.records.record(recorder, target, &[views]);
        let last = config.most_divisions();
        for level in 0..=last {
            let divide = self.divide.iter().flatten().filter(|_| level < last);
            for OfLevel { label, pipeline, groups } in self.level.iter().chain(divide) {
                let place = *groups as u64 + GROUP_BYTES * u64::from(level);
                target.indirect_pass(recorder, label, pipeline, place, level, counted);
            }
        }
        self.scan.record(recorder, target, "bricks/build_8_scan", lists, 0, compute);
        pass(recorder, "bricks/build_9_store", &self.store, records, compute);
        for (axis, (label, reach)) in self.reaches.iter().flatten().enumerate() {
            // The order is along slices, then columns, then rows.
            let bricks_of_line = [along[2], along[0], along[1]][axis];
            pass(recorder, label, reach, bricks / bricks_of_line, compute);
        }
        if let Some(copy) = &self.triangles {
            pass(recorder, "bricks/build_13_triangles", copy, triangles, compute);
        }
        target.status_pass(recorder, "bricks/build_14_status", &self.status);
    }
}
