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
//! | passes | [`BuildPipelines`], [`BuildTarget`], [`ViewDraw`], [`Modules`], [`folded`] |
//! | cells of triangles | [`Visits`], [`Visit`], [`LargePass`], [`bin_groups`] |
//! | lists and their depths | [`Lengths`], [`Scan`], [`ListSort`], [`Pyramid`] |
//! | traces and surfaces | [`TraceKernels`], [`TraceKernelsDesc`], [`TraceModules`], [`Lookup`] |
//! | stale builds | [`box_is_same`] |

pub use crate::addressing::{Modules, TraceModules};
pub use crate::configured::{Common, Configured, check_range, check_work_budget};
pub use crate::design::{Demand, Design, Parts, default_work_budget};
pub use crate::groups::folded;
pub use crate::kernels::{Lookup, TraceKernels, TraceKernelsDesc};
pub use crate::lengths::Lengths;
pub use crate::list_sort::ListSort;
pub use crate::passes::{BuildPipelines, BuildTarget, ViewDraw};
pub use crate::pool_name::{HEADER_POOL, PoolBytes, PoolContents, PoolName, bytes_of_words};
pub use crate::pooled::{Pooled, VARYING_SHARE};
pub use crate::pools::Pools;
pub use crate::pyramid::Pyramid;
pub use crate::scan::Scan;
pub use crate::scratch::Scratch;
pub use crate::viewpoint::box_is_same;
pub use crate::visit::{LargePass, Visit, Visits, bin_groups};
