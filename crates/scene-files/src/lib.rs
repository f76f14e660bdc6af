//! Scenes from files: glTF, OBJ, PLY, numbered files that form one scene over time, and environment maps.
//! `rasray-scene-source` loads scenes with this crate; a host can use it alone.
//!
//! - [`load()`] makes a [`rasray_scene::Scene`] from a file; [`LoadOptions`] holds limits, the choice of a
//!   scene in a file with several, and frames per second.
//! - [`load_environment`] reads an environment map, [`decode_image`] an image.
//! - [`sequence`] reads numbered files.
//!
//! The page `docs/scene-files.md` of the repository says which parts of a file are read, refused and remarked
//! on.

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
