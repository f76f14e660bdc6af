//! Work that is divided: shares of samples that add up to the picture, shares of frames, and what goes on
//! where it was stopped.

use std::path::Path;

use exr::prelude::{FlatImage, FlatSamples, Text, read_all_flat_layers_from_file};
use rasray_report::Report;

use crate::motion::RISING;
use crate::scripted::{entries, rasray, scripted, stderr};

fn image(path: &Path) -> FlatImage {
    read_all_flat_layers_from_file(path).expect("an image")
}

fn channel(image: &FlatImage, name: &str) -> Vec<f32> {
    let channels = &image.layer_data[0].channel_data.list;
    let found = channels.iter().find(|channel| channel.name.to_string() == name).expect("the channel");
    match &found.sample_data {
        FlatSamples::F32(values) => values.clone(),
        other => panic!("{name}: {other:?}"),
    }
}

/// On a device: the sums of the shares are those of the whole, but for the order in which f32 are added.
#[test]
fn shares_of_the_samples_add_up_to_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = |name: &str| folder.path().join(name);
    let run = |line: &str| {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        stderr(&output)
    };
    let spp = 5;
    let line = format!("render cornell --size 8x6 --spp {spp} --bounces 2 --aov depth,primitive --output");
    run(&format!("{line} whole.exr"));
    for share in 1..=3 {
        run(&format!("{line} part.{share}.exr --shard {share}/3"));
    }
    run("merge merged.exr part.1.exr part.2.exr part.3.exr");
    run("merge again.exr part.3.exr part.1.exr part.2.exr");
    let bytes = |name: &str| std::fs::read(place(name)).expect("a file");
    assert_eq!(bytes("merged.exr"), bytes("again.exr"), "the order in which parts are named");
    let (whole, merged) = (image(&place("whole.exr")), image(&place("merged.exr")));
    // All but the checksum, since bits of sums differ.
    let header = |image: &FlatImage| {
        let mut attributes = image.layer_data[0].attributes.clone();
        attributes.other.remove(&Text::from("rasrayChecksum")).expect("a checksum");
        attributes
    };
    assert_eq!(header(&whole), header(&merged));
    assert_eq!(channel(&whole, "Z"), channel(&merged, "Z"));
    let mut lit = 0;
    for name in ["R", "G", "B"] {
        for (whole, merged) in channel(&whole, name).into_iter().zip(channel(&merged, name)) {
            // Radiance is not negative, so each of n additions and the division change the sum by 2^-24 at
            // most: n for the whole, fewer for the largest share, one when the sum of shares is rounded.
            let bound = f64::from(2 * spp + 2) * 2.0_f64.powi(-24) * f64::from(whole);
            let difference = (f64::from(whole) - f64::from(merged)).abs();
            assert!(difference <= bound, "{name}: {whole} and {merged} lie {difference} apart");
            lit += usize::from(whole > 0.0);
        }
    }
    assert!(lit > 60, "only {lit} of 144 values are light");
    let said = run(&format!("{line} merged.exr --resume"));
    assert!(said.contains("there already"), "{said}");
    // One share of one is the picture, bit for bit.
    run(&format!("{line} part.exr --shard 1/1"));
    run("merge one.exr part.exr");
    assert_eq!(bytes("one.exr"), bytes("whole.exr"));
}

#[test]
fn a_merged_picture_is_taken_for_that_of_one_process() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |line: &str| {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        stderr(&output)
    };
    let line = "render cornell --size 4x3 --spp 3 --output";
    run(&format!("{line} b.exr --shard 2/2"));
    run(&format!("{line} a.exr --shard 1/2"));
    run("merge whole.png b.exr a.exr --exposure 1");
    let said = run(&format!("{line} whole.png --exposure 1 --resume"));
    assert!(said.contains("there already"), "{said}");
    for (options, reason) in [
        ("whole.png --resume", "something else"),
        ("whole.png --seed 2 --exposure 1 --resume", "something else"),
        ("another.png --resume", "missing"),
    ] {
        let said = run(&format!("{line} {options}"));
        assert!(said.contains("the image is rendered") && said.contains(reason), "{options}: {said}");
        assert!(run(&format!("{line} {options}")).contains("there already"), "{options}");
    }
    // A share, too, is only made where it is missing; a report that was asked for comes with it.
    assert!(run(&format!("{line} a.exr --shard 1/2 --resume")).contains("there already"));
    let reported = format!("{line} a.exr --shard 1/2 --resume --report r.json");
    assert!(run(&reported).contains("without a report") && run(&reported).contains("there already"));
    let report = std::fs::read(folder.path().join("r.json")).expect("the report");
    let report: Report = serde_json::from_slice(&report).expect("a report");
    assert_eq!((report.runs[0].shard.as_deref(), report.runs[0].spp), (Some("1/2"), Some(2)));
    assert!(report.runs[0].key.as_ref().is_some_and(|key| key.len() == 64));
}

/// One share of one is the picture, bit for bit, and so are both without noise.
#[test]
fn a_merged_picture_is_denoised_as_one_of_one_process() {
    if let Err(error) = rasray_denoise::Denoiser::find() {
        return eprintln!("skipped: {error}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let run = |line: &str| {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        stderr(&output)
    };
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).expect("a file");
    let line = "render cornell --size 16x16 --spp 3";
    run(&format!("{line} --aov albedo,normal --output part.exr --shard 1/1"));
    for (name, aovs) in [("a.png", ""), ("a.exr", "--aov albedo,normal")] {
        let whole = format!("{line} {aovs} --denoise --output");
        run(&format!("{whole} {name}"));
        run(&format!("merge merged.{name} part.exr --denoise"));
        assert_eq!(bytes(&format!("merged.{name}")), bytes(name), "the file with its key");
        if name.ends_with("png") {
            let output = scripted(folder.path(), "merge noisy.png part.exr");
            assert!(stderr(&output).contains("--aov"), "a PNG holds no albedo: {}", stderr(&output));
        } else {
            run("merge noisy.exr part.exr");
            assert!(run(&format!("{whole} noisy.exr --resume")).contains("something else"));
        }
        assert!(run(&format!("{whole} merged.{name} --resume")).contains("there already"));
    }
    run(&format!("{line} --aov albedo --output part.exr --shard 1/1"));
    let output = scripted(folder.path(), "merge lacking.png part.exr --denoise");
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("part.exr: has no normal") && !folder.path().join("lacking.png").exists()
    );
}

#[test]
fn parts_that_make_no_picture_are_refused_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let make = |options: &str| {
        let output = scripted(folder.path(), &format!("render cornell --size 4x3 --spp 6 {options}"));
        assert_eq!(output.status.code(), Some(0), "{options}: {}", stderr(&output));
    };
    for share in 1..=3 {
        make(&format!("--output {share}.exr --shard {share}/3"));
    }
    make("--output half.exr --shard 1/2");
    make("--output seed.exr --shard 2/3 --seed 2");
    make("--output aov.exr --shard 1/1 --aov depth");
    make("--output whole.exr");
    let cut = std::fs::read(folder.path().join("2.exr")).expect("a part");
    std::fs::write(folder.path().join("cut.exr"), &cut[..cut.len() - 3]).expect("a file");
    let before = entries(folder.path());
    for (line, code, says) in [
        ("merge o.exr 1.exr 3.exr", 4, "2 of 6 samples are in no part, sample 1 first"),
        ("merge o.exr 1.exr 2.exr 2.exr", 2, "2.exr: holds sample 1, which 2.exr holds"),
        ("merge o.exr 1.exr 2.exr 3.exr half.exr", 2, "half.exr: holds sample 0, which 1.exr holds"),
        ("merge o.exr 1.exr seed.exr 3.exr", 2, "seed.exr: is of another picture than 1.exr"),
        ("merge o.exr 1.exr cut.exr 3.exr", 2, "cut.exr: is damaged"),
        ("merge o.exr whole.exr", 2, "whole.exr: holds no share"),
        ("merge o.exr 1.exr absent.exr", 2, "absent.exr: cannot be read"),
        ("merge 1.exr 1.exr 2.exr 3.exr", 2, "1.exr: is a part and the result"),
        ("merge o.png aov.exr", 2, "o.png: a PNG cannot hold"),
        ("merge o.exr 1.exr 2.exr 3.exr --exposure 1", 2, "--exposure"),
        ("merge o.jpg 1.exr 2.exr 3.exr", 2, ".jpg"),
        ("merge o.jsonl 1.exr", 2, "1.exr"),
        ("merge o.jsonl absent.jsonl", 2, "absent.jsonl"),
        ("render cornell --spp 2 --shard 3/3 -o o.exr", 2, "--shard 3/3 has none of 2 samples"),
        ("render cornell --spp 2 --shard 1/2 -o o.png", 2, "o.png: a PNG cannot hold the sums"),
        ("render cornell --shard 3/2 -o o.exr", 2, "such as 2/8"),
        ("render cornell --resume --report r.json", 2, "--output"),
    ] {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(code), "{line}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{line}: {}", stderr(&output));
    }
    assert_eq!(entries(folder.path()), before);
    // Shares of different divisions that hold each sample once go together.
    make("--output rest.exr --shard 4/6");
    make("--output last.exr --shard 6/6");
    make("--output odd.exr --shard 2/6");
    let output = scripted(folder.path(), "merge o.exr odd.exr rest.exr half.exr last.exr");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

#[test]
fn shares_of_frames_are_the_frames_and_their_reports_go_together() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("rising.gltf"), RISING).expect("a scene");
    let run = |line: &str| {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        stderr(&output)
    };
    let line = "render rising.gltf --frames 3-7 --size 2x2 --spp 1 --output f.#.png --resume --report";
    run(&format!("{line} 2.jsonl --shard 2/2"));
    assert_eq!(entries(folder.path()), ["2.jsonl", "f.4.png", "f.6.png", "rising.gltf"]);
    run(&format!("{line} 1.jsonl --shard 1/2"));
    assert!(run(&format!("{line} 7.jsonl --shard 7/7")).contains("0 frames were rendered"));
    run("merge all.jsonl 2.jsonl 7.jsonl 1.jsonl");
    let said = run(&format!("{line} all.jsonl"));
    assert!(said.contains("0 frames were rendered, 5 were there already"), "{said}");
    let rows = |name: &str| -> Vec<(u32, String)> {
        let text = std::fs::read_to_string(folder.path().join(name)).expect("a report");
        let row = |line: &str| {
            let report: Report = serde_json::from_str(line).expect("a report");
            let frame = report.scene.pose.and_then(|pose| pose.frame).expect("a frame");
            (frame, report.runs[0].key.clone().expect("a key"))
        };
        text.lines().map(row).collect()
    };
    let frames: Vec<_> = rows("all.jsonl").into_iter().map(|(frame, _)| frame).collect();
    assert_eq!(frames, [3, 4, 5, 6, 7]);
    // Rows merged once more change nothing; those of another picture are refused.
    run("merge twice.jsonl all.jsonl 1.jsonl");
    assert_eq!(rows("twice.jsonl"), rows("all.jsonl"));
    run(&format!("{line} seed.jsonl --seed 2 --shard 2/2"));
    let output = scripted(folder.path(), "merge bad.jsonl all.jsonl seed.jsonl");
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("seed.jsonl: has another picture of frame 4"), "{}", stderr(&output));
}

#[test]
fn reports_that_are_not_of_all_frames_of_a_command_are_refused_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("rising.gltf"), RISING).expect("a scene");
    let run = |line: &str| {
        let output = scripted(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
        stderr(&output)
    };
    let line = "render rising.gltf --size 2x2 --spp 1 --output f.#.png --frames";
    for share in 1..=3 {
        run(&format!("{line} 3-9 --shard {share}/3 --report {share}.jsonl"));
    }
    run(&format!("{line} 3-9 --shard 4/4 --report quarter.jsonl"));
    run(&format!("{line} 3-9 --shard 2/3 --seed 2 --report seed.jsonl"));
    run(&format!("{line} 3-9 --shard 2/3 --fps 12 --report fps.jsonl"));
    run(&format!("{line} 10-11 --report more.jsonl"));
    run(&format!("{line} 10-11 --report spp.jsonl").replace("--spp 1", "--spp 2"));
    // Every option that changes pictures is in their reports.
    const OPTIONS: [(&str, &str); 10] = [
        ("--sampler pcg", r#""sampler":"pcg""#),
        ("--primary raster", r#""primary":"raster""#),
        ("--occluder shadow-maps", r#""occluder":"shadow-maps","shadow_resolution":1024"#),
        ("--occluder shadow-maps --shadow-points 2", r#""shadow_points":2"#),
        ("--back-faces none", r#""back_faces":"none""#),
        ("--shadow-terminator offset", r#""shadow-terminator":"offset""#),
        ("--glass-shadows opaque", r#""glass-shadows":"opaque""#),
        ("--integrator ao --ao-distance 2", r#""ao-distance":2"#),
        ("--environment 1,1,1", r#""environment":"given""#),
        ("--alpha off", r#""alpha":"off""#),
    ];
    for (number, (option, _)) in OPTIONS.into_iter().enumerate() {
        run(&format!("{line} 10-11 {option} --report option{number}.jsonl"));
    }
    let text = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect("a report");
    for (number, (option, field)) in OPTIONS.into_iter().enumerate() {
        let row = text(&format!("option{number}.jsonl"));
        assert!(row.contains(field) && !text("more.jsonl").contains(field), "{option}: {row}");
        let output =
            scripted(folder.path(), &format!("merge out.jsonl 1.jsonl 2.jsonl 3.jsonl option{number}.jsonl"));
        assert_eq!(output.status.code(), Some(2), "{option}: {}", stderr(&output));
        let says = format!("option{number}.jsonl: has frame 10 of another command");
        assert!(stderr(&output).contains(&says), "{option}: {}", stderr(&output));
    }
    let rows = text("1.jsonl").lines().count();
    assert_eq!(rows, 3);
    let cut: String = text("1.jsonl").lines().take(2).flat_map(|line| [line, "\n"]).collect();
    std::fs::write(folder.path().join("cut.jsonl"), cut).expect("a file");
    let before = entries(folder.path());
    for (parts, says) in [
        // A share, two shares, and what a process that was killed left of one.
        (
            "1.jsonl 3.jsonl",
            "1.jsonl: is of frames 3-9, of which 2 of 7 are in no report: 4, 7; nothing of share 2 of 3 is there",
        ),
        (
            "2.jsonl",
            "2.jsonl: is of frames 3-9, of which 5 of 7 are in no report: 3, 5-6, 8-9; nothing of shares 1, 3 of 3",
        ),
        ("cut.jsonl 2.jsonl 3.jsonl", "cut.jsonl: is of frames 3-9, of which 1 of 7 are in no report: 9"),
        // Shares of different divisions.
        ("1.jsonl quarter.jsonl", "of which 4 of 7 are in no report: 4-5, 7-8"),
        ("more.jsonl 1.jsonl", "1.jsonl: is of frames 3-9"),
        // Shares of other commands, though no frame is there twice.
        (
            "1.jsonl seed.jsonl 3.jsonl",
            "seed.jsonl: has frame 4 of another command than that of frame 3 in 1.jsonl",
        ),
        (
            "1.jsonl fps.jsonl 3.jsonl",
            "fps.jsonl: has frame 4 of another command than that of frame 3 in 1.jsonl",
        ),
        ("1.jsonl 2.jsonl 3.jsonl spp.jsonl", "spp.jsonl: has frame 10 of another command"),
    ] {
        let output = scripted(folder.path(), &format!("merge out.jsonl {parts}"));
        assert_eq!(output.status.code(), Some(2), "{parts}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{parts}: {}", stderr(&output));
    }
    assert_eq!(entries(folder.path()), before, "nothing was written");
    // All shares, and frames of another command with the same options.
    run("merge all.jsonl 3.jsonl 1.jsonl 2.jsonl");
    run("merge both.jsonl more.jsonl all.jsonl");
    assert_eq!(text("both.jsonl").lines().count(), 9);
    // A report that is kept is of the frames of the command that kept it.
    let line = format!("{line} 3-4 --report kept.jsonl");
    run(&format!("{line} --shard 1/2"));
    run(&format!("{line} --shard 2/2 --resume"));
    run(&line.replace("3-4", "3-5 --resume"));
    let output = scripted(folder.path(), "merge out.jsonl kept.jsonl");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(text("out.jsonl").lines().count(), 3);
    run(&line.replace("3-4", "3-3 --resume"));
    assert_eq!(text("kept.jsonl").matches("\"last\":3").count(), 1);
}
