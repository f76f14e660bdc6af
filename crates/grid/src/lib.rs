//! A uniform grid: the baseline for structures made of cells. Hosts make one from their triangles and trace
//! it as any [`rasray_ads::Structure`].
//!
//! Cells of one size cover the bounds of the geometry. Each cell lists the triangles that reach into it, and
//! rays go from cell to cell (Amanatides and Woo 1987). Hits are those of the triangles.
//!
//! - [`Grid`] is the structure; the contract of [`rasray_ads::Structure`] says who waits and when to resize.
//! - [`Config`] holds its options.
//! - [`plan`] and [`formula_bytes`] compute its memory without a device.
//! - [`Contents`] and [`well_formed`] check its lists on the host, for tests.
//!
//! `docs/systems/grid.md` has passes, bytes, options and limits. This crate is the shortest example of a
//! structure.

mod build;
mod config;
mod layout;
mod pool;
mod structure;
mod validate;

pub use config::Config;
pub use layout::{Demand, FormulaBytes, formula_bytes, plan};
pub use pool::Pool;
pub use rasray_ads::Addressing;
pub use rasray_shaders_glsl::records::GridHeader as Header;
pub use structure::{Grid, Passes};
pub use validate::{Contents, Fault, well_formed};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
