//! Uses of rasray's packages by a crate of somebody else: a structure, its GLSL by name, and a shader of its
//! own.

use rasray_bricks::{Bricks, Config, Views};

/// The shader of this crate, in bytes.
pub static SHADOW: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/shadow.spv"));

/// Device features to enable for bricks.
pub fn features() -> Vec<&'static str> {
    let requirements = Bricks::requirements_of(&Config::new(Views::Axes));
    requirements.required.iter().map(|feature| feature.name()).collect()
}

/// Files of bricks that a shader may include.
pub fn includes() -> impl Iterator<Item = &'static str> {
    rasray_shaders_glsl::files().iter().map(|file| file.name).filter(|name| name.starts_with("bricks/"))
}
