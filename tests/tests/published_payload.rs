//! The published payload carries no triangle ids: secondary rays must meet its fragments all the same.

use rasray_abuffer::{ABuffer, Config};
use rasray_ads::{BruteForce, Structure};
use rasray_gpu::Timing;
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
use rasray_integrators::{AmbientOcclusion, Film, Integrator, IntegratorDesc, waves};
use rasray_tests::harness::Bench;
use rasray_tracer::build_until_complete;

const SIZE: u32 = 32;

/// Mean ambient occlusion of an image.
fn mean(bench: &Bench, scene: &GpuScene, structure: &mut dyn Structure) -> f32 {
    let device = bench.device();
    build_until_complete(device, structure, scene.eye(), Timing::None).expect("the build completes");
    let film = Film::new(device, SIZE, SIZE).expect("a small film fits");
    let desc = IntegratorDesc::new(device, scene, &film);
    let integrator = AmbientOcclusion::new(&desc, f32::INFINITY).expect("the range is valid");
    device.submit(|recorder| integrator.record_reset(recorder)).expect("the device works");
    for wave in waves(SIZE * SIZE, 4, integrator.wave_capacity()) {
        let submitted = device
            .submit(|recorder| integrator.record_wave(recorder, structure, wave))
            .expect("the device works");
        submitted.value.expect("the wave fits");
    }
    let pixels = film.read(device).expect("the film is readable");
    pixels.iter().map(|pixel| pixel[0]).sum::<f32>() / pixels.len() as f32
}

#[test]
fn secondary_rays_meet_fragments_without_ids() {
    let bench = Bench::new();
    let scene = rasray_scene::builtin::cornell();
    let camera = scene.cameras[0].clone();
    let origin = SceneTables::default_frame_origin(&scene, camera.world_from_camera.translation);
    let tables = SceneTables::new(&scene, origin, &Parts::ALL).expect("the scene is whole");
    let view = View { camera, width: SIZE, height: SIZE, seed: 1 };
    let scene = GpuScene::upload(bench.device(), &tables, &view).expect("the scene fits");

    let binding = Some(scene.binding());
    let mut brute =
        BruteForce::new(bench.device(), scene.geometry(), binding, false).expect("pipelines are made");
    let truth = mean(&bench, &scene, &mut brute);
    let config = Config::published(256);
    let mut published =
        ABuffer::new(bench.device(), config, scene.geometry(), binding).expect("pipelines are made");
    let found = mean(&bench, &scene, &mut published);
    // The published rules lose hits, so the image is brighter, but most of the box still occludes.
    assert!(truth < 0.4, "the inside of a box is dark: {truth}");
    assert!(found > truth - 0.05, "lost hits brighten: {found} against {truth}");
    assert!(found < 0.5 + 0.5 * truth, "most occlusion is found: {found} against {truth}");
}
