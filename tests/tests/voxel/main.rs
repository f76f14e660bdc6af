//! Voxels over A-buffers along the axes: marks, storages, exactness, voxels as leaves, the octree, pools of
//! every edge capacity.

mod capacity;
mod costs;
mod exact;
mod leaves;
mod marks;
mod octree;
mod storage;
