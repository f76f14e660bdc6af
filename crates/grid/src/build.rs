//! Build of the grid: its pipelines, and its passes in the order they are recorded.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, BuildTarget, LargePass, Lengths, Visit, Visits};
use rasray_ads::{AdsError, Builder};
use rasray_gpu::{Access, ComputePipeline, Recorder};

use crate::{Header, Pool};

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    large: Option<LargePass>,
    lengths: Lengths,
    store: Visit,
    status: ComputePipeline,
}

impl Build {
    pub(crate) fn new(pipelines: &BuildPipelines<'_>) -> Result<Self, AdsError> {
        let visits = Visits { pipelines, builder: Builder::Binning, groups: offset_of!(Header, groups) };
        let visit = |name| visits.visit("", name, "");
        Ok(Self {
            large: visits.large("build_1_large")?,
            lengths: Lengths::new(pipelines, visit("build_2_count")?, "build_3_scan")?,
            store: visit("build_4_store")?,
            status: pipelines.compute("build_5_status")?,
        })
    }

    /// Records all passes of a build.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, cells: u64, target: BuildTarget<'_>) {
        target.record_header(recorder, "grid/build_0_header", &[Pool::Lists], Access::COMPUTE);
        if let Some(large) = &self.large {
            large.record(recorder, target);
        }
        self.lengths.record(recorder, target, &[], cells, Access::COMPUTE);
        self.store.record(recorder, target, &[]);
        target.status_pass(recorder, "grid/build_5_status", &self.status);
    }
}
