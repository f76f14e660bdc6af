//! Errors that are to be reported as defects: neither input nor device causes them.

use rasray_experiment::{
    AdsError, ExperimentError, FrameError, GpuError, GpuSceneError, IntegratorError, MetricsError,
    ReferenceError, SystemsError, TracerError,
};

/// Returns true for a defect. Advice and exit code both depend on this, so that they go together. An error
/// counts as a defect unless it is known to have another cause.
pub(super) fn is_defect(error: &ExperimentError) -> bool {
    match error {
        ExperimentError::Gpu(error) => is_defect_of_gpu(error),
        ExperimentError::Ads(error) | ExperimentError::Systems(SystemsError::Ads(error)) => {
            is_defect_of_ads(error)
        }
        ExperimentError::GpuScene(error) => is_defect_of_scene(error),
        ExperimentError::Integrator(error) => is_defect_of_integrator(error),
        ExperimentError::Tracer(error) => is_defect_of_tracer(error),
        ExperimentError::Frame(error) | ExperimentError::ShadowMaps { source: error, .. } => {
            is_defect_of_frame(error)
        }
        ExperimentError::Reference(error) => is_defect_of_reference(error),
        ExperimentError::Metrics(error) => !matches!(error, MetricsError::TooLarge { .. }),
        // While a device is opened, whatever is missing is missing in the device or its driver.
        ExperimentError::Opening(_)
        | ExperimentError::Selection(_)
        | ExperimentError::Systems(_)
        | ExperimentError::Load(_)
        | ExperimentError::Oracle(_)
        | ExperimentError::SceneExceedsBinding { .. }
        | ExperimentError::PoolExceedsBinding { .. }
        | ExperimentError::SystemNeedsFeature { .. }
        | ExperimentError::OptionNeedsFeature { .. }
        | ExperimentError::ImageTooLarge { .. }
        | ExperimentError::Pinhole { .. }
        | ExperimentError::NoFirstHits { .. }
        | ExperimentError::Occluder(_)
        | ExperimentError::NoReference { .. }
        | ExperimentError::NoStillPart
        | ExperimentError::NoSuchRay { .. }
        | ExperimentError::HitCount { .. }
        | ExperimentError::TemporaryFile { .. }
        | ExperimentError::MissingEntries { .. }
        | ExperimentError::Unanswered { .. } => false,
        _ => true,
    }
}

/// Returns true if the call itself was wrong, on any device.
fn is_defect_of_gpu(error: &GpuError) -> bool {
    matches!(
        error,
        GpuError::InvalidUse { .. }
            | GpuError::InvalidShader { .. }
            | GpuError::OutOfRange { .. }
            | GpuError::FeatureNotEnabled { .. }
    )
}

fn is_defect_of_ads(error: &AdsError) -> bool {
    match error {
        AdsError::Gpu(error) => is_defect_of_gpu(error),
        AdsError::PoolTooLarge { .. }
        | AdsError::Option { .. }
        | AdsError::NoFirstHits { .. }
        | AdsError::InParts { .. }
        | AdsError::Damaged { .. } => false,
        _ => true,
    }
}

/// Returns true only for what the layers below report: the other errors are those of scenes.
fn is_defect_of_scene(error: &GpuSceneError) -> bool {
    match error {
        GpuSceneError::Gpu(error) => is_defect_of_gpu(error),
        GpuSceneError::Ads(error) => is_defect_of_ads(error),
        _ => false,
    }
}

fn is_defect_of_integrator(error: &IntegratorError) -> bool {
    match error {
        IntegratorError::Gpu(error) => is_defect_of_gpu(error),
        IntegratorError::Ads(error) => is_defect_of_ads(error),
        IntegratorError::Value(_)
        | IntegratorError::PhotonBytes { .. }
        | IntegratorError::Crowded { .. }
        | IntegratorError::UnknownOption { .. }
        | IntegratorError::CannotFetch { .. }
        | IntegratorError::CannotDraw { .. }
        | IntegratorError::WaveSize { .. }
        | IntegratorError::ImageSize { .. }
        | IntegratorError::WaveCapacity { .. } => false,
        _ => true,
    }
}

fn is_defect_of_tracer(error: &TracerError) -> bool {
    match error {
        TracerError::Gpu(error) => is_defect_of_gpu(error),
        TracerError::Ads(error) => is_defect_of_ads(error),
        TracerError::Unfinished { .. }
        | TracerError::NotReady { .. }
        | TracerError::Corrupted { .. }
        | TracerError::Unstable { .. } => false,
        _ => true,
    }
}

fn is_defect_of_frame(error: &FrameError) -> bool {
    match error {
        FrameError::Gpu(error) => is_defect_of_gpu(error),
        FrameError::Ads(error) => is_defect_of_ads(error),
        FrameError::Tracer(error) => is_defect_of_tracer(error),
        FrameError::Integrator(error) => is_defect_of_integrator(error),
        FrameError::Scene(error) => is_defect_of_scene(error),
        FrameError::Unfinished { .. } | FrameError::Unstable { .. } | FrameError::DrawnAdaptively => false,
        _ => true,
    }
}

fn is_defect_of_reference(error: &ReferenceError) -> bool {
    !matches!(
        error,
        ReferenceError::Oracle(_) | ReferenceError::Malformed { .. } | ReferenceError::EmptyImage { .. }
    )
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
        of(false, wrapped(|| AdsError::PoolTooLarge { structure: bvh, pool: "nodes", elements: 1 << 33 }));
        of(false, wrapped(|| AdsError::Damaged { structure: bvh, fault: "a loop".to_owned() }));

        of(true, vec![IntegratorError::NotListed.into(), TracerError::Busy { slots: 2 }.into()]);
        of(true, in_frames(|| IntegratorError::NotListed.into()).into());
        of(true, in_frames(|| TracerError::Busy { slots: 2 }.into()).into());
        of(false, in_frames(|| TracerError::Unfinished { unfinished: 2, rounds: 3 }.into()).into());
        of(false, in_frames(|| FrameError::Unfinished { rays: 2 }).into());
        of(false, in_frames(|| FrameError::DrawnAdaptively).into());
    }
}
