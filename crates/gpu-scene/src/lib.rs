//! Scenes on a Vulkan device: posed geometry, materials, texels and lights. Structures build from them, and
//! integrators shade with them.
//!
//! - [`SceneTables`] packs a scene into plain arrays, byte for byte as shaders read them (`docs/shading.md`).
//!   It needs no device, so its contents can be checked anywhere.
//! - [`Parts`] chooses the parts that are packed: those that a render can observe.
//! - [`GpuScene`] uploads the tables and binds them: a `rasray_ads::Geometry` for structures, and a set for
//!   shading. [`GpuScene::staged`] uploads them with a frame of the caller, without waiting.
//! - [`PosePass`] poses moving draws on the device, frame by frame: [`PosePass::frame`] computes the
//!   transforms of nodes, [`PosePass::record`] records the rest. An oracle reads the positions back from the
//!   device.
//! - [`TexelRuns`] spreads texels over several buffers, so that they may exceed one binding of a device.
//!   [`TexelDemand`] tells before an upload whether they fit, and makes the largest images smaller.
//!
//! Positions in the tables are posed in f64 (`world_from_mesh * position`, minus the frame origin) and then
//! rounded to f32. Structures and oracles read these: [`Posed::positions`].

mod attributes;
mod distribution;
mod emissive;
mod environment;
mod error;
mod features;
mod glass_albedo;
mod kinds;
pub mod layout;
mod lights;
mod materials;
pub mod mips;
mod origin;
mod parts;
mod pose;
mod pose_pass;
mod smaller_images;
mod staging;
mod table_bytes;
mod tables;
mod texel_runs;
mod textures;
mod upload;
mod view;
mod words;

pub use environment::EnvironmentTables;
pub use error::GpuSceneError;
pub use features::ShadingFeatures;
pub use origin::{frame_origin_spacing, snap_frame_origin};
pub use parts::{Parts, TextureKind};
pub use pose::{LARGEST_COORDINATE, Posed};
pub use pose_pass::{FramePose, PosePass};
pub use smaller_images::{SmallerImage, TexelDemand};
pub use table_bytes::left_out_bytes;
pub use tables::SceneTables;
pub use texel_runs::{TEXEL_BYTES, TexelRuns};
pub use upload::{GpuScene, PosedBuffers};
pub use view::{Sampling, View};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
