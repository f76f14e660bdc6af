//! Photon maps by the command: their passes and memory in reports, what they show, and what is refused.

use serde_json::Value;

use crate::scripted::{rasray, stderr};

#[test]
fn photons_light_what_paths_of_lamps_without_extent_do_not_find() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let run = |name: &str, options: &str| {
        let image = "--size 24x16 --spp 2 --bounces 3 --validation";
        let line = format!("render pool {image} {options} --output {name}.png --report {name}.json");
        let output = rasray(folder, &line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).expect("the report");
        let report: Value = serde_json::from_str(&text).expect("JSON");
        let pixels = image::open(folder.join(format!("{name}.png"))).expect("an image").to_rgb8().into_raw();
        (report["runs"][0].clone(), pixels)
    };
    let photons = "--integrator photons --photon-paths 5000";
    let (_, by_paths) = run("paths", "");
    let (caustic, by_photons) = run("caustic", photons);
    let (_, again) = run("again", &format!("{photons} --system grid"));
    let (_, all) = run("all", &format!("{photons} --photons all --radius 0.2"));
    assert!(by_photons == again, "another structure");
    assert!(by_photons != all && by_photons != by_paths);
    // Light of the sun reaches the ground through the water.
    let brighter = by_photons.iter().zip(&by_paths).filter(|(a, b)| **a > b.saturating_add(4)).count();
    assert!(brighter > by_photons.len() / 10, "{brighter} of {} channels", by_photons.len());
    assert_eq!(caustic["integrator"], "photons");
    let passes = caustic["passes"].as_array().expect("a list");
    for made in ["integrators/photon_emit", "integrators/photon_shade"] {
        assert!(passes.iter().any(|pass| pass["label"] == made), "{made}: {passes:?}");
    }
}

#[test]
fn what_photons_cannot_do_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let image = "render cornell --size 4x3 --spp 1 --output a.png";
    for (options, says, hint) in [
        ("--photons all", "--photons is an option of --integrator photons", "--integrator photons"),
        ("--integrator photons --radius 0", "--radius", "above 0"),
        ("--integrator photons --photon-paths 0", "--photon-paths", "1 to"),
        ("--integrator photons --glass-shadows opaque", "--glass-shadows", "path"),
        ("--integrator photons --bounces 1024 --photon-paths 1048576", "bytes", "--photon-paths"),
        (
            "--integrator photons --photons all --radius 9 --photon-paths 60000",
            "photons around them",
            "--radius",
        ),
    ] {
        let output = rasray(folder.path(), &format!("{image} {options}"));
        let told = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{options}: {told}");
        assert!(told.contains(says) && told.contains(hint), "{options}: {told}");
    }
}
