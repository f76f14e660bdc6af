//! Bounding volume hierarchies: the baseline for structures in image space.
//!
//! All structures share one triangle test, so hits are identical and only speed differs. All builders make
//! trees of one format, so one traversal reads them all.
//!
//! - [`Bvh`] is the structure; the contract of [`rasray_ads::Structure`] says who waits and when to resize.
//! - [`Config`] holds its options: [`Builder`], [`Children`] per node, [`Chunks`] and more.
//! - [`plan`] and [`formula_bytes`] compute its memory without a device.
//! - [`Contents`] and [`well_formed`] check its nodes on the host, for tests.
//!
//! | builder | algorithm |
//! |---|---|
//! | [`Builder::Sah`] | least expected cost by surface area, on the host |
//! | [`Builder::Lbvh`] | triangles sorted along a Morton curve, on the device: Karras, "Maximizing parallelism in the construction of BVHs, octrees, and k-d trees", HPG 2012 |
//! | [`Builder::Ploc`] | clusters in that order merged by surface area: Meister and Bittner, "Parallel locally-ordered clustering for bounding volume hierarchy construction", TVCG 24(3), 2018 |
//! | [`Builder::Trbvh`] | treelets of the tree by Morton codes restructured by surface area: Karras and Aila, "Fast parallel construction of high-quality bounding volume hierarchies", HPG 2013 |
//! | [`Builder::Refit`] | the tree of [`Builder::Ploc`], kept while it stays good: then builds only compute its boxes |
//!
//! `docs/systems/bvh.md` has passes, bytes, options, limits and departures.

mod build;
mod config;
mod four;
mod host;
mod kept;
mod layout;
mod pool;
mod structure;
mod validate;

pub use config::{Builder, Children, Chunks, Config, Loads};
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
