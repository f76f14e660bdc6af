//! The contract of all acceleration data structures of rasray, and the geometry, the ray queues and the trace
//! kernels that they share. Hosts record builds and traces through the contract; structure crates such as
//! `rasray-bvh` implement it.
//!
//! - [`Structure`] is the contract: it builds itself from a [`Geometry`], traces rays through itself, and
//!   finds the surfaces of hits.
//! - [`Geometry`] binds the triangles in the buffers of a host ([`GeometryDesc`]). If only some triangles
//!   move, [`GeometryParts`] and [`Combined`] divide them.
//! - [`RayQueue`] holds rays, hits and surfaces on the device. [`Trace`] says which of its rays to trace, and
//!   for which kind of answer.
//! - [`Occluder`] answers shadow rays in place of a structure.
//! - [`BruteForce`] tests every triangle against every ray. All other structures are compared with it.
//! - [`Counters`] and [`TraceStep`] measure and log the work of rays; [`Inspect`] reads pools for tests and
//!   tools.
//! - [`kit`] has the parts that structures are made of; hosts do not need it.
//!
//! # Building
//! The exact demand for memory is known only after the GPU ran, so the caller may have to repeat a build:
//!
//! 1. Prepare a build ([`Structure::prepare_build`]), record it ([`Structure::record_build`]), submit it, and
//!    wait.
//! 2. Read the [`BuildStatus`] ([`Structure::status`]), and check it ([`Structure::check`]).
//! 3. On [`Check::Grow`] resize and begin again. [`Check::Complete`] ends the build.
//!
//! Until a build of the present triangles is complete, traces answer "not ready" and count these answers.
//! They never answer for some of the triangles only, nor for earlier triangles.
//!
//! # Memory and waits
//! Functions that record never submit, wait or allocate. These allocate: constructors,
//! [`Structure::resize`], [`Structure::set_slots`], and [`Structure::set_geometry`] with more triangles than
//! before. These submit and wait:
//!
//! - [`Structure::prepare_build`] of a structure that is built on the host
//! - constructors of a [`RayQueue`] on a device with a queue, to clear it
//! - functions that read pools, or write them for tests and reports
//!
//! # Synchronisation
//! [`Structure::record_build`], [`Structure::record_trace`] and [`Structure::record_surfaces`] end with
//! a barrier that makes their results visible to compute shaders and transfers recorded after them. The
//! caller's barriers make the data that they read visible to compute, vertex and fragment shaders.

mod brute_force;
mod combined;
mod counters;
mod description;
mod ends;
mod error;
mod geometry;
mod inspect;
pub mod kit;
mod list_counts;
mod occluder;
mod queue;
mod scene_binding;
mod sizes;
mod slots;
mod status;
mod steps;
mod structure;
mod trace;
mod viewpoint;
mod words;

// The contract between structures and hosts.
pub use error::AdsError;
pub use inspect::Inspect;
pub use occluder::Occluder;
pub use scene_binding::SceneBinding;
pub use structure::{InlineTrace, Structure, StructureReport};
pub use viewpoint::{CameraView, Viewpoint};

// Options that several structures have, and facts about a structure.
pub use counters::Counters;
pub use description::{Dependencies, Description, StructureKind};
pub use ends::Ends;
pub use kit::addressing::Addressing;
pub use kit::visit::Builder;

// Builds and their outcomes.
pub use list_counts::ListCounts;
pub use sizes::{PoolSize, Sizes};
pub use status::{BuildStatus, Check, Growth, PoolStatus};

// Triangles.
pub use geometry::bounds_pass::BoundsPass;
pub use geometry::desc::{BufferOffset, GeometryDesc, IndexFormat, IndexRange, Indexing, PositionRange};
pub use geometry::extent::GeometryExtent;
pub use geometry::parts::{GeometryParts, MovingPart, PartRays, Rest};
pub use geometry::{Geometry, NO_MAP};

// Rays and traces.
pub use kit::kernels::TracedPart;
pub use queue::buffers::QueueBuffers;
pub use queue::{Domain, QueueCounters, QueueParts, RayQueue};
pub use rasray_gpu::TraceMode;
pub use steps::{SkipReason, StepKind, TestVerdict, TraceStep};
pub use trace::{Start, Trace};

// Structures of this crate.
pub use brute_force::BruteForce;
pub use combined::Combined;

// Records that shaders share.
pub use rasray_shaders_glsl::records::{
    Draw, GeometryHeader, GeometryRigid, Hit, QueueHeader, Ray, RayWork, RecordLayout, Surface, TraceState,
};

/// Primitive id of a miss: "no primitive".
pub const PRIMITIVE_NONE: u32 = rasray_shaders_glsl::constants::contract::PRIMITIVE_NONE;
/// Primitive id of a fragment whose triangle is not known.
pub const PRIMITIVE_UNKNOWN: u32 = rasray_shaders_glsl::constants::contract::PRIMITIVE_UNKNOWN;
/// Flag of a draw whose triangles are alpha-masked.
pub const DRAW_ALPHA_MASKED: u32 = rasray_shaders_glsl::constants::contract::DRAW_ALPHA_MASKED;
/// Flag of a draw whose triangles are single-sided: rays with [`RAY_CULL_BACK_FACES`] pass through their
/// backs.
pub const DRAW_SINGLE_SIDED: u32 = rasray_shaders_glsl::constants::contract::DRAW_SINGLE_SIDED;
/// Flag of a draw whose front is the clockwise side.
pub const DRAW_MIRRORED: u32 = rasray_shaders_glsl::constants::contract::DRAW_MIRRORED;
/// Flag in [`Ray::flags`]: the ray passes through backs of draws with [`DRAW_SINGLE_SIDED`].
pub const RAY_CULL_BACK_FACES: u32 = rasray_shaders_glsl::constants::contract::RAY_CULL_BACK_FACES;

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
