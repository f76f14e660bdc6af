//! Textures whose texels lie in several buffers give the same pictures.

use crate::pictures::common::scenes::textured_room;
use crate::pictures::common::{Setup, are_same, assert_same, assert_silent, device, forward_camera, mean};
use glam::DVec3;
use rasray_ads::BruteForce;
use rasray_gpu::Device;
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, ShadingFeatures, TexelRuns, View};
use rasray_integrators::{AmbientOcclusion, Film, Integrator, Path, Raycast};

/// Makes every kind of texture and a mask, with texels in runs.
fn stage(device: &Device, tables: &SceneTables, runs: TexelRuns) -> Setup {
    let view = View { camera: forward_camera(DVec3::new(0.0, 0.0, 0.5)), width: 24, height: 16, seed: 5 };
    let scene = GpuScene::upload_in_runs(device, tables, &view, runs).expect("the scene fits");
    let structure = BruteForce::new(device, scene.geometry(), Some(scene.binding()), false)
        .expect("the structure can be made");
    let film = Film::new(device, view.width, view.height).expect("the film fits");
    Setup { device: device.clone(), scene, structure, film }
}

/// Renders path tracing with bounces, ray casting, and the mask as visibility rays observe it.
fn pictures(stage: &Setup, features: ShadingFeatures) -> [Vec<[f32; 3]>; 3] {
    let desc = || stage.desc_with(200, features);
    let path = Path::new(&desc(), 3).expect("valid");
    let raycast = Raycast::new(&desc()).expect("valid");
    let occlusion = AmbientOcclusion::new(&desc(), 2.0).expect("valid");
    let all: [&dyn Integrator; 3] = [&path, &raycast, &occlusion];
    all.map(|integrator| stage.render(integrator, 2))
}

#[test]
fn pictures_do_not_depend_on_the_runs_that_texels_lie_in() {
    let device = device();
    let tables = SceneTables::new(&textured_room(), DVec3::ZERO, &Parts::ALL).expect("well formed");
    let count = tables.texels.len() as u64;
    let whole = stage(&device, &tables, TexelRuns::LONGEST);
    assert!(!whole.scene.features().texel_runs);
    let expected = pictures(&whole, whole.scene.features());
    assert!(expected.iter().all(|picture| mean(picture) > 0.05));
    // The code for several runs also reads a single one.
    let [width, _] = whole.scene.image_size();
    let assert_expected = |pictures: &[Vec<[f32; 3]>; 3], why: &str| {
        for (picture, expected) in pictures.iter().zip(&expected) {
            assert_same(&device, picture, expected, width, why);
        }
    };
    assert_expected(&pictures(&whole, ShadingFeatures::ALL), "one run");
    let mut seen = Vec::new();
    for shift in 0..12 {
        let runs = TexelRuns::at_most(1 << shift);
        if runs.most_texels() < count || runs.length() >= count {
            continue;
        }
        let split = stage(&device, &tables, runs);
        assert!(split.scene.features().texel_runs);
        assert_expected(&pictures(&split, split.scene.features()), &format!("runs of {}", runs.length()));
        seen.push(count.div_ceil(runs.length()));
    }
    assert_eq!(seen, [4, 2], "buffers that were in use");
    // Changed texels change the picture: every run is read.
    for run in 0..4 {
        let mut damaged = tables.clone();
        let texels = damaged.texels.chunks_mut(512).nth(run).expect("four runs");
        texels.fill(0x0010_80F0);
        let split = stage(&device, &damaged, TexelRuns::at_most(512));
        let damaged = pictures(&split, split.scene.features());
        let pairs = damaged.iter().zip(&expected);
        assert!(!pairs.into_iter().all(|(a, b)| are_same(&device, a, b)), "run {run}");
    }
    assert_silent(&device);
}
