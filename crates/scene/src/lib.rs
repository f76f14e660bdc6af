//! Scenes: what is in them, those that are built in, and what of them a render can observe.
//!
//! Nothing here knows of Vulkan, or reads a file: `rasray-scene-files` does. Transforms are kept in f64 until the pose;
//! positions are metres, angles radians, times seconds, radiance W/(sr m^2).

pub mod animation;
mod back_faces;
pub mod builtin;
pub mod check;
pub mod default_view;
pub mod deforming;
mod error;
pub mod facing;
pub mod flattened;
mod mesh;
pub mod model;
mod moments;
pub mod nearest;
pub mod needs;
pub mod pose;
pub mod remarks;
mod sampler;
mod shadow_terminator;
pub mod text;
pub mod time;
mod warning;

pub use back_faces::BackFaces;
pub use deforming::Motion;
pub use error::SceneError;
pub use model::*;
pub use pose::Moment;
pub use sampler::Sampler;
pub use shadow_terminator::ShadowTerminator;

/// Examples of the readme, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
