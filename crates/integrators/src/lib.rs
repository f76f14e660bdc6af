//! Integrators: they turn the hits of rays into radiance on a film. Programs that render a scene use one with
//! any structure.
//!
//! - [`Integrator`] is the contract. It records waves: runs of pixels, with one sample of each pixel. A wave
//!   fills a ray queue, has the given [`rasray_ads::Structure`] trace it, shades the hits, and adds to the
//!   film.
//! - [`INTEGRATORS`] has a row per integrator: ray casting, layers, ambient occlusion, environment mapping,
//!   Whitted's ray tracing, path tracing and photon maps.
//! - [`Film`] holds the image.
//! - [`Visibility`] draws the first hits of the camera in place of tracing them; [`Fetch`] draws the surfaces
//!   of hits.
//!
//! Integrators depend on no structure, and structures on no integrator. `docs/shading.md` describes shading
//! and random numbers. Random numbers depend on the pixel's number in the whole image, the sample and the
//! use, never on the wave, so the picture does not depend on the way in which it is cut into waves.
//!
//! Shaders bind four sets: geometry, the integrator's own buffers, the queue, the scene.
//!
//! # Example
//!
//! ```no_run
//! use rasray_ads::BruteForce;
//! use rasray_gpu::{Device, DeviceDesc, Timing};
//! use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
//! use rasray_integrators::{AmbientOcclusion, Film, Integrator, IntegratorDesc};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let scene = rasray_scene::builtin::cornell();
//! let device = Device::create(&DeviceDesc::default())?;
//! let view = View { camera: scene.cameras[0].clone(), width: 64, height: 64, seed: 1 };
//! let origin = SceneTables::default_frame_origin(&scene, view.eye());
//! let tables = SceneTables::new(&scene, origin, &Parts::VISIBILITY)?;
//! let gpu_scene = GpuScene::upload(&device, &tables, &view)?;
//! let structure = BruteForce::new(&device, gpu_scene.geometry(), Some(gpu_scene.binding()), false)?;
//! let film = Film::new(&device, view.width, view.height)?;
//! let occlusion = AmbientOcclusion::new(&IntegratorDesc::new(&device, &gpu_scene, &film), 0.5)?;
//! device.submit(|recorder| occlusion.record_reset(recorder))?;
//! for wave in film.bands().waves(0..16, occlusion.wave_capacity()) {
//!     occlusion.render_wave(&device, Timing::None, (&structure).into(), wave)?;
//! }
//! let image = film.read(&device)?;
//! # Ok(()) }
//! ```

mod aov;
mod bands;
mod error;
mod fetch;
mod film;
mod integrator;
mod kernels;
mod registry;
mod rounds;
mod traced;
mod visibility;
mod wave;

pub use aov::AovPass;
pub use bands::{Bands, PIXEL_LIMIT};
pub use error::IntegratorError;
pub use fetch::{Fetch, FetchCounts};
pub use film::Film;
pub use integrator::{Integrator, IntegratorDesc, check_faults, check_features};
pub use rasray_shaders_glsl::constants::scene::PATH_LAYER_LIMIT;
pub use rasray_shaders_glsl::records::{
    AovPixel, AovSurface, FilmFaults, FilmPixel, PathState, Photon, VisibilityCounts,
};
pub use registry::*;
pub use traced::{FirstHits, Traced};
pub use visibility::Visibility;
pub use wave::{WAVE_LIMIT, Wave, wave_capacity};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
