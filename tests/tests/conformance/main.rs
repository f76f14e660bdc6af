//! Every system in every preset against the exact oracle on hard cases, and the judge that says so.

mod evaluate;
mod hard_counts;
mod laws;
mod oracle_hierarchy;
mod report;
mod rows;
mod sweeps;
