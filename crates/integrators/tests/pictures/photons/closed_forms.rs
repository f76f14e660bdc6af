//! Light of photons against closed forms, and the gathered light against a sum over all photons.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use rasray_integrators::{Path, Photon, PhotonKind};
use rasray_reference::shading::{View, camera_ray, pixel_position};
use rasray_scene::{Material, Projection, Sampler};

use super::{estimate, floor, from_above, lit, options, photons, places, point_light, render, sample_means};
use crate::pictures::common::*;
use crate::pictures::whitted::{glass, mirror, reflected};

/// The scene is a closed box whose walls emit inwards and reflect the same share everywhere.
#[test]
fn a_furnace_keeps_its_flux() {
    const ALBEDO: f64 = 0.7;
    const RADIANCE: f64 = 0.5;
    const PATHS: u32 = 40_000;
    let wall = Material { double_sided: false, ..lambert(ALBEDO as f32, RADIANCE as f32) };
    let furnace = scene(box_inside(1.0, 0), vec![wall], [0.0; 3]);
    let device = device();
    let eye = camera(DVec3::ZERO, DVec3::X, DVec3::Y, Projection::Orthographic { half_height: 0.5 });
    let stage = Setup::new(&device, &furnace, eye, 16, 16, 3);
    let map = photons(&stage, options(PhotonKind::All, 6, PATHS, 0.1));
    let [average, error] = estimate(sample_means(&stage, &map, 16));
    let emitted = PI * RADIANCE * 24.0;
    let stored = map.read_map(&device).expect("readable");
    assert_eq!(stored.photons.iter().map(|photon| photon.bounce).max(), Some(5));
    for bounce in 1..=5_u32 {
        let flux: f64 = stored
            .photons
            .iter()
            .filter(|photon| photon.bounce == bounce)
            .map(|photon| f64::from(photon.flux[1]))
            .sum();
        let expected = emitted * ALBEDO.powi(bounce as i32);
        println!("after {bounce} scatterings: {flux} W, expected {expected}");
        // Paths may be ended at random from the scattering after the third on: the number of the remaining
        // ones is binomial.
        let left = ALBEDO.powi(if bounce > 3 { 4 } else { 0 }) * ALBEDO.powi((bounce as i32 - 4).max(0));
        let deviation = ((1.0 - left) / (left * f64::from(PATHS))).sqrt();
        assert!((flux / expected - 1.0).abs() < 1.0e-4 + 4.0 * deviation, "{bounce}: {flux}, not {expected}");
    }
    // The light was scattered 0 to 6 times.
    let expected: f64 = (0..=6).map(|bounce| RADIANCE * ALBEDO.powi(bounce)).sum();
    println!("radiance {average} +- {error}, expected {expected}");
    assert!((average - expected).abs() < 4.0 * error && error < 0.01 * expected);
    assert_silent(&device);
}

/// A mirror above a lamp sends light to the floor like an image of the lamp above the mirror, through a hole.
#[test]
fn light_by_a_plane_mirror_is_that_of_an_image_of_the_lamp() {
    const SIDE: u32 = 32;
    let (albedo, half) = (0.5, 0.3);
    let mirror_above = square(DVec3::Y * 2.0, DVec3::X * 0.4, DVec3::Z * 0.4, 1);
    let scene = lit(
        vec![floor(2.0, 0), mirror_above],
        vec![lambert(albedo, 0.0), mirror(1.0)],
        point_light(1.0, 3.0),
    );
    let device = device();
    let stage = Setup::new(&device, &scene, from_above(0.9, half), SIDE, SIDE, 5);
    let irradiance =
        |[x, z]: [f64; 2], height: f64| 3.0 * height / (height * height + x * x + z * z).powf(1.5);
    let of_light = |light: f64| f64::from(albedo) / PI * light;
    let mut errors = Vec::new();
    for photon_paths in [1 << 14, 1 << 18] {
        let image = render(&stage, options(PhotonKind::Caustic, 2, photon_paths, 0.15), 1);
        let (mut squares, mut sum, mut expected) = (0.0, 0.0, 0.0);
        for (pixel, place) in image.iter().zip(places(SIDE, f64::from(half))) {
            let caustic = f64::from(pixel[0]) - of_light(irradiance(place, 1.0));
            let right = of_light(irradiance(place, 3.0));
            squares += (caustic - right).powi(2);
            (sum, expected) = (sum + caustic, expected + right);
        }
        let error = (squares / f64::from(SIDE * SIDE)).sqrt() / (expected / f64::from(SIDE * SIDE));
        println!("{photon_paths} paths: error {error}, mean {} of what is expected", sum / expected);
        errors.push((error, sum / expected));
    }
    assert!(errors[1].0 < 0.4 * errors[0].0, "16 times the photons, a quarter of the noise: {errors:?}");
    assert!(errors[1].0 < 0.2 && (errors[1].1 - 1.0).abs() < 0.03, "{errors:?}");
    assert_silent(&device);
}

/// A plate of glass stands between a lamp and the floor: all light on the floor was refracted twice.
#[test]
fn light_through_a_plate_of_glass_is_that_of_the_closed_form() {
    const SIDE: u32 = 16;
    let (albedo, half, intensity) = (0.8, 0.25_f32, 2.0);
    // The lamp is at 1, the plate from 0.6 to 0.4, so that 0.8 of the way is in air.
    let plate = |height: f64, up: f64| square(DVec3::Y * height, DVec3::X * 3.0, -DVec3::Z * 3.0 * up, 1);
    let meshes = vec![floor(3.0, 0), plate(0.6, 1.0), plate(0.4, -1.0)];
    let scene = lit(meshes, vec![lambert(albedo, 0.0), glass()], point_light(1.0, intensity));
    let device = device();
    let stage = Setup::new(&device, &scene, from_above(0.3, half), SIDE, SIDE, 9);
    let map = photons(&stage, options(PhotonKind::Caustic, 3, 1 << 16, 0.05));
    let [found, error] = estimate(sample_means(&stage, &map, 8));
    // The closed form goes by the angle in air: metres from the middle, and the flux of a ring over its area.
    let away = |angle: f64| {
        let inside = (angle.sin() / 1.5).asin();
        0.8 * angle.tan() + 0.2 * inside.tan()
    };
    let irradiance = |radius: f64| {
        let (mut low, mut high) = (0.0, 1.5_f64);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if away(middle) < radius { low = middle } else { high = middle }
        }
        let step = 1.0e-5;
        let slope = (away(low + step) - away(low - step)) / (2.0 * step);
        let passed = (1.0 - reflected(low.cos())).powi(2);
        f64::from(intensity) * passed * low.sin() / (radius * slope)
    };
    let count = f64::from(SIDE * SIDE);
    let lit = places(SIDE, f64::from(half)).map(|[x, z]| irradiance(x.hypot(z))).sum::<f64>() / count;
    let expected = f64::from(albedo) / PI * lit;
    println!("{found} +- {error}, expected {expected}");
    assert!((found - expected).abs() < 4.0 * error + 0.002 * expected && error < 0.02 * expected);
    // Paths do not find this light at all.
    let paths = Path::new(&stage.desc(), 3).expect("valid");
    assert_eq!(mean(&stage.render(&paths, 1)), 0.0);
    assert_silent(&device);
}

/// The reference sums every photon within the radius, once, in f64: on a diffuse floor each counts the same
/// share of its flux.
#[test]
fn what_is_gathered_is_the_sum_over_all_photons() {
    const SIDE: u32 = 24;
    let (albedo, half, seed) = (0.6, 0.5_f32, 21);
    let ceiling = square(DVec3::Y * 2.0, DVec3::X * 2.0, DVec3::Z * 2.0, 0);
    let wall = square(DVec3::new(-1.0, 1.0, 0.0), -DVec3::Z * 2.0, DVec3::Y, 0);
    let scene = lit(vec![floor(1.0, 0), ceiling, wall], vec![lambert(albedo, 0.0)], point_light(0.9, 1.0));
    let device = device();
    let eye = from_above(0.8, half);
    let stage = Setup::new(&device, &scene, eye.clone(), SIDE, SIDE, seed);
    // The direct light has the same random numbers.
    let direct = stage.render(&Path::new(&stage.desc(), 1).expect("valid"), 1);
    for (photon_paths, radius) in [(3000, 0.2), (20_000, 0.03), (1000, 3.0)] {
        let map = photons(&stage, options(PhotonKind::All, 4, photon_paths, radius));
        let image = stage.render(&map, 1);
        let stored = map.read_map(&device).expect("readable");
        assert!((stored.radius - radius).abs() < 1.0e-6 && stored.photons.len() > photon_paths as usize / 2);
        let view = View {
            camera: eye.clone(),
            width: SIDE,
            height: SIDE,
            samples: 1,
            seed,
            sampler: Sampler::Sobol,
        };
        let (mut most, mut lit) = (0.0_f64, 0);
        for (number, (pixel, direct)) in image.iter().zip(&direct).enumerate() {
            let ray = camera_ray(
                &view,
                stage.scene.frame_origin(),
                pixel_position(SIDE, view.numbers(number as u32, 0)),
            );
            let place = ray.origin + ray.direction * (ray.origin.y / -ray.direction.y);
            let expected = naive(&stored.photons, place, f64::from(radius)) * f64::from(albedo) / PI;
            let found = f64::from(pixel[0]) - f64::from(direct[0]);
            let scale = f64::from(pixel[0]).max(1.0e-6);
            most = most.max((found - expected).abs() / scale);
            lit += usize::from(expected > 0.0);
        }
        println!("{photon_paths} paths within {radius}: {most:e} off at most, {lit} pixels with photons");
        assert!(most < 2.0e-5 && lit > image.len() / 2, "{most}, {lit}");
    }
    assert_silent(&device);
}

/// Returns W/m^2 by the kernel 2 (1 - d^2 / r^2) / (pi r^2), of photons that the floor sees.
fn naive(photons: &[Photon], place: Vec3, radius: f64) -> f64 {
    let of_photon = |photon: &Photon| {
        let apart = (Vec3::from(photon.position) - place).as_dvec3().length() / radius;
        let is_seen = apart < 1.0 && photon.direction[1] > 0.0;
        if is_seen {
            f64::from(photon.flux[0]) * 2.0 * (1.0 - apart * apart) / (PI * radius * radius)
        } else {
            0.0
        }
    };
    photons.iter().map(of_photon).sum()
}
