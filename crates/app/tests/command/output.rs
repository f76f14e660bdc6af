//! Destinations of results, and messages beside them: standard output, quiet and verbose runs, names that a
//! terminal would obey, completions and pages.

use crate::scripted::{HARNESS, command, entries, scripted, stderr, stdout};
use rasray_report::Report;
use serde_json::Value;
use std::io::Read;
use std::path::Path;
use std::process::Stdio;

#[test]
fn an_image_goes_to_standard_output_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = scripted(folder.path(), "render cornell --size 4x3 -o - --format png --report r.json");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let image = image::load_from_memory(&stdout(&output)).expect("nothing but an image").to_rgb8();
    assert_eq!((image.width(), image.height()), (4, 3));
    // Messages go elsewhere, and only files are said to be written.
    let said = stderr(&output);
    assert!(
        said.contains("camera 0 ") && said.contains("wrote r.json") && !said.contains("wrote -"),
        "{said}"
    );
    assert_eq!(entries(folder.path()), ["r.json"]);

    let output = scripted(folder.path(), "render cornell --size 4x3 --aov depth -o - --format exr");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let piped = folder.path().join("piped.exr");
    std::fs::write(&piped, stdout(&output)).expect("a file");
    assert!(exr::prelude::read_all_flat_layers_from_file(&piped).is_ok());
}

#[test]
fn a_report_goes_to_standard_output_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    for line in ["render cornell --size 4x3 --report -", "compare cornell --systems mmrt --report -"] {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let report: Report = serde_json::from_slice(&stdout(&output)).expect("nothing but a report");
        let camera = report.camera.expect("the camera that was used");
        assert_eq!((camera.index, camera.kind.as_str()), (Some(0), "perspective"));
        assert!(stderr(&output).contains("camera 0 '"), "{}", stderr(&output));
    }
    assert!(entries(folder.path()).is_empty());
}

#[test]
fn standard_output_takes_one_thing_whose_format_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    for (line, named, fix) in [
        ("render cornell -o -", "standard output", "--format png"),
        ("render cornell -o - --format png --report -", "same file", "two files"),
        ("render cornell -o - --format png --aov depth", "--aov", ".exr"),
        ("render cornell --report r.json --format png", "--output", "--help"),
        ("compare cornell --systems mmrt --report - --html -", "same file", "two files"),
    ] {
        let output = scripted(folder.path(), line);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {said}");
        assert!(said.contains(named) && said.contains(fix), "{line}: {said}");
    }
    assert!(entries(folder.path()).is_empty());
    // A format that is said goes before the name's.
    let output = scripted(folder.path(), "render cornell --size 4x3 -o picture --format png");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(image::load_from_memory(&std::fs::read(folder.path().join("picture")).expect("a file")).is_ok());
    std::fs::write(folder.path().join("one.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a scene");
    let output = scripted(folder.path(), "render one.obj --size 4x3 -o ./one.obj --format png");
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
}

#[test]
fn a_run_says_little_everything_or_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("one.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a scene");
    let run = |line: &str| {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        (String::from_utf8(stdout(&output)).expect("text"), stderr(&output))
    };
    let line = "render one.obj --size 4x3 -o a.png";
    let (out, said) = run(line);
    assert!(out.contains("trace 2.0 ms") && !out.contains("2.000 ms") && out.lines().count() < 8, "{out}");
    assert!(out.contains("camera default, --eye "), "{out}");
    assert!(said.contains("wrote a.png") && said.contains("default-light"), "{said}");
    let (out, _) = run(&format!("{line} --verbose"));
    assert!(out.contains("2.000 ms") && out.contains(" counts\n"), "{out}");
    let (out, said) = run(&format!("--quiet {line}"));
    assert_eq!((out.as_str(), said.as_str()), ("", ""));
    // Answers that were asked for are no talk.
    assert!(run("info -q one.obj").0.contains("triangles"));
    let output = scripted(folder.path(), "render nothing.obj -q -o a.png");
    assert!(stderr(&output).starts_with("error: "), "{}", stderr(&output));
}

#[test]
fn an_image_without_contents_comes_with_a_hint() {
    let folder = tempfile::tempdir().expect("a folder");
    // The scripted image is 0.5, 0.25, 1.
    for (exposure, word) in [("-7", "nearly black: --exposure -2 "), ("2", "nearly white: --exposure -2 ")] {
        let output =
            scripted(folder.path(), &format!("render cornell --size 4x3 -o a.png --exposure {exposure}"));
        assert!(stderr(&output).contains(word), "{}", stderr(&output));
    }
    let output = scripted(folder.path(), "render cornell --size 4x3 -o a.png");
    assert!(!stderr(&output).contains("hint"), "{}", stderr(&output));
}

/// A scene whose names would clear the screen, ring the bell and turn the direction of writing.
fn hostile(folder: &Path) {
    let scene = serde_json::json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "camera": 0, "name": "eye\u{1b}[2J\u{7}\u{9b}2J\u{202e}" }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } }],
        "animations": [{ "name": "\u{1b}[31m", "channels": [], "samplers": [] }],
    });
    std::fs::write(folder.join("names.gltf"), scene.to_string()).expect("a scene");
}

#[test]
fn names_in_a_file_cannot_steer_a_terminal() {
    let folder = tempfile::tempdir().expect("a folder");
    hostile(folder.path());
    for line in [
        "render names.gltf --size 4x3 -o a.png",
        "render names.gltf --size 4x3 -o a.png --verbose",
        "render names.gltf --size 4x3 -o a.png --report -",
        "render names.gltf -o a.png --camera nobody",
        "compare names.gltf --systems mmrt",
        "info names.gltf",
        "info names.gltf --json",
        "info \u{1b}[2Jnames.gltf",
        "\u{1b}[2J\u{7}",
    ] {
        let output =
            command(folder.path(), line).env("RASRAY_LOG", "trace").output().expect("the command starts");
        for (stream, bytes) in [("stdout", &output.stdout), ("stderr", &output.stderr)] {
            let text = String::from_utf8_lossy(bytes);
            let obeyed = |character: &char| {
                (character.is_control() && *character != '\n')
                    || ('\u{202a}'..='\u{202e}').contains(character)
            };
            assert_eq!(text.chars().find(obeyed), None, "{line:?}: {stream}: {text}");
        }
    }
    let output = scripted(folder.path(), "info names.gltf --json");
    let info: Value = serde_json::from_slice(&stdout(&output)).expect("JSON");
    assert_eq!(
        info["scene"]["cameras"][0]["name"], "eye\u{1b}[2J\u{7}\u{9b}2J\u{202e}",
        "data holds names as the file does"
    );
    let output = scripted(folder.path(), "info names.gltf");
    assert!(String::from_utf8_lossy(&output.stdout).contains(r"eye\u{1b}[2J\u{7}"), "{output:?}");
}

#[test]
fn info_is_data_too() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("one.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a scene");
    let json = |line: &str| -> Value {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        serde_json::from_slice(&stdout(&output)).expect("JSON")
    };
    let info = json("info cornell --json");
    assert_eq!((&info["schema"], &info["scene"]["triangles"]), (&"rasray-info/1".into(), &38.into()));
    assert_eq!(info["scene"]["cameras"][0], info["scene"]["default_view"], "the first is the default");
    assert_eq!(info["scene"]["default_light"], false);
    assert!(info["needs"]["terms"].as_array().is_some_and(|terms| !terms.is_empty()));
    // Where nothing is shaded, less is uploaded, and the report of a render says the same.
    let left_out = |info: &Value| info["needs"]["not_uploaded_bytes"].as_u64().expect("it was counted");
    let occlusion = json("info cornell --integrator ao --json");
    assert!(left_out(&occlusion) > left_out(&info));
    let line = "render cornell --integrator ao --size 4x3 --report r.json";
    let output = scripted(folder.path(), line);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = std::fs::read(folder.path().join("r.json")).expect("the report");
    let report: Value = serde_json::from_slice(&text).expect("JSON");
    assert_eq!(report["scene"]["not_uploaded_bytes"], left_out(&occlusion));
    let info = json("info one.obj --json");
    assert_eq!(info["scene"]["default_view"]["name"], "default");
    assert_eq!(
        (&info["scene"]["default_light"], &info["scene"]["environment"]),
        (&true.into(), &"none".into())
    );
    let info = json("info --json");
    assert_eq!((&info["device"]["name"], &info["devices"][1]), (&"scripted".into(), &"another".into()));
    assert_eq!(info["limits"]["storage buffer"], "128 MiB");
    assert_eq!(info["features"][0]["required"], true);
    assert_eq!(info["paths"][0]["chosen"], "descriptor");
    let passes = json("info cornell --passes --system mmrt --storage dll --json");
    assert_eq!(passes["passes"][0]["label"], "mmrt/build_0_header");
    assert_eq!((&passes["passes"][0]["workgroups"], &passes["passes"][0]["draws"]), (&7.into(), &0.into()));
    let text = String::from_utf8(stdout(&scripted(folder.path(), "info cornell --passes"))).expect("text");
    assert!(text.trim_start().starts_with("pass ") && text.contains("bvh/build_0_header"), "{text}");
    let lists = json("info cornell --statistics --system mmrt --storage dll --json");
    assert_eq!((&lists["lists"][0]["cells_of"], &lists["lists"][0]["cells"]), (&"mmrt".into(), &9.into()));
    let text =
        String::from_utf8(stdout(&scripted(folder.path(), "info cornell --statistics"))).expect("text");
    assert!(text.trim_start().starts_with("cells of ") && text.contains("on average"), "{text}");
    for (line, words) in [
        ("info cornell --passes --statistics", "--statistics"),
        ("info cornell --storage dll", "--storage is an option of a structure"),
        ("info cornell --passes --storage dll", "system bvh has no option --storage"),
        ("info cornell --system mmrt", "--passes"),
        ("info --passes", "SCENE"),
    ] {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(stderr(&output).contains(words), "{line}: {}", stderr(&output));
    }
    let text = String::from_utf8(stdout(&scripted(folder.path(), "info cornell"))).expect("text");
    for words in ["default view", "cameras\n  0  ", "perspective", "--eye "] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

#[test]
fn completions_and_pages_know_the_options() {
    let folder = tempfile::tempdir().expect("a folder");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = scripted(folder.path(), &format!("completions {shell}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let script = String::from_utf8(stdout(&output)).expect("text");
        assert!(script.contains("ao-distance") && script.contains("completions"), "{shell}");
    }
    for (line, title, word) in [
        ("man", ".TH rasray 1", "Exit codes"),
        ("man render", ".TH rasray-render 1", "ao\\-distance"),
        ("man compare", ".TH rasray-compare 1", "ray\\-set"),
        ("man info", ".TH rasray-info 1", "json"),
    ] {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let page = String::from_utf8(stdout(&output)).expect("text");
        assert!(page.contains(title) && page.contains(word), "{line}: {page}");
    }
    let output = scripted(folder.path(), "man nobody");
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("render"), "{}", stderr(&output));
}

/// A reader that wants no more is no error, and neither is an image that it leaves half read.
#[cfg(unix)]
#[test]
fn a_reader_that_has_gone_away_is_no_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut child = command(folder.path(), "render cornell --size 512x512 -o - --format exr")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut reader = child.stdout.take().expect("piped");
    reader.read_exact(&mut [0; HARNESS.len()]).expect("what the harness says");
    drop(reader);
    let output = child.wait_with_output().expect("its end");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}
