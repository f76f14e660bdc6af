//! Errors that end an experiment early.

use std::io;
use std::path::PathBuf;

use rasray_ads::AdsError;
use rasray_frame::FrameError;
use rasray_gpu::{Feature, GpuError};
use rasray_gpu_scene::GpuSceneError;
use rasray_integrators::IntegratorError;
use rasray_metrics::MetricsError;
use rasray_options::Value;
use rasray_reference::oracle::OracleError;
use rasray_reference::shading::ReferenceError;
use rasray_report::bytes;
use rasray_scene_source::LoadError;
use rasray_systems::{System, SystemsError};
use rasray_tracer::TracerError;

use crate::selection::SelectionError;

/// Error of an experiment that gave no result. Its message is a whole sentence without a full stop. Messages
/// of the device, of a structure, of a scene or of the reference are passed on unchanged.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// Systems, presets and options do not go together.
    #[error(transparent)]
    Selection(#[from] SelectionError),
    /// The registry cannot make a system with these options.
    #[error(transparent)]
    Systems(SystemsError),
    /// There is no scene to show, or no view of it.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// No device was opened.
    #[error(transparent)]
    Opening(GpuError),
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A structure or a queue failed.
    #[error(transparent)]
    Ads(#[from] AdsError),
    /// The scene's tables cannot be made or do not fit the device.
    #[error(transparent)]
    GpuScene(GpuSceneError),
    /// An integrator, a film or drawn camera rays failed.
    #[error(transparent)]
    Integrator(#[from] IntegratorError),
    /// A frame failed.
    #[error(transparent)]
    Frame(FrameError),
    /// A build or a trace failed.
    #[error(transparent)]
    Tracer(TracerError),
    /// The oracle refused the triangles.
    #[error(transparent)]
    Oracle(#[from] OracleError),
    /// The reference cannot make its image.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// Results cannot be compared with the truth.
    #[error(transparent)]
    Metrics(#[from] MetricsError),
    /// A buffer of the scene is larger than one binding.
    #[error("the scene's {name} have {size} bytes, and this device binds {limit} at most")]
    SceneExceedsBinding {
        /// Name of the buffer.
        name: String,
        /// Size of the buffer, bytes.
        size: u64,
        /// Largest size of a binding, bytes.
        limit: u64,
    },
    /// A pool of a structure is larger than one binding.
    #[error("{source}")]
    PoolExceedsBinding {
        /// The system of the structure.
        system: &'static System,
        /// Error of the device.
        source: GpuError,
    },
    /// A system needs what the device lacks.
    #[error("system {system} needs the feature {feature}, which {device} lacks")]
    SystemNeedsFeature {
        /// Name of the system.
        system: &'static str,
        /// Missing feature.
        feature: Feature,
        /// Name of the device.
        device: String,
    },
    /// An option of a system needs what the device lacks.
    #[error("{option} {value} of {system} needs {feature}, which {device} lacks")]
    OptionNeedsFeature {
        /// Name of the system.
        system: &'static str,
        /// Name of the option.
        option: &'static str,
        /// Value of the option.
        value: Value,
        /// Missing feature.
        feature: Feature,
        /// Name of the device.
        device: String,
    },
    /// The memory cannot hold an image.
    #[error(
        "an image of {} x {} pixels takes {} ({bytes_per_pixel} bytes a pixel), and {memory} has {}",
        size[0], size[1],
        bytes(u64::from(size[0]) * u64::from(size[1]) * bytes_per_pixel),
        bytes(*available)
    )]
    ImageTooLarge {
        /// Width and height, pixels.
        size: [u32; 2],
        /// Bytes that each pixel takes in this memory.
        bytes_per_pixel: u64,
        /// Available bytes.
        available: u64,
        /// Owner of the memory.
        memory: Holder,
    },
    /// Camera rays cannot be drawn for a camera with a lens.
    #[error("primary {primary} draws through a pinhole, and the camera has a lens")]
    Pinhole {
        /// Value of the option `primary`.
        primary: &'static str,
    },
    /// First hits were asked of a structure that does not have them.
    #[error("primary fragments: {structure} has no view of the camera to take them from")]
    NoFirstHits {
        /// Name of the structure.
        structure: &'static str,
    },
    /// Shadow maps cannot answer the shadow rays of an image.
    #[error("occluder shadow-maps: {0}")]
    Occluder(#[from] OccluderError),
    /// Shadow maps cannot be made.
    #[error("occluder shadow-maps: {source}")]
    ShadowMaps {
        /// Number of points with maps on each emitting triangle.
        points: u32,
        /// Cause of the failure.
        source: FrameError,
    },
    /// The reference has no such integrator.
    #[error("images are compared with the reference, which has the integrators {known}")]
    NoReference {
        /// Names of the integrators that the reference has.
        known: String,
    },
    /// Moving parts were asked of a scene whose triangles differ in each frame.
    #[error("a scene whose triangles are others in each frame has no part that stands still")]
    NoStillPart,
    /// The scene to be posed was not uploaded as one that moves.
    #[error("a scene is to be posed that was not made to move")]
    NotPosed,
    /// The set has no ray of this index.
    #[error("there is no ray {index} in {set}, which has {rays}")]
    NoSuchRay {
        /// Index of the ray, from 0.
        index: u32,
        /// Name of the set.
        set: String,
        /// Number of rays in the set.
        rays: usize,
    },
    /// The number of given hits is not the number of rays.
    #[error("{name} has {hits} hits for the {rays} rays of {set}")]
    HitCount {
        /// Name of the program or file that gave the hits.
        name: String,
        /// Number of hits given.
        hits: usize,
        /// Number of rays in the set.
        rays: usize,
        /// Name of the set.
        set: String,
    },
    /// The folder for temporary files does not accept a file.
    #[error("{}: cannot be written: {source}", path.display())]
    TemporaryFile {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The device does not have the triangles of a hard case.
    #[error("the triangles of {case} are not the same on the device")]
    OtherTriangles {
        /// Name of the case.
        case: String,
    },
    /// The validation layer found a defect.
    #[error("the validation layer says: {message}")]
    Validation {
        /// First message of the layer.
        message: String,
    },
    /// Entries were missing from a traced structure.
    #[error("{system}: {entries} entries were missing from what was traced")]
    MissingEntries {
        /// System and preset.
        system: String,
        /// Number of entries.
        entries: u64,
    },
    /// Rays had no answer.
    #[error("{system}: {rays} rays had no answer after the last round")]
    Unanswered {
        /// System and preset.
        system: String,
        /// Number of rays.
        rays: u64,
    },
    /// An image lacks pixels.
    #[error("the image '{image}' has {pixels} of {expected} pixels")]
    MissingPixels {
        /// Name of the image.
        image: &'static str,
        /// Number of pixels of the image.
        pixels: usize,
        /// Expected number of pixels.
        expected: usize,
    },
}

/// Owner of the memory that cannot hold an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holder {
    /// Memory of the device.
    Device,
    /// Memory of the host, which a software device shares.
    Host,
}

impl std::fmt::Display for Holder {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Device => "the device",
            Self::Host => "this machine",
        })
    }
}

/// Reason for which shadow maps cannot answer the shadow rays of an image.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OccluderError {
    /// The scene has blended surfaces.
    #[error("surfaces of this scene let light pass, and maps do not say which lie on a ray")]
    Blended,
    /// The scene has panes of glass.
    #[error("panes of this scene let light pass, and maps do not say which lie on a ray")]
    Panes {
        /// True if the integrator has an option that makes the panes' shadows opaque.
        can_be_opaque: bool,
    },
    /// The integrator traces no shadow rays.
    #[error("the integrator {integrator} sends no ray to a light")]
    NoShadowRays {
        /// Name of the integrator.
        integrator: &'static str,
    },
    /// Light passes back faces.
    #[error("maps have both sides of every surface, and with back-faces all no light meets backs")]
    BackFaces,
}

impl From<SystemsError> for ExperimentError {
    fn from(error: SystemsError) -> Self {
        match error {
            SystemsError::Ads(error) => Self::Ads(error),
            error => Self::Systems(error),
        }
    }
}

impl From<GpuSceneError> for ExperimentError {
    fn from(error: GpuSceneError) -> Self {
        match error {
            GpuSceneError::Scene(error) => Self::Load(error.into()),
            GpuSceneError::Gpu(GpuError::TooLarge { name, size, limit })
            | GpuSceneError::Ads(AdsError::Gpu(GpuError::TooLarge { name, size, limit })) => {
                Self::SceneExceedsBinding { name, size, limit }
            }
            error => Self::GpuScene(error),
        }
    }
}

impl From<TracerError> for ExperimentError {
    fn from(error: TracerError) -> Self {
        match error {
            TracerError::Ads(error) => Self::Ads(error),
            TracerError::Gpu(error) => Self::Gpu(error),
            error => Self::Tracer(error),
        }
    }
}

impl From<FrameError> for ExperimentError {
    fn from(error: FrameError) -> Self {
        match error {
            FrameError::Tracer(error) => error.into(),
            FrameError::Integrator(error) => Self::Integrator(error),
            FrameError::Gpu(error) => Self::Gpu(error),
            FrameError::Scene(error) => error.into(),
            FrameError::Ads(error) => Self::Ads(error),
            error => Self::Frame(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::error::Error as _;

    use super::*;
    use rasray_scene::SceneError;

    #[test]
    fn what_a_crate_passes_on_is_the_error_of_the_crate_that_failed() {
        let lost = || GpuError::DeviceLost { call: "vkQueueSubmit", during: "trace".to_owned() };
        let nested = [
            FrameError::Tracer(TracerError::Gpu(lost())).into(),
            TracerError::Gpu(lost()).into(),
            ExperimentError::from(FrameError::Gpu(lost())),
        ];
        for error in nested {
            assert!(matches!(error, ExperimentError::Gpu(GpuError::DeviceLost { .. })), "{error:?}");
        }
        let unstable = TracerError::Unstable { structure: "bvh", rebuilds: 4, pool: None };
        let error = ExperimentError::from(FrameError::Tracer(unstable));
        assert!(matches!(error, ExperimentError::Tracer(TracerError::Unstable { .. })), "{error:?}");
    }

    #[test]
    fn what_the_system_said_of_a_file_is_kept_as_a_source() {
        let source = || io::Error::from(io::ErrorKind::PermissionDenied);
        let of_scene = SceneError::Read { path: "a.ply".into(), source: source() };
        let errors = [
            ExperimentError::from(GpuSceneError::Scene(of_scene)),
            ExperimentError::TemporaryFile { path: "a.ply".into(), source: source() },
        ];
        for error in errors {
            let source = error.source().and_then(|source| source.downcast_ref::<io::Error>());
            assert_eq!(source.map(io::Error::kind), Some(io::ErrorKind::PermissionDenied), "{error}");
        }
    }

    #[test]
    fn a_scene_that_exceeds_a_binding_is_told_from_other_failures() {
        let large = || GpuError::TooLarge { name: "texels".to_owned(), size: 9, limit: 8 };
        for error in [GpuSceneError::Gpu(large()), GpuSceneError::Ads(AdsError::Gpu(large()))] {
            let error = ExperimentError::from(error);
            assert_eq!(error.to_string(), "the scene's texels have 9 bytes, and this device binds 8 at most");
        }
        let other = ExperimentError::from(GpuSceneError::TooManyTexels { count: 9, limit: 8 });
        assert!(matches!(other, ExperimentError::GpuScene(_)), "{other:?}");
    }
}
