//! Monte Carlo error falls with the root of the number of samples, down to the truth and not to some bias.

use std::f64::consts::PI;

use glam::DVec3;
use rasray_integrators::Integrator;
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    SIGMAS, Studio, System, box_around, diffuse, enclosure, glowing, looking, parallel, polygon_irradiance,
    scene_of, square,
};
use rasray_tests::tier::is_full;

/// Each pixel is a repetition of its own, for each seed.
const SIZE: u32 = 32;
const SEEDS: [u32; 2] = [1, 2];
/// Largest error of the slope.
const TOLERANCE: f64 = 0.05;

/// A slope in log-log and its standard error.
#[derive(Clone, Copy, Debug)]
struct Slope {
    value: f64,
    sigma: f64,
}

impl Slope {
    fn is_that_of_noise(&self) -> bool {
        (self.value + 0.5).abs() <= TOLERANCE
    }
}

/// Slope of the error against `truth` over 2^k samples, k = 0 to `octaves`; every k takes samples of its own.
/// `repeat` renders one sample again and again instead.
fn slope(stage: &mut Studio<'_>, integrator: &dyn Integrator, truth: f64, repeat: bool) -> Slope {
    let octaves = if is_full() { 9 } else { 5 };
    let mut points = Vec::new();
    for octave in 0..=octaves {
        let count = 1_u32 << octave;
        let mut squares = Vec::new();
        for seed in SEEDS {
            stage.reseed(seed);
            let index = |i: u32| if repeat { 0 } else { count + i };
            let picture = stage.render_each(integrator, (0..count).map(index));
            squares.extend(picture.pixels.iter().map(|pixel| (f64::from(pixel[0]) - truth).powi(2)));
        }
        let n = squares.len() as f64;
        let mean = squares.iter().sum::<f64>() / n;
        let variance = squares.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
        // Half the logarithm of the mean square, and what its own spread makes of it.
        points.push((0.5 * mean.log2(), 0.5 * (variance / n).sqrt() / mean / std::f64::consts::LN_2));
    }
    let centre = 0.5 * f64::from(octaves);
    let weights: Vec<f64> = (0..=octaves).map(|octave| f64::from(octave) - centre).collect();
    let norm: f64 = weights.iter().map(|w| w * w).sum();
    let value = weights.iter().zip(&points).map(|(w, (error, _))| w * error).sum::<f64>() / norm;
    let sigma =
        weights.iter().zip(&points).map(|(w, (_, sigma))| (w * sigma).powi(2)).sum::<f64>().sqrt() / norm;
    Slope { value, sigma }
}

fn check(name: &str, stage: &mut Studio<'_>, integrator: &dyn Integrator, truth: f64) {
    stage.sample_independently();
    let found = slope(stage, integrator, truth, false);
    let repeated = slope(stage, integrator, truth, true);
    let biased = slope(stage, integrator, truth * 1.2, false);
    eprintln!("{name}: {found:.4?}, samples repeated {repeated:.4?}, truth off by a fifth {biased:.4?}");
    assert!(SIGMAS * found.sigma < TOLERANCE, "{name}: too few repetitions to tell: {found:?}");
    assert!(found.is_that_of_noise(), "{name}: {found:?}");
    assert!(!repeated.is_that_of_noise(), "{name}: repeated samples pass: {repeated:?}");
    assert!(!biased.is_that_of_noise(), "{name}: a wrong truth passes: {biased:?}");
}

/// A floor element below a square of radiance 1.
#[test]
fn direct_light_converges() {
    let bench = Bench::new();
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, z)| DVec3::new(x, 1.0, z));
    let light = square(DVec3::Y, DVec3::X, DVec3::Z, 1);
    let floor = square(DVec3::ZERO, DVec3::X, DVec3::NEG_Z, 0);
    let scene = scene_of(vec![floor, light], vec![diffuse([1.0; 3]), glowing([0.0; 3], [1.0; 3])]);
    let camera = parallel(DVec3::Y * 0.5, DVec3::ZERO, 1e-5);
    let mut stage = Studio::new(&bench, &scene, camera, SIZE, System::BruteForce);
    let path = stage.path(1);
    check("direct light", &mut stage, &path, polygon_irradiance(DVec3::ZERO, DVec3::Y, &corners) / PI);
}

#[test]
fn occlusion_converges() {
    let bench = Bench::new();
    let walls = [
        square(DVec3::new(0.0, 5.0, 0.0), DVec3::Y * 5.0, DVec3::Z * 50.0, 0),
        square(DVec3::ZERO, DVec3::X * 50.0, DVec3::NEG_Z * 50.0, 0),
    ];
    let corners =
        [(0.0, -50.0), (10.0, -50.0), (10.0, 50.0), (0.0, 50.0)].map(|(y, z)| DVec3::new(0.0, y, z));
    let scene = scene_of(walls.to_vec(), vec![diffuse([0.5; 3])]);
    let point = DVec3::X;
    let camera = parallel(point + DVec3::new(2.0, 2.0, 1.0), point, 1e-5);
    let mut stage = Studio::new(&bench, &scene, camera, SIZE, System::BruteForce);
    let occlusion = stage.occlusion(f32::INFINITY);
    let truth = 1.0 - polygon_irradiance(point, DVec3::Y, &corners) / PI;
    check("occlusion", &mut stage, &occlusion, truth);
}

#[test]
fn paths_converge() {
    let bench = Bench::new();
    let scene = scene_of(box_around(DVec3::ZERO, DVec3::ONE, 0), vec![glowing([0.7; 3], [1.0; 3])]);
    let camera = looking(DVec3::new(0.1, -0.2, 0.3), DVec3::new(-0.5, 0.3, -0.9), 1.0);
    let mut stage = Studio::new(&bench, &scene, camera, SIZE, System::BruteForce);
    let path = stage.path(3);
    check("paths in a furnace", &mut stage, &path, enclosure(1.0, f64::from(0.7_f32), 3));
}
