//! Scenes on a Vulkan device: posed geometry, materials, texels and lights.
//!
//! [`SceneTables`] packs a scene into plain arrays, byte for byte what the shaders read (see
//! `docs/shading.md`). It needs no device, so its contents can be checked anywhere. Only the
//! [`Parts`] that a render can observe are packed.
//!
//! [`GpuScene`] uploads the tables and binds them: a `rasray_ads::Geometry` for structures, a set for
//! everything that shades.
//!
//! [`GpuScene::staged`] does the same without waiting: the tables go to the device with a frame of the caller's.
//!
//! Texels are spread over several buffers ([`TexelRuns`]), and may exceed what one binding of a device holds. What
//! exceeds these too is known before ([`TexelDemand`]): the scene's largest images can be made smaller.
//!
//! Geometry is posed in f64 when the tables are made: `world_from_mesh * position`, minus the frame
//! origin, rounded to f32. What structures build from and what an oracle should read is
//! [`Posed::positions`].
//!
//! [`PosePass`] poses moving draws on the device, frame by frame: [`PosePass::frame`] says where nodes are,
//! [`PosePass::record`] records the rest. An oracle reads positions back from the device then.

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
