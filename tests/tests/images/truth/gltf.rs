//! Laws of light in a scene that comes from a file: emissive strength, specular, node transforms.

use std::path::Path;

use glam::DVec3;
use rasray_scene::{Mesh, Scene};
use rasray_scene_files::{LoadOptions, gltf};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    Studio, System, assert_refused, assert_truth, box_around, enclosure, looking,
};

/// One mesh of several.
fn merged(parts: &[Mesh]) -> Mesh {
    let mut whole = Mesh::default();
    for part in parts {
        let first = whole.positions.len() as u32;
        whole.positions.extend(&part.positions);
        whole.indices.extend(part.indices.iter().map(|index| first + index));
    }
    whole
}

/// A room that emits half its factor times `strength` and reflects 0.5, 0.25, 0.75: scaled and moved by
/// its node.
fn room(strength: f32) -> Scene {
    let mesh = merged(&box_around(DVec3::ZERO, DVec3::ONE, 0));
    let mut bytes: Vec<u8> = mesh.positions.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let indices_at = bytes.len();
    bytes.extend(mesh.indices.iter().flat_map(|index| index.to_le_bytes()));
    let data: String = bytes.iter().map(|byte| format!("%{byte:02X}")).collect();
    let (vertices, indices, length) = (mesh.positions.len(), mesh.indices.len(), bytes.len());
    let (index_bytes, emission) = (length - indices_at, "[0.5, 1.0, 0.25]");
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},
        "extensionsUsed":["KHR_materials_emissive_strength","KHR_materials_specular"],
        "buffers":[{{"byteLength":{length},"uri":"data:application/octet-stream,{data}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":{indices_at}}},
            {{"buffer":0,"byteOffset":{indices_at},"byteLength":{index_bytes}}}],
        "accessors":[
            {{"bufferView":0,"componentType":5126,"count":{vertices},"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]}},
            {{"bufferView":1,"componentType":5125,"count":{indices},"type":"SCALAR"}}],
        "materials":[{{
            "pbrMetallicRoughness":{{"baseColorFactor":[0.5,0.25,0.75,1],"metallicFactor":0}},
            "emissiveFactor":{emission},
            "extensions":{{"KHR_materials_specular":{{"specularFactor":0}},
                "KHR_materials_emissive_strength":{{"emissiveStrength":{strength}}}}}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],
        "nodes":[{{"mesh":0,"translation":[100,20,-7],"scale":[2,3,-1.5]}}],
        "scenes":[{{"nodes":[0]}}],"scene":0}}"#
    );
    gltf::from_slice(Path::new("room.gltf"), json.as_bytes(), &LoadOptions::default()).expect("a valid file")
}

#[test]
fn a_glowing_room_from_a_file_obeys_its_series() {
    let bench = Bench::new();
    let eye = DVec3::new(100.2, 20.4, -7.3);
    let camera = looking(eye, eye + DVec3::new(-0.5, 0.3, -0.9), 1.0);
    let truth =
        [(1.0, 0.5), (2.0, 0.25), (0.5, 0.75)].map(|(emission, albedo)| enclosure(emission, albedo, 3));
    let samples = super::samples(&bench, 8);
    for (strength, right) in [(2.0, true), (2.1, false)] {
        let stage = Studio::new(&bench, &room(strength), camera.clone(), 64, System::BruteForce);
        let found = stage.estimate(&stage.path(3), samples);
        let check = if right { assert_truth } else { assert_refused };
        check("room from a file", &found, truth, 0.0);
    }
}
