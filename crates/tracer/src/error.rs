//! Errors of builds and traces.

use rasray_ads::{AdsError, PoolStatus};
use rasray_gpu::GpuError;

/// Error of a build or a trace that produced no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TracerError {
    /// The structure or a queue failed.
    #[error(transparent)]
    Ads(#[from] AdsError),
    /// The Vulkan layer failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A build still needed more capacity after growing to the demand of earlier ones.
    #[error(
        "{structure} is still incomplete after {rebuilds} rebuilds; its demand is not stable{}",
        pool.map(|pool| format!(": {pool}")).unwrap_or_default()
    )]
    Unstable {
        /// Name of the structure.
        structure: &'static str,
        /// Number of rebuilds made.
        rebuilds: u32,
        /// The pool that lacked most elements, if one was too small.
        pool: Option<PoolStatus>,
    },
    /// A replay was requested of a structure that does not log steps.
    #[error("{structure} does not log steps; create it with `Counters::Steps` to replay a ray")]
    NoSteps {
        /// Name of the structure.
        structure: &'static str,
    },
    /// Rays did not finish within the rounds allowed.
    #[error("{unfinished} rays did not finish within {rounds} rounds; allow more rounds")]
    Unfinished {
        /// Number of unfinished rays.
        unfinished: u32,
        /// Number of rounds allowed.
        rounds: u32,
    },
    /// Traces met list entries with an invalid index: the structure's memory was damaged since the build.
    #[error(
        "{entries} list entries of {structure} had an invalid index while rays were traced: build it again"
    )]
    Corrupted {
        /// Name of the structure.
        structure: &'static str,
        /// Number of invalid entries since the last build.
        entries: u64,
    },
    /// Rays were traced while the structure was incomplete.
    #[error("{rays} rays were traced through a structure that is not built")]
    NotReady {
        /// Number of rays without an answer.
        rays: u32,
    },
    /// All slots hold frames in flight.
    #[error("all {slots} slots hold frames in flight: take the oldest first")]
    Busy {
        /// Number of slots of the ring.
        slots: u32,
    },
}
