//! Scenes as data: meshes, instances, materials, lights, cameras and their animation. Loaders make scenes;
//! renderers and checks read them.
//!
//! - [`Scene`] is a scene; [`model`] has its parts.
//! - [`builtin`] has the scenes that need no file.
//! - [`pose`], [`animation`] and [`deforming`] give the scene at a [`Moment`].
//! - [`needs`] says which parts of a scene a render can observe.
//! - [`default_view`] finds a camera, and [`check`] checks and repairs meshes.
//!
//! The crate knows no Vulkan and reads no file: `rasray-scene-files` does. Transforms are f64 until the pose;
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
