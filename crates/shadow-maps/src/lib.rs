//! Shadow maps: an occluder that answers shadow rays in place of traces (Williams 1978). Images use it with
//! `--occluder shadow-maps`; hosts can use it beside any structure.
//!
//! A map holds the depths that a light without extent sees, or that a point on an emitting triangle sees. The
//! rasterizer draws it in each frame in which lights or triangles have moved. A map knows one depth per
//! texel, and so has an error that traces do not have.
//!
//! - [`ShadowMaps`] is the [`rasray_ads::Occluder`]. A structure traces the rays that lead to no light with a
//!   map.
//! - [`Config`] has the number of texels of a map and the number of points of an emitting triangle.
//! - [`Lights`] and [`Emitters`] are the lights with maps; [`bytes`] computes the memory without a device.
//!
//! `docs/shadow-maps.md` has passes, bytes, options and measured errors.

mod config;
mod layout;
mod maps;

pub use config::Config;
pub use layout::{bytes, views_of};
pub use maps::{Emitters, Lights, ShadowMaps};
pub use rasray_shaders_glsl::records::{EmissiveTriangle, Light};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
