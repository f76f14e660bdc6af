//! Two parallel mirrors: a ray hits one after the other, and both its place and its share of light are
//! known after every reflection.

use glam::DVec3;
use rasray_scene::{Camera, Material, Scene};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    Estimate, Studio, System, assert_refused, assert_truth, parallel, scene_of, square, unlit,
};
use rasray_tests::tier::Counts;

use super::{RESOLUTION, by_system, grey, law};

const REFLECTANCE: f32 = 0.95;
/// Metres by which the ray rises on its way from wall to wall.
const RISE: f64 = 0.01;

/// Height at which the ray from halfway between the walls hits a wall after `reflections` of them.
fn height(reflections: u32, rise: f64) -> f64 {
    rise * (f64::from(reflections) + 0.5)
}

/// Mirrors at x = 0 and x = 1 for a ray that should rise by `step`. On the wall that the ray hits next, the
/// mirror ends below a strip of radiance 1 and twice `half` metres in height around where the ray should
/// arrive; nothing lies above.
fn corridor(reflections: u32, step: f64, half: f64, reflectance: f32) -> Scene {
    let target = height(reflections, step);
    let mirror = Material {
        base_color: [reflectance, reflectance, reflectance, 1.0],
        roughness: 0.0,
        ..Material::default()
    };
    let lowest = -1.5 * height(reflections, step);
    let wall = |x: f64, top: f64| {
        let (middle, half) = (0.5 * (top + lowest), 0.5 * (top - lowest));
        square(DVec3::new(x, middle, 0.0), DVec3::Y * half, DVec3::Z, 0)
    };
    // The ray leaves towards x = 1.
    let end = if reflections.is_multiple_of(2) { 1.0 } else { 0.0 };
    let strip = square(DVec3::new(end, target, 0.0), DVec3::Y * half, DVec3::Z, 1);
    let meshes = vec![wall(end, target - half), wall(1.0 - end, -lowest), strip];
    scene_of(meshes, vec![mirror, unlit(1.0)])
}

fn camera(rise: f64) -> Camera {
    let eye = DVec3::new(0.5, 0.0, 0.0);
    parallel(eye, eye + DVec3::new(1.0, rise, 0.0), 1e-10)
}

/// Reflections, and samples of each picture.
const COUNTS: Counts<&[(u32, u32)]> = Counts {
    quick: &[(1, 2), (3, 2), (10, 4), (50, 4)],
    software: &[(1, 2), (3, 2), (10, 64), (50, 32), (100, 16)],
    full: &[(1, 2), (3, 2), (10, 64), (50, 256), (100, 512)],
};

struct Run {
    reflections: u32,
    step: f64,
    half: f64,
    reflectance: f32,
    rise: f64,
    samples: u32,
    system: System,
}

fn run(bench: &Bench, run: &Run) -> Estimate {
    let scene = corridor(run.reflections, run.step, run.half, run.reflectance);
    let stage = Studio::new(bench, &scene, camera(run.rise), by_system(run.system, 64, 32), run.system);
    stage.estimate(&stage.path(run.reflections), run.samples)
}

/// Half of the strip's height after k reflections: k gamma_20 of the height, the bound for exact hits.
fn tolerance(reflections: u32) -> f64 {
    let units = 20.0 * f64::from(f32::EPSILON) / 2.0;
    f64::from(reflections) * units / (1.0 - units) * height(reflections, RISE)
}

#[test]
fn every_reflection_dims_by_the_same_factor_and_rises_by_the_same_step() {
    let bench = Bench::new();
    for &(reflections, samples) in COUNTS.on(bench.device(), "reflections and samples") {
        let right = Run {
            reflections,
            step: RISE,
            half: tolerance(reflections),
            reflectance: REFLECTANCE,
            rise: RISE,
            samples,
            system: System::BruteForce,
        };
        let truth = grey(f64::from(REFLECTANCE).powi(reflections as i32));
        let name = format!("{reflections} reflections");
        assert_truth(&name, &run(&bench, &right), truth, 0.0);
        // A ray that is off by twice the tolerance misses the strip.
        let off = 2.0 * tolerance(reflections) / height(reflections, 1.0);
        let broken = Run { rise: RISE + off, ..right };
        assert_refused(&format!("{name}, steeper"), &run(&bench, &broken), truth, 0.0);
        if reflections == 10 {
            let broken = Run { rise: RISE, reflectance: REFLECTANCE * 1.01, ..broken };
            assert_refused(&format!("{name}, brighter"), &run(&bench, &broken), truth, 0.0);
        }
    }
}

#[test]
fn fragments_know_their_planes_well_enough_for_ten_reflections() {
    let bench = Bench::new();
    // The strip must cover the centres of cells: it is as high as the step of the ray.
    let right = Run {
        reflections: 10,
        step: RISE,
        half: 0.5 * RISE,
        reflectance: REFLECTANCE,
        rise: RISE,
        samples: 2,
        system: System::Fragments(4 * RESOLUTION),
    };
    let truth = grey(f64::from(REFLECTANCE).powi(10));
    let slack = law(right.system, 11);
    assert_truth("10 reflections, fragments", &run(&bench, &right), truth, slack);
    let broken = Run { reflectance: 0.9, ..right };
    assert_refused("10 reflections, fragments", &run(&bench, &broken), truth, slack);
}
