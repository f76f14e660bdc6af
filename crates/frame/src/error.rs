//! Why a frame has no picture.

use rasray_ads::{AdsError, PoolStatus};
use rasray_gpu::GpuError;
use rasray_gpu_scene::GpuSceneError;
use rasray_integrators::IntegratorError;
use rasray_tracer::TracerError;

/// Why a frame could not be recorded, or has no picture.
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
    /// The pass that moves the scene failed.
    #[error(transparent)]
    Scene(#[from] GpuSceneError),
    /// The structure failed.
    #[error(transparent)]
    Ads(#[from] AdsError),
    /// Rays had no answer, and more rounds change nothing.
    #[error("{rays} rays did not finish")]
    Unfinished {
        /// Number of rays.
        rays: u64,
    },
    /// Camera rays that are drawn are those of all pixels.
    #[error(
        "camera rays are drawn, which are those of all pixels: trace them, or take as many samples of each pixel"
    )]
    DrawnAdaptively,
    /// A frame was not complete however often it was repeated.
    #[error(
        "a frame through {structure} was not complete after {repeats} repeats; its demand is not stable{}",
        pool.map(|pool| format!(": {pool}")).unwrap_or_default()
    )]
    Unstable {
        /// Name of the structure.
        structure: &'static str,
        /// Repeats.
        repeats: u32,
        /// The pool that lacked most in the last of them, where one was too small.
        pool: Option<PoolStatus>,
    },
}
