//! Results that the command leaves behind: images, reports, exit codes.

use crate::scripted::{command, entries, scripted, stderr};
use exr::prelude::FlatSamples;
use rasray_experiment::Aov;
use rasray_metrics::{Tone, ToneCurve};
use rasray_report::{Report, SCHEMA};
use std::path::Path;

fn report(path: &Path) -> Report {
    serde_json::from_slice(&std::fs::read(path).expect("a report")).expect("the schema")
}

#[test]
fn a_png_is_tone_mapped_by_exposure_and_srgb_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = scripted(folder.path(), "render cornell --size 4x3 --exposure 1 -o a.png");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let image = image::open(folder.path().join("a.png")).expect("an image").to_rgb8();
    assert_eq!((image.width(), image.height()), (4, 3));
    assert!(image.pixels().all(|pixel| pixel.0 == [255, 188, 255]));
    assert_eq!(entries(folder.path()), ["a.png"]);
}

#[test]
fn a_png_has_the_curve_that_was_asked_for_and_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |line: &str| {
        let output = scripted(folder.path(), &format!("render cornell --size 4x3 -o a.png {line}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let file = std::fs::File::open(folder.path().join("a.png")).expect("an image");
        let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG");
        let texts = reader.info().uncompressed_latin1_text.clone();
        let said = texts.into_iter().find(|chunk| chunk.keyword == "rasrayTone").expect("a tone").text;
        let mut pixels = vec![0; reader.output_buffer_size().expect("a small image")];
        reader.next_frame(&mut pixels).expect("pixels");
        (said, [pixels[0], pixels[1], pixels[2]], stderr(&output))
    };
    // Pixels of Blender's AgX and the fit of ACES for 0.5, 0.25, 1.
    let tone = |curve, exposure| rasray_metrics::tone_map(&[[0.5, 0.25, 1.0]], Tone { curve, exposure });
    let (said, pixel, _) = run("--tone agx --exposure -1");
    assert_eq!((said.as_str(), &pixel[..]), ("agx, exposure -1", &tone(ToneCurve::Agx, -1.0)[..]));
    let (said, pixel, _) = run("--tone aces");
    assert_eq!((said.as_str(), &pixel[..]), ("aces, exposure 0", &tone(ToneCurve::Aces, 0.0)[..]));
    let (.., resumed) = run("--tone aces --resume");
    assert!(resumed.contains("there already"), "{resumed}");
    let (said, pixel, resumed) = run("--resume");
    assert!(resumed.contains("something else"), "another tone is another file: {resumed}");
    assert_eq!((said.as_str(), pixel), ("exposure 0", [188, 137, 255]));
}

#[test]
fn a_denoiser_that_is_missing_is_named_before_anything_is_rendered() {
    let folder = tempfile::tempdir().expect("a folder");
    for line in
        ["render cornell --size 16x16 --denoise -o a.exr --device stuck", "merge a.exr b.exr --denoise"]
    {
        let mut command = command(folder.path(), line);
        let output =
            command.env("RASRAY_OIDN", "/nowhere/libOpenImageDenoise.so.2").output().expect("it starts");
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        for word in
            ["--denoise", "/nowhere/libOpenImageDenoise.so.2", "help: ", "RASRAY_OIDN", "pip install pyoidn"]
        {
            assert!(stderr(&output).contains(word), "{word}: {}", stderr(&output));
        }
        assert!(entries(folder.path()).is_empty());
    }
}

#[test]
fn files_say_what_denoised_them() {
    if let Err(error) = rasray_denoise::Denoiser::find() {
        return eprintln!("skipped: {error}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let run = |line: &str| {
        let output = scripted(folder.path(), &format!("render cornell --size 16x16 {line}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stderr(&output)
    };
    run("--denoise --aov depth -o a.exr");
    let image = exr::prelude::read_all_flat_layers_from_file(folder.path().join("a.exr")).expect("an image");
    let layer = &image.layer_data[0];
    let said = layer.attributes.other.get(&exr::prelude::Text::from("rasrayDenoised")).expect("it says so");
    assert!(format!("{said:?}").contains("Open Image Denoise 2."), "{said:?}");
    let names: Vec<_> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
    assert_eq!(names, ["B", "G", "R", "Z"], "what the denoiser was fed with was not asked for");
    assert!(run("--denoise --aov depth -o a.exr --resume").contains("there already"));
    assert!(run("--aov depth -o a.exr --resume").contains("something else"));
    run("--denoise -o a.png");
    let bytes = std::fs::read(folder.path().join("a.png")).expect("an image");
    assert!(bytes.windows(18).any(|text| text == b"Open Image Denoise"), "it says so");
}

#[test]
fn an_exr_holds_every_wanted_channel() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "render cornell --size 4x3 --spp 2 --aov depth,normal,primitive -o a.exr";
    let output = scripted(folder.path(), line);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let image = exr::prelude::read_all_flat_layers_from_file(folder.path().join("a.exr")).expect("an image");
    let names: Vec<_> = image.layer_data[0].channel_data.list.iter().map(|c| c.name.to_string()).collect();
    assert_eq!(names, ["B", "G", "N.X", "N.Y", "N.Z", "R", "Z", "id"]);

    let all: Vec<_> = Aov::ALL.iter().map(|aov| aov.name()).collect();
    let line = format!("render walker --frames 3 --size 4x3 --spp 2 --aov {} -o a.#.exr", all.join(","));
    let output = scripted(folder.path(), &line);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let image =
        exr::prelude::read_all_flat_layers_from_file(folder.path().join("a.3.exr")).expect("an image");
    let channels = &image.layer_data[0].channel_data.list;
    for aov in Aov::ALL {
        for (number, name) in aov.channels().iter().enumerate() {
            let found = channels.iter().find(|channel| channel.name.to_string() == *name).expect(name);
            let expected = match aov.is_whole() {
                true => FlatSamples::U32(vec![7; 12]),
                false => FlatSamples::F32(vec![number as f32 + 1.0; 12]),
            };
            assert_eq!(found.sample_data, expected, "{name}");
        }
    }
}

#[test]
fn a_report_follows_the_schema_and_leaves_out_what_was_not_measured() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("one.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a scene");
    let line = "render cornell --size 4x3 --seed 9 --bounces 2 --report r.json";
    let output = scripted(folder.path(), line);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let made = report(&folder.path().join("r.json"));
    assert_eq!(made.schema, SCHEMA);
    assert_eq!((made.scene.name.as_str(), &made.scene.sha256), ("cornell", &None));
    assert!(made.scene.triangles > 0);
    let run = &made.runs[0];
    assert_eq!((run.system.as_str(), run.structure.as_str(), run.preset.as_str()), ("bvh", "bvh", "robust"));
    assert_eq!(run.chosen.as_deref(), Some("the fastest exact structure"));
    assert_eq!((run.seed, run.bounces, run.width, run.spp), (Some(9), Some(2), Some(4), Some(16)));
    assert_eq!((run.times.build_ms, run.memory.is_none(), run.accuracy.is_none()), (None, true, true));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("trace 2.0 ms") && text.contains("1,000 rays"), "{text}");
    assert!(text.contains("system bvh: the fastest exact structure"), "{text}");
    for (given, system) in [("--system bvh", "bvh"), ("--system hu --preset published", "hu")] {
        let output = scripted(folder.path(), &format!("render cornell --size 4x3 --report r.json {given}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let made = report(&folder.path().join("r.json"));
        assert_eq!((made.runs[0].system.as_str(), &made.runs[0].chosen), (system, &None));
    }
}

#[test]
fn a_comparison_makes_a_run_per_system_preset_and_ray_set() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "compare cornell --systems mmrt,brute-force --presets robust,published --ray-set eye,eye,camera \
                --buckets 8 mmrt.march=samples --report r.json";
    let output = scripted(folder.path(), line);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let runs = report(&folder.path().join("r.json")).runs;
    let shape: Vec<_> = runs
        .iter()
        .map(|run| format!("{} {} {}", run.system, run.preset, run.ray_set.as_deref().unwrap_or("-")))
        .collect();
    assert_eq!(
        shape,
        [
            "mmrt robust eye",
            "mmrt published eye",
            "brute-force robust eye",
            "mmrt robust camera",
            "mmrt published camera",
            "brute-force robust camera",
        ]
    );
    assert_eq!((&runs[0].options["buckets"], &runs[0].options["march"]), (&8.into(), &"samples".into()));
    assert!(runs[2].options.is_empty());
}

#[test]
fn a_hard_case_fails_the_check_only_where_a_target_was_missed() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |line: &str| scripted(folder.path(), line);
    let output = run("compare hard:E5 --systems mmrt,brute-force --rays 17 --seed 3 --report r.json");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let made = report(&folder.path().join("r.json"));
    assert_eq!((made.scene.name.as_str(), made.runs.len()), ("hard:E5", 2));
    let hard = made.runs[1].hard.as_ref().expect("a verdict");
    assert_eq!((hard.met, hard.reason.as_str(), made.runs[1].seed), (Some(false), "17 rays", Some(3)));
    assert!(made.command.is_some_and(|line| line.starts_with("rasray compare hard:E5")));

    let output = run("compare hard:E5 --systems mmrt,brute-force --check");
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).contains("brute-force"), "{}", stderr(&output));
    let output = run("compare hard:E5 --systems selective --check");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    // A case that is a file needs no device's answers.
    let output = run("compare hard:C6-end --systems mmrt --check");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("refused"), "{output:?}");
}

#[test]
fn an_error_on_one_hard_case_keeps_the_cases_before_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "compare hard:all --systems mmrt --rays 3 --device broken --report r.json";
    let output = scripted(folder.path(), line);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("the device was lost"), "{}", stderr(&output));
    assert!(stderr(&output).contains("warning: 2 of "), "{}", stderr(&output));
    let kept = report(&folder.path().join("r.json")).runs;
    let ids: Vec<_> = kept.iter().filter_map(|run| run.ray_set.as_deref()).collect();
    assert_eq!(ids, ["G1", "G2"]);
    // With nothing whole there is nothing to keep.
    let output = scripted(folder.path(), "compare hard:G3 --systems mmrt --device broken --report n.json");
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(!folder.path().join("n.json").exists());
}

#[test]
fn a_device_that_is_absent_or_fails_ends_with_3_and_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    for device in ["absent", "broken"] {
        let output =
            scripted(folder.path(), &format!("render cornell -o a.png --report r.json --device {device}"));
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        assert!(stderr(&output).contains("help: "), "{}", stderr(&output));
    }
    assert!(entries(folder.path()).is_empty());
}

#[test]
fn unanswered_rays_end_with_4_and_make_a_report_but_no_image() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = scripted(folder.path(), "render cornell -o a.png --report r.json --device unfinished");
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert_eq!(entries(folder.path()), ["r.json"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_with_4_and_leaves_what_was_there() {
    let folder = tempfile::tempdir().expect("a folder");
    std::os::unix::fs::symlink("/dev/full", folder.path().join("full.png")).expect("a link");
    let output = scripted(folder.path(), "render cornell --size 64x64 -o full.png");
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(stderr(&output).contains("full.png"), "{}", stderr(&output));

    // A file of the old name stays as it was when the new one does not fit.
    std::fs::write(folder.path().join("a.exr"), b"old").expect("a file");
    let inner = command(folder.path(), "render cornell --size 256x256 -o a.exr --aov depth,normal,primitive");
    let mut shell = std::process::Command::new("bash");
    shell.args(["-c", "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\""]).arg(inner.get_program());
    shell.args(inner.get_args()).current_dir(folder.path());
    for (name, value) in inner.get_envs() {
        shell.env(name, value.expect("set, not removed"));
    }
    let output = shell.output().expect("bash starts");
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert_eq!(std::fs::read(folder.path().join("a.exr")).expect("the file"), b"old");
    assert_eq!(entries(folder.path()), ["a.exr", "full.png"]);
}

#[test]
fn a_scene_without_triangles_is_a_warning() {
    let folder = tempfile::tempdir().expect("a folder");
    let empty = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[]}],"scene":0}"#;
    std::fs::write(folder.path().join("empty.gltf"), empty).expect("a scene");
    let output = scripted(folder.path(), "render empty.gltf --size 4x3 -o a.png --report r.json");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stderr(&output);
    assert!(said.contains("warning: empty: the file has no meshes; only the background is shown"), "{said}");
    assert_eq!(said.matches("no-triangles").count(), 1, "{said}");
    assert_eq!(entries(folder.path()), ["a.png", "empty.gltf", "r.json"]);
    assert_eq!(report(&folder.path().join("r.json")).scene.sha256.map(|text| text.len()), Some(64));
}

#[test]
fn images_that_the_device_does_not_hold_are_smaller_and_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let lines = [
        "render atrium --size 4x3 --report r.json",
        "compare atrium --systems mmrt --ray-set eye --report r.json",
    ];
    for line in lines {
        let output = scripted(folder.path(), &format!("{line} --device small"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let said = stderr(&output);
        let warning = said.lines().find(|line| line.contains("(smaller-images)")).unwrap_or_default();
        assert_eq!(said.matches("smaller-images").count(), 1, "{said}");
        assert!(
            warning.starts_with("warning: atrium: ") && warning.contains("scripted holds 7.81 KiB"),
            "{said}"
        );
        let smaller = report(&folder.path().join("r.json")).scene.smaller_images;
        assert!(
            !smaller.is_empty() && smaller.iter().all(|image| image.to[0] < image.from[0]),
            "{smaller:?}"
        );
        assert!(smaller.iter().any(|image| warning.contains(&image.name)), "{warning}");
        // A device that holds them all says nothing.
        let output = scripted(folder.path(), line);
        assert!(!stderr(&output).contains("smaller-images"), "{}", stderr(&output));
        assert!(report(&folder.path().join("r.json")).scene.smaller_images.is_empty());
    }
}

#[test]
fn info_describes_the_device_in_use() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = scripted(folder.path(), "info");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = String::from_utf8_lossy(&output.stdout);
    for line in [
        "  1  another",
        "  Vulkan  1.2.3",
        "  scalarBlockLayout  yes  required  a test",
        "  shaderInt64        no   optional  a test",
        "  storage buffer  128 MiB",
        "  mmrt  addressing  descriptor  a software driver",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
}
