//! Tests of a device: selection, computing, drawing, and refusals.

mod common;
mod compute;
mod driver_tree;
mod embedding;
mod errors;
mod flights;
mod raster;
mod selection;
