//! Shadow maps: what each light without extent sees, and points on triangles that emit, as depths, which answer shadow rays in place of traces (Williams
//! 1978). Drawn by the rasterizer each frame in which lights or triangles have moved.
//!
//! A map has an error that traces do not have: it knows one depth per texel. Passes, bytes, options and how often answers
//! differ are on `docs/shadow-maps.md`.
//!
//! [`ShadowMaps`] is an [`rasray_ads::Occluder`]: rays that lead to no light with a map are traced through a structure.

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
