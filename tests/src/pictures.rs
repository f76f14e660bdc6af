//! Small pictures of built-in scenes, through any structure.

use rasray_ads::{Ray, Structure};
use rasray_gpu::Timing;
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
use rasray_integrators::{Film, Integrator, Traced};
use rasray_scene::{Scene, builtin::builtin};

use crate::harness::Bench;
use crate::random::Random;

/// Uploads a built-in scene, seen by its first camera in `size` x `size` pixels.
///
/// # Panics
/// If there is no such scene or the device refuses it.
pub fn stage(bench: &Bench, name: &str, size: u32) -> GpuScene {
    staged(bench, &builtin(name).expect("it is built in").expect("it needs no parameters"), size)
}

/// Uploads as [`stage`] any scene that has a camera.
///
/// # Panics
/// If it has none or the device refuses it.
pub fn staged(bench: &Bench, scene: &Scene, size: u32) -> GpuScene {
    let camera = scene.cameras[0].clone();
    let origin = SceneTables::default_frame_origin(scene, camera.world_from_camera.translation);
    let tables = SceneTables::new(scene, origin, &Parts::ALL).expect("the scene is whole");
    let view = View { camera, width: size, height: size, seed: 1 };
    GpuScene::upload(bench.device(), &tables, &view).expect("the scene fits")
}

/// Makes rays from points well within a scene in any direction.
pub fn rays_inside(scene: &GpuScene, count: usize) -> Vec<Ray> {
    let [lower, upper] = scene.geometry().bounds();
    let mut random = Random::new(0x7061_796C);
    let mut inside = |axis: usize| {
        let share = random.between(0.2, 0.8);
        lower[axis] + share * (upper[axis] - lower[axis])
    };
    let origins: Vec<[f32; 3]> = (0..count).map(|_| [inside(0), inside(1), inside(2)]).collect();
    origins.into_iter().map(|origin| Ray::new(origin, random.direction())).collect()
}

/// Renders pixels of `samples` paths each.
///
/// # Panics
/// If the device fails.
pub fn rendered(
    bench: &Bench,
    integrator: &dyn Integrator,
    film: &Film,
    samples: u32,
    structure: &mut dyn Structure,
) -> Vec<[f32; 3]> {
    rendered_through(bench, integrator, film, samples, (&*structure).into())
}

/// Renders as [`rendered`] with passes in addition to a structure.
///
/// # Panics
/// If the device fails.
pub fn rendered_through(
    bench: &Bench,
    integrator: &dyn Integrator,
    film: &Film,
    samples: u32,
    traced: Traced<'_>,
) -> Vec<[f32; 3]> {
    let device = bench.device();
    device.submit(|recorder| integrator.record_reset(recorder)).expect("the device works");
    for wave in film.bands().waves(0..samples, integrator.wave_capacity()) {
        integrator.render_wave(device, Timing::None, traced, wave).expect("the wave fits");
    }
    for queue in integrator.queues() {
        let counters = queue.download_counters(device).expect("the device works");
        assert_eq!((counters.unfinished, counters.not_ready, counters.corrupted), (0, 0, 0));
    }
    film.read(device).expect("the film is readable")
}
