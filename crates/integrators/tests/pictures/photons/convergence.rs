//! The squared errors of caustics over the number of samples.

use std::f64::consts::PI;

use glam::DVec3;
use rasray_gpu::Timing;
use rasray_gpu_scene::Sampling;
use rasray_integrators::{Integrator, Path, PhotonKind};
use rasray_scene::Sampler;

use super::{floor, from_above, lit, options, photons, places, point_light};
use crate::pictures::common::*;
use crate::pictures::whitted::mirror;

/// Returns the exponent with which numbers fall by a count: the slope of a line through their logarithms.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let logarithms = || points.iter().map(|(count, number)| (count.ln(), number.ln()));
    let count = points.len() as f64;
    let [x, y] = logarithms().fold([0.0, 0.0], |sum, (x, y)| [sum[0] + x / count, sum[1] + y / count]);
    let along: f64 = logarithms().map(|(a, b)| (a - x) * (b - y)).sum();
    along / logarithms().map(|(a, _)| (a - x).powi(2)).sum::<f64>()
}

/// Returns the variance of a mean of samples over that of the first, if the variance of a sample is as one
/// over the area in which photons are gathered.
fn variance(samples: u32) -> f64 {
    let (mut of_sample, mut sum) = (1.0, 0.0);
    for sample in 1..=samples {
        sum += of_sample;
        of_sample *= (f64::from(sample) + 1.0) / (f64::from(sample) + 2.0 / 3.0);
    }
    sum / f64::from(samples).powi(2)
}

/// The squared errors are those of light by a plane mirror on the floor, in its middle and at its border. In
/// the middle they are noise.
#[test]
fn squared_errors_fall_as_the_page_says() {
    const SIDE: u32 = 32;
    const COUNTS: [u32; 5] = [1, 4, 16, 64, 256];
    const SEEDS: u32 = 3;
    let (albedo, half, end) = (0.5, 0.3_f32, 1.2);
    let mirror_above = square(DVec3::Y * 2.0, DVec3::X * 0.4, DVec3::Z * 0.4, 1);
    let materials = vec![lambert(albedo, 0.0), mirror(1.0)];
    let scene = lit(vec![floor(2.0, 0), mirror_above], materials, point_light(1.0, 3.0));
    let device = device();
    // The closed form uses an image of the lamp at a height of 3, seen through the outline of the mirror.
    let light = |x: f64, z: f64| {
        let is_lit = x.abs() < end && z.abs() < end;
        if is_lit { f64::from(albedo) / PI * 9.0 / (9.0 + x * x + z * z).powf(1.5) } else { 0.0 }
    };
    let within: Vec<[f64; 2]> = places(16, f64::from(half) / f64::from(SIDE)).collect();
    let predicted = exponent(&COUNTS.map(|count| (f64::from(count), variance(count))));
    println!("noise falls with the exponent {predicted:.3} over these numbers of samples");
    for (name, middle) in [("in the middle", 0.0), ("at the end", end)] {
        let of_pixel = |[x, z]: [f64; 2]| {
            let sum: f64 = within.iter().map(|[u, v]| light(middle + x + u, z + v)).sum();
            sum / within.len() as f64
        };
        let expected: Vec<f64> = places(SIDE, f64::from(half)).map(of_pixel).collect();
        let power: f64 = expected.iter().map(|light| light * light).sum();
        let [of_sobol, of_pcg] = [Sampler::Sobol, Sampler::Pcg].map(|sampler| {
            let mut squares = [0.0; COUNTS.len()];
            for seed in 0..SEEDS {
                let mut eye = from_above(0.9, half);
                eye.world_from_camera.translation.x += middle;
                let mut stage = Setup::new(&device, &scene, eye, SIDE, SIDE, seed);
                let sampling = Sampling { sampler, ..Sampling::default() };
                stage.scene.set_sampling(sampling).expect("the frame can be written");
                let map = photons(&stage, options(PhotonKind::Caustic, 2, 1 << 13, 0.15));
                // Direct light has the same random numbers.
                let direct = Path::new(&stage.desc(), 1).expect("valid");
                let found = pictures_after(&stage, &map, COUNTS);
                let direct = pictures_after(&stage, &direct, COUNTS);
                for (square, (found, direct)) in squares.iter_mut().zip(found.iter().zip(&direct)) {
                    let by_photons = found.iter().zip(direct).map(|(a, b)| f64::from(a[0]) - f64::from(b[0]));
                    let errors = by_photons.zip(&expected).map(|(found, right)| (found - right).powi(2));
                    *square += errors.sum::<f64>() / power / f64::from(SEEDS);
                }
            }
            let points: [_; COUNTS.len()] = std::array::from_fn(|at| (f64::from(COUNTS[at]), squares[at]));
            let slope = exponent(&points);
            println!("{name}, {}: {squares:.5?}, exponent {slope:.3}", sampler.name());
            assert!(squares.is_sorted_by(|more, less| more > less), "{name}: {squares:?}");
            (squares, slope)
        });
        assert!(of_sobol.0.iter().zip(of_pcg.0).all(|(sobol, pcg)| *sobol < pcg), "{name}");
        if middle == 0.0 {
            assert!((of_pcg.1 - predicted).abs() < 0.1, "{}, not {predicted}", of_pcg.1);
        }
    }
    assert_silent(&device);
}

/// Returns the pictures after each of several numbers of samples, in ascending order.
fn pictures_after<const N: usize>(
    stage: &Setup,
    integrator: &dyn Integrator,
    counts: [u32; N],
) -> [Vec<[f32; 3]>; N] {
    stage.device.submit(|recorder| integrator.record_reset(recorder)).expect("the reset runs");
    let mut done = 0;
    counts.map(|count| {
        for wave in stage.film.bands().waves(done..count, integrator.wave_capacity()) {
            let traced = (&stage.structure).into();
            integrator.render_wave(&stage.device, Timing::None, traced, wave).expect("the wave runs");
        }
        done = count;
        stage.film.read(&stage.device).expect("readable")
    })
}
