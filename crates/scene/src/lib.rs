//! Scenes: what is in them, how they are read, and what of them a render can observe.
//!
//! Nothing here knows of Vulkan. Transforms are kept in f64 until the pose; positions are metres,
//! angles radians, times seconds, radiance W/(sr m^2).

pub mod model;

pub use model::*;
