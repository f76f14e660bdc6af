//! Voxel grids over three axis A-buffers, after Hu et al. and the selective variant: a structure of
//! fragments. Hosts make one from their triangles and trace it as any [`rasray_ads::Structure`].
//!
//! The rasterizer stores the fragments of three orthographic views of the scene's cube, and marks the voxels
//! that contain fragments. Rays step through the voxels, and search the views in the marked ones.
//!
//! - [`Voxels`] is the structure; the contract of [`rasray_ads::Structure`] says who waits and when to
//!   resize.
//! - [`Config`] holds its options: [`Storage`], [`Payload`], [`Marking`], [`Leaves`], [`Accept`] and more.
//! - [`plan`] and [`formula_bytes`] compute its memory without a device.
//! - [`Contents`] and [`well_formed`] check its lists on the host, for tests.
//!
//! Sources: Hu, Huang, Zhang, Yuan, Li, "Ray tracing via GPU rasterization", The Visual Computer 30 (2014);
//! Frid Kastrati, Goswami, "Selective rasterized raytracing", 2017, which keeps each fragment in one view
//! only. `docs/systems/hu.md` and `docs/systems/selective.md` have passes, bytes, options, limits and
//! departures.

mod build;
mod choices;
mod config;
mod layout;
mod pool;
mod structure;
mod validate;

pub use build::Build;
pub use choices::{Accept, Axes, Coverage, Inside, Leaves, March, Marking, Payload, Storage, Traversal};
pub use config::{Config, VOXEL_LEAVES_GRID};
pub use layout::{Demand, FormulaBytes, formula_bytes, list_count, plan};
pub use pool::Pool;
pub use rasray_ads::{Addressing, Builder, Ends};
pub use rasray_shaders_glsl::records::VoxelHeader as Header;
pub use structure::Voxels;
pub use validate::{Contents, Fault, Fragment, well_formed};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
