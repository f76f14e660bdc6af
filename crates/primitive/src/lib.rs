//! Primitive lists: the rasterizer stores the ids of triangles in lists per tile and depth bucket of the six
//! faces of a cube around the eye, and rays are tested against what the tiles on their way list.
//!
//! Source: Vardis, Vasilakis, Papaioannou, "DIRT: Deferred image-based ray tracing", HPG 2016. Hits are those
//! of the triangles themselves; the rules of the paper by which some are lost are options. See
//! `docs/systems/dirt.md` for passes, bytes, options, limits and departures.
//!
//! [`PrimitiveLists`] implements [`rasray_ads::Structure`]; its contract says who waits and when to resize.

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
