//! Exit codes of errors of libraries.

use super::defects::is_defect;
use crate::error::{EXIT_DEFECT, EXIT_DEVICE, EXIT_REFUSED, EXIT_USAGE};
use rasray_experiment::{
    AdsError, ExperimentError, FrameError, GpuSceneError, Holder, IntegratorError, TracerError,
};

/// Returns the exit code: [`EXIT_DEFECT`] for a defect, whatever failed; otherwise [`EXIT_DEVICE`] only for a
/// missing feature or a failure of a device.
pub(crate) fn exit_code(error: &ExperimentError) -> u8 {
    if is_defect(error) {
        return EXIT_DEFECT;
    }
    match error {
        ExperimentError::Opening(_)
        | ExperimentError::Gpu(_)
        | ExperimentError::SceneExceedsBinding { .. }
        | ExperimentError::PoolExceedsBinding { .. }
        | ExperimentError::SystemNeedsFeature { .. }
        | ExperimentError::ImageTooLarge { memory: Holder::Device, .. } => EXIT_DEVICE,
        ExperimentError::MissingEntries { .. } | ExperimentError::Unanswered { .. } => EXIT_REFUSED,
        ExperimentError::Ads(error) => code_of_ads(error),
        ExperimentError::GpuScene(error) => code_of_scene(error),
        ExperimentError::Integrator(error) => code_of_integrator(error),
        ExperimentError::Tracer(error) => code_of_tracer(error),
        ExperimentError::Frame(error) | ExperimentError::ShadowMaps { source: error, .. } => {
            code_of_frame(error)
        }
        _ => EXIT_USAGE,
    }
}

fn code_of_ads(error: &AdsError) -> u8 {
    match error {
        AdsError::Gpu(_) => EXIT_DEVICE,
        AdsError::Damaged { .. } => EXIT_REFUSED,
        _ => EXIT_USAGE,
    }
}

fn code_of_scene(error: &GpuSceneError) -> u8 {
    match error {
        GpuSceneError::Gpu(_) | GpuSceneError::TooManyTexels { .. } => EXIT_DEVICE,
        GpuSceneError::Ads(error) => code_of_ads(error),
        _ => EXIT_USAGE,
    }
}

fn code_of_integrator(error: &IntegratorError) -> u8 {
    match error {
        IntegratorError::Gpu(_)
        | IntegratorError::CannotDraw { .. }
        | IntegratorError::CannotFetch { .. } => EXIT_DEVICE,
        IntegratorError::Ads(error) => code_of_ads(error),
        _ => EXIT_USAGE,
    }
}

fn code_of_tracer(error: &TracerError) -> u8 {
    match error {
        TracerError::Gpu(_) => EXIT_DEVICE,
        TracerError::Ads(error) => code_of_ads(error),
        TracerError::Unfinished { .. }
        | TracerError::NotReady { .. }
        | TracerError::Corrupted { .. }
        | TracerError::Unstable { .. } => EXIT_REFUSED,
        _ => EXIT_USAGE,
    }
}

fn code_of_frame(error: &FrameError) -> u8 {
    match error {
        FrameError::Gpu(_) => EXIT_DEVICE,
        FrameError::Ads(error) => code_of_ads(error),
        FrameError::Tracer(error) => code_of_tracer(error),
        FrameError::Integrator(error) => code_of_integrator(error),
        FrameError::Scene(error) => code_of_scene(error),
        FrameError::Unfinished { .. } | FrameError::Unstable { .. } => EXIT_REFUSED,
        _ => EXIT_USAGE,
    }
}

/// Returns the exit code of a window that cannot be opened, or shows no picture.
#[cfg(feature = "viewer")]
pub(crate) fn code_of_viewer(error: &rasray_viewer::ViewerError) -> u8 {
    use rasray_viewer::ViewerError;
    match error {
        ViewerError::Experiment(error) => exit_code(error),
        ViewerError::NoDisplay | ViewerError::NoWindow { .. } | ViewerError::Window { .. } => EXIT_DEVICE,
        _ => EXIT_USAGE,
    }
}
