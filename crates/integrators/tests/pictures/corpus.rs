//! Scenes from other authors, device against CPU. They are found through the environment variable
//! `RASRAY_SCENES`; without it nothing is tested, and the output says so.

use std::path::PathBuf;

use crate::pictures::common::difference::{difference, path};
use rasray_scene::{Environment, default_view::default_camera};
use rasray_scene_files::LoadOptions;

/// Instances, mirrored normal maps, texture settings, vertex colours, lights, blending.
const FILES: [&str; 6] = [
    "architecture/samplebuilding_instanced/subpass_scene_opaque.gltf",
    "conformance/NormalTangentMirrorTest/NormalTangentMirrorTest.glb",
    "conformance/TextureSettingsTest/TextureSettingsTest.glb",
    "conformance/VertexColorTest/VertexColorTest.glb",
    "emissive/khronos_lights/lights.gltf",
    "pbr/AlphaBlendModeTest/AlphaBlendModeTest.glb",
];

/// Files that are rendered as well where `RASRAY_FULL` is 1.
const MORE_FILES: [&str; 16] = [
    "conformance/NegativeScaleTest/NegativeScaleTest.glb",
    "conformance/TextureTransformTest/TextureTransformTest.gltf",
    "emissive/EmissiveStrengthTest/EmissiveStrengthTest.glb",
    "instanced/SimpleInstancing/SimpleInstancing.glb",
    "transmissive/GlassBrokenWindow/GlassBrokenWindow.glb",
    "animated/CesiumMilkTruck/CesiumMilkTruck.glb",
    "animated/InterpolationTest/InterpolationTest.glb",
    "conformance/MeshPrimitiveModes/MeshPrimitiveModes.gltf",
    "conformance/OrientationTest/OrientationTest.glb",
    "conformance/SimpleSparseAccessor/SimpleSparseAccessor.gltf",
    "cornell/cornell_emissive_bevy/CornellBox.glb",
    "cornell/cornell_nvpro/cornellBox.gltf",
    "pbr/DamagedHelmet/DamagedHelmet.glb",
    "transmissive/AttenuationTest/AttenuationTest.glb",
    "transmissive/TransmissionTest/TransmissionTest.glb",
    "transmissive/ior_test/17_ior.gltf",
];

#[test]
fn real_scenes_look_the_same_on_device_and_cpu() {
    let Some(folder) = std::env::var_os("RASRAY_SCENES").map(PathBuf::from) else {
        eprintln!("skipped {} scenes: RASRAY_SCENES is not set", FILES.len());
        return;
    };
    let mut failed = Vec::new();
    // The rule is that of `rasray_tests::tier`, which is above this crate.
    let is_full = std::env::var_os("RASRAY_FULL").is_some_and(|value| value == "1");
    let more = if is_full { &MORE_FILES[..] } else { &[] };
    for &file in FILES.iter().chain(more) {
        let start = std::time::Instant::now();
        let mut scene = rasray_scene_files::load(&folder.join(file), &LoadOptions::default()).expect(file);
        // The scenes get an environment in addition to their lights: some emit too little for a comparison.
        scene.environment = Environment::Constant([0.6, 0.7, 0.8]);
        let camera = scene.cameras.first().cloned().unwrap_or_else(|| default_camera(&scene));
        let found = difference(&scene, &scene, &camera, 1, &path(2));
        eprintln!("{file}: {found:?} {:?}", start.elapsed());
        if found.share > 0.02 {
            failed.push((file, found));
        }
    }
    if let Some((_, first)) = failed.first() {
        first.assert(false, format_args!("{failed:?}; of the first"));
    }
}
