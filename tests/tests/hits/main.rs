//! Hits of all systems where something is unusual: surfaces as origins, masks, backs that rays pass, long
//! lists, motion, huge pools, buffers of an engine, replayed rays.

mod engine_buffers;
mod hard_transforms;
mod large_pools;
mod long_lists;
mod masked;
mod motion;
mod on_surface;
mod ray_work;
mod replay;
mod single_sided;
mod slivers;
