//! The shared core of all acceleration data structures of rasray: the contract, geometry, ray queues and the kernels
//! that trace them, and a brute-force structure that every other one is compared with.
//!
//! # The contract
//! A [`Structure`] owns three things: how it is built from a [`Geometry`], how rays are traced through
//! it, and what surface a hit stands for. It knows nothing of integrators.
//!
//! Building is resumed by its caller, because the exact demand for memory is known only after the GPU
//! ran: record a build, submit and wait as you like, read the [`BuildStatus`], and on [`Check::Grow`]
//! resize and record again. Until a build of the triangles that a structure has is complete, traces answer "not ready" and
//! count it; they never give a partial answer, nor one for triangles that it had before.
//!
//! This crate records commands. What is recorded never submits, waits or allocates. Memory is allocated by constructors,
//! [`Structure::resize`], [`Structure::set_slots`], and [`Structure::set_geometry`] where there are more triangles than before.
//! These submit and wait: [`Structure::prepare_build`] of a structure that is built on the host, a [`RayQueue`] that is made on
//! a device with a queue, through which it is cleared, and whatever reads pools or writes them for tests and reports.
//!
//! # Synchronisation
//! [`Structure::record_build`], [`Structure::record_trace`] and [`Structure::record_surfaces`] end with
//! a barrier that makes their results visible to compute shaders and transfers recorded after them.
//! Data that they read must be visible to compute, vertex and fragment shaders before.

mod addressing;
mod bounds_pass;
mod brute_force;
mod combined;
mod configured;
mod counters;
mod description;
mod design;
mod ends;
mod error;
mod geometry;
mod geometry_desc;
mod geometry_extent;
mod geometry_gather;
mod geometry_parts;
mod groups;
mod inspect;
mod kernels;
mod lengths;
mod list_counts;
mod list_sort;
mod occluder;
mod passes;
mod pool_name;
mod pooled;
mod pools;
mod pyramid;
mod queue;
mod queue_buffers;
mod scan;
mod scene_binding;
mod scratch;
mod sizes;
mod slots;
mod status;
mod steps;
mod structure;
mod trace;
mod viewpoint;
mod visit;
mod words;

pub use addressing::{Addressing, Modules, TraceModules};
pub use bounds_pass::BoundsPass;
pub use brute_force::BruteForce;
pub use combined::Combined;
pub use configured::{Common, Configured, check_range, check_work_budget};
pub use counters::Counters;
pub use description::{Dependencies, Description, StructureKind};
pub use design::{Demand, Design, Parts, default_work_budget};
pub use ends::Ends;
pub use error::AdsError;
pub use geometry::{Geometry, NO_MAP};
pub use geometry_desc::{BufferOffset, GeometryDesc, IndexFormat, IndexRange, Indexing, PositionRange};
pub use geometry_extent::GeometryExtent;
pub use geometry_parts::{GeometryParts, MovingPart, PartRays, Rest};
pub use groups::folded;
pub use inspect::Inspect;
pub use kernels::{Lookup, TraceKernels, TraceKernelsDesc, TracedPart};
pub use lengths::Lengths;
pub use list_counts::ListCounts;
pub use list_sort::ListSort;
pub use occluder::Occluder;
pub use passes::{BuildPipelines, BuildTarget, ViewDraw};
pub use pool_name::{HEADER_POOL, PoolBytes, PoolContents, PoolName, bytes_of_words};
pub use pooled::{Pooled, VARYING_SHARE};
pub use pools::Pools;
pub use pyramid::Pyramid;
pub use queue::{Domain, QueueCounters, QueueParts, RayQueue};
pub use queue_buffers::QueueBuffers;
pub use rasray_gpu::TraceMode;
pub use rasray_shaders_glsl::records::{
    Draw, GeometryHeader, GeometryRigid, Hit, QueueHeader, Ray, RayWork, RecordLayout, Surface, TraceState,
};
pub use scan::Scan;
pub use scene_binding::SceneBinding;
pub use scratch::Scratch;
pub use sizes::{PoolSize, Sizes};
pub use status::{BuildStatus, Check, Growth, PoolStatus};
pub use steps::{SkipReason, StepKind, TestVerdict, TraceStep};
pub use structure::{InlineTrace, Structure, StructureReport};
pub use trace::{Start, Trace};
pub use viewpoint::{CameraView, Viewpoint, box_is_same};
pub use visit::{Builder, LargePass, Visit, Visits, bin_groups};

/// "No primitive": a miss.
pub const PRIMITIVE_NONE: u32 = rasray_shaders_glsl::constants::contract::PRIMITIVE_NONE;
/// A fragment whose triangle is not known.
pub const PRIMITIVE_UNKNOWN: u32 = rasray_shaders_glsl::constants::contract::PRIMITIVE_UNKNOWN;
/// A draw whose triangles are alpha-masked.
pub const DRAW_ALPHA_MASKED: u32 = rasray_shaders_glsl::constants::contract::DRAW_ALPHA_MASKED;
/// A draw whose triangles have a back that rays with [`RAY_CULL_BACK_FACES`] pass.
pub const DRAW_SINGLE_SIDED: u32 = rasray_shaders_glsl::constants::contract::DRAW_SINGLE_SIDED;
/// A draw whose front is the clockwise side.
pub const DRAW_MIRRORED: u32 = rasray_shaders_glsl::constants::contract::DRAW_MIRRORED;
/// In [`Ray::flags`]: backs of draws with [`DRAW_SINGLE_SIDED`] are no hits.
pub const RAY_CULL_BACK_FACES: u32 = rasray_shaders_glsl::constants::contract::RAY_CULL_BACK_FACES;

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
