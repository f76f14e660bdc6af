//! Layered depth cubes: hits, layers, the march, pools of every edge capacity.

mod capacity;
mod hits;
mod layers;
mod march;

use rasray_ldc::{Accept, Config};

/// The robust structure with planes of fragments in place of triangles.
fn planes(resolution: u32) -> Config {
    Config { accept: Accept::Plane, ..Config::robust(resolution) }
}
