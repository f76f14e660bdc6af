//! Systems as data: which structure, which presets, which options. The command, tests and benches loop
//! over [`SYSTEMS`] and make structures through [`Spec`]; beside it only tests that look into a structure name one.

mod brute_force;
mod bvh;
mod dirt;
mod error;
mod hu;
mod ldc;
mod mmrt;
mod option;
mod selective;
mod spec;
mod voxel;

pub use error::SystemsError;
pub use spec::{Preset, SYSTEMS, Spec, System};
