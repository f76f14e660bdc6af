//! Every test of this package as one program, which is built and linked once: a module for each concern,
//! whose first lines say what it holds. `tools/run-tests` runs each module in a process of its own.

#[path = "abuffer/main.rs"]
mod abuffer;
#[path = "bvh/main.rs"]
mod bvh;
#[path = "conformance/main.rs"]
mod conformance;
mod driver_rt;
mod drivers;
#[path = "frames/main.rs"]
mod frames;
#[path = "hits/main.rs"]
mod hits;
#[path = "images/main.rs"]
mod images;
mod invariance;
mod kept_pictures;
#[path = "layout/main.rs"]
mod layout;
#[path = "ldc/main.rs"]
mod ldc;
#[path = "misuse/main.rs"]
mod misuse;
mod modules;
#[path = "payloads/main.rs"]
mod payloads;
#[path = "pose/main.rs"]
mod pose;
#[path = "primitive/main.rs"]
mod primitive;
#[path = "shared/main.rs"]
mod shared;
mod tools;
#[path = "voxel/main.rs"]
mod voxel;
