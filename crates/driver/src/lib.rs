//! The driver's own tree, traced by ray queries (`VK_KHR_acceleration_structure`, `VK_KHR_ray_query`): the
//! structure that hardware for ray tracing accelerates. Hosts make one from their triangles and trace it as
//! any [`rasray_ads::Structure`].
//!
//! The driver finds the boxes of triangles that a ray hits, and the test that all structures share decides
//! whether the ray hits a triangle. Hits are exact, and equal on every driver.
//!
//! - [`Driver`] is the structure; the contract of [`rasray_ads::Structure`] says who waits and when to
//!   resize.
//! - [`Config`] holds its options; [`Goal`] chooses between fast traces and fast builds.
//! - [`plan`] and [`formula_bytes`] compute its memory without a device.
//!
//! `docs/systems/driver-rt.md` has passes, bytes, options and limits.

mod config;
mod layout;
mod pool;
mod structure;
mod validate;

pub use config::{Config, Goal};
pub use layout::{Demand, formula_bytes, plan};
pub use pool::Pool;
pub use rasray_shaders_glsl::records::DriverHeader as Header;
pub use structure::{Driver, Passes};
pub use validate::{Contents, Fault, well_formed};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
