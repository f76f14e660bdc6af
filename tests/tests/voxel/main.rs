//! Voxels over A-buffers along the axes: marks, storages, exactness, voxels as leaves, pools of every edge
//! capacity.

mod capacity;
mod exact;
mod leaves;
mod marks;
mod storage;
