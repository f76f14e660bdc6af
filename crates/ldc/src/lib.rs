//! Layered depth cubes, after LDC: a structure of fragments in three orthographic views. Hosts make one from
//! their triangles and trace it as any [`rasray_ads::Structure`].
//!
//! The rasterizer stores every fragment of three views along the axes, each triangle in the view that it
//! faces most. One pass makes all layers of a cell and stores them contiguously, sorted by depth, in the
//! order in which peeling would find them. Rays traverse the views one after the other.
//!
//! - [`LayeredDepthCube`] is the structure; the contract of [`rasray_ads::Structure`] says who waits and when
//!   to resize.
//! - [`Config`] holds its options: [`Depth`], [`Payload`], [`Coverage`], [`Accept`], [`Making`] and more.
//! - [`plan`] and [`formula_bytes`] compute its memory without a device.
//! - [`Contents`] and [`well_formed`] check its lists on the host, for tests.
//!
//! Source: Bürger, Hertel, Krüger, Westermann, "GPU rendering of secondary effects", VMV 2007 (LDC).
//! `docs/systems/ldc.md` has passes, bytes, options, limits and departures.

mod build;
mod config;
mod layout;
mod pool;
mod structure;
mod validate;

pub use build::Build;
pub use config::{Accept, Config, Coverage, Depth, Making, Occupancy, Payload};
pub use layout::{Demand, FormulaBytes, block_count, cell_count, formula_bytes, plan};
pub use pool::Pool;
pub use rasray_ads::{Addressing, Builder, Ends};
pub use rasray_shaders_glsl::records::LdcHeader as Header;
pub use structure::LayeredDepthCube;
pub use validate::{Contents, Fault, well_formed};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
