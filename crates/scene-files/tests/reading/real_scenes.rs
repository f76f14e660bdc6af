//! Scenes of `RASRAY_SCENES` seen through the model: views, poses.

use rasray_scene::default_view::{bounds, default_camera, ensure_lit};
use rasray_scene::{Moment, Scene};
use rasray_scene_files::{LoadOptions, load};

use crate::gltf_support::{assert_well_formed, scenes_folder};

/// True if the default camera stands within the bounds.
fn stands_inside(scene: &Scene) -> bool {
    let (low, high) = bounds(scene).expect("triangles");
    let eye = default_camera(scene).world_from_camera.translation;
    eye.cmpgt(low).all() && eye.cmplt(high).all()
}

#[test]
fn real_scenes_are_classified_right() {
    let Some(folder) = scenes_folder("real_scenes_are_classified_right") else { return };
    for (file, inside) in [
        ("architecture/crytek_sponza/sponza.obj", true),
        ("architecture/samplebuilding_instanced/subpass_scene_opaque.gltf", true),
        ("architecture/medieval_building/Medieval_building.obj", false),
        ("organic/stanford-bunny/stanford-bunny.obj", false),
        ("organic/teapot/teapot.obj", false),
        ("pbr/DamagedHelmet/DamagedHelmet.glb", false),
        ("animated/CesiumMilkTruck/CesiumMilkTruck.glb", false),
        ("emissive/EmissiveStrengthTest/EmissiveStrengthTest.glb", false),
        ("morph/MorphStressTest/MorphStressTest.glb", false),
    ] {
        let mut scene = load(&folder.join(file), &LoadOptions::default()).expect(file);
        assert_eq!(stands_inside(&scene), inside, "{file}");
        if file.ends_with("DamagedHelmet.glb") {
            assert!(ensure_lit(&mut scene), "a few glowing marks light nothing");
        }
    }
}

/// Real scenes at several times are well formed, keep their number of triangles, have moved, and equal the
/// scene at rest at their beginning.
#[test]
fn animated_scenes_are_well_formed_at_all_times() {
    let Some(folder) = scenes_folder("animated_scenes_are_well_formed_at_all_times") else { return };
    for file in [
        "animated/BoxAnimated/BoxAnimated.glb",
        "animated/CesiumMilkTruck/CesiumMilkTruck.glb",
        "animated/InterpolationTest/InterpolationTest.glb",
        "morph/AnimatedMorphCube/AnimatedMorphCube.glb",
        "morph/AnimatedMorphSphere/AnimatedMorphSphere.glb",
        "morph/MorphStressTest/MorphStressTest.glb",
        "skinned/CesiumMan/CesiumMan.glb",
        "skinned/Fox/Fox.glb",
        "skinned/RiggedFigure/RiggedFigure.glb",
        "skinned/RiggedSimple/RiggedSimple.glb",
        "skinned/SimpleSkin/SimpleSkin.gltf",
    ] {
        let scene = load(&folder.join(file), &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
        let clips = scene.animation.rig.compatible_clips();
        assert!(!clips.is_empty(), "{file}");
        let shown = |seconds: f64| {
            let posed = scene.at(&Moment { seconds, clips: clips.clone() }).expect("a rig");
            assert_well_formed(&posed);
            let triangles: Vec<usize> = (posed.instances.iter())
                .map(|instance| posed.meshes[instance.mesh].triangle_count())
                .collect();
            (triangles, format!("{:?} {:?}", posed.meshes, posed.instances))
        };
        let duration = f64::from(scene.animation.duration);
        let (triangles, begin) = shown(0.0);
        let mut moved = false;
        for step in 1..=5 {
            let (found, there) = shown(duration * f64::from(step) / 5.0);
            assert_eq!(found, triangles, "{file}");
            moved |= there != begin;
        }
        assert!(moved, "{file} does not move");
    }
}
