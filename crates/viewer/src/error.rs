//! Why there is no picture, or no window.

use rasray_denoise::DenoiseError;
use rasray_experiment::ExperimentError;
use rasray_scene_source::LoadError;

/// Why there is no picture, or no window. Messages are whole sentences without a full stop.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ViewerError {
    /// Making pictures failed.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// Noise cannot be taken out of the picture.
    #[error(transparent)]
    Denoise(#[from] DenoiseError),
    /// The scene has no such camera.
    #[error("the scene has no camera {index}")]
    NoCamera {
        /// Its number, from 0.
        index: usize,
    },
    /// A camera was moved to where no numbers are.
    #[error("the camera is not at a place that numbers can say")]
    Nowhere,
    /// A map of work through a system that does not count it.
    #[error("system {system} does not count its work")]
    NotCounted {
        /// The system.
        system: &'static str,
    },
    /// The picked surface is elsewhere now.
    #[error("the scene has moved since it was picked")]
    Moved,
    /// Nothing names a display.
    #[error("there is no display for a window: neither DISPLAY nor WAYLAND_DISPLAY is set")]
    NoDisplay,
    /// The window system gives no window.
    #[cfg(feature = "window")]
    #[error("there is no display for a window: {source}")]
    NoWindow {
        /// Its error.
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
