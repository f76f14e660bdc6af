//! Data that a render cannot observe are left out without a change of the picture.

use crate::pictures::common::{difference::*, scenes::*, *};
use glam::DVec3;
use rasray_gpu::Device;
use rasray_gpu_scene::{Parts, View};
use rasray_integrators::IntegratorSpec;
use rasray_scene::{Camera, Scene, needs::Needs};

/// Returns the uploaded bytes and the picture.
fn image(
    device: &Device,
    scene: &Scene,
    camera: &Camera,
    integrator: &IntegratorSpec,
    parts: &Parts,
) -> (u64, Vec<[f32; 3]>) {
    let view = View { camera: camera.clone(), width: 16, height: 12, seed: 5 };
    let stage = Setup::with(device, scene, view, parts);
    let integrator = integrator.make(&stage.desc()).expect("valid");
    let image = stage.render(integrator.as_ref(), 2);
    (stage.scene.bytes(), image)
}

#[test]
fn leaving_out_what_is_not_observed_changes_bytes_and_not_the_picture() {
    let device = device();
    let cases = [
        (textured_room(), forward_camera(DVec3::new(0.0, 0.2, 1.0))),
        (glass_room(), forward_camera(DVec3::new(0.0, 0.0, 0.9))),
    ];
    let integrators = [raycast(), occlusion(1.0), path(0), path(2)];
    for (scene, camera) in &cases {
        for integrator in &integrators {
            let workload = integrator.workload();
            let parts = Parts::from(&Needs::of(scene, workload));
            let (needed_bytes, needed) = image(&device, scene, camera, integrator, &parts);
            let (all_bytes, all) = image(&device, scene, camera, integrator, &Parts::ALL);
            assert!(needed_bytes <= all_bytes);
            if scene.name == "textured room" && workload.is_visibility() {
                assert!(needed_bytes < all_bytes / 2, "{needed_bytes} of {all_bytes} bytes");
            }
            for (a, b) in needed.iter().zip(&all) {
                for channel in 0..3 {
                    let close = (a[channel] - b[channel]).abs() <= 1e-4 * b[channel].abs();
                    assert!(close, "{} {integrator:?}: {a:?} {b:?}", scene.name);
                }
            }
        }
    }
    assert_silent(&device);
}
