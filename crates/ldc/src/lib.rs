//! Layered depth cubes: the rasterizer stores every fragment of three orthographic views along the axes, each
//! triangle in the view it faces most, and rays traverse the views one after the other.
//!
//! Source: Bürger, Hertel, Krüger, Westermann, "GPU rendering of secondary effects", VMV 2007 (LDC). All
//! layers of a cell are made in one pass and stored contiguously, sorted by depth, as peeling would
//! yield them. See `docs/systems/ldc.md` for passes, bytes, options, limits and departures.
//!
//! [`LayeredDepthCube`] implements [`rasray_ads::Structure`]; its contract says who waits and when to resize.

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
