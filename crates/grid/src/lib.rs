//! A plain uniform grid: cells of one size over the bounds of the geometry, each with a list of the triangles that reach
//! into it, traced from cell to cell (Amanatides and Woo 1987). It is the baseline of structures made of cells.
//!
//! Passes, bytes, options and limits are on `docs/systems/grid.md`.
//!
//! [`Grid`] implements [`rasray_ads::Structure`]; its contract says who waits and when to resize.

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
