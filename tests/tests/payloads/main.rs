//! What fragments carry beside depths, and the integrators that read it.

mod capacity;
mod integrators;
mod published;
