//! What a render cannot observe is left out without a change of the picture.

use crate::pictures::common::{scenes::*, *};
use glam::DVec3;
use rasray_gpu::Device;
use rasray_gpu_scene::{Parts, View};
use rasray_integrators::{AmbientOcclusion, Integrator, Path, Raycast};
use rasray_scene::{
    Camera, Scene,
    needs::{self, Needs, Workload},
};

/// Bytes uploaded and the picture.
fn image(
    device: &Device,
    scene: &Scene,
    camera: &Camera,
    workload: Workload,
    parts: &Parts,
) -> (u64, Vec<[f32; 3]>) {
    let view = View { camera: camera.clone(), width: 16, height: 12, seed: 5 };
    let stage = Setup::with(device, scene, view, parts);
    let desc = stage.desc();
    let integrator: Box<dyn Integrator> = match workload.integrator {
        needs::Integrator::Raycast => Box::new(Raycast::new(&desc).expect("valid")),
        needs::Integrator::AmbientOcclusion => Box::new(AmbientOcclusion::new(&desc, 1.0).expect("valid")),
        _ => Box::new(Path::new(&desc, workload.bounces).expect("valid")),
    };
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
    let workloads = [
        (needs::Integrator::Raycast, 0),
        (needs::Integrator::AmbientOcclusion, 0),
        (needs::Integrator::Path, 0),
        (needs::Integrator::Path, 2),
    ];
    for (scene, camera) in &cases {
        for (integrator, bounces) in workloads {
            let workload = Workload { integrator, bounces };
            let parts = Parts::from(&Needs::of(scene, workload));
            let (needed_bytes, needed) = image(&device, scene, camera, workload, &parts);
            let (all_bytes, all) = image(&device, scene, camera, workload, &Parts::ALL);
            assert!(needed_bytes <= all_bytes);
            if scene.name == "textured room" && integrator == needs::Integrator::AmbientOcclusion {
                assert!(needed_bytes < all_bytes / 2, "{needed_bytes} of {all_bytes} bytes");
            }
            for (a, b) in needed.iter().zip(&all) {
                for channel in 0..3 {
                    let close = (a[channel] - b[channel]).abs() <= 1e-4 * b[channel].abs();
                    assert!(close, "{} {workload:?}: {a:?} {b:?}", scene.name);
                }
            }
        }
    }
    assert_silent(&device);
}
