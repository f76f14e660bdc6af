//! Every system in every preset against the exact oracle on hard cases, and tests of the evaluation itself.

mod evaluate;
mod hard_counts;
mod laws;
mod moving;
mod oracle_hierarchy;
mod report;
mod rows;
mod sweeps;
mod voxels;
