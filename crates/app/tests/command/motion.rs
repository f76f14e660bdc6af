//! Scenes at a time: which clips move them, what reports say of it, and what is refused.

use std::path::Path;

use exr::prelude::read_first_flat_layer_from_file;
use serde_json::{Value, json};

use crate::scripted::{rasray, stderr};

/// A triangle that rises from z = 0 to 4 m within two seconds, and a second clip that lets it rise from
/// there.
pub const RISING: &str = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"name":"sheet","mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"animations":[
 {"name":"rise","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],"samplers":[{"input":1,"output":2}]},
 {"name":"stay","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
  "samplers":[{"input":1,"output":2,"interpolation":"STEP"}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
 {"bufferView":0,"byteOffset":36,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[2]},
 {"bufferView":0,"byteOffset":44,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":68}],
"buffers":[{"byteLength":68,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAgEA="}]}"#;

#[test]
fn a_scene_is_shown_at_a_time() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("rising.gltf"), RISING).expect("a scene");
    let run = |line: &str| {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        output.stdout
    };
    let info: Value = serde_json::from_slice(&run("info rising.gltf --json")).expect("JSON");
    let clips = json!([{ "name": "rise", "duration_s": 2.0 }, { "name": "stay", "duration_s": 2.0 }]);
    assert_eq!(info["scene"]["animation"], clips);
    let text = String::from_utf8(run("info rising.gltf")).expect("text");
    assert!(text.contains("rise") && text.contains("2.000 s"), "{text}");

    // Seen from 9 m above where it lies at rest.
    let aimed = "--eye 0.25,0.25,9 --target 0.25,0.25,0 --size 1x1 --spp 1 --aov depth --report r.json --output o.exr";
    let depth = |time: &str| -> (f32, Value) {
        run(&format!("render rising.gltf {time} {aimed}"));
        let report = std::fs::read(folder.path().join("r.json")).expect("the report");
        let report: Value = serde_json::from_slice(&report).expect("JSON");
        (depth_of(&folder.path().join("o.exr")), report["scene"]["pose"].clone())
    };
    assert_eq!(depth(""), (9.0, Value::Null));
    assert_eq!(depth("--time 1"), (7.0, json!({ "time_s": 1.0, "clips": ["rise"] })));
    assert_eq!(depth("--time 1 --clip stay"), (9.0, json!({ "time_s": 1.0, "clips": ["stay"] })));
    assert_eq!(depth("--time 7.5 --clip 0"), (5.0, json!({ "time_s": 7.5, "clips": ["rise"] })));
    run("compare rising.gltf --time 1.25 --systems bricks,brute-force --rays 200");
}

/// The depth in the middle of a picture.
fn depth_of(path: &Path) -> f32 {
    let image = read_first_flat_layer_from_file(path).expect("an image");
    let channels = &image.layer_data.channel_data.list;
    let channel = channels.iter().find(|channel| channel.name.to_string() == "Z").expect("a depth");
    channel.sample_data.value_by_flat_index(0).to_f32()
}

#[test]
fn frames_are_images_of_their_times_and_go_on_where_they_stopped() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("rising.gltf"), RISING).expect("a scene");
    let line = "render rising.gltf --frames 8-11 --fps 8 --clip rise --eye 0.25,0.25,9 --target 0.25,0.25,0 --size 1x1 \
                --spp 1 --aov depth --output out.###.exr --report r.jsonl --resume";
    let run = || {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stderr(&output)
    };
    let image = |number: &str| folder.path().join(format!("out.{number}.exr"));
    let says = |words: &str| {
        let said = run();
        assert!(said.contains(words), "{words}: {said}");
        let depths = ["008", "009", "010", "011"].map(|number| depth_of(&image(number)));
        assert_eq!(depths, [7.0, 6.75, 6.5, 6.25]);
    };
    says("4 frames were rendered (4 missing), 0 were there already");
    let rows = || std::fs::read_to_string(folder.path().join("r.jsonl")).expect("the report");
    let reports: Vec<Value> =
        rows().lines().map(|line| serde_json::from_str(line).expect("JSON in each line")).collect();
    let poses: Vec<_> = reports.iter().map(|report| report["scene"]["pose"].clone()).collect();
    let frames = json!({ "first": 8, "last": 11, "key": poses[0]["frames"]["key"] });
    assert!(frames["key"].is_string());
    assert_eq!(poses[2], json!({ "time_s": 1.25, "clips": ["rise"], "frame": 10, "frames": frames }));
    assert_eq!(poses.len(), 4);
    // The first build is no frame's.
    for (report, build) in reports.iter().zip([false, true, true, true]) {
        let run = &report["runs"][0];
        let stages: Vec<_> =
            run["stages"].as_array().expect("a list").iter().map(|time| time["stage"].clone()).collect();
        // Surfaces of triangles are looked up where they are shaded.
        let all = ["pose", "build", "trace-closest", "trace-occluded", "shade", "film"];
        let expected: Vec<_> = all.into_iter().filter(|stage| build || *stage != "build").collect();
        assert_eq!(stages, expected);
        assert_eq!(run["pose_ms"], run["stages"][0]["ms"]);
        assert!(run["pose_ms"].as_f64() > Some(0.0));
    }
    // Files that are there stay; those missing, damaged or of another time are made, and those without a row.
    std::fs::copy(image("011"), image("009")).expect("it is there");
    std::fs::remove_file(image("010")).expect("it is there");
    let whole = std::fs::read(image("008")).expect("it is there");
    std::fs::write(image("008"), &whole[..whole.len() - 1]).expect("a file");
    says("3 frames were rendered (1 missing, 1 of something else, 1 damaged), 1 were there already");
    assert_eq!(std::fs::read(image("008")).expect("it is there"), whole);
    let text = rows();
    let kept = text.lines().skip(1).map(|line| format!("{line}\n")).collect::<String>();
    std::fs::write(folder.path().join("r.jsonl"), &kept).expect("a file");
    says("1 frames were rendered (1 without a report), 3 were there already");
    assert!(rows().ends_with(&kept));
    // Another scene of the same name.
    std::fs::write(folder.path().join("rising.gltf"), format!("{RISING} ")).expect("a scene");
    says("4 frames were rendered (4 of something else), 0 were there already");
}

/// A scene on the device is kept from frame to frame; a picture alone has it anew.
#[test]
fn frames_are_the_pictures_of_their_times() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |line: &str| {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
    };
    let pixels = |name: &str| image::open(folder.path().join(name)).expect("an image").to_rgb8().into_raw();
    for (scene, system, refresh) in [
        ("cloth-ball:1k", "bvh", "all"),
        ("walker:8k", "mmrt", "all"),
        ("cloth-ball:1k", "bvh", "moving"),
        ("walker:8k", "bricks", "moving"),
        ("walker:8k", "bvh", "objects"),
    ] {
        let of = format!("render {scene} --system {system} --size 40x30 --spp 1 --integrator ao");
        run(&format!("{of} --frames 2-4 --fps 4 --refresh {refresh} --output f#.png --report r.jsonl"));
        let rows = std::fs::read_to_string(folder.path().join("r.jsonl")).expect("the report");
        for (frame, row) in rows.lines().enumerate() {
            let run = &serde_json::from_str::<Value>(row).expect("JSON in each line")["runs"][0];
            // The first frame makes the structure, the others keep it.
            let (first, build) = (&run["first_build_ms"], &run["build_ms"]);
            assert_eq!((first.is_number(), build.is_number()), (frame == 0, frame > 0), "{row}");
            assert_eq!(run["paths"]["refresh"].as_str().unwrap_or("all"), refresh, "{row}");
        }
        for frame in 2..=4 {
            run(&format!("{of} --time {} --output t.png", f64::from(frame) / 4.0));
            assert!(pixels(&format!("f{frame}.png")) == pixels("t.png"), "{scene}, frame {frame}");
        }
        assert!(pixels("f2.png") != pixels("f3.png") && pixels("f3.png") != pixels("f4.png"), "{scene}");
    }
}

/// In parts, structures that store fragments have views around what moves and around what does not: the same
/// picture whichever frames came before, and no farther from that of exact hits than through one structure.
#[test]
fn frames_of_fragments_in_parts_do_not_depend_on_those_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |line: &str| {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
    };
    let pixels = |name: &str| image::open(folder.path().join(name)).expect("an image").to_rgb8().into_raw();
    let difference = |one: &[u8], other: &[u8]| {
        let sum = one.iter().zip(other).map(|(one, other)| f64::from(one.abs_diff(*other))).sum::<f64>();
        sum / one.len() as f64
    };
    let shown = "--size 40x30 --spp 1 --integrator raycast --fps 2";
    run(&format!("render walker:8k --system bvh {shown} --frames 0-2 --output e#.png"));
    for (system, preset) in
        [("hu", "published"), ("mmrt", "robust"), ("selective", "published"), ("ldc", "published")]
    {
        let of = format!("render walker:8k --system {system} --preset {preset} --resolution 256 {shown}");
        run(&format!("{of} --frames 0-2 --refresh moving --output m#.png --report r.jsonl"));
        run(&format!("{of} --frames 0-2 --output a#.png"));
        let rows = std::fs::read_to_string(folder.path().join("r.jsonl")).expect("the report");
        assert_eq!(rows.lines().filter(|row| row.contains(r#""refresh":"moving""#)).count(), 3, "{rows}");
        for frame in 0..=2 {
            run(&format!("{of} --frames {frame}-{frame} --refresh moving --output one#.png"));
            let moving = pixels(&format!("m{frame}.png"));
            assert!(moving == pixels(&format!("one{frame}.png")), "{system}, frame {frame}");
            let exact = pixels(&format!("e{frame}.png"));
            let off = [&moving, &pixels(&format!("a{frame}.png"))].map(|picture| difference(picture, &exact));
            println!("{system} {preset}, frame {frame}: {off:.3?} of 255 off in parts and as one");
            assert!(off[0] <= off[1] + 0.1, "{system} {preset}, frame {frame}: {off:?} of 255 off");
        }
        assert!(pixels("m0.png") != pixels("m1.png") && pixels("m1.png") != pixels("m2.png"), "{system}");
    }
}

/// A triangle at a height, as an ASCII PLY; `more` of them with the same corners.
fn sheet(height: f64, more: usize) -> String {
    let faces = "3 0 1 2\n".repeat(1 + more);
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face {}\n\
         property list uchar int vertex_indices\nend_header\n0 0 {height}\n1 0 {height}\n0 1 {height}\n{faces}",
        1 + more
    )
}

#[test]
fn numbered_files_are_shown_at_their_times() {
    let folder = tempfile::tempdir().expect("a folder");
    for number in 2..=5 {
        let text = sheet(f64::from(number), number as usize);
        std::fs::write(folder.path().join(format!("s.{number:03}.ply")), text).expect("a scene");
    }
    let run = |line: &str| {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        output.stdout
    };
    let info: Value = serde_json::from_slice(&run("info s.###.ply --fps 10 --json")).expect("JSON");
    assert_eq!(info["scene"]["motion"], json!({ "kind": "changing", "duration_s": 0.5 }));
    let text = String::from_utf8(run("info s.###.ply")).expect("text");
    assert!(text.contains("other triangles at every time, until 0.200 s"), "{text}");

    let aimed = "--eye 0.25,0.25,9 --target 0.25,0.25,0 --size 1x1 --spp 1 --aov depth --report r#.json --output o#.exr";
    run(&format!("render s.###.ply --frames 1-6 --fps 8 {aimed}"));
    // Before the first it is the first, after the last the last.
    for (frame, number) in [(1, 2), (2, 2), (3, 3), (4, 4), (5, 5), (6, 5)] {
        assert_eq!(depth_of(&folder.path().join(format!("o{frame}.exr"))), 9.0 - number as f32);
        let report = std::fs::read(folder.path().join(format!("r{frame}.json"))).expect("the report");
        let report: Value = serde_json::from_slice(&report).expect("JSON");
        let file = format!("s.{number:03}.ply");
        let found = &report["scene"]["pose"];
        let frames = json!({ "first": 1, "last": 6, "key": found["frames"]["key"] });
        let time = f64::from(frame) / 8.0;
        let pose = json!({ "time_s": time, "clips": [], "frame": frame, "frames": frames, "file": file });
        assert_eq!(*found, pose);
        assert_eq!(report["scene"]["triangles"], json!(1 + number));
    }
    // At a time the last that has begun; at rest the first.
    let aimed = aimed.replace('#', "");
    run(&format!("render s.###.ply --time 0.44 --fps 10 {aimed}"));
    assert_eq!(depth_of(&folder.path().join("o.exr")), 5.0);
    run(&format!("render s.###.ply {aimed}"));
    assert_eq!(depth_of(&folder.path().join("o.exr")), 7.0);
    run("compare s.###.ply --time 0.2 --systems bricks,brute-force --rays 200");

    std::fs::write(folder.path().join("s.004.ply"), "ply\n").expect("a file");
    for (line, says) in [
        ("render s.###.ply --time 0.16 -o x.png", "s.004.ply"),
        ("render s.###.ply --frames 3-4 -o x#.png", "s.004.ply"),
        ("render s.###.ply --time 1 --clip 0 -o x.png", "leave --clip out"),
        ("render s.###.ply --frames 1-2 --refresh moving -o x#.png", "others in each frame"),
        ("render t.###.ply -o x.png", "no such file, such as t.001.ply"),
        ("render s.###.ply --time 0.08 --report s.003.ply -o x.png", "names a file of the scene"),
    ] {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(2), "{line}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{line}: {}", stderr(&output));
    }
    std::fs::remove_file(folder.path().join("s.004.ply")).expect("it is there");
    let output = rasray(folder.path(), "render s.###.ply -o x.png");
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("s.004.ply is missing"), "{}", stderr(&output));
}

#[test]
fn built_in_scenes_that_move_are_listed_shown_and_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |line: &str| {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        output.stdout
    };
    for (scene, kind, seconds) in
        [("walker:8k", "rig", 6.0), ("cloth-ball:1k", "deforming", 3.0), ("cornell", "still", 0.0)]
    {
        let info: Value = serde_json::from_slice(&run(&format!("info {scene} --json"))).expect("JSON");
        assert_eq!(info["scene"]["motion"], json!({ "kind": kind, "duration_s": seconds }), "{scene}");
    }
    run("compare walker:8k --time 0.3 --systems bricks,brute-force --rays 100");
    run("compare cloth-ball:1k --time 0.5 --systems bricks,brute-force --rays 100");
    let output = rasray(folder.path(), "render cloth-ball:1k --time 1 --clip fall -o x.png");
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("leave --clip out"), "{}", stderr(&output));
}

#[test]
fn times_and_clips_that_there_are_not_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("rising.gltf"), RISING).expect("a scene");
    for (line, says) in [
        ("render cornell --time 1 -o x.png", "has no clips"),
        ("render rising.gltf --time 1 --clip fly -o x.png", "has no clip 'fly'"),
        ("render rising.gltf --time 1 --clip 2 -o x.png", "0 (rise), 1 (stay)"),
        ("render rising.gltf --clip rise -o x.png", "--time"),
        ("render rising.gltf --frames 0-3 -o x.png", "write a run of #"),
        ("render rising.gltf --frames 3-0 -o x#.png", "a range such as 0-99"),
        ("render rising.gltf --frames 0-3 --time 1 -o x#.png", "--time"),
        ("render rising.gltf --frames 0-3 -o x#.png --report r.json", ".jsonl"),
        ("render rising.gltf --time 1 --fps 30 -o x.png", "--fps is of frames"),
        ("compare rising.gltf --fps 30 --systems bricks", "--fps is of frames"),
        ("render cornell --frames 0-3 -o #.png", "has no clips"),
        ("render rising.gltf --time soon -o x.png", "finite number of seconds"),
        ("render rising.gltf --refresh moving -o x.png", "--frames"),
        ("render rising.gltf --time 1 --refresh moving -o x.png", "--time"),
    ] {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(2), "{line}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{line}: {}", stderr(&output));
    }
}
