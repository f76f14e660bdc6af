//! The systems of rasray as data: each is a structure with its presets and options. The command, tests and
//! benches loop over [`SYSTEMS`]; only tests of the contents of a structure name its crate.
//!
//! - [`System`] is a row of [`SYSTEMS`]: name, help, presets, options.
//! - [`Spec`] is a system with a preset and values of options, from which the structure is made.
//! - [`OPTIONS`] has every option of structures, with its range, its help and whether it may change a hit
//!   ([`Hits`]).

mod bricks;
mod brute_force;
mod bvh;
mod dirt;
mod driver_rt;
mod error;
mod grid;
mod hu;
mod ldc;
mod mmrt;
mod option_value;
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
