//! Integrators on a device against the naive reference.

mod common;
mod corpus;
mod images;
mod needs;
mod reference;
mod texel_runs;
