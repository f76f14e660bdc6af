//! The truth: exact hits, and images computed naively on the CPU from the scene model.

pub mod integrators;
pub mod oracle;
pub mod shading;
pub mod views;

#[cfg(test)]
mod testing;
