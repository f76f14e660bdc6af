//! The frames of the papers, made anew for each moment of a scene that moves.

use serde_json::{Value, json};

use crate::scripted::{rasray, stderr};

#[test]
fn every_paper_has_its_frame_of_a_scene_that_moves() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let image = "--preset published --resolution 64 --size 24x16 --spp 1 --validation --frames 0-1 --fps 2";
    for (system, integrator, occluder) in [
        ("mmrt", "path", "shadow-maps"),
        ("dirt", "path", "structure"),
        ("hu", "whitted", "structure"),
        ("selective", "whitted", "structure"),
        ("ldc", "whitted", "structure"),
    ] {
        let line = format!(
            "render walker:8k --system {system} {image} --output {system}#.png --report {system}.jsonl"
        );
        let output = rasray(folder, &line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        let text = std::fs::read_to_string(folder.join(format!("{system}.jsonl"))).expect("the report");
        assert_eq!(text.lines().count(), 2);
        for line in text.lines() {
            let report: Value = serde_json::from_str(line).expect("JSON in each line");
            let run = &report["runs"][0];
            assert_eq!(
                (&run["preset"], &run["integrator"], &run["primary"], &run["occluder"]),
                (&json!("published"), &json!(integrator), &json!("raster"), &json!(occluder)),
                "{system}"
            );
            let stages = run["stages"].as_array().expect("a list");
            for made in ["pose", "visible"] {
                assert!(stages.iter().any(|time| time["stage"] == made), "{system}: {stages:?}");
            }
        }
        let pixels = |frame: u32| {
            image::open(folder.join(format!("{system}{frame}.png"))).expect("an image").to_rgb8().into_raw()
        };
        assert!(pixels(0) != pixels(1), "{system}: nothing moved");
    }
}
