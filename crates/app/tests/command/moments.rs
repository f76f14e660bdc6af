//! Decisions for the moment that is shown: which key, whether a sky is added, what is warned of; and what a
//! camera frames.

use std::path::Path;

use serde_json::Value;

use crate::scripted::{rasray, stderr};

/// A lamp before a wall, which a clip of steps hides by a scale of 0 until second 1; at rest it is hidden.
const LAMP: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"camera":0,"translation":[0,0,5],"name":"cam"},{"mesh":0,"scale":[0,0,0]},{"mesh":1}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
 {"primitives":[{"attributes":{"POSITION":2},"indices":1,"material":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
 {"bufferView":0,"byteOffset":96,"componentType":5123,"count":6,"type":"SCALAR"},
 {"bufferView":0,"byteOffset":108,"componentType":5126,"count":4,"type":"VEC3"},
 {"bufferView":0,"byteOffset":216,"componentType":5126,"count":2,"type":"SCALAR"},
 {"bufferView":0,"byteOffset":224,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":248}],
"buffers":[{"byteLength":248,"uri":"data:application/octet-stream;base64,mpmZvpqZmb4AAAAAmpmZPpqZmb4AAAAAmpmZvpqZmT4AAAAAmpmZPpqZmT4AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAABAAMAAAADAAIAAAAAwAAAwL8AAIC/AAAAQAAAwL8AAIC/AAAAwAAAwD8AAIC/AAAAQAAAwD8AAIC/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAABAAMAAAADAAIAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AACAPwAAgD8="}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.01}}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]},"emissiveFactor":[1,1,1],
  "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":8}},"doubleSided":true},
 {"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0}}],
"extensionsUsed":["KHR_materials_emissive_strength"],
"animations":[{"name":"on","samplers":[{"input":3,"output":4,"interpolation":"STEP"}],
 "channels":[{"sampler":0,"target":{"node":1,"path":"scale"}}]}]}"#;

fn run(folder: &Path, line: &str) -> (Vec<u8>, String) {
    let output = rasray(folder, line);
    assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
    let said = stderr(&output);
    (output.stdout, said)
}

fn gray(place: &Path) -> Vec<u8> {
    image::open(place).expect("an image").to_luma8().into_raw()
}

/// A sky stands in for light that is missing then, not for what was missing at rest.
#[test]
fn the_sky_is_decided_at_the_moment_that_is_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("lamp.gltf"), LAMP).expect("a scene");
    std::fs::write(folder.path().join("baked.gltf"), LAMP.replace("[0,0,0]", "[1,1,1]")).expect("a scene");
    let render = |scene: &str, when: &str| -> (Vec<u8>, bool) {
        let line = format!("render {scene}.gltf {when} --size 32x24 --spp 4 --output o.png");
        let (_, said) = run(folder.path(), &line);
        (gray(&folder.path().join("o.png")), said.contains("default-light"))
    };
    let (baked, has_sky) = render("baked", "");
    assert!(!has_sky);
    let (shown, has_sky) = render("lamp", "--time 1");
    assert!(!has_sky && shown == baked, "the lamp shines then");
    let (hidden, has_sky) = render("lamp", "--time 0.5");
    assert!(has_sky && hidden == render("lamp", "").0, "nothing does before");
    assert!(render("baked", "--time 0.5").1, "a lamp that is hidden then lights nothing");

    // Frames have one light, in every share of them.
    let (_, said) =
        run(folder.path(), "render lamp.gltf --frames 0-2 --fps 2 --size 32x24 --spp 4 --output f#.png");
    assert!(!said.contains("default-light"), "{said}");
    let frame = |name: &str| gray(&folder.path().join(name));
    assert!(frame("f0.png").iter().all(|value| *value == 0) && frame("f2.png") == shown);
    let shares = "render lamp.gltf --frames 0-2 --fps 2 --size 32x24 --spp 4 --output s#.png --shard 1/3";
    run(folder.path(), shares);
    assert_eq!(frame("s0.png"), frame("f0.png"));
    // With others it is another picture, and kept for none of them.
    let (_, said) = run(
        folder.path(),
        "render lamp.gltf --frames 0-1 --fps 2 --size 32x24 --spp 4 --output f#.png --resume",
    );
    assert!(said.contains("default-light") && said.contains("(2 of something else)"), "{said}");
    assert!(frame("f0.png") == hidden);

    let compared = "compare lamp.gltf --time 1 --systems bricks,brute-force --rays 100 --report r.json";
    assert!(!run(folder.path(), compared).1.contains("default-light"));
}

#[test]
fn a_scene_is_looked_over_at_a_time() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("lamp.gltf"), LAMP).expect("a scene");
    let info = |when: &str| -> (Value, String) {
        let (json, said) = run(folder.path(), &format!("info lamp.gltf {when} --json"));
        (serde_json::from_slice::<Value>(&json).expect("JSON")["scene"].clone(), said)
    };
    let (rest, said) = info("");
    assert!(rest["default_light"] == true && rest["pose"].is_null() && said.contains("zero-scale"), "{said}");
    let (then, said) = info("--time 1");
    assert!(then["default_light"] == false && then["pose"]["time_s"] == 1.0, "{then}");
    assert!(!said.contains("zero-scale") && !said.contains("default-light"), "{said}");
    // The lamp is at z = 0, the wall at -1.
    assert_eq!(then["bounds_m"][1][2], 0.0);
    let (text, _) = run(folder.path(), "info lamp.gltf --time 1 --clip on");
    assert!(String::from_utf8_lossy(&text).contains("1 s, on"));
    for (line, says) in [
        ("info lamp.gltf --time 1 --clip off", "0 (on)"),
        ("info cornell --time 1", "has no clips"),
        ("info lamp.gltf --clip on", "--time"),
        ("info --time 1", "SCENE"),
    ] {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(2), "{line}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{line}: {}", stderr(&output));
    }
}

/// A plate of 3.9 x 1.9 m before a parallel camera that frames 4 x 2 m.
#[test]
fn what_a_camera_frames_is_never_cropped() {
    let folder = tempfile::tempdir().expect("a folder");
    let plate = |camera: &str, size: f64| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"camera":0,"translation":[0,0,5]}},{{"mesh":0,"scale":[{},{},1]}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":5}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}}],
            "bufferViews":[{{"buffer":0,"byteLength":48}}],"cameras":[{camera}],
            "buffers":[{{"byteLength":48,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAvwAAgD8AAAAAAACAPwAAgD8AAAAA"}}]}}"#,
            1.95 * size,
            0.95 * size
        )
    };
    let parallel = r#"{"type":"orthographic","orthographic":{"xmag":2,"ymag":1,"znear":0.1,"zfar":20}}"#;
    let perspective = r#"{"type":"perspective","perspective":{"yfov":1.0,"aspectRatio":2,"znear":0.1}}"#;
    // At 5 m a perspective of 1 radian frames 2 * 5 * tan(0.5) m.
    for (camera, size) in [(parallel, 1.0), (perspective, 5.0 * 0.5_f64.tan())] {
        std::fs::write(folder.path().join("plate.gltf"), plate(camera, size)).expect("a scene");
        for (size, [width, height], [across, up]) in
            [("90x90", [90, 90], [88, 43]), ("270x90", [270, 90], [176, 86]), ("30x90", [30, 90], [30, 14])]
        {
            for primary in ["trace", "raster"] {
                let line = format!(
                    "render plate.gltf --size {size} --spp 1 --integrator raycast --environment 0,0,0 --primary {primary} --output o.png"
                );
                run(folder.path(), &line);
                let pixels = gray(&folder.path().join("o.png"));
                let lit = |column: usize, row: usize| usize::from(pixels[row * width + column] > 0);
                let columns: usize = (0..width).map(|column| lit(column, height / 2)).sum();
                let rows: usize = (0..height).map(|row| lit(width / 2, row)).sum();
                assert!(
                    columns.abs_diff(across) <= 1 && rows.abs_diff(up) <= 1,
                    "{size} {camera}: {columns} {rows}"
                );
            }
        }
    }
    let (text, _) = run(folder.path(), "info plate.gltf");
    assert!(String::from_utf8_lossy(&text).contains("framing 2.000:1"), "{}", String::from_utf8_lossy(&text));
    let (json, _) = run(folder.path(), "info plate.gltf --json");
    let info: Value = serde_json::from_slice(&json).expect("JSON");
    assert_eq!(info["scene"]["cameras"][0]["aspect_ratio"], 2.0);
}
