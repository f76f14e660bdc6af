//! Experiments on the systems of the registry: comparisons of hits and images with an exact oracle, hard
//! cases, renders and replays of single rays. The command, the tests and the benches run them.
//!
//! - [`Backend`] carries out jobs on a device; [`open`] makes one.
//! - [`CompareJob`], [`HardJob`] and [`RenderJob`] are the jobs, as plain data; [`Comparison`] and
//!   [`RenderOutput`] are their results.
//! - [`SystemConfig`] is a system with its preset and options; [`Frame`] is an image, [`RaySet`] a set of
//!   rays.
//! - [`ExperimentError`] has every reason for which a job gives no result.
//!
//! ```no_run
//! use rasray_experiment::{DeviceChoice, open};
//!
//! let mut backend = open(&DeviceChoice::default())?;
//! for name in backend.info()?.devices {
//!     println!("{name}");
//! }
//! # Ok::<(), rasray_experiment::ExperimentError>(())
//! ```

mod aov;
mod automatic;
mod backend;
mod built;
mod campaign;
mod cell;
mod compare;
mod contestant;
mod describe;
mod device_backend;
mod device_record;
mod device_scene;
mod error;
mod evaluate;
mod frame;
mod further_images;
mod hard;
mod hard_file;
mod hard_verdict;
mod image_memory;
mod images;
mod jobs;
mod kept_files;
mod key;
mod measured;
mod motion;
mod moving_scene;
mod paper_frame;
mod pass_list;
mod passes;
mod placed;
mod progressive_image;
mod rays;
mod render_job;
mod replay;
mod scene_info;
mod selection;
mod shard;
mod system_config;
pub mod texels;
mod traced_set;
mod whole;
mod work_maps;

pub use automatic::SystemRequest;
pub use backend::{
    Backend, ChosenPath, DeviceChoice, DeviceDescription, Feature, FinishedRun, OnProgress, OnRun,
    OpenBackend, Progress, TexelCapacity,
};
pub use built::{Built, ResolvedOptions};
pub use campaign::{CampaignCells, ExperimentCells};
pub use cell::{CellList, HardSubject, cell_key, compare_cells, hard_cells};
pub use contestant::Contestant;
pub use describe::requirements;
pub use device_backend::{open, open_device};
pub use device_record::device_record;
pub use device_scene::DeviceScene;
pub use error::{ExperimentError, Holder, OccluderError};
pub use evaluate::device_hits;
pub use hard_file::compare_file;
pub use jobs::{
    Answers, Aov, AovImage, AovSelection, CompareJob, Comparison, FILE_SET, FilmSums, Frame, FrameBefore,
    HardJob, OccluderKind, Primary, RaySet, Refresh, RenderJob, RenderOutput, SavedRays, SavedSet,
};
pub use kept_files::NamedBytes;
pub use key::picture_key;
pub use measured::{HIT_ROUNDING, Measured, Tolerance};
pub use moving_scene::PoseTimes;
pub use paper_frame::FrameDefaults;
pub use placed::{Placed, case_camera};
pub use progressive_image::ProgressiveImage;
pub use rasray_ads::AdsError;
pub use rasray_frame::{Adaptive, FrameError};
pub use rasray_gpu::{GpuError, PassCommands, Stage};
pub use rasray_gpu_scene::GpuSceneError;
pub use rasray_integrators::{
    INTEGRATORS, IntegratorError, IntegratorRow, IntegratorSpec, integrator_options,
};
pub use rasray_metrics::MetricsError;
pub use rasray_options::OptionValues;
pub use rasray_reference::{oracle::OracleError, shading::ReferenceError};
pub use rasray_scene::Sampler;
pub use rasray_systems::SystemsError;
pub use rasray_tracer::TracerError;
pub use rays::{RaySource, incoherent_rays, oracle_ray};
pub use render_job::KeptScene;
pub use scene_info::{SceneInfo, count_not_uploaded};
pub use selection::{SelectionError, one_system, several_systems};
pub use shard::Shard;
pub use system_config::SystemConfig;
pub use traced_set::{TracedSet, trace_in_turns};
pub use whole::check_run;
pub use work_maps::{hit_at, work_per_pixel};
