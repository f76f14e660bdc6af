//! Loops on the host that drive structures: builds until complete, batches of rays, frames in flight.
//! Embedders record their frames with this crate; comparisons, benches and tests build and trace with it.
//!
//! - [`FrameStructure`] builds a structure over frames in flight. It neither submits nor waits, so a host
//!   records its own frames with it.
//! - [`Frames`] is the complete loop of a structure over frames, with its submissions.
//! - [`build_until_complete`] submits builds and resizes the pools until a build is complete.
//! - [`BatchTracer`] traces any number of rays and returns their hits.
//! - [`Replay`] logs the steps of single rays.

mod batch;
mod build;
mod error;
mod frame_structure;
mod frames;
mod refresh;
mod replay;
mod share;

pub use batch::{BatchTracer, TraceOutcome};
pub use build::{BuildOutcome, build_until_complete, refresh_until_complete};
pub use error::TracerError;
pub use frame_structure::{FrameOutcome, FrameSettings, FrameStructure, StructureCounts};
pub use frames::{EndedFrame, Frames};
pub use refresh::Refresh;
pub use replay::Replay;

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
