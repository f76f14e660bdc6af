//! Shadow maps in place of traced shadow rays: what the report says of them, and what they are refused for.

use std::path::Path;

use serde_json::{Value, json};

use crate::scripted::{rasray, stderr};

fn run(folder: &Path, line: &str) {
    let output = rasray(folder, line);
    assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
}

#[test]
fn frames_by_maps_are_the_pictures_of_their_times() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let maps = "--occluder shadow-maps --shadow-resolution 64 --validation";
    let image = "--size 48x32 --spp 2 --bounces 1";
    run(
        folder,
        &format!("render walker:8k {image} {maps} --frames 0-1 --fps 2 --output f#.png --report r.jsonl"),
    );
    run(folder, &format!("render walker:8k {image} {maps} --time 0.5 --output one.png"));
    run(folder, &format!("render walker:8k {image} --time 0.5 --output traced.png"));
    let pixels = |name: &str| image::open(folder.join(name)).expect("an image").to_rgb8().into_raw();
    assert!(pixels("f1.png") == pixels("one.png") && pixels("f0.png") != pixels("f1.png"));
    let differ =
        pixels("one.png").iter().zip(pixels("traced.png")).filter(|(a, b)| a.abs_diff(*b) > 8).count();
    assert!((1..300).contains(&differ), "{differ} of {} channels differ", 48 * 32 * 3);
    let text = std::fs::read_to_string(folder.join("r.jsonl")).expect("the report");
    for line in text.lines() {
        let report: Value = serde_json::from_str(line).expect("JSON in each line");
        let run = &report["runs"][0];
        assert_eq!((&run["occluder"], &run["shadow_resolution"]), (&json!("shadow-maps"), &json!(64)));
        assert_eq!(run["memory"]["by_part"]["shadow maps"], json!(32 + 8 + 60 + 4 * 64 * 64));
        let stages = run["stages"].as_array().expect("a list");
        assert!(stages.iter().any(|time| time["stage"] == "shadow-maps"), "{stages:?}");
    }
    assert_eq!(text.lines().count(), 2);
}

/// The lamp of cornell by maps of points on its two triangles: the more points, the nearer to the picture
/// that is traced.
#[test]
fn a_lamp_with_an_extent_is_served_by_maps_of_its_points() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let image = "render cornell --size 32x32 --spp 32 --bounces 1 --validation --output";
    run(folder, &format!("{image} traced.png"));
    let pixels = |name: &str| image::open(folder.join(name)).expect("an image").to_rgb8().into_raw();
    let traced = pixels("traced.png");
    let error = |points: u32| {
        let maps = format!("--occluder shadow-maps --shadow-resolution 128 --shadow-points {points}");
        run(folder, &format!("{image} {points}.png {maps} --report {points}.json"));
        let report = std::fs::read_to_string(folder.join(format!("{points}.json"))).expect("the report");
        let report: Value = serde_json::from_str(&report).expect("JSON");
        let run = &report["runs"][0];
        assert_eq!(run["shadow_points"], json!(points));
        let views = 2 * 6 * points;
        assert_eq!(run["memory"]["by_part"]["shadow maps"], json!(32 + 8 + views * (60 + 4 * 128 * 128)));
        let squared = pixels(&format!("{points}.png")).into_iter().zip(&traced);
        squared.map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2)).sum::<f64>()
    };
    let (few, more) = (error(1), error(16));
    assert!(more > 0.0 && few > 4.0 * more, "squared error: {few} by 1 point, {more} by 16");
}

/// A square on which a lamp shines, of one material.
fn square(material: &str, extensions: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}},{{"translation":[0,0,2],"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":5,"material":0}}]}}],"materials":[{material}],
        "extensions":{{"KHR_lights_punctual":{{"lights":[{{"type":"point"}}]}}}},"extensionsUsed":["KHR_lights_punctual"{extensions}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}}],
        "buffers":[{{"byteLength":48,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAvwAAgD8AAAAAAACAPwAAgD8AAAAA"}}]}}"#
    )
}

#[test]
fn what_maps_cannot_answer_is_refused_with_a_way_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let veil = r#"{"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}}"#;
    let glass = r#"{"pbrMetallicRoughness":{"roughnessFactor":0,"metallicFactor":0},
        "extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}}"#;
    for (name, text) in [
        ("plain", square(r#"{"doubleSided":false}"#, "")),
        ("veil", square(veil, "")),
        ("pane", square(glass, r#","KHR_materials_transmission""#)),
    ] {
        std::fs::write(folder.join(format!("{name}.gltf")), text).expect("a scene");
    }
    let image = "--size 8x8 --spp 1 --output o.png --occluder shadow-maps --shadow-resolution 16";
    for (line, says, fix) in [
        ("veil.gltf", "surfaces of this scene let light pass", "--alpha off"),
        ("pane.gltf", "panes of this scene let light pass", "--glass-shadows opaque"),
        (
            "pane.gltf --integrator whitted",
            "panes of this scene let light pass",
            "write --occluder structure",
        ),
        ("plain.gltf --integrator ao", "the integrator ao sends no ray to a light", "--integrator path"),
        ("plain.gltf --bounces 0", "the integrator path sends no ray to a light", "with bounces"),
        (
            "plain.gltf --back-faces all",
            "--back-faces all",
            "write --occluder structure, or leave out --back-faces all",
        ),
    ] {
        let output = rasray(folder, &format!("render {line} {image}"));
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {said}");
        assert!(
            said.contains("--occluder shadow-maps") && said.contains(says) && said.contains(fix),
            "{line}: {said}"
        );
    }
    for line in ["plain.gltf", "veil.gltf --alpha off", "pane.gltf --glass-shadows opaque"] {
        run(folder, &format!("render {line} {image}"));
    }
    // Nothing for maps to answer is no mistake, and is said.
    let output = rasray(folder, &format!("render cornell {image}"));
    assert_eq!(output.status.code(), Some(0));
    assert!(stderr(&output).contains("no point, spot or directional light"), "{}", stderr(&output));
    let output = rasray(folder, &format!("render plain.gltf {image} --shadow-points 2"));
    assert!(stderr(&output).contains("nothing in the scene emits"), "{}", stderr(&output));
    // Emitting triangles with more maps than fit are an error that says what to make smaller.
    let output = rasray(
        folder,
        &format!("render cornell {image} --shadow-resolution 4096 --shadow-points 1024")
            .replace("--shadow-resolution 16 ", ""),
    );
    assert_ne!(output.status.code(), Some(0));
    assert!(
        stderr(&output).contains("a smaller --shadow-resolution or --shadow-points"),
        "{}",
        stderr(&output)
    );
}
