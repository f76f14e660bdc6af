//! Systems as data: which structure, which presets, which options. The command, tests and benches loop
//! over [`SYSTEMS`] and make structures through [`Spec`]; apart from it only tests that look into a structure name one.

mod bricks;
mod brute_force;
mod bvh;
mod dirt;
mod error;
mod given;
mod grid;
mod hu;
mod ldc;
mod mmrt;
mod option_row;
mod options;
mod registry;
mod selective;
mod spec;
mod voxel;

pub use error::SystemsError;
pub use option_row::{Group, Hits, OptionRow, Values, Word};
pub use options::{OPTIONS, option};
pub use registry::SYSTEMS;
pub use spec::{Preset, Spec, System};

/// What the readme shows compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
