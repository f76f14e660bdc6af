//! Photon maps: the stored photons, the gathered light, and comparisons with closed forms and paths.

mod closed_forms;
mod convergence;
mod limits;
mod paths;
mod recording;

use glam::DVec3;
use rasray_gpu::Timing;
use rasray_integrators::{Integrator, PathOptions, PhotonKind, PhotonOptions, Photons, Wave};
use rasray_scene::{Camera, Light, Material, Mesh, Projection, Scene};

use crate::pictures::common::*;

fn options(kind: PhotonKind, bounces: u32, photon_paths: u32, radius: f32) -> PhotonOptions {
    PhotonOptions { paths: PathOptions::from(bounces), kind, photon_paths, radius: Some(radius) }
}

fn photons(stage: &Setup, options: PhotonOptions) -> Photons {
    Photons::new(&stage.desc(), options).expect("valid")
}

fn render(stage: &Setup, options: PhotonOptions, samples: u32) -> Vec<[f32; 3]> {
    let image = stage.render(&photons(stage, options), samples);
    let faults = stage.film.read_faults(&stage.device).expect("readable");
    assert_eq!((faults.non_finite, faults.unended, faults.cut, faults.crowded), (0, 0, 0, 0));
    image
}

/// Makes a camera that looks down at the floor from a height, and sees `half` of it to each side of its
/// centre.
fn from_above(height: f64, half: f32) -> Camera {
    let projection = Projection::Orthographic { half_height: half };
    camera(DVec3::Y * height, DVec3::X, -DVec3::Z, projection)
}

fn lit(meshes: Vec<Mesh>, materials: Vec<Material>, light: Option<Light>) -> Scene {
    Scene { lights: light.into_iter().collect(), ..scene(meshes, materials, [0.0; 3]) }
}

fn floor(half: f64, material: usize) -> Mesh {
    square(DVec3::ZERO, DVec3::X * half, -DVec3::Z * half, material)
}

fn point_light(height: f64, intensity: f32) -> Option<Light> {
    let position = DVec3::Y * height;
    Some(Light::Point { position, intensity: [intensity; 3], range: f32::INFINITY })
}

/// Iterates over the positions of the pixel centres of a square picture, in metres from the middle of the
/// picture of [`from_above`].
fn places(side: u32, half: f64) -> impl Iterator<Item = [f64; 2]> {
    let place = move |index: u32| (2.0 * (f64::from(index) + 0.5) / f64::from(side) - 1.0) * half;
    (0..side * side).map(move |pixel| [place(pixel % side), place(pixel / side)])
}

/// Returns the mean of the picture of each sample.
fn sample_means(stage: &Setup, integrator: &dyn Integrator, samples: u32) -> Vec<f64> {
    let [width, height] = stage.scene.image_size();
    let mean_of = |sample| {
        stage.device.submit(|recorder| integrator.record_reset(recorder)).expect("the reset runs");
        let wave = Wave { first_pixel: 0, pixel_count: width * height, sample };
        let traced = (&stage.structure).into();
        integrator.render_wave(&stage.device, Timing::None, traced, wave).expect("the wave runs");
        mean(&stage.film.read(&stage.device).expect("readable"))
    };
    (0..samples).map(mean_of).collect()
}

/// Returns the mean of numbers and its standard error.
fn estimate(numbers: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let numbers: Vec<f64> = numbers.into_iter().collect();
    let count = numbers.len() as f64;
    let average = numbers.iter().sum::<f64>() / count;
    let squares: f64 = numbers.iter().map(|number| (number - average).powi(2)).sum();
    [average, (squares / (count - 1.0) / count).sqrt()]
}

/// Returns the mean difference of two kinds of samples with the same random numbers, and its standard error.
fn difference_of(samples: &[f64], others: &[f64]) -> [f64; 2] {
    estimate(samples.iter().zip(others).map(|(sample, other)| sample - other))
}
