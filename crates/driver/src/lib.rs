//! The driver's own tree, traced by ray queries (`VK_KHR_acceleration_structure`, `VK_KHR_ray_query`): what hardware for ray
//! tracing has to be compared with. The driver finds boxes around triangles; whether a triangle is hit is decided by the test
//! that all structures share, so hits are exact and the same on every driver.
//!
//! Passes, bytes, options and limits are on `docs/systems/driver-rt.md`.
//!
//! [`Driver`] implements [`rasray_ads::Structure`]; its contract says who waits and when to resize.

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
