//! Primitive lists, after DIRT: a structure of triangle ids per tile of image-space views. Hosts make one
//! from their triangles and trace it as any [`rasray_ads::Structure`].
//!
//! The rasterizer stores the ids of triangles in lists per tile and depth bucket of the six faces of a cube
//! around the eye. Rays test the triangles that the tiles on their way list, so hits are those of the
//! triangles. The rules of the paper that lose some hits are options.
//!
//! - [`PrimitiveLists`] is the structure; the contract of [`rasray_ads::Structure`] says who waits and when
//!   to resize.
//! - [`Config`] holds its options: [`Storage`], [`March`], [`Coverage`], [`Accept`], [`Stop`] and more.
//! - [`plan`] and [`formula_bytes`] compute its memory without a device.
//! - [`Contents`] and [`well_formed`] check its lists on the host, for tests.
//!
//! Source: Vardis, Vasilakis, Papaioannou, "DIRT: Deferred image-based ray tracing", HPG 2016.
//! `docs/systems/dirt.md` has passes, bytes, options, limits and departures.

mod build;
mod config;
mod layout;
mod pool;
mod rules;
mod structure;
mod validate;

pub use config::{Centre, Config, PyramidStart, Storage, Views};
pub use layout::{Demand, FormulaBytes, cell_count, formula_bytes, plan};
pub use pool::Pool;
pub use rasray_ads::{Addressing, Builder};
pub use rasray_shaders_glsl::records::PrimitiveHeader as Header;
pub use rules::{Accept, Coverage, Depths, March, Stop};
pub use structure::{Passes, PrimitiveLists};
pub use validate::{Contents, Fault, well_formed};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
