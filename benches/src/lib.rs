//! Shared parts of benches: words of their command lines, other tracers to be measured beside this project's,
//! and clocks.

pub mod clock;
pub mod embree;
pub mod moving;
pub mod setting;
