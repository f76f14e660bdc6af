//! Truth of a scene, computed on the processor: exact hits, and images computed naively. Comparisons and
//! tests check structures and integrators against it.
//!
//! - [`oracle`] decides which triangle a ray hits, exactly on the single-precision data of the device.
//! - [`integrators`] computes the correct image of each integrator of the registry, from the scene model.
//! - [`shading`] has the surfaces, lights, cameras and random numbers of these images.
//! - [`views`] follows a ray through the cells of views.

pub mod integrators;
pub mod oracle;
pub mod shading;
pub mod views;

#[cfg(test)]
mod testing;
