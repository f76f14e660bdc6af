//! Runs structures from the host: the loop that builds until complete, batches of rays traced through a queue, and frames
//! in flight.
//!
//! [`FrameStructure`] neither submits nor waits: embedders with frames of their own record with it. Everything else
//! submits for itself.

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
pub use frame_structure::{FrameOutcome, FrameStructure, Keeping, StructureCounts};
pub use frames::{Ended, Frames};
pub use refresh::Refresh;
pub use replay::Replay;

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
