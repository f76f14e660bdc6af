//! Files that contradict themselves, ask for too much or reach outside their folder: each is refused with an
//! error that names the place.

use std::path::Path;

use crate::gltf_support::rich::{png, rich_glb};
use crate::gltf_support::{data_uri, floats, glb, kinds, load_bytes, triangle_bytes, triangle_gltf};
use rasray_scene::SceneError;
use rasray_scene_files::{Limits, LoadOptions, gltf};

/// Makes a file of one placed triangle with some text replaced.
fn altered(from: &str, to: &str) -> String {
    let file = triangle_gltf(r#"[{"mesh":0}]"#, "", "");
    assert!(file.contains(from), "{from} is not in the file");
    file.replace(from, to)
}

fn message(file: &str) -> String {
    match load_bytes(file.as_bytes()) {
        Ok(_) => panic!("loads: {file}"),
        Err(error @ SceneError::Internal { .. }) => panic!("panicked: {error}: {file}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn contradictions_are_named() {
    let positions = r#""bufferView":0,"componentType":5126,"count":3,"type":"VEC3""#;
    let cases = [
        (r#""POSITION":0"#, r#""POSITION":7"#, "meshes[0].primitives[0].attributes: refers to element 7"),
        (r#""indices":1"#, r#""indices":2"#, "meshes[0].primitives[0].indices"),
        (
            r#""indices":1"#,
            r#""indices":0"#,
            "accessors[0]: must have elements of 1 unsigned integers, has VEC3 of floats",
        ),
        (
            r#""indices":1"#,
            r#""indices":1,"material":0"#,
            "material: refers to element 0, but there are only 0",
        ),
        (
            r#""indices":1"#,
            r#""indices":1,"mode":9"#,
            "primitives[0].mode: is 9, which the format does not know",
        ),
        (r#""type":"VEC3""#, r#""type":"VEC2""#, "accessors[0]: has elements of type VEC2 where 3 numbers"),
        (
            r#""type":"VEC3""#,
            r#""type":"VEC9""#,
            "accessors[0].type: is \"VEC9\", which the format does not know",
        ),
        (
            positions,
            r#""bufferView":0,"componentType":5123,"count":3,"type":"VEC3""#,
            "accessors[0]: positions",
        ),
        (
            positions,
            r#""bufferView":0,"componentType":5126,"count":4,"type":"VEC3""#,
            "accessors[0]: needs 48 bytes",
        ),
        (
            positions,
            r#""bufferView":0,"byteOffset":4,"componentType":5126,"count":3,"type":"VEC3""#,
            "accessors[0]: needs 40 bytes",
        ),
        (
            positions,
            r#""bufferView":0,"byteOffset":1,"componentType":5126,"count":3,"type":"VEC3""#,
            "accessors[0]: needs 37 bytes, but bufferViews[0] has only 36",
        ),
        (
            positions,
            r#""bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,
            "indices":{"bufferView":1,"byteOffset":0,"componentType":5123},"values":{"bufferView":0,"byteOffset":28}}"#,
            "accessors[0]: needs 40 bytes",
        ),
        (
            positions,
            r#""bufferView":0,"componentType":5126,"count":2,"type":"VEC3","sparse":{"count":3,
            "indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":0}}"#,
            "accessors[0]: 3 sparse elements of 2",
        ),
        (
            positions,
            r#""bufferView":0,"componentType":5126,"count":2,"type":"VEC3","sparse":{"count":1,
            "indices":{"bufferView":1,"byteOffset":4,"componentType":5123},"values":{"bufferView":0}}"#,
            "accessors[0]: sparse index 2, but there are only 2 elements",
        ),
        (
            positions,
            r#""bufferView":0,"componentType":5126,"count":4611686018427387904,"type":"VEC3""#,
            "accessors[0]: needs 55340232221128654848 bytes, but bufferViews[0] has only 36",
        ),
        (
            positions,
            r#""bufferView":0,"byteOffset":18446744073709551615,"componentType":5126,"count":3,"type":"VEC3""#,
            "accessors[0]: needs 18446744073709551651 bytes",
        ),
        (r#""componentType":5123"#, r#""componentType":5126"#, "accessors[1]"),
        (
            r#""byteOffset":36,"byteLength":6"#,
            r#""byteOffset":40,"byteLength":6"#,
            "accessors[1]: needs 6 bytes, but bufferViews[1] has only 4 of its 6: they start at byte 40",
        ),
        (
            r#""byteOffset":36"#,
            r#""byteOffset":18446744073709551615"#,
            "bufferViews[1] has only 0 of its 6: they start at byte 18446744073709551615",
        ),
        (r#""buffer":0,"byteLength":36"#, r#""buffer":0,"byteLength":36,"byteStride":8"#, "a stride of 8"),
        (
            r#""buffer":0,"byteLength":36"#,
            r#""buffer":3,"byteLength":36"#,
            "bufferViews[0].buffer: refers to element 3",
        ),
        (
            r#""byteLength":44"#,
            r#""byteLength":40"#,
            "accessors[1]: needs 6 bytes, but bufferViews[1] has only 4 of its 6",
        ),
        (r#""byteLength":44"#, r#""byteLength":-1"#, "buffers[0].byteLength: must be a whole number"),
        (r#""uri":"#, r#""nothing":"#, "buffers[0]: has neither a reference nor a binary chunk"),
        (r#"{"mesh":0}"#, r#"{"mesh":4294967296}"#, "nodes[0].mesh: 4294967296 is too large"),
        (r#""POSITION":0"#, r#""POSITION":4294967296"#, "attributes.POSITION: 4294967296 is too large"),
        (r#"{"mesh":0}"#, r#"{"mesh":0,"children":[9]}"#, "nodes[0].children: refers to element 9"),
        (r#"{"mesh":0}"#, r#"{"mesh":0,"skin":0}"#, "nodes[0].skin"),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"matrix":[1,2,3]}"#,
            "nodes[0].matrix: must be 16 numbers, is [1,2,3]",
        ),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"scale":[1,"x",1]}"#,
            "nodes[0].scale: must be 3 numbers, is [1,\"x\",1]",
        ),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"matrix":[1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1]}"#,
            "nodes[0].matrix: is projective",
        ),
        (r#""version":"2.0""#, r#""version":"1.0""#, "only glTF 2.0"),
        (r#""version":"2.0""#, r#""version":"2.0","minVersion":"2.1""#, "only glTF 2.0"),
        (r#"{"version":"2.0"}"#, r#"{"v":"2.0"}"#, "is this a glTF file?"),
    ];
    for (from, to, words) in cases {
        let text = message(&altered(from, to));
        assert!(text.contains(words), "{to}: {text:?} does not say {words:?}");
        assert!(text.contains("test.gltf"), "{text}");
    }
    for (text, words) in [
        ("", "is empty, not glTF"),
        ("[]", "not an object"),
        ("{}", "asset.version"),
        ("{\"a\":\n", "the text ends in line 2"),
        ("{\"a\":\n\n7x}", "line 3, column 2 is no JSON, or a number out of range, near `{\"a\": 7x}`"),
        ("text", "begins with bytes 74 65 78 74, neither `glTF` nor the `{` of JSON"),
        ("v 0 0 0\0", "is binary data, not glTF"),
    ] {
        let found = message(text);
        assert!(found.contains(words), "{text:?}: {found}");
    }
}

#[test]
fn vertex_indices_must_exist() {
    for (index, bytes) in [(3_u32, [3, 0]), (4, [4, 0]), (65535, [0xFF, 0xFF])] {
        let mut binary = triangle_bytes();
        binary[38..40].copy_from_slice(&bytes);
        let file = triangle_gltf(r#"[{"mesh":0}]"#, "", "")
            .replace(&data_uri(&triangle_bytes()), &data_uri(&binary));
        match load_bytes(file.as_bytes()) {
            Err(SceneError::IndexOutOfRange { index: found, vertices: 3, .. }) => {
                assert_eq!(found, u64::from(index))
            }
            other => panic!("{index}: {other:?}"),
        }
    }
    let two = altered(r#""componentType":5123,"count":3"#, r#""componentType":5123,"count":2"#);
    assert!(message(&two).contains("2 vertices do not make whole triangles"));
}

/// A joint with a weight must exist; the index of one without weight may be any number.
#[test]
fn joints_must_exist() {
    let mut binary = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    binary.extend([0, 1, 9, 9].repeat(3));
    binary.extend(floats(&[0.5, 0.5, 0.0, 0.0].repeat(3)));
    let file = |joints: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":96,"uri":"{}"}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":12}},
                {{"buffer":0,"byteOffset":48,"byteLength":48}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},
                {{"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"}},
                {{"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}}}]}}],
            "skins":[{{"joints":{joints}}}],"nodes":[{{"mesh":0,"skin":0}},{{}},{{}}]}}"#,
            data_uri(&binary)
        )
    };
    load_bytes(file("[1,2]").as_bytes()).expect("both joints exist");
    assert!(message(&file("[1]")).contains("joint 1, but skins[0] has only 1"));
    assert!(message(&file("[]")).contains("skins[0]"));
    assert!(message(&file("[1,3]")).contains("skins[0].joints: refers to element 3"));
}

#[test]
fn references_outside_the_folder_are_refused() {
    let inside = data_uri(&triangle_bytes());
    let outside = [
        "../a.bin",
        "/etc/passwd",
        "a/../../b",
        "%2e%2e%2fa.bin",
        "file:///etc/passwd",
        "https://host/a.bin",
    ];
    for uri in outside {
        let file = triangle_gltf(r#"[{"mesh":0}]"#, "", "").replace(&inside, uri);
        let error = load_bytes(file.as_bytes());
        assert!(matches!(error, Err(SceneError::UnsafeReference { .. })), "{uri}: {error:?}");
        let material = format!(
            r#","images":[{{"uri":"{uri}"}}],"textures":[{{"source":0}}],
            "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}]"#
        );
        // A scene does not need its images.
        let file = triangle_gltf(r#"[{"mesh":0}]"#, r#","material":0"#, &material);
        let scene = load_bytes(file.as_bytes()).unwrap_or_else(|error| panic!("image {uri}: {error}"));
        assert_eq!(kinds(&scene), ["missing-texture"], "image {uri}");
        assert!(scene.images.is_empty() && scene.files.is_empty());
    }
    let absent = triangle_gltf(r#"[{"mesh":0}]"#, "", "").replace(&inside, "absent.bin");
    match load_bytes(absent.as_bytes()) {
        Err(error @ SceneError::Missing { .. }) => {
            let text = error.to_string();
            assert!(text.starts_with("nowhere/test.gltf: buffers[0] needs nowhere/absent.bin"), "{text}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn required_extensions_must_be_supported() {
    let cases = [
        ("EXT_texture_avif", "npx @gltf-transform/cli"),
        ("EXT_texture_webp", "npx @gltf-transform/cli"),
        ("ACME_unheard_of", "export the scene without it"),
    ];
    for (name, words) in cases {
        let used = format!(r#","extensionsUsed":["{name}"]"#);
        let scene =
            load_bytes(triangle_gltf(r#"[{"mesh":0}]"#, "", &used).as_bytes()).expect("it is optional");
        assert!(
            scene
                .warnings
                .iter()
                .any(|warning| warning.kind == "unsupported-extension" && warning.message.contains(name))
        );
        let required = format!(r#"{used},"extensionsRequired":["{name}"]"#);
        match load_bytes(triangle_gltf(r#"[{"mesh":0}]"#, "", &required).as_bytes()) {
            Err(error @ SceneError::UnsupportedExtension { .. }) => {
                let text = error.to_string();
                assert!(text.contains(name) && text.contains(words), "{text}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
    // Two extensions that the gltf crate itself would refuse.
    let supported = r#","extensionsRequired":["KHR_materials_volume","KHR_materials_specular"]"#;
    assert!(load_bytes(triangle_gltf(r#"[{"mesh":0}]"#, "", supported).as_bytes()).is_ok());
}

#[test]
fn every_limit_refuses() {
    let file = rich_glb();
    let refused = |change: fn(&mut Limits), option: &str| {
        let mut options = LoadOptions::default();
        change(&mut options.limits);
        match gltf::from_slice(Path::new("limits.glb"), &file, &options) {
            Err(SceneError::TooLarge { option: found, found: amount, limit, .. }) => {
                assert_eq!(found, option);
                assert!(amount > limit);
            }
            other => panic!("{option}: {other:?}"),
        }
    };
    refused(|limits| limits.triangles = 7, "triangles");
    refused(|limits| limits.vertices = 5, "vertices");
    refused(|limits| limits.elements = 60, "elements");
    refused(|limits| limits.image_pixels = 3, "image_pixels");
    refused(|limits| limits.total_pixels = 3, "total_pixels");
    refused(|limits| limits.nodes = 3, "nodes");
    refused(|limits| limits.instances = 3, "instances");
    refused(|limits| limits.depth = 1, "depth");
    let limits = Limits {
        triangles: 8,
        vertices: 6,
        image_pixels: 4,
        total_pixels: 4,
        nodes: 4,
        instances: 4,
        depth: 2,
        ..Limits::default()
    };
    let exact = LoadOptions { limits, ..LoadOptions::default() };
    gltf::from_slice(Path::new("limits.glb"), &file, &exact).expect("limits that are just met");

    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("large.glb");
    std::fs::write(&path, &file).expect("a temporary file");
    let mut options = LoadOptions::default();
    options.limits.file_bytes = file.len() as u64 - 1;
    let error = rasray_scene_files::load(&path, &options);
    assert!(matches!(error, Err(SceneError::TooLarge { option: "file_bytes", .. })), "{error:?}");
    options.limits.file_bytes += 1;
    assert!(rasray_scene_files::load(&path, &options).is_ok());
}

#[test]
fn a_small_file_cannot_ask_for_much() {
    // Without a buffer view the elements are zeros, and take no space in the file.
    let zeros = altered(
        r#""bufferView":0,"componentType":5126,"count":3"#,
        r#""componentType":5126,"count":18446744073709551615"#,
    );
    assert!(message(&zeros).contains("vertices"));
    // A PNG header that claims 65535 x 65535 texels.
    let mut image = png();
    image[16..24].copy_from_slice(&[0, 0, 0xFF, 0xFF, 0, 0, 0xFF, 0xFF]);
    let material = format!(
        r#","images":[{{"uri":"{}"}}],"textures":[{{"source":0}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}]"#,
        data_uri(&image)
    );
    let scene = load_bytes(triangle_gltf(r#"[{"mesh":0}]"#, r#","material":0"#, &material).as_bytes());
    assert_eq!(kinds(&scene.expect("an image that is left out")), ["unreadable-texture"]);
}

#[test]
fn containers_must_be_whole() {
    let whole = glb(r#"{"asset":{"version":"2.0"}}"#, &floats(&[1.0]));
    assert!(load_bytes(&whole).is_ok());
    assert!(load_bytes(&glb("\u{feff}{\"asset\":{\"version\":\"2.0\"}}", &floats(&[1.0]))).is_ok());
    let mut wrong_version = whole.clone();
    wrong_version[4] = 1;
    let mut long = whole.clone();
    long[8] = long[8].wrapping_add(1);
    let mut no_json = whole.clone();
    no_json[16..20].copy_from_slice(b"BIN\0");
    let mut long_chunk = whole.clone();
    long_chunk[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
    for (bytes, words) in [
        (wrong_version, "GLB version 1"),
        (long, "truncated"),
        (no_json, "does not begin with a chunk of JSON"),
        (
            whole[..12].iter().enumerate().map(|(i, &byte)| if i == 8 { 12 } else { byte }).collect(),
            "no whole chunk",
        ),
        (long_chunk, "ends behind the file"),
        (b"glTF".to_vec(), "truncated"),
    ] {
        match load_bytes(&bytes) {
            Err(error) => assert!(error.to_string().contains(words), "{error}"),
            Ok(_) => panic!("{words}: loads"),
        }
    }
    assert!(matches!(
        rasray_scene_files::load(Path::new("scene.xyz"), &LoadOptions::default()),
        Err(SceneError::UnknownFormat { .. })
    ));
    assert!(matches!(
        rasray_scene_files::load(Path::new("does-not-exist.glb"), &LoadOptions::default()),
        Err(SceneError::Read { .. })
    ));
}
