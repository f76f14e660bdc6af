//! Small glTF files made in the test, and the path to the folder of real scenes.
#![allow(dead_code, reason = "every test file uses its own part of this")]

pub mod moving;
pub mod rich;

use std::path::{Path, PathBuf};

use rasray_scene::{Scene, SceneError};
use rasray_scene_files::{LoadOptions, gltf};

/// Returns the folder that `RASRAY_SCENES` names, or prints that this test was skipped.
pub fn scenes_folder(test: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("RASRAY_SCENES").map(PathBuf::from).filter(|folder| folder.is_dir());
    if folder.is_none() {
        eprintln!("skipped: {test}: RASRAY_SCENES does not name a folder of scenes");
    }
    folder
}

/// Returns the number of triangles of all instances.
pub fn placed_triangles(scene: &Scene) -> usize {
    scene.instances.iter().map(|instance| scene.meshes[instance.mesh].triangle_count()).sum()
}

/// Loads text or bytes as a file in a folder that does not exist.
pub fn load_bytes(bytes: &[u8]) -> Result<Scene, SceneError> {
    gltf::from_slice(Path::new("nowhere/test.gltf"), bytes, &LoadOptions::default())
}

/// Returns the kinds of a scene's warnings.
pub fn kinds(scene: &Scene) -> Vec<&'static str> {
    scene.warnings.iter().map(|warning| warning.kind).collect()
}

/// Asserts the promises of [`Scene`] and [`rasray_scene::Mesh`], for any input.
pub fn assert_well_formed(scene: &Scene) {
    assert!(!scene.materials.is_empty());
    for mesh in &scene.meshes {
        let vertices = mesh.positions.len();
        assert!(mesh.indices.len().is_multiple_of(3));
        assert!(mesh.indices.iter().all(|&index| (index as usize) < vertices), "{}", mesh.name);
        assert!(mesh.positions.iter().flatten().all(|x| x.abs() <= 1.8e18 && !x.is_subnormal()));
        assert!(mesh.material < scene.materials.len());
        for normal in mesh.normals.iter().flatten() {
            let length: f32 = normal.iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-5, "{}: {normal:?}", mesh.name);
        }
        assert!(mesh.normals.as_ref().is_none_or(|list| list.len() == vertices));
        assert!(mesh.tangents.as_ref().is_none_or(|list| list.len() == vertices));
        assert!(mesh.tangents.iter().flatten().all(|tangent| tangent[3].abs() == 1.0));
        for set in mesh.uvs.iter().flatten() {
            assert_eq!(set.len(), vertices);
            assert!(set.iter().flatten().all(|x| x.is_finite()));
        }
        assert!(mesh.colors.as_ref().is_none_or(|list| list.len() == vertices));
    }
    for instance in &scene.instances {
        assert!(instance.mesh < scene.meshes.len());
        assert!(instance.world_from_mesh.is_finite(), "{}", instance.name);
    }
    for texture in &scene.textures {
        assert!(texture.image < scene.images.len());
    }
    for image in &scene.images {
        assert_eq!(image.rgba8.len() as u64, u64::from(image.width) * u64::from(image.height) * 4);
    }
    for material in &scene.materials {
        let textures = [
            material.base_color_texture,
            material.metallic_roughness_texture,
            material.anisotropy_texture,
            material.normal_texture,
            material.emission_texture,
            material.transmission_texture,
        ];
        assert!(
            textures.iter().flatten().all(|found| found.texture < scene.textures.len() && found.uv_set < 2)
        );
        assert!((0.0..=1.0).contains(&material.roughness) && material.ior >= 1.0);
    }
}

/// Makes a GLB container around JSON and bytes.
pub fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut file = b"glTF".to_vec();
    let length = 12 + 8 + json.len() + 8 + binary.len();
    file.extend(2_u32.to_le_bytes());
    file.extend((length as u32).to_le_bytes());
    file.extend((json.len() as u32).to_le_bytes());
    file.extend(b"JSON");
    file.extend(json);
    file.extend((binary.len() as u32).to_le_bytes());
    file.extend(b"BIN\0");
    file.extend(binary);
    file
}

/// Returns the bytes of floats.
pub fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// Makes a `data:` URI of bytes, percent-encoded.
pub fn data_uri(bytes: &[u8]) -> String {
    let escaped: String = bytes.iter().map(|byte| format!("%{byte:02X}")).collect();
    format!("data:application/octet-stream,{escaped}")
}

/// Returns the corners of one triangle, then indices 0 1 2 as u16 and padding: 44 bytes.
pub fn triangle_bytes() -> Vec<u8> {
    let mut bytes = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    bytes.extend([0, 0, 1, 0, 2, 0, 0, 0]);
    bytes
}

/// Makes a file with one indexed triangle. The caller gives `nodes` and the other top-level members (`extra`
/// begins with a comma where it is not empty); `primitive` is added to the primitive.
pub fn triangle_gltf(nodes: &str, primitive: &str, extra: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},
        "buffers":[{{"byteLength":44,"uri":"{}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":6}}],
        "accessors":[
            {{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},
            {{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1{primitive}}}]}}],
        "nodes":{nodes}{extra}}}"#,
        data_uri(&triangle_bytes())
    )
}
