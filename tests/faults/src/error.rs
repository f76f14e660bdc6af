//! Why a picture or hits were not made, whichever crate says so.

use rasray_ads::AdsError;
use rasray_gpu::GpuError;
use rasray_gpu_scene::GpuSceneError;
use rasray_integrators::IntegratorError;
use rasray_systems::SystemsError;
use rasray_tracer::TracerError;

/// An error of any crate on the way from a scene to a picture.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Error of the Vulkan layer.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// Error of structures and queues.
    #[error(transparent)]
    Ads(#[from] AdsError),
    /// Error of the scene on the device.
    #[error(transparent)]
    Scene(#[from] GpuSceneError),
    /// Error of integrators and film.
    #[error(transparent)]
    Integrator(#[from] IntegratorError),
    /// Error of the registry.
    #[error(transparent)]
    Systems(#[from] SystemsError),
    /// Error of builds and traces.
    #[error(transparent)]
    Tracer(#[from] TracerError),
}

impl Failure {
    /// The error of the Vulkan layer that is behind it.
    pub fn gpu(&self) -> Option<&GpuError> {
        match self {
            Self::Gpu(error)
            | Self::Ads(AdsError::Gpu(error))
            | Self::Scene(GpuSceneError::Gpu(error) | GpuSceneError::Ads(AdsError::Gpu(error)))
            | Self::Integrator(IntegratorError::Gpu(error) | IntegratorError::Ads(AdsError::Gpu(error)))
            | Self::Systems(SystemsError::Ads(AdsError::Gpu(error)))
            | Self::Tracer(TracerError::Gpu(error) | TracerError::Ads(AdsError::Gpu(error))) => Some(error),
            _ => None,
        }
    }
}
