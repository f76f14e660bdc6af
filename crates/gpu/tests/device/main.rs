//! A device: what it is chosen for, what it computes and draws, what it refuses.

mod common;
mod compute;
mod driver_tree;
mod embedding;
mod errors;
mod flights;
mod raster;
mod selection;
