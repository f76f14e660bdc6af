//! Errors of builds and traces.

use rasray_ads::AdsError;
use rasray_gpu::GpuError;

/// Why a build or a trace has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TracerError {
    /// The structure or a queue failed.
    #[error(transparent)]
    Ads(#[from] AdsError),
    /// The Vulkan layer failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A build still asked for more after it had been given what earlier ones asked for.
    #[error("{structure} is still incomplete after {rebuilds} rebuilds; its demand is not stable")]
    Unstable {
        /// Name of the structure.
        structure: &'static str,
        /// Rebuilds made.
        rebuilds: u32,
    },
    /// A structure was asked to replay a ray that does not log steps.
    #[error("{structure} does not log steps; create it with `Counters::Steps` to replay a ray")]
    NoSteps {
        /// Name of the structure.
        structure: &'static str,
    },
    /// Rays were given up.
    #[error("{unfinished} rays did not finish within {rounds} rounds; allow more rounds")]
    Unfinished {
        /// Rays given up.
        unfinished: u32,
        /// Rounds allowed.
        rounds: u32,
    },
    /// Traces met entries that name nothing: what is in the structure's memory is not what was built.
    #[error("{entries} entries of {structure} named nothing while rays were traced: build it again")]
    Corrupted {
        /// Name of the structure.
        structure: &'static str,
        /// Entries met since the last build.
        entries: u64,
    },
    /// Rays met an incomplete structure.
    #[error("{rays} rays were traced through a structure that is not built")]
    NotReady {
        /// Rays without an answer.
        rays: u32,
    },
}
