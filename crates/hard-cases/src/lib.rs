//! Hard cases of ray tracing: scenes and rays that break tracers, as data with their truth. `rasray compare
//! hard:ID` and the conformance tests run them.
//!
//! - [`HardCase`] is a case: triangles, rays, an eye, and the answers that are known by construction.
//!   [`case()`] makes the case of an id, [`cases`] makes all of them.
//! - [`CATALOGUE`] has a row per id: its subject, and the [`Targets`] of each kind of structure.
//! - [`HardFile`] is bad input that never becomes triangles.
//! - [`replay`] makes one ray again. A ray depends on case, seed and index alone, never on the number of
//!   rays.
//!
//! Ids begin with a letter: G triangle shape, E edges and vertices, V views, Z depth, X voxels, C capacity
//! and bad input, T transforms, P light transport; variants append a parameter. Coordinates are single
//! precision, in metres, and the camera looks along +z. The truth comes from the oracle at run time. Where a
//! case states its answer, a test holds the oracle against it.

mod capacity;
mod case;
mod catalogue;
mod departure;
mod depth;
mod depth_layers;
mod edges;
mod files;
mod geometry;
mod gltf_text;
mod grid;
mod interfaces;
mod light;
mod random;
mod shape;
mod transforms;
mod views;
mod views_center;
mod voxel_content;
mod voxels;

#[cfg(test)]
mod single_precision;
#[cfg(test)]
mod tests;

pub use capacity::POISONED_DROPPED;
pub use case::{Answer, CAMERA_TOWARDS, Expectation, HardCase, Scale, Triangle};
pub use catalogue::{CATALOGUE, CatalogueRow, Target, Targets, catalogue_row};
pub use files::{HardFile, Loading, Refusal, file_ids, files};
pub use grid::Grid;
pub use random::Stream;
pub use transforms::{Transformed, transformed};
pub use views::outermost_pixels;

use case::Entry;
use rasray_reference::oracle::Ray;

/// Iterates over all entries by theme.
fn entries() -> impl Iterator<Item = &'static Entry> {
    [
        shape::CASES,
        edges::CASES,
        views::CASES,
        views_center::CASES,
        depth::CASES,
        depth_layers::CASES,
        voxels::CASES,
        voxel_content::CASES,
        capacity::CASES,
        transforms::CASES,
        light::CASES,
        interfaces::CASES,
    ]
    .into_iter()
    .flatten()
}

/// Returns the ids of all cases.
pub fn ids() -> Vec<&'static str> {
    entries().map(|entry| entry.id).collect()
}

/// Returns the ids and titles of all cases and files.
pub fn titles() -> Vec<(&'static str, &'static str)> {
    entries().map(|entry| (entry.id, entry.title)).chain(files::titles()).collect()
}

/// Builds the case with this id; `None` if there is none.
pub fn case(id: &str, scale: Scale) -> Option<HardCase> {
    entries().find(|entry| entry.id == id).map(|entry| entry.build(scale))
}

/// Builds all cases, one at a time.
pub fn cases(scale: Scale) -> impl Iterator<Item = HardCase> {
    entries().map(move |entry| entry.build(scale))
}

/// Returns the ray of a case that was generated at an index with a seed.
pub fn replay(id: &str, seed: u64, index: usize) -> Option<Ray> {
    case(id, Scale { rays: index + 1, seed, full: false })?.rays.get(index).copied()
}
