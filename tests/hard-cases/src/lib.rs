//! The hard cases of ray tracing: scenes and rays that break tracers, as data with their truth.
//!
//! Every case has a short id (G triangle shape, E edges and vertices, V views, Z depth, C capacity and
//! bad input, P light transport; variants append a parameter). Coordinates are single precision and the camera
//! looks along +z. The truth comes from the oracle at run time; where a case's answer is known by
//! construction it is stated as well, and a test holds the oracle against it.
//!
//! A ray depends on (case, seed, index) alone, never on how many rays are asked for, so that a failure
//! is replayed with [`replay`].

mod capacity;
mod case;
mod depth;
mod depth_layers;
mod edges;
mod geometry;
mod light;
mod random;
mod shape;
mod views;
mod views_center;

#[cfg(test)]
mod single_precision;
#[cfg(test)]
mod tests;

pub use capacity::POISONED_DROPPED;
pub use case::{Answer, Expectation, HardCase, Scale, Triangle};
pub use random::Stream;

use case::Entry;
use rasray_reference::oracle::Ray;

/// All entries by theme.
fn entries() -> impl Iterator<Item = &'static Entry> {
    [
        shape::CASES,
        edges::CASES,
        views::CASES,
        views_center::CASES,
        depth::CASES,
        depth_layers::CASES,
        capacity::CASES,
        light::CASES,
    ]
    .into_iter()
    .flatten()
}

/// Ids of all cases.
pub fn ids() -> Vec<&'static str> {
    entries().map(|entry| entry.id).collect()
}

/// Builds the case with this id; absent if there is none.
pub fn case(id: &str, scale: Scale) -> Option<HardCase> {
    entries().find(|entry| entry.id == id).map(|entry| entry.build(scale))
}

/// Builds all cases, one at a time.
pub fn cases(scale: Scale) -> impl Iterator<Item = HardCase> {
    entries().map(move |entry| entry.build(scale))
}

/// The ray of a case that was generated at an index with a seed.
pub fn replay(id: &str, seed: u64, index: usize) -> Option<Ray> {
    case(id, Scale { rays: index + 1, seed, full: false })?.rays.get(index).copied()
}
