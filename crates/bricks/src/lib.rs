//! Bricks: a structure of cells with lists of triangles, whose hits are those of the triangles. Hosts make
//! one from their triangles and trace it as any [`rasray_ads::Structure`].
//!
//! Each cell lists the triangles that reach into it. 4x4x4 cells form a brick with a mask, and each brick
//! stores how far around it everything is empty, so that rays cross empty space many cells at a time.
//!
//! - [`Bricks`] is the structure; the contract of [`rasray_ads::Structure`] says who waits and when to
//!   resize.
//! - [`Config`] holds its options; [`Views`] chooses the projections in which cells are made.
//! - [`plan`] and [`formula_bytes`] compute its memory without a device.
//! - [`Contents`] and [`well_formed`] check its lists on the host, for tests.
//!
//! No paper describes this structure. `docs/systems/bricks.md` has its debts to DIRT and to Hu et al.,
//! passes, bytes, options and limits.

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
