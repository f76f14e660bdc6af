//! The payload of fragments, and the integrators that read it.

mod capacity;
mod ids;
mod integrators;
mod lamps;
mod published;
mod whitted;
