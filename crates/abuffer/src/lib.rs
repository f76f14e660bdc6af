//! Multiview, multilayer A-buffers: the rasterizer stores every fragment of the six faces of a cube around
//! the eye, or of what a camera there sees, in per-cell, per-bucket lists, and rays are traced through the
//! cells.
//!
//! Source: Vardis, Vasilakis, Papaioannou, "A multiview and multilayer approach for interactive ray
//! tracing", I3D 2016 (MMRT). Lists are kept in one of the storages the paper compares ([`Storage`]), with payload
//! in a pool of its own or within the nodes. See `docs/systems/mmrt.md` for passes, bytes, options, limits
//! and departures.
//!
//! [`ABuffer`] implements [`rasray_ads::Structure`]; its contract says who waits and when to resize.

mod build;
mod choices;
mod config;
mod fault;
mod layout;
mod pool;
mod structure;
mod validate;

pub use build::Build;
pub use choices::{Accept, Bounds, Coverage, March, Payload, Storage, ViewSwitching, Views};
pub use config::Config;
pub use fault::Fault;
pub use layout::{Demand, FormulaBytes, cell_count, formula_bytes, plan};
pub use pool::Pool;
pub use rasray_ads::{Addressing, Builder};
pub use rasray_shaders_glsl::records::AbufferHeader as Header;
pub use structure::ABuffer;
pub use validate::{Contents, Fragment, well_formed};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
