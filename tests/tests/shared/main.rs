//! Shared parts of structures, alone on the device: triangle test, marches, grids, buckets, coverage, pages,
//! parity, builders.

mod axis_builders;
mod bucket;
mod coverage;
mod device;
mod grid;
mod list_counts;
mod march;
mod march_cases;
mod pages;
mod parity;
mod placement;
mod triangle;
mod turns;
