//! A voxel grid over three axis A-buffers: the rasterizer stores the fragments of three orthographic views of
//! the scene's cube, and marks the voxels they lie in. Rays step through the voxels, and search the views of
//! those that are marked.
//!
//! Sources: Hu, Huang, Zhang, Yuan, Li, "Ray tracing via GPU rasterization", The Visual Computer 30 (2014);
//! Frid Kastrati, Goswami, "Selective rasterized raytracing", 2017, which keeps each fragment in one view
//! only. See `docs/systems/hu.md` and `docs/systems/selective.md` for passes, bytes, options, limits and
//! departures.
//!
//! [`Voxels`] implements [`rasray_ads::Structure`]; its contract says who waits and when to resize.

mod build;
mod config;
mod layout;
mod pool;
mod structure;
mod validate;

pub use build::Build;
pub use config::{
    Accept, Axes, Config, Coverage, Inside, Leaves, March, Marking, Payload, Storage, Traversal,
    VOXEL_LEAVES_GRID,
};
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
