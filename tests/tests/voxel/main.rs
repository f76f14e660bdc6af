//! Voxels over A-buffers along the axes: marks, storages, exactness, pools of every edge capacity.

mod capacity;
mod exact;
mod marks;
mod storage;
