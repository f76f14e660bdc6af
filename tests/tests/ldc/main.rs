//! Layered depth cubes: hits, layers, the march, pools of every edge capacity.

mod capacity;
mod hits;
mod layers;
mod march;

use rasray_ldc::{Accept, Config};
use rasray_tests::shapes::{Triangle, layers_in_a_room};

/// The robust structure with planes of fragments in place of triangles.
fn planes(resolution: u32) -> Config {
    Config { accept: Accept::Plane, ..Config::robust(resolution) }
}

/// Layers in a room whose edges lie between views.
fn layers_between_views() -> Vec<Triangle> {
    layers_in_a_room([-10.0, -9.9, -9.7], [10.0, 9.8, 9.6])
}
