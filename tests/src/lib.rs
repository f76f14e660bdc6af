//! Shared parts of rasray's tests: a device, triangles, random numbers, hard cases.

pub mod capacity;
pub mod conformance;
pub mod harness;
pub mod image_truth;
pub mod invariance;
pub mod pictures;
pub mod random;
pub mod rays;
pub mod shapes;
pub mod tier;
pub mod views;
pub mod visits;
pub mod voxels;

pub use rasray_hard_cases as hard_cases;
