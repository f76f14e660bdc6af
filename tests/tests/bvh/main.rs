//! Bounding volume hierarchies: trees, hits, and the oracle.

mod hits;
mod oracle;
mod refit;
mod scenes;
mod sort;
mod treelets;
mod trees;
