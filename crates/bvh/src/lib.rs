//! Bounding volume hierarchies: the baseline that structures in image space are compared with, behind the
//! same contract and with the same triangle test, so that hits are identical and only speed differs.
//!
//! Builders make trees of one format, which one traversal reads: [`Builder::Sah`] lowers the expected
//! cost by surface area on the host, [`Builder::Lbvh`] sorts triangles along a Morton curve on the device
//! (Karras, "Maximizing parallelism in the construction of BVHs, octrees, and k-d trees", HPG 2012),
//! [`Builder::Ploc`] merges clusters in that order by surface area (Meister and Bittner, "Parallel locally-ordered clustering for
//! bounding volume hierarchy construction", TVCG 24(3), 2018), [`Builder::Trbvh`] restructures treelets of the tree by Morton
//! codes by surface area (Karras and Aila, "Fast parallel construction of high-quality bounding volume hierarchies", HPG 2013),
//! and [`Builder::Refit`] does that once and then only finds boxes anew. See `docs/systems/bvh.md` for passes, bytes, options,
//! limits and departures.
//!
//! [`Bvh`] implements [`rasray_ads::Structure`]; its contract says who waits and when to resize.

mod build;
mod config;
mod four;
mod host;
mod layout;
mod order;
mod pool;
mod structure;
mod validate;

pub use config::{Builder, Children, Chunks, Config};
pub use layout::{FormulaBytes, formula_bytes, plan};
pub use pool::Pool;
pub use rasray_ads::Addressing;
pub use rasray_shaders_glsl::records::{
    BvhHeader as Header, BvhNode as Node, BvhNodeOfFour as NodeOfFour, BvhRecord as Record,
};
pub use structure::{Bvh, Demand, Passes};
pub use validate::{Contents, Fault, Shape, well_formed};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
