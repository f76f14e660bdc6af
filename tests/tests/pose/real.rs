//! Real scenes at several times of every clip.

use std::path::PathBuf;

use glam::DVec3;
use rasray_scene::{Environment, Light, Moment};
use rasray_scene_files::LoadOptions;
use rasray_tests::harness::Bench;

use crate::pose::held::DeviceScene;

/// Files, and how many vertices of each move.
const FILES: [(&str, usize); 12] = [
    ("animated/BoxAnimated/BoxAnimated.glb", 96),
    ("animated/CesiumMilkTruck/CesiumMilkTruck.glb", 1656),
    ("animated/InterpolationTest/InterpolationTest.glb", 216),
    ("instanced/SimpleInstancing/SimpleInstancing.glb", 0),
    ("morph/AnimatedMorphCube/AnimatedMorphCube.glb", 24),
    ("morph/AnimatedMorphSphere/AnimatedMorphSphere.glb", 1876),
    ("morph/MorphStressTest/MorphStressTest.glb", 1528),
    ("skinned/CesiumMan/CesiumMan.glb", 3273),
    ("skinned/Fox/Fox.glb", 1728),
    ("skinned/RiggedFigure/RiggedFigure.glb", 370),
    ("skinned/RiggedSimple/RiggedSimple.glb", 160),
    ("skinned/SimpleSkin/SimpleSkin.gltf", 10),
];

#[test]
fn real_scenes_are_where_the_host_has_them() {
    let Some(folder) = std::env::var_os("RASRAY_SCENES").map(PathBuf::from) else {
        eprintln!("skipped {} scenes: RASRAY_SCENES is not set", FILES.len());
        return;
    };
    let bench = Bench::new();
    println!("scene: moving vertices; positions, ulp; normals; tangents");
    for (file, moving) in FILES {
        let mut scene = rasray_scene_files::load(&folder.join(file), &LoadOptions::default()).expect(file);
        // All kinds of light, one of which may move.
        scene.environment = Environment::Constant([0.5; 3]);
        scene.materials[0].emission = [1.0, 2.0, 3.0];
        scene.lights.push(Light::Directional { direction: DVec3::NEG_Y, irradiance: [3.0; 3] });
        scene.lights.push(Light::Point { position: DVec3::ONE, intensity: [1.0; 3], range: f32::INFINITY });
        let durations: Vec<f64> =
            scene.animation.rig.clips.iter().map(|clip| f64::from(clip.duration)).collect();
        for origin in [DVec3::ZERO, DVec3::new(1.0e6, -2.0e6, 3.0e5)] {
            let stage = DeviceScene::new(&bench, scene.clone(), origin);
            // At rest, where there is no clip.
            let mut worst = stage.held(&Moment::default());
            for (clip, duration) in durations.iter().enumerate() {
                for share in [0.0, 0.21, 0.5, 0.83, 1.0] {
                    let moment = Moment { seconds: share * duration, clips: vec![clip] };
                    worst = worst.worst(stage.held(&moment));
                }
            }
            println!(
                "{file}, origin {}: {}; {:.2}; {:.1e}; {:.1e}; {} absent",
                origin.x, worst.vertices, worst.ulps, worst.normal, worst.tangent, worst.absent
            );
            assert_eq!(
                (worst.vertices, stage.pass.moves(), !durations.is_empty()),
                (moving, moving > 0, moving > 0),
                "{file}"
            );
            assert!(worst.ulps <= 4.0, "{file}: {worst:?}");
            assert!(worst.normal <= 1.0e-5 && worst.tangent <= 1.0e-5, "{file}: {worst:?}");
        }
    }
}
