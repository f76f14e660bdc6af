//! Faults of files that are shown all the same: each is named in a warning, or accepted where the meaning is
//! plain.

use crate::gltf_support::rich::png;
use crate::gltf_support::{
    assert_well_formed, data_uri, floats, glb, kinds, load_bytes, placed_triangles, triangle_bytes,
    triangle_gltf,
};
use rasray_scene::{AlphaMode, Light, Scene, SceneError};

const NODE: &str = r#"[{"mesh":0}]"#;

fn load_text(text: &str) -> Scene {
    let scene = load_bytes(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert_well_formed(&scene);
    scene
}

/// Loads one placed triangle with some text replaced; the result must still be one triangle.
fn altered(from: &str, to: &str) -> Scene {
    let file = triangle_gltf(NODE, "", "");
    assert!(file.contains(from), "{from} is not in the file");
    let scene = load_text(&file.replace(from, to));
    assert_eq!(placed_triangles(&scene), 1, "{to}");
    scene
}

/// Asserts that the only warning of a scene is of a kind and holds all words.
fn assert_says(scene: &Scene, kind: &str, words: &[&str]) {
    let [warning] = &scene.warnings[..] else { panic!("{kind}: {:?}", scene.warnings) };
    assert_eq!(warning.kind, kind);
    for word in words {
        assert!(warning.message.contains(word), "{:?} does not say {word:?}", warning.message);
    }
}

#[test]
fn transforms_that_contradict_or_flatten_are_named() {
    let cases = [
        (r#""matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"scale":[2,2,2]"#, "matrix-and-parts"),
        (r#""matrix":[1,0,0,0,0,1,0,0,0,0,0,0,0,0,0,1]"#, "singular-transform"),
        (r#""matrix":[0.1,0.2,0.3,0,0.3,0.6,0.9,0,0,0,1,0,0,0,0,1]"#, "singular-transform"),
        (r#""scale":[1,0,1]"#, "zero-scale"),
        (r#""scale":[-0.0,1,1]"#, "zero-scale"),
    ];
    for (transform, kind) in cases {
        assert_says(&altered(r#"{"mesh":0}"#, &format!(r#"{{"mesh":0,{transform}}}"#)), kind, &["nodes[0]"]);
    }
    let small = altered(r#"{"mesh":0}"#, r#"{"mesh":0,"matrix":[1e-9,0,0,0,0,1e-9,0,0,0,0,1e-9,0,0,0,0,1]}"#);
    assert!(small.warnings.is_empty(), "small is not singular: {:?}", small.warnings);
    let scene =
        altered(r#"{"mesh":0}"#, r#"{"mesh":0,"matrix":[3,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"scale":[2,2,2]}"#);
    assert_eq!(scene.instances[0].world_from_mesh.matrix3.x_axis.x, 3.0, "the matrix decides");
}

#[test]
fn lights_out_of_range_are_named() {
    let light = |light: &str| {
        let extra = format!(r#","extensions":{{"KHR_lights_punctual":{{"lights":[{light}]}}}}"#);
        let nodes = r#"[{"mesh":0,"extensions":{"KHR_lights_punctual":{"light":0}}}]"#;
        load_text(&triangle_gltf(nodes, "", &extra))
    };
    let cases = [
        (r#"{"type":"point","intensity":-3}"#, "intensity -3 is negative"),
        (r#"{"type":"directional","color":[1,-0.5,0]}"#, "color [1.0, -0.5, 0.0]"),
        (r#"{"type":"point","range":-1}"#, "range -1 is not above 0"),
        (
            r#"{"type":"spot","spot":{"innerConeAngle":0.7,"outerConeAngle":0.5}}"#,
            "innerConeAngle 0.7 is above",
        ),
        (
            r#"{"type":"spot","spot":{"innerConeAngle":-0.1,"outerConeAngle":0.5}}"#,
            "innerConeAngle -0.1 is negative",
        ),
        (r#"{"type":"spot","spot":{"outerConeAngle":2}}"#, "outerConeAngle 2"),
    ];
    for (text, words) in cases {
        let scene = light(text);
        assert_eq!(scene.lights.len(), 1, "{text}");
        assert_says(&scene, "light-range", &["lights[0]", words]);
    }
    assert!(light(r#"{"type":"spot","intensity":2,"spot":{}}"#).warnings.is_empty());
    assert!(matches!(
        light(r#"{"type":"point","intensity":-3}"#).lights[0],
        Light::Point { intensity: [0.0, 0.0, 0.0], .. }
    ));
    // A light of an unknown type is dropped where a node has it, and is ignored elsewhere.
    let scene = light(r#"{"type":"area"}"#);
    assert!(scene.lights.is_empty());
    assert_says(&scene, "bad-light", &["nodes[0]", r#"is "area", which the format does not know"#]);
    let unused = r#","extensions":{"KHR_lights_punctual":{"lights":[{"type":"area"}]}}"#;
    assert!(load_text(&triangle_gltf(NODE, "", unused)).warnings.is_empty());
}

#[test]
fn textures_need_coordinates() {
    let material = |what: &str| {
        let extra = format!(
            r#","images":[{{"uri":"{}"}}],"textures":[{{"source":0}}],"materials":[{{{what}}}]"#,
            data_uri(&png())
        );
        load_text(&triangle_gltf(NODE, r#","material":0"#, &extra))
    };
    let base = r#""pbrMetallicRoughness":{"baseColorTexture":{"index":0}}"#;
    let kind = "texture-without-coordinates";
    assert_says(&material(base), kind, &["mesh mesh0", "base colour texture", "no texture coordinates 0"]);
    assert_says(
        &material(r#""normalTexture":{"index":0,"texCoord":1}"#),
        kind,
        &["normal map", "coordinates 1"],
    );
    let both = material(&format!(r#"{base},"normalTexture":{{"index":0}}"#));
    assert_eq!(kinds(&both), [kind, kind]);
}

/// Makes the triangle's file with its positions as a second attribute of another type.
fn with_attribute(semantic: &str, accessor: &str) -> Scene {
    let file = triangle_gltf(NODE, "", "")
        .replace(r#""POSITION":0"#, &format!(r#""POSITION":0,"{semantic}":2"#))
        .replace(
            r#""type":"SCALAR"}"#,
            &format!(r#""type":"SCALAR"}},{{"bufferView":0,"count":3,{accessor}}}"#),
        );
    load_text(&file)
}

#[test]
fn attributes_of_types_that_are_not_allowed_are_named() {
    let scene = with_attribute("TEXCOORD_0", r#""componentType":5125,"type":"VEC2""#);
    assert_says(
        &scene,
        "attribute-type",
        &["meshes[0].primitives[0]", "TEXCOORD_0", "unsigned 32-bit integers"],
    );
    assert!(scene.meshes[0].uvs[0].is_some(), "it is read as it is");
    let cases = [
        ("TEXCOORD_1", r#""componentType":5123,"type":"VEC2""#, 1),
        ("TEXCOORD_1", r#""componentType":5123,"normalized":true,"type":"VEC2""#, 0),
        ("TEXCOORD_0", r#""componentType":5126,"type":"VEC2""#, 0),
        ("COLOR_0", r#""componentType":5125,"normalized":true,"type":"VEC3""#, 1),
        ("COLOR_0", r#""componentType":5121,"normalized":true,"type":"VEC4""#, 0),
        ("JOINTS_0", r#""componentType":5125,"type":"VEC2""#, 1),
        // The set of coordinates is not read.
        ("TEXCOORD_2", r#""componentType":5125,"type":"VEC2""#, 0),
        ("_CUSTOM", r#""componentType":5125,"type":"VEC2""#, 0),
    ];
    for (semantic, accessor, count) in cases {
        let scene = with_attribute(semantic, accessor);
        let found = kinds(&scene).iter().filter(|kind| **kind == "attribute-type").count();
        assert_eq!(found, count, "{semantic} {accessor}: {:?}", scene.warnings);
    }
    // A matrix has four numbers and padding between them, so it is no colour.
    let matrix = triangle_gltf(NODE, "", "").replace(r#""POSITION":0"#, r#""POSITION":0,"COLOR_0":2"#).replace(
        r#""type":"SCALAR"}"#,
        r#""type":"SCALAR"},{"bufferView":0,"count":3,"componentType":5121,"normalized":true,"type":"MAT2"}"#,
    );
    let error = load_bytes(matrix.as_bytes()).map(drop).expect_err("a matrix").to_string();
    assert!(error.contains("accessors[2]: has elements of type MAT2"), "{error}");
}

#[test]
fn misplaced_chunks_are_named() {
    let json =
        triangle_gltf(NODE, "", "").replace(&format!(r#","uri":"{}""#, data_uri(&triangle_bytes())), "");
    let good = glb(&json, &triangle_bytes());
    let load = |bytes: &[u8]| {
        let scene = load_bytes(bytes).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(placed_triangles(&scene), 1);
        scene
    };
    assert!(load(&good).warnings.is_empty());
    let with = |chunks: &[u8]| {
        let mut bytes = [&good[..], chunks].concat();
        let length = bytes.len() as u32;
        bytes[8..12].copy_from_slice(&length.to_le_bytes());
        load(&bytes)
    };
    assert_says(&with(b"\x04\0\0\0BIN\0abcd"), "glb-chunks", &["a second chunk of its kind"]);
    assert_says(&with(b"\x04\0\0\0JSON{}  "), "glb-chunks", &["a second chunk of its kind"]);
    assert!(with(b"\x04\0\0\0ACMEabcd").warnings.is_empty(), "unknown chunks are allowed");
    assert_says(&load(&[&good[..], b"trailing"].concat()), "glb-chunks", &["the 8 bytes after its end"]);
    let binary = 12 + 8 + json.len().next_multiple_of(4);
    let mut late = [&good[..binary], b"\x04\0\0\0ACMEabcd", &good[binary..]].concat();
    let length = late.len() as u32;
    late[8..12].copy_from_slice(&length.to_le_bytes());
    assert_says(&load(&late), "glb-chunks", &["not the second"]);
}

/// Parts that the scene does not use may be missing, unknown or broken.
#[test]
fn unused_parts_may_be_broken() {
    let cases = [
        (r#""buffers":["#, r#""buffers":[{"byteLength":9,"uri":"gone.bin"},"#),
        (r#""buffers":["#, r#""buffers":[{"byteLength":9},"#),
    ];
    for (from, to) in cases {
        let file = triangle_gltf(NODE, "", "").replace(from, to).replace(r#""buffer":0"#, r#""buffer":1"#);
        assert!(load_text(&file).warnings.is_empty(), "{to}");
    }
    let last = r#""type":"SCALAR"}"#;
    for accessor in [
        r#"{"componentType":9,"count":3,"type":"VEC3"}"#,
        r#"{"componentType":5126,"count":3,"type":"VEC9"}"#,
        r#"{"bufferView":0,"componentType":5126,"count":300,"type":"VEC3"}"#,
    ] {
        assert!(altered(last, &format!("{last},{accessor}")).warnings.is_empty(), "{accessor}");
    }
    let mesh = r#""meshes":[{"primitives":[{"mode":77,"attributes":{}}]},"#;
    let file = triangle_gltf(r#"[{"mesh":1}]"#, "", "").replace(r#""meshes":["#, mesh);
    assert_eq!(placed_triangles(&load_text(&file)), 1);
}

#[test]
fn whole_numbers_may_have_a_point() {
    for (from, to) in [
        (r#""count":3,"type":"VEC3""#, r#""count":3.0,"type":"VEC3""#),
        (r#""POSITION":0"#, r#""POSITION":0.0"#),
        (r#""indices":1"#, r#""indices":1e0,"mode":4.0,"material":null"#),
        (r#"{"mesh":0}"#, r#"{"mesh":0.0,"children":null,"name":null}"#),
        (r#""byteLength":44"#, r#""byteLength":44.0"#),
    ] {
        assert!(altered(from, to).warnings.is_empty(), "{to}");
    }
    let half = triangle_gltf(r#"[{"mesh":0.5}]"#, "", "");
    let error = load_bytes(half.as_bytes()).map(drop).expect_err("no whole number").to_string();
    assert!(error.contains("nodes[0].mesh: must be a whole number that is not negative, is 0.5"), "{error}");
}

/// Claims of more bytes than exist do no harm if the elements exist.
#[test]
fn padding_after_the_last_element_may_be_missing() {
    assert_says(
        &altered(r#""byteLength":44"#, r#""byteLength":48"#),
        "short-buffer",
        &["buffers[0]", "48", "44"],
    );
    let view = altered(r#""byteOffset":36,"byteLength":6"#, r#""byteOffset":36,"byteLength":12"#);
    assert_says(&view, "short-buffer-view", &["bufferViews[1]", "bytes 36 to 48", "only 44"]);
    // Three positions, 16 bytes apart, without the 4 bytes after the last.
    let mut bytes = floats(&[0.0, 0.0, 0.0, 9.0, 1.0, 0.0, 0.0, 9.0, 0.0, 1.0, 0.0]);
    bytes.extend([0, 0, 1, 0, 2, 0]);
    let strided = triangle_gltf(NODE, "", "")
        .replace(&data_uri(&triangle_bytes()), &data_uri(&bytes))
        .replace(r#"{"buffer":0,"byteLength":36}"#, r#"{"buffer":0,"byteLength":44,"byteStride":16}"#)
        .replace(r#""byteLength":44,"uri""#, r#""byteLength":50,"uri""#)
        .replace(r#""byteOffset":36,"byteLength":6"#, r#""byteOffset":44,"byteLength":6"#);
    let scene = load_text(&strided);
    assert_eq!(scene.meshes[0].positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert!(scene.warnings.is_empty());
}

#[test]
fn a_cutoff_above_one_shows_nothing() {
    let cutoff = |text: &str| {
        let extra = format!(r#","materials":[{{"alphaMode":"MASK","alphaCutoff":{text}}}]"#);
        let scene = load_text(&triangle_gltf(NODE, r#","material":0"#, &extra));
        let AlphaMode::Mask { cutoff } = scene.materials[0].alpha_mode else { panic!("{text}: no mask") };
        (cutoff, kinds(&scene))
    };
    assert_eq!(cutoff("0.75"), (0.75, vec![]));
    assert_eq!(cutoff("1"), (1.0, vec![]));
    assert_eq!(cutoff("1.1"), (f32::INFINITY, vec![]));
    assert_eq!(cutoff("1e39"), (f32::INFINITY, vec![]));
    assert_eq!(cutoff("-1"), (0.0, vec!["material-range"]));
}

#[test]
fn empty_scenes_say_why() {
    let cases = [
        ("[{}]", "", "1 mesh is in no scene"),
        (NODE, r#","scenes":[{}]"#, "1 mesh is in no scene"),
        (NODE, r#","scenes":[{},{"nodes":[0]}]"#, "the scene has no mesh; 1 mesh is in other scenes"),
    ];
    for (nodes, extra, words) in cases {
        assert_says(&load_text(&triangle_gltf(nodes, "", extra)), "no-triangles", &[words]);
    }
    assert_says(&load_text(r#"{"asset":{"version":"2.0"}}"#), "no-triangles", &["the file has no meshes"]);
}

#[test]
fn a_file_whose_triangles_are_all_dropped_is_an_error() {
    let refused = |text: &str| match load_bytes(text.as_bytes()) {
        Err(error @ SceneError::NoTriangles { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    let bytes = floats(&[f32::NAN, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let mut all = triangle_bytes();
    all[..36].copy_from_slice(&bytes);
    let file = triangle_gltf(NODE, "", "").replace(&data_uri(&triangle_bytes()), &data_uri(&all));
    assert!(refused(&file).contains("1 triangles were dropped: a corner of theirs is not finite"));
    assert!(
        refused(&triangle_gltf(NODE, "", "").replace(r#""POSITION":0"#, "")).contains("without positions")
    );
    let far =
        triangle_gltf(r#"[{"scale":[1e200,1,1],"children":[1]},{"scale":[1e200,1,1],"mesh":0}]"#, "", "");
    assert!(refused(&far).contains("1 instances have a place that is not finite"));
}

/// Extensions beyond the material model are named, declared or not.
#[test]
fn unsupported_extensions_are_named_wherever_they_are() {
    let names = [
        "KHR_materials_clearcoat",
        "KHR_materials_sheen",
        "KHR_materials_iridescence",
        "KHR_materials_variants",
    ];
    for name in names {
        let material =
            format!(r#","materials":[{{"extensions":{{"{name}":{{}},"KHR_materials_unlit":{{}}}}}}]"#);
        let undeclared = load_text(&triangle_gltf(NODE, r#","material":0"#, &material));
        assert_says(&undeclared, "unsupported-extension", &[name]);
        let declared = format!(r#"{material},"extensionsUsed":["{name}","KHR_materials_unlit"]"#);
        let declared = load_text(&triangle_gltf(NODE, r#","material":0"#, &declared));
        assert_says(&declared, "unsupported-extension", &[name]);
    }
}

/// Names are data: names, warnings and errors hold them as the file does, and code that shows them must
/// escape them.
#[test]
fn names_are_as_the_file_has_them() {
    let nasty = r#""name":"\u001b[2J\u202eevil\u009b""#;
    let extra = format!(
        r#","materials":[{{{nasty},"normalTexture":{{"index":0}}}}],"textures":[{{"source":0}}],
        "images":[{{{nasty},"uri":"{}"}}],"cameras":[{{{nasty},"type":"perspective","perspective":{{"yfov":1,"znear":1}}}}]"#,
        data_uri(&png())
    );
    let nodes = format!(r#"[{{{nasty},"mesh":0,"camera":0}},{{{nasty}}}]"#);
    let file = triangle_gltf(&nodes, r#","material":0"#, &extra)
        .replace(r#""meshes":[{"#, &format!(r#""meshes":[{{{nasty},"#));
    let scene = load_text(&file);
    let name = "\u{1b}[2J\u{202e}evil\u{9b}";
    for found in [
        &scene.meshes[0].name,
        &scene.instances[0].name,
        &scene.materials[0].name,
        &scene.images[0].name,
        &scene.cameras[0].name,
    ] {
        assert_eq!(found, name);
    }
    assert!(scene.warnings.iter().any(|warning| warning.message.contains(name)), "{:?}", scene.warnings);
    let refused = file.replace(
        r#""bufferView":0,"componentType":5126"#,
        r#""bufferView":0,"componentType":5126,"byteOffset":"\u001b[2J""#,
    );
    let error = load_bytes(refused.as_bytes()).map(drop).expect_err("text").to_string();
    assert!(
        error.contains("accessors[0].byteOffset: must be a whole number")
            && error.contains(r#"is "\u001b[2J""#),
        "{error:?}"
    );
}
