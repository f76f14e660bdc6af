//! Shared parts of benches: the words of their command lines, tracers of others to be measured beside,
//! clocks.

pub mod clock;
pub mod embree;
pub mod moving;
pub mod setting;
