//! From hits to radiance: ray casting, ambient occlusion, path tracing, and the film.
//!
//! An [`Integrator`] records waves: runs of pixels of which one sample is taken. Each wave fills a
//! ray queue, has it traced by whatever [`rasray_ads::Structure`] it is handed, shades what was met,
//! and adds to a [`Film`]. Integrators name no structure, and structures know nothing of them.
//!
//! What is shaded and which random numbers are drawn is written in `docs/shading.md`; random numbers
//! depend on the pixel's number in the whole image, the sample and the use, never on the wave, so the
//! picture does not depend on how the image is cut.
//!
//! Shaders bind four sets: geometry, the integrator's own buffers, the queue, the scene.

mod ambient_occlusion;
mod aov;
mod error;
mod film;
mod integrator;
mod kernels;
mod path;
mod raycast;
mod wave;

pub use ambient_occlusion::AmbientOcclusion;
pub use aov::{AovPass, AovPixel};
pub use error::IntegratorError;
pub use film::{Film, FilmFaults, FilmPixel, PIXEL_LIMIT};
pub use integrator::{Integrator, IntegratorDesc};
pub use path::{BOUNCE_LIMIT, Path, PathState};
pub use raycast::Raycast;
pub use wave::{WAVE_CAPACITY, Wave, waves};
