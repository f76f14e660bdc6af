//! The build of a grid: pipelines, and the passes in the order they are recorded.

use std::mem::offset_of;

use rasray_ads::{AdsError, BuildPipelines, BuildTarget, Builder, LargePass, Scan, Visit, Visits};
use rasray_gpu::{Access, ComputePipeline, Recorder};

use crate::{Header, Pool};

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    large: Option<LargePass>,
    count: Visit,
    scan: Scan,
    store: Visit,
    status: ComputePipeline,
}

impl Build {
    pub(crate) fn new(pipelines: &BuildPipelines<'_>) -> Result<Self, AdsError> {
        let visits = Visits { pipelines, builder: Builder::Binning, groups: offset_of!(Header, groups) };
        let visit = |name| visits.visit("", name, "");
        Ok(Self {
            large: visits.large("build_1_large")?,
            count: visit("build_2_count")?,
            scan: Scan::new(pipelines, "build_3_scan")?,
            store: visit("build_4_store")?,
            status: pipelines.compute("build_5_status")?,
        })
    }

    /// Records all passes.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, cells: u64, target: BuildTarget<'_>) {
        target.record_header(recorder, "grid/build_0_header", &[Pool::Lists], Access::COMPUTE);
        if let Some(large) = &self.large {
            large.record(recorder, target);
        }
        self.count.record(recorder, target, &[]);
        self.scan.record(recorder, target, "grid/build_3_scan", cells, 0, Access::COMPUTE);
        self.store.record(recorder, target, &[]);
        target.status_pass(recorder, "grid/build_5_status", &self.status);
    }
}
