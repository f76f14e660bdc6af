//! Parts for authors of pooled structures. Hosts do not need them.
//!
//! A structure implements [`Design`]; [`Pooled`] makes a [`Structure`](crate::Structure) of it. The macros
//! [`configured!`](crate::configured), [`pools!`](crate::pools) and [`words!`](crate::words) write the
//! implementations that are the same for all structures; Rust exports them at the root of the crate.
//!
//! The crate `rasray-shaders-glsl` compiles the kernels, so a new structure is made in a clone of the
//! repository: `docs/adding.md`.
//!
//! | job | parts |
//! |---|---|
//! | definition | [`Design`], [`Parts`], [`Demand`], [`Pooled`], [`VARYING_SHARE`] |
//! | options | [`Configured`], [`Common`], [`check_range`], [`check_work_budget`], [`default_work_budget`] |
//! | buffers | [`PoolName`], [`Pools`], [`PoolBytes`], [`PoolContents`], [`HEADER_POOL`], [`Scratch`] |
//! | passes | [`BuildPipelines`], [`BuildTarget`], [`ViewDraw`], [`Modules`], [`workgroups`], [`folded`] |
//! | cells of triangles | [`Visits`], [`Visit`], [`LargePass`], [`bin_groups`] |
//! | lists and their depths | [`Lengths`], [`Scan`], [`ListSort`], [`Pyramid`] |
//! | traces and surfaces | [`TraceKernels`], [`TraceKernelsDesc`], [`TraceModules`], [`Lookup`] |
//! | stale builds | [`box_is_same`] |

pub(crate) mod addressing;
mod configured;
mod design;
pub(crate) mod groups;
pub(crate) mod kernels;
mod lengths;
mod list_sort;
mod passes;
mod pool_name;
mod pooled;
mod pools;
mod pyramid;
mod scan;
mod scratch;
pub(crate) mod visit;

pub use crate::viewpoint::box_is_same;
pub use addressing::{Modules, TraceModules};
pub use configured::{Common, Configured, check_range, check_work_budget};
pub use design::{Demand, Design, FIRST_ROUNDS, Parts, default_work_budget};
pub use groups::{folded, workgroups};
pub use kernels::{Lookup, TraceKernels, TraceKernelsDesc};
pub use lengths::Lengths;
pub use list_sort::ListSort;
pub use passes::{BuildPipelines, BuildTarget, ViewDraw};
pub use pool_name::{HEADER_POOL, PoolBytes, PoolContents, PoolName, bytes_of_words};
pub use pooled::{Pooled, VARYING_SHARE};
pub use pools::Pools;
pub use pyramid::Pyramid;
pub use scan::Scan;
pub use scratch::Scratch;
pub use visit::{LargePass, Visit, Visits, bin_groups};
