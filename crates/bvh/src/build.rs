//! The build on the device: pipelines, and the passes in the order they are recorded.

use rasray_ads::{AdsError, BuildPipelines, BuildTarget, Scan};
use rasray_gpu::{Access, ComputePipeline, Recorder, Stage};
use rasray_shaders_glsl::constants::bvh::{BVH_DIGIT_VALUES, BVH_DIGITS, BVH_GROUP_SIZE, BVH_SORT_CHUNK};

use crate::layout::union_levels;
use crate::{Builder, Config, Pool};

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    of_builder: OfBuilder,
    records: ComputePipeline,
    status: ComputePipeline,
}

#[derive(Debug)]
enum OfBuilder {
    Sah { boxes: ComputePipeline },
    Lbvh(Box<LbvhPipelines>),
}

#[derive(Debug)]
struct LbvhPipelines {
    codes: ComputePipeline,
    counts: ComputePipeline,
    scan: Scan,
    scatter: ComputePipeline,
    unions: ComputePipeline,
    topology: ComputePipeline,
    /// Where later builds keep the order of the first.
    refit: Option<ComputePipeline>,
}

impl Build {
    pub(crate) fn new(pipelines: &BuildPipelines<'_>, config: &Config) -> Result<Self, AdsError> {
        let compute = |name| pipelines.compute(name);
        let of_builder = match config.builder {
            Builder::Sah => OfBuilder::Sah { boxes: compute("build_1_boxes")? },
            builder @ (Builder::Lbvh | Builder::Refit) => OfBuilder::Lbvh(Box::new(LbvhPipelines {
                codes: compute("build_2_codes")?,
                counts: compute("build_3_counts")?,
                scan: Scan::new(pipelines, "build_4_scan")?,
                scatter: compute("build_5_scatter")?,
                unions: compute("build_7_unions")?,
                topology: compute("build_8_topology")?,
                refit: if builder == Builder::Refit { Some(compute("build_9_refit")?) } else { None },
            })),
        };
        Ok(Self { of_builder, records: compute("build_6_records")?, status: compute("build_10_status")? })
    }

    /// Records what the host needs to know of the triangles. The host has written the header.
    pub(crate) fn record_boxes(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        let OfBuilder::Sah { boxes } = &self.of_builder else { return };
        record_header(recorder, target);
        recorder.begin_pass(Stage::Build, "bvh/build_1_boxes");
        target.dispatch(recorder, boxes, groups(target.geometry.triangle_count()), 0);
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_READ);
        recorder.end_pass();
    }

    /// Records all passes, but for those that order triangles where `keeps_order`. The host has written the header.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>, keeps_order: bool) {
        record_header(recorder, target);
        let triangles = target.geometry.triangle_count();
        let refit = match &self.of_builder {
            OfBuilder::Lbvh(pipelines) => pipelines.refit.as_ref().filter(|_| keeps_order),
            OfBuilder::Sah { .. } => None,
        };
        if let (OfBuilder::Lbvh(pipelines), None) = (&self.of_builder, refit) {
            pipelines.record_order(recorder, target);
        }
        pass(recorder, target, "bvh/build_6_records", &self.records, 0, triangles);
        if let OfBuilder::Lbvh(pipelines) = &self.of_builder {
            let (label, nodes) = match refit {
                Some(refit) => ("bvh/build_9_refit", refit),
                None => ("bvh/build_8_topology", &pipelines.topology),
            };
            pipelines.record_unions(recorder, target);
            pass(recorder, target, label, nodes, 0, triangles.saturating_sub(1));
        }
        target.status_pass(recorder, "bvh/build_10_status", &self.status);
    }
}

impl LbvhPipelines {
    /// Codes, and the order of the triangles by them.
    fn record_order(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        let triangles = target.geometry.triangle_count();
        let chunks = triangles.div_ceil(BVH_SORT_CHUNK);
        let counts = u64::from(chunks) * u64::from(BVH_DIGIT_VALUES);
        pass(recorder, target, "bvh/build_2_codes", &self.codes, 0, triangles);
        // Four digits take the keys from the first buffer to the second and back twice.
        for digit in 0..BVH_DIGITS {
            pass(recorder, target, "bvh/build_3_counts", &self.counts, digit, chunks);
            self.scan.record(recorder, target, "bvh/build_4_scan", counts, digit, Access::COMPUTE);
            pass(recorder, target, "bvh/build_5_scatter", &self.scatter, digit, chunks);
        }
    }

    /// Unions of the records' boxes.
    fn record_unions(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        let triangles = target.geometry.triangle_count();
        for (level, boxes) in (0..).zip(union_levels(triangles.into())) {
            pass(recorder, target, "bvh/build_7_unions", &self.unions, level, boxes as u32);
        }
    }
}

fn groups(items: u32) -> u64 {
    items.div_ceil(BVH_GROUP_SIZE).into()
}

/// A pass with an invocation per item, visible to the next one.
fn pass(
    recorder: &mut Recorder<'_>,
    target: BuildTarget<'_>,
    label: &str,
    pipeline: &ComputePipeline,
    step: u32,
    items: u32,
) {
    target.compute_pass(recorder, label, pipeline, groups(items), step, Access::COMPUTE);
}

fn record_header(recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
    target.record_header(recorder, "bvh/build_0_header", &[] as &[Pool], Access::COMPUTE);
}
