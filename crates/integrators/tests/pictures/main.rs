//! Integrators on a device against the naive reference.

mod anisotropy;
pub(crate) mod common;
mod corpus;
mod cube_map;
mod images;
mod layers;
mod lens;
mod needs;
mod passing;
mod photons;
mod reference;
mod registry;
mod texel_runs;
mod whitted;
