//! Scenes: what is in them, how they are read, and what of them a render can observe.
//!
//! Nothing here knows of Vulkan. Transforms are kept in f64 until the pose; positions are metres,
//! angles radians, times seconds, radiance W/(sr m^2).

pub mod animation;
mod back_faces;
pub mod builtin;
pub mod check;
mod decode;
pub mod default_view;
pub mod deforming;
mod environment_map;
mod error;
pub mod facing;
mod files;
mod finish;
mod flattened;
mod formats;
pub mod gltf;
mod images;
mod kinds;
mod limits;
mod load;
mod mesh;
pub mod model;
mod moments;
pub mod nearest;
pub mod needs;
pub mod obj;
mod origin;
pub mod ply;
mod polygon;
pub mod pose;
mod recognise;
mod reference;
mod remarks;
pub mod sequence;
mod shadow_terminator;
mod text;
mod time;
mod warning;

pub use back_faces::BackFaces;
pub use decode::decode_image;
pub use deforming::Motion;
pub use environment_map::load_environment;
pub use error::SceneError;
pub use limits::{Limits, LoadOptions, SceneChoice};
pub use load::load;
pub use model::*;
pub use pose::Moment;
pub use shadow_terminator::ShadowTerminator;

/// What the readme shows compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
