//! Exit codes of errors of libraries.

use crate::error::{EXIT_DEFECT, EXIT_DEVICE, EXIT_REFUSED, EXIT_USAGE};
use rasray_experiment::{
    AdsError, ExperimentError, FrameError, GpuError, GpuSceneError, Holder, IntegratorError, MetricsError,
    ReferenceError, SystemsError, TracerError,
};

/// Returns the exit code: [`EXIT_DEVICE`] only for a missing feature or a failure of a device, and
/// [`EXIT_DEFECT`] unless the error is known to have another cause.
pub(crate) fn exit_code(error: &ExperimentError) -> u8 {
    match error {
        // While a device is opened, whatever is missing is missing in the device or its driver.
        ExperimentError::Opening(_)
        | ExperimentError::SceneExceedsBinding { .. }
        | ExperimentError::PoolExceedsBinding { .. }
        | ExperimentError::SystemNeedsFeature { .. }
        | ExperimentError::ImageTooLarge { memory: Holder::Device, .. } => EXIT_DEVICE,
        ExperimentError::MissingEntries { .. } | ExperimentError::Unanswered { .. } => EXIT_REFUSED,
        ExperimentError::Gpu(error) => code_of_gpu(error),
        ExperimentError::Ads(error) => code_of_ads(error),
        ExperimentError::Systems(SystemsError::Ads(error)) if code_of_ads(error) == EXIT_DEFECT => {
            EXIT_DEFECT
        }
        ExperimentError::GpuScene(error) => code_of_scene(error),
        ExperimentError::Integrator(error) => code_of_integrator(error),
        ExperimentError::Tracer(error) => code_of_tracer(error),
        ExperimentError::Frame(error) | ExperimentError::ShadowMaps { source: error, .. } => {
            code_of_frame(error)
        }
        ExperimentError::Reference(
            ReferenceError::Oracle(_) | ReferenceError::Malformed { .. } | ReferenceError::EmptyImage { .. },
        )
        | ExperimentError::Metrics(MetricsError::TooLarge { .. })
        | ExperimentError::Selection(_)
        | ExperimentError::Systems(_)
        | ExperimentError::Load(_)
        | ExperimentError::Oracle(_)
        | ExperimentError::OptionNeedsFeature { .. }
        | ExperimentError::ImageTooLarge { .. }
        | ExperimentError::Pinhole { .. }
        | ExperimentError::NoFirstHits { .. }
        | ExperimentError::Occluder(_)
        | ExperimentError::NoReference { .. }
        | ExperimentError::NoStillPart
        | ExperimentError::NoSuchRay { .. }
        | ExperimentError::HitCount { .. }
        | ExperimentError::TemporaryFile { .. } => EXIT_USAGE,
        _ => EXIT_DEFECT,
    }
}

fn code_of_gpu(error: &GpuError) -> u8 {
    match error {
        GpuError::InvalidUse { .. }
        | GpuError::InvalidShader { .. }
        | GpuError::OutOfRange { .. }
        | GpuError::FeatureNotEnabled { .. } => EXIT_DEFECT,
        _ => EXIT_DEVICE,
    }
}

fn code_of_ads(error: &AdsError) -> u8 {
    match error {
        AdsError::Gpu(error) => code_of_gpu(error),
        AdsError::Damaged { .. } => EXIT_REFUSED,
        AdsError::PoolTooLarge { .. }
        | AdsError::Option { .. }
        | AdsError::NoFirstHits { .. }
        | AdsError::InParts { .. } => EXIT_USAGE,
        _ => EXIT_DEFECT,
    }
}

/// Returns the exit code; errors that no layer below reports are those of scenes.
fn code_of_scene(error: &GpuSceneError) -> u8 {
    match error {
        GpuSceneError::Gpu(error) => code_of_gpu(error),
        GpuSceneError::TooManyTexels { .. } => EXIT_DEVICE,
        GpuSceneError::Ads(error) => code_of_ads(error),
        _ => EXIT_USAGE,
    }
}

fn code_of_integrator(error: &IntegratorError) -> u8 {
    match error {
        IntegratorError::Gpu(error) => code_of_gpu(error),
        IntegratorError::Ads(error) => code_of_ads(error),
        IntegratorError::CannotDraw { .. } | IntegratorError::CannotFetch { .. } => EXIT_DEVICE,
        IntegratorError::Value(_)
        | IntegratorError::PhotonBytes { .. }
        | IntegratorError::Crowded { .. }
        | IntegratorError::UnknownOption { .. }
        | IntegratorError::WaveSize { .. }
        | IntegratorError::ImageSize { .. }
        | IntegratorError::WaveCapacity { .. } => EXIT_USAGE,
        _ => EXIT_DEFECT,
    }
}

fn code_of_tracer(error: &TracerError) -> u8 {
    match error {
        TracerError::Gpu(error) => code_of_gpu(error),
        TracerError::Ads(error) => code_of_ads(error),
        TracerError::Unfinished { .. }
        | TracerError::NotReady { .. }
        | TracerError::Corrupted { .. }
        | TracerError::Unstable { .. } => EXIT_REFUSED,
        _ => EXIT_DEFECT,
    }
}

fn code_of_frame(error: &FrameError) -> u8 {
    match error {
        FrameError::Gpu(error) => code_of_gpu(error),
        FrameError::Ads(error) => code_of_ads(error),
        FrameError::Tracer(error) => code_of_tracer(error),
        FrameError::Integrator(error) => code_of_integrator(error),
        FrameError::Scene(error) => code_of_scene(error),
        FrameError::Unfinished { .. } | FrameError::Unstable { .. } => EXIT_REFUSED,
        FrameError::DrawnAdaptively => EXIT_USAGE,
        _ => EXIT_DEFECT,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::AppError;
    use crate::hints::DEFECT;

    /// Returns errors that hold the error of a frame.
    fn in_frames(inner: impl Fn() -> FrameError) -> [ExperimentError; 2] {
        [ExperimentError::Frame(inner()), ExperimentError::ShadowMaps { points: 2, source: inner() }]
    }

    /// Wraps an error of the device or of a structure in every type of error that passes it on.
    fn wrapped<T>(inner: impl Fn() -> T) -> Vec<ExperimentError>
    where
        T: Into<AdsError>
            + Into<GpuSceneError>
            + Into<IntegratorError>
            + Into<TracerError>
            + Into<FrameError>
            + Into<ExperimentError>,
    {
        let plain: ExperimentError = inner().into();
        let mut all = vec![
            plain,
            ExperimentError::Ads(inner().into()),
            ExperimentError::Systems(SystemsError::Ads(inner().into())),
            ExperimentError::GpuScene(inner().into()),
            ExperimentError::Integrator(inner().into()),
            ExperimentError::Integrator(IntegratorError::Ads(inner().into())),
            ExperimentError::Tracer(inner().into()),
        ];
        all.extend(in_frames(|| inner().into()));
        all.extend(in_frames(|| FrameError::Ads(inner().into())));
        all.extend(in_frames(|| FrameError::Scene(inner().into())));
        all.extend(in_frames(|| FrameError::Integrator(inner().into())));
        all.extend(in_frames(|| FrameError::Tracer(inner().into())));
        all
    }

    #[test]
    fn advice_and_exit_code_agree_on_defects_whatever_wraps_them() {
        let of = |defect: bool, errors: Vec<ExperimentError>| {
            for error in errors.into_iter().map(AppError::from) {
                assert_eq!(error.exit_code() == 5, defect, "{}{error:?}", error.lines());
                assert_eq!(error.help() == DEFECT, defect, "{}{error:?}", error.lines());
            }
        };
        let bvh = "bvh";
        let name = || "nodes".to_owned();
        of(true, wrapped(|| GpuError::InvalidUse { name: name(), reason: "it has no slots".to_owned() }));
        of(true, wrapped(|| GpuError::InvalidShader { name: name(), reason: "it is empty" }));
        of(true, wrapped(|| GpuError::OutOfRange { name: name(), offset: 8, size: 4, buffer_size: 8 }));
        of(true, wrapped(|| AdsError::NotPrepared { structure: bvh }));
        of(true, wrapped(|| AdsError::NoScene { structure: bvh }));
        of(true, wrapped(|| AdsError::OutsideBounds { triangles: 1 }));
        of(false, wrapped(|| GpuError::DeviceLost { call: "vkQueueSubmit", during: "trace".to_owned() }));
        of(false, wrapped(|| GpuError::TooLarge { name: name(), size: 9, limit: 8 }));
        of(false, wrapped(|| AdsError::NoFirstHits { structure: bvh }));
        of(
            false,
            wrapped(|| AdsError::PoolTooLarge {
                structure: bvh,
                pool: "nodes",
                elements: 1 << 33,
                limit: 1 << 27,
            }),
        );
        of(false, wrapped(|| AdsError::Damaged { structure: bvh, fault: "a loop".to_owned() }));

        of(true, vec![IntegratorError::NotListed.into(), TracerError::Busy { slots: 2 }.into()]);
        of(true, in_frames(|| IntegratorError::NotListed.into()).into());
        of(true, in_frames(|| TracerError::Busy { slots: 2 }.into()).into());
        of(false, in_frames(|| TracerError::Unfinished { unfinished: 2, rounds: 3 }.into()).into());
        of(false, in_frames(|| FrameError::Unfinished { rays: 2 }).into());
        of(false, in_frames(|| FrameError::DrawnAdaptively).into());
    }
}
