//! The published payload carries no triangle ids: secondary rays must meet its fragments all the same.

use rasray_abuffer::{ABuffer, Config, Payload};
use rasray_ads::Structure;
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

    let mean_of = |payload| {
        let config = Config { payload, ..Config::published(256) };
        let mut structure = ABuffer::new(bench.device(), config, scene.geometry(), Some(scene.binding()))
            .expect("pipelines are made");
        mean(&bench, &scene, &mut structure)
    };
    // The same rules with and without ids: rays start a little apart, so a few meet something else.
    let with_ids = mean_of(Payload::Index);
    let without_ids = mean_of(Payload::Attributes);
    assert!(with_ids < 0.9, "walls occlude: {with_ids}");
    assert!((with_ids - without_ids).abs() < 0.02, "{with_ids} with ids, {without_ids} without");
}
