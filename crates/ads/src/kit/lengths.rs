//! Passes that count the lengths of contiguous lists and turn the lengths into offsets.

use rasray_gpu::{Access, Recorder};

use crate::AdsError;
use crate::kit::{BuildPipelines, BuildTarget, Scan, ViewDraw, Visit};

/// The passes before contiguous lists are stored: a visit that counts the elements of each list, and a scan
/// that turns these lengths into offsets of the lists.
#[derive(Debug)]
pub struct Lengths {
    count: Visit,
    scan: Scan,
    label: String,
}

impl Lengths {
    /// Makes the pipelines of the scan with that name ([`Scan::new`]), which follows the visit `count`.
    ///
    /// # Errors
    /// A module is not compiled in, or the device refuses it.
    pub fn new(pipelines: &BuildPipelines<'_>, count: Visit, scan: &str) -> Result<Self, AdsError> {
        Ok(Self { count, scan: Scan::new(pipelines, scan)?, label: pipelines.label(scan) })
    }

    /// Records both passes over `lists` lists; `scan_count` of the structure gives the same number. The
    /// offsets are visible to `readers`.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        target: BuildTarget<'_>,
        draws: &[ViewDraw],
        lists: u64,
        readers: Access,
    ) {
        self.count.record(recorder, target, draws);
        self.scan.record(recorder, target, &self.label, lists, 0, readers);
    }
}
