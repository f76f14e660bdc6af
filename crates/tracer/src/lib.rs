//! Runs structures from the host: the loop that builds until complete, and batches of rays traced through a queue. This
//! crate submits and waits; embedders with their own frame use [`rasray_ads`] alone.

mod batch;
mod build;
mod error;
mod replay;
mod share;

pub use batch::{BatchTracer, TraceOutcome};
pub use build::{BuildOutcome, build_until_complete};
pub use error::TracerError;
pub use replay::Replay;

/// What the readme shows compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
