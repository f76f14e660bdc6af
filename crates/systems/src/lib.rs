//! Systems as data: which structure, which presets, which options. The command, tests and benches loop
//! over [`SYSTEMS`] and make structures through [`Spec`]; apart from it only tests that look into a structure name one.

mod bricks;
mod brute_force;
mod bvh;
mod dirt;
mod driver_rt;
mod error;
mod given;
mod grid;
mod hu;
mod ldc;
mod mmrt;
mod options;
mod registry;
mod selective;
mod spec;
mod structure_option;
mod voxel;

pub use error::SystemsError;
pub use options::{OPTIONS, VIEW_LIMIT, option};
pub use registry::SYSTEMS;
pub use spec::{PaperFrame, Preset, Spec, System};
pub use structure_option::{Group, Hits, StructureOption};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
