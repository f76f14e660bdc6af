//! Bricks: cells with lists of the triangles that reach into them, 4x4x4 cells in a brick with a mask, and bricks that
//! say how far around them everything is empty. Hits are those of the triangles, and rays cross empty space many
//! cells at a time.
//!
//! This structure is in no paper. What it takes from DIRT and from Hu et al., its passes, bytes, options and limits are
//! in `docs/systems/bricks.md`.
//!
//! [`Bricks`] implements [`rasray_ads::Structure`]; its contract says who waits and when to resize.

mod build;
mod config;
mod grid;
mod layout;
mod pool;
mod structure;
mod validate;

pub use config::Config;
pub use grid::Views;
pub use layout::{Demand, FormulaBytes, formula_bytes, plan};
pub use pool::Pool;
pub use rasray_ads::{Addressing, Builder};
pub use rasray_shaders_glsl::records::BricksHeader as Header;
pub use structure::{Bricks, Passes};
pub use validate::{Cell, Contents, Fault, well_formed};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
