//! Multiview, multilayer A-buffers, after MMRT: a structure of fragments for rays near the eye. Hosts make
//! one from their triangles and trace it as any [`rasray_ads::Structure`].
//!
//! The rasterizer draws the six faces of a cube around the eye, the camera's view there, or both, and stores
//! every fragment in lists per cell and depth bucket. Rays step through the cells and search their lists.
//!
//! - [`ABuffer`] is the structure; the contract of [`rasray_ads::Structure`] says who waits and when to
//!   resize.
//! - [`Config`] holds its options: [`Views`], [`Storage`] (those that the paper compares), [`Payload`],
//!   [`March`], [`Coverage`], [`Accept`] and more.
//! - [`plan`] and [`formula_bytes`] compute its memory without a device.
//! - [`Contents`] and [`well_formed`] check its lists on the host, for tests.
//!
//! Source: Vardis, Vasilakis, Papaioannou, "A multiview and multilayer approach for interactive ray
//! tracing", I3D 2016 (MMRT). `docs/systems/mmrt.md` has passes, bytes, options, limits and departures.

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
