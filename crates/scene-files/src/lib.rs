//! Scenes from files: glTF, OBJ and PLY, numbered files that are one scene over time, and environment maps.
//!
//! [`load`] makes a [`rasray_scene::Scene`] of a file. What of a file is read, refused and remarked on is in
//! `docs/scene-files.md` of the repository.

mod basis;
mod decode;
mod environment_map;
mod files;
mod finish;
mod formats;
pub mod gltf;
mod images;
mod kinds;
mod limits;
mod load;
pub mod obj;
mod origin;
pub mod ply;
mod polygon;
mod recognise;
mod reference;
pub mod sequence;

pub use decode::decode_image;
pub use environment_map::load_environment;
pub use limits::{Limits, LoadOptions, SceneChoice};
pub use load::load;

/// Examples of the readme, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
