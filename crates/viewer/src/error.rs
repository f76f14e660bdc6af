//! Errors for which there is no picture, or no window.

use rasray_denoise::DenoiseError;
use rasray_experiment::ExperimentError;
use rasray_scene_source::LoadError;

/// Reason for which there is no picture, or no window. Messages are whole sentences without a full stop.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ViewerError {
    /// Making pictures failed.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// Denoising the picture failed.
    #[error(transparent)]
    Denoise(#[from] DenoiseError),
    /// The scene has no camera of this index.
    #[error("the scene has no camera {index}")]
    NoCamera {
        /// Index of the camera, from 0.
        index: usize,
    },
    /// The camera was moved to a place that is not finite.
    #[error("the camera is not at a place that numbers can say")]
    Nowhere,
    /// A map of work was asked of a system that does not count its work.
    #[error("system {system} does not count its work")]
    NotCounted {
        /// Name of the system.
        system: &'static str,
    },
    /// The picked surface is no longer where it was picked.
    #[error("the scene has moved since it was picked")]
    Moved,
    /// No environment variable names a display.
    #[error("there is no display for a window: neither DISPLAY nor WAYLAND_DISPLAY is set")]
    NoDisplay,
    /// The window system refuses a window.
    #[cfg(feature = "window")]
    #[error("there is no display for a window: {source}")]
    NoWindow {
        /// Error of the window system.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The window cannot be drawn.
    #[cfg(feature = "window")]
    #[error("the window cannot be drawn: {during}: {source}")]
    Window {
        /// Step that failed.
        during: &'static str,
        /// Error of the window system or the device.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

impl From<LoadError> for ViewerError {
    fn from(error: LoadError) -> Self {
        Self::Experiment(error.into())
    }
}
