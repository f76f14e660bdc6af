//! Errors of frames and images.

use rasray_ads::{AdsError, PoolStatus};
use rasray_gpu::GpuError;
use rasray_gpu_scene::GpuSceneError;
use rasray_integrators::IntegratorError;
use rasray_tracer::TracerError;

/// Error of a frame that could not be recorded, or that has no picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FrameError {
    /// A build or the ring of frames failed.
    #[error(transparent)]
    Tracer(#[from] TracerError),
    /// The integrator refused the frame.
    #[error(transparent)]
    Integrator(#[from] IntegratorError),
    /// The Vulkan layer failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The pass that poses the scene failed.
    #[error(transparent)]
    Scene(#[from] GpuSceneError),
    /// The structure failed.
    #[error(transparent)]
    Ads(#[from] AdsError),
    /// Rays did not finish, and more rounds would not help.
    #[error("{rays} rays did not finish")]
    Unfinished {
        /// Number of rays without an answer.
        rays: u64,
    },
    /// Drawing answers the camera rays of all pixels, so it cannot give some pixels more samples than others.
    #[error(
        "camera rays are drawn, which are those of all pixels: trace them, or take as many samples of each pixel"
    )]
    DrawnAdaptively,
    /// A frame was still incomplete after the maximum number of repeats.
    #[error(
        "a frame through {structure} was not complete after {repeats} repeats; its demand is not stable{}",
        pool.map(|pool| format!(": {pool}")).unwrap_or_default()
    )]
    Unstable {
        /// Name of the structure.
        structure: &'static str,
        /// Number of repeats.
        repeats: u32,
        /// The pool that lacked most elements in the last repeat, if one was too small.
        pool: Option<PoolStatus>,
    },
}
