//! Shading from a hit to its radiance, computed naively from the scene model.
//!
//! The mathematics is that of `docs/shading.md` and is written a second time here, in single precision and in
//! the order of the shaders, because the outcome of a random choice depends on it. No data are shared with
//! the upload to a device: textures, attributes, lights and materials are read from [`rasray_scene::Scene`],
//! so that a mistake in packing shows as a difference.
//!
//! Lengths are metres relative to the frame origin, radiance is W/(sr m^2) in linear Rec. 709.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "`!(x > 0.0)` fails for NaN as well, as in the shaders"
)]

mod albedo;
mod alpha;
mod anisotropy;
mod attributes;
pub mod bsdf;
mod bsdf_terms;
mod camera;
mod emission;
mod environment;
mod error;
mod facet_normal;
pub mod glass_albedo;
mod light;
mod light_table;
mod microfacet;
mod posed;
mod posing;
pub mod random;
mod ray;
mod spawn;
mod surface;
mod terminator;
mod texture;
mod triangle;
mod ward;

#[cfg(test)]
mod tests;

pub use bsdf::{
    BsdfSample, bsdf_evaluate, bsdf_is_rough, bsdf_pdf, bsdf_sample, bsdf_straight, bsdf_times_cosine,
};
pub use camera::{View, camera_ray, lens_numbers, pixel_position, through_lens};
pub use emission::Emission;
pub use environment::EnvironmentTable;
pub use error::ReferenceError;
pub use light::{LightSample, window};
pub use light_table::LightTable;
pub use microfacet::{basis_around, cosine_hemisphere, luminance};
pub use posed::PosedScene;
pub use ray::Ray;
pub use spawn::{spawn_ray, spawn_segment};
pub use surface::Surface;
