//! Structures that were damaged after a build: traces end, say so, and touch nothing that is not theirs.
//!
//! Nothing checks the accesses but the shaders themselves: robust buffer access is never switched on. So
//! everything runs in a process of its own, which may crash or hang without taking the tests along.

mod abuffer;
mod bricks;
mod bvh;
mod ldc;
mod primitive;
mod registry;
mod survive;
mod voxel;
