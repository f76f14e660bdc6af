//! Real files: the scenes load with their known numbers of triangles, and the malformed ones end as the table
//! says.

use std::path::{Path, PathBuf};

use crate::gltf_support::{assert_well_formed, kinds, placed_triangles, scenes_folder};
use rasray_scene::{Moment, Scene, SceneError};
use rasray_scene_files::{LoadOptions, load};

/// Number of placed triangles of every glTF scene.
const SCENES: [(&str, usize); 32] = [
    ("animated/BoxAnimated/BoxAnimated.glb", 254),
    ("animated/CesiumMilkTruck/CesiumMilkTruck.glb", 3624),
    ("animated/InterpolationTest/InterpolationTest.glb", 110),
    ("architecture/samplebuilding_instanced/subpass_scene_opaque.gltf", 23388),
    ("conformance/MeshPrimitiveModes/MeshPrimitiveModes.gltf", 16),
    ("conformance/MultipleScenes/MultipleScenes.gltf", 2),
    ("conformance/NegativeScaleTest/NegativeScaleTest.glb", 7724),
    ("conformance/NormalTangentMirrorTest/NormalTangentMirrorTest.glb", 5240),
    ("conformance/OrientationTest/OrientationTest.glb", 524),
    ("conformance/SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12),
    ("conformance/TextureSettingsTest/TextureSettingsTest.glb", 72),
    ("conformance/TextureTransformTest/TextureTransformTest.gltf", 24),
    ("conformance/VertexColorTest/VertexColorTest.glb", 36),
    ("cornell/cornell_emissive_bevy/CornellBox.glb", 36),
    ("cornell/cornell_nvpro/cornellBox.gltf", 16732),
    ("emissive/EmissiveStrengthTest/EmissiveStrengthTest.glb", 90),
    ("emissive/khronos_lights/lights.gltf", 1724),
    ("instanced/SimpleInstancing/SimpleInstancing.glb", 1500),
    ("morph/AnimatedMorphCube/AnimatedMorphCube.glb", 12),
    ("morph/AnimatedMorphSphere/AnimatedMorphSphere.glb", 960),
    ("morph/MorphStressTest/MorphStressTest.glb", 2412),
    ("pbr/AlphaBlendModeTest/AlphaBlendModeTest.glb", 61),
    ("pbr/DamagedHelmet/DamagedHelmet.glb", 15452),
    ("skinned/CesiumMan/CesiumMan.glb", 4672),
    ("skinned/Fox/Fox.glb", 576),
    ("skinned/RiggedFigure/RiggedFigure.glb", 256),
    ("skinned/RiggedSimple/RiggedSimple.glb", 188),
    ("skinned/SimpleSkin/SimpleSkin.gltf", 8),
    ("transmissive/AttenuationTest/AttenuationTest.glb", 292),
    ("transmissive/GlassBrokenWindow/GlassBrokenWindow.glb", 987),
    ("transmissive/TransmissionTest/TransmissionTest.glb", 128775),
    ("transmissive/ior_test/17_ior.gltf", 60),
];

fn load_file(path: &Path) -> Result<Scene, SceneError> {
    let result = load(path, &LoadOptions::default());
    if let Ok(scene) = &result {
        assert_well_formed(scene);
    }
    result
}

#[test]
fn scenes_load_with_their_triangles() {
    let Some(folder) = scenes_folder("scenes_load_with_their_triangles") else { return };
    let mut wrong = Vec::new();
    for (file, triangles) in SCENES {
        match load_file(&folder.join(file)) {
            Ok(scene) => {
                if placed_triangles(&scene) != triangles {
                    wrong.push(format!(
                        "{file}: {} triangles, expected {triangles}",
                        placed_triangles(&scene)
                    ));
                }
            }
            Err(error) => wrong.push(format!("{file}: {error}")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Collects all files below a folder.
fn files_below(folder: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { panic!("cannot list {}", folder.display()) };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            files_below(&path, files);
        } else {
            files.push(path);
        }
    }
}

/// Outcome of loading a file: the words that its error must hold, or triangles and kinds of warnings.
enum End {
    Error(&'static str),
    Loads(usize, &'static [&'static str]),
}
use End::{Error, Loads};

const BAD_FILES: [(&str, End); 24] = [
    ("degenerate/BoxBadNormals-glTF-Binary/BoxBadNormals.glb", Loads(12, &["bad-normals", "bad-normals"])),
    ("degenerate/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", Error("12 triangles were dropped")),
    ("degenerate/IncorrectVertexArrays/Cube.gltf", Error("35 vertices do not make whole triangles")),
    ("degenerate/trimesh_odd/empty_nodes.glb", Loads(0, &["no-triangles"])),
    ("malformed/assimp_gltf/IndexOutOfRange/AllIndicesOutOfRange.gltf", Error("vertex index 65535")),
    ("malformed/assimp_gltf/IndexOutOfRange/IndexOutOfRange.gltf", Error("vertex index 255")),
    ("malformed/assimp_gltf/MissingBin/BoxTextured.gltf", Error("BoxTextured0.bin")),
    ("malformed/assimp_gltf/RecursiveNodes/RecursiveNodes.gltf", Error("its own ancestor")),
    (
        "malformed/assimp_gltf/SchemaFailures/sceneWrongType.gltf",
        Error("scene: must be a whole number that is not negative, is \"hello\""),
    ),
    ("malformed/assimp_gltf/TestNoRootNode/NoScene.gltf", Error("scene: refers to element 0")),
    ("malformed/assimp_gltf/TestNoRootNode/SceneWithoutNodes.gltf", Loads(0, &["no-triangles"])),
    ("malformed/assimp_gltf/wrongTypes/badArray.gltf", Error("meshes[0].primitives: must be an array")),
    ("malformed/assimp_gltf/wrongTypes/badExtension.gltf", Error("KHR_texture_transform: must be an object")),
    ("malformed/assimp_gltf/wrongTypes/badNumber.gltf", Error("normalTexture.index: is missing")),
    ("malformed/assimp_gltf/wrongTypes/badObject.gltf", Error("pbrMetallicRoughness: must be an object")),
    ("malformed/assimp_gltf/wrongTypes/badString.gltf", Error("scenes[0].name: must be text, is 42")),
    ("malformed/assimp_gltf/wrongTypes/badUint.gltf", Error("that is not negative, is -1")),
    ("malformed/gltf_rs/gltf-json/tests/minimal_accessor_invalid.gltf", Loads(1, &[])),
    (
        "malformed/gltf_rs/gltf-json/tests/non_sparse_accessor_without_buffer_view.gltf",
        Loads(1, &["degenerate-triangles"]),
    ),
    (
        "malformed/tinygltf/BoundsChecking/integer-out-of-bounds.gltf",
        Error("bufferViews[0].byteLength: must be a whole number that is not negative, is 1e+300"),
    ),
    (
        "malformed/tinygltf/BoundsChecking/invalid-buffer-index.gltf",
        Error("bufferViews[1].buffer: refers to element 1"),
    ),
    ("malformed/tinygltf/BoundsChecking/invalid-buffer-view-index.gltf", Error("bufferViews[0].buffer")),
    ("malformed/tinygltf/BoundsChecking/invalid-primitive-indices.gltf", Error("bufferViews[0].buffer")),
    ("malformed/tinygltf/regression/unassigned-skeleton.gltf", Loads(8, &["skin-matrices"])),
];

/// A separate case: a container whose binary chunk is empty.
const EMPTY_CHUNK: &str = "malformed/tinygltf/regression/zero-sized-bin-chunk-issue-440.glb";

#[test]
fn bad_files_end_as_the_table_says() {
    let Some(folder) = scenes_folder("bad_files_end_as_the_table_says") else { return };
    let mut wrong = Vec::new();
    for (file, end) in BAD_FILES.iter().chain([&(EMPTY_CHUNK, Loads(1, &[]))]) {
        match (load_file(&folder.join(file)), end) {
            (Err(SceneError::Internal { reason, .. }), _) => {
                wrong.push(format!("{file}: panicked: {reason}"))
            }
            (Err(error), Error(words)) => {
                let text = error.to_string();
                if !text.contains(words) || !text.contains(folder.to_str().unwrap_or_default()) {
                    wrong.push(format!("{file}: {text:?} does not say {words:?} and the file"));
                }
            }
            (Ok(scene), Loads(triangles, warnings)) => {
                if placed_triangles(&scene) != *triangles || kinds(&scene) != *warnings {
                    wrong.push(format!(
                        "{file}: {} triangles, {:?}",
                        placed_triangles(&scene),
                        scene.warnings
                    ));
                }
            }
            (Ok(_), Error(words)) => wrong.push(format!("{file}: loads, expected {words:?}")),
            (Err(error), Loads(..)) => wrong.push(format!("{file}: {error}")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A glTF file that appears in the corpus must be in one of the tables.
#[test]
fn every_file_of_the_corpus_is_listed() {
    let Some(folder) = scenes_folder("every_file_of_the_corpus_is_listed") else { return };
    let mut files = Vec::new();
    files_below(&folder, &mut files);
    let listed: Vec<PathBuf> = (SCENES.iter().map(|(file, _)| *file))
        .chain(BAD_FILES.iter().map(|(file, _)| *file))
        .chain([EMPTY_CHUNK])
        .map(|file| folder.join(file))
        .collect();
    let is_gltf = |path: &&PathBuf| path.extension().is_some_and(|found| found == "gltf" || found == "glb");
    let missing: Vec<_> = files.iter().filter(is_gltf).filter(|file| !listed.contains(file)).collect();
    assert!(missing.is_empty(), "not in the tables: {missing:?}");
}

/// Scenes that can move have a rig, and no others have one. Posed by no clip, a scene equals the scene at
/// rest, to the bit.
#[test]
fn what_moves_has_a_rig() {
    let Some(folder) = scenes_folder("what_moves_has_a_rig") else { return };
    for (file, _) in SCENES {
        let scene = load_file(&folder.join(file)).unwrap_or_else(|error| panic!("{error}"));
        let moves = ["animated/", "morph/", "skinned/"].iter().any(|part| file.starts_with(part));
        assert_eq!(scene.animation.rig.placements.is_empty(), !moves, "{file}");
        let posed = scene.at(&Moment::default()).expect("a rig");
        assert_eq!(format!("{:?}", posed.meshes), format!("{:?}", scene.meshes), "{file}");
        assert_eq!(format!("{:?}", posed.instances), format!("{:?}", scene.instances), "{file}");
    }
}

/// Returns the extent of a scene in the world along each axis.
fn extent(scene: &Scene) -> [f64; 3] {
    let points = scene.instances.iter().flat_map(|instance| {
        let mesh = &scene.meshes[instance.mesh];
        mesh.indices.iter().map(|&index| {
            let position = glam::Vec3::from(mesh.positions[index as usize]).as_dvec3();
            instance.world_from_mesh.transform_point3(position)
        })
    });
    let (low, high) = points
        .fold((glam::DVec3::INFINITY, glam::DVec3::NEG_INFINITY), |(low, high), point| {
            (low.min(point), high.max(point))
        });
    (high - low).to_array()
}

/// Skins decide the place of a mesh: placed by their nodes, these figures would lie down or change size.
#[test]
fn skinned_figures_stand_upright() {
    let Some(folder) = scenes_folder("skinned_figures_stand_upright") else { return };
    let cases = [
        ("skinned/CesiumMan/CesiumMan.glb", [1.138, 1.507, 0.312]),
        ("skinned/Fox/Fox.glb", [25.19, 79.03, 154.72]),
        ("skinned/RiggedFigure/RiggedFigure.glb", [1.179, 1.450, 0.326]),
        ("skinned/RiggedSimple/RiggedSimple.glb", [2.0, 9.150, 2.0]),
    ];
    for (file, expected) in cases {
        let scene = load_file(&folder.join(file)).unwrap_or_else(|error| panic!("{error}"));
        let found = extent(&scene);
        let close = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-3 * b);
        assert!(close, "{file}: {found:?}, expected {expected:?}");
    }
}
