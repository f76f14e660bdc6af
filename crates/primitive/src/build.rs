//! Build of the lists: its pipelines, and its passes in the order they are recorded.

use std::mem::offset_of;

use rasray_ads::AdsError;
use rasray_ads::kit::{BuildPipelines, BuildTarget, Lengths, Pyramid, Visit, Visits};
use rasray_gpu::{Access, ComputePipeline, Recorder};

use crate::layout::{cell_count, faces};
use crate::{Config, Coverage, Header, Pool, Storage};

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    near: ComputePipeline,
    bounds: Visit,
    scale: Option<ComputePipeline>,
    pyramid: Option<Pyramid>,
    lengths: Option<Lengths>,
    store: Visit,
    status: ComputePipeline,
}

impl Build {
    pub(crate) fn new(pipelines: &BuildPipelines<'_>, config: &Config) -> Result<Self, AdsError> {
        let touching = pipelines.touching();
        let pipelines =
            if config.coverage == Coverage::ConservativeExtension { &touching } else { pipelines };
        let visits = Visits { pipelines, builder: config.builder, groups: offset_of!(Header, groups) };
        let visit = |name| visits.visit("build_raster", name, "");
        let lengths = || Lengths::new(pipelines, visit("build_5_count")?, "build_6_scan");
        let compute = |wanted: bool, name| wanted.then(|| pipelines.compute(name)).transpose();
        Ok(Self {
            near: pipelines.compute("build_1_near")?,
            bounds: visit("build_2_bounds")?,
            scale: compute(config.buckets > 1, "build_3_scale")?,
            pyramid: config.has_pyramid().then(|| Pyramid::new(pipelines, "build_4_pyramid")).transpose()?,
            lengths: (config.storage == Storage::Contiguous).then(lengths).transpose()?,
            store: visit("build_7_store")?,
            status: pipelines.compute("build_8_status")?,
        })
    }

    /// Records all passes of a build.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let cells = cell_count(config);
        let lists = cells * u64::from(config.buckets);
        let shaders = Access::COMPUTE | Access::FRAGMENT;
        let views = [faces(config)];

        let readers = shaders | Access::VERTEX_READ;
        target.record_header(recorder, "primitive/build_0_header", &[Pool::Bounds, Pool::Lists], readers);
        let triangles = target.geometry.triangle_count().into();
        target.items_pass(recorder, "primitive/build_1_near", &self.near, triangles, 0, shaders);
        self.bounds.record(recorder, target, &views);
        if let Some(scale) = &self.scale {
            target.items_pass(recorder, "primitive/build_3_scale", scale, cells, 0, shaders);
        }
        if let Some(pyramid) = &self.pyramid {
            pyramid.record(recorder, target, "primitive/build_4_pyramid", &views, shaders);
        }
        if let Some(lengths) = &self.lengths {
            lengths.record(recorder, target, &views, lists, shaders);
        }
        self.store.record(recorder, target, &views);
        target.status_pass(recorder, "primitive/build_8_status", &self.status);
    }
}
