//! The built command on a device: what it saves can be traced again, and what others find is evaluated.

use crate::scripted::rasray;
use rasray_report::{Accuracy, Pass, PassOf, Report};
use std::path::Path;
use std::process::Command;

/// Runs a comparison that must succeed and returns its report.
fn compared(folder: &Path, line: &str) -> Report {
    let output = rasray(folder, &format!("{line} --repetitions 1 --report r.json"));
    assert_eq!(output.status.code(), Some(0), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&std::fs::read(folder.join("r.json")).expect("a report")).expect("the schema")
}

fn accuracy(report: &Report, run: usize) -> &Accuracy {
    report.runs[run].accuracy.as_ref().expect("rays are judged")
}

/// Start of the records of a `.npy` file of version 1.
fn records(bytes: &[u8]) -> usize {
    10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]))
}

#[test]
fn rays_and_hits_go_out_and_come_back_and_a_wrong_hit_is_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let line = "compare cornell --systems mmrt,brute-force --ray-set bounce --rays 400 --size 16x9";
    let first = compared(path, &format!("{line} --save-rays . --save-hits ."));
    assert_eq!((first.runs.len(), accuracy(&first, 1).missed), (2, 0));
    assert!(first.statistics.is_some_and(|statistics| statistics.rates > 5));

    // Rays read from the file get the same answers, bit for bit, and each variant of a system has a file.
    let line =
        "compare cornell --systems mmrt,brute-force mmrt.buckets=4,8 --rays-file bounce.rays --save-hits .";
    compared(path, line);
    for (name, again) in [
        ("oracle", "oracle"),
        ("mmrt-robust", "mmrt-robust.buckets=4"),
        ("mmrt-robust", "mmrt-robust.buckets=8"),
        ("brute-force-robust", "brute-force-robust"),
    ] {
        let read = |name: &str| std::fs::read(path.join(format!("{name}.npy"))).expect("hits");
        assert_eq!(read(&format!("bounce.{name}")), read(&format!("file.{again}")), "{again}");
    }

    // The oracle's own answers, rounded to f32, have no fault.
    let line = "compare cornell --systems brute-force --rays-file bounce.rays --hits-file other=other.npy";
    let truth = std::fs::read(path.join("bounce.oracle.npy")).expect("the oracle's answers");
    std::fs::write(path.join("other.npy"), &truth).expect("a file");
    let right = compared(path, line);
    assert_eq!((right.runs[1].system.as_str(), right.runs[1].times.trace_ms), ("other", None));
    let evaluated = accuracy(&right, 1);
    assert_eq!((evaluated.missed, evaluated.false_hits, evaluated.wrong_primitive), (0, 0, Some(0)));
    assert_eq!((evaluated.t_off, evaluated.non_finite), (Some(0), 0));

    // Records are t (8 bytes), triangle (4), u, v (8 each) and whether the ray is ambiguous.
    let start = records(&truth);
    let sure_hit = truth[start..]
        .chunks_exact(29)
        .position(|record| record[8..12] != [0xFF; 4] && record[28] == 0)
        .expect("a sure hit");
    let place = start + 29 * sure_hit;
    for (change, missed, wrong, off) in [
        (&[(8, 0xFF), (9, 0xFF), (10, 0xFF), (11, 0xFF)][..], 1, 0, 0),
        (&[(8, truth[place + 8] ^ 1)][..], 0, 1, 0),
        (&[(6, truth[place + 6] ^ 0x10)][..], 0, 0, 1),
    ] {
        let mut wrong_hits = truth.clone();
        for (offset, byte) in change {
            wrong_hits[place + offset] = *byte;
        }
        std::fs::write(path.join("other.npy"), wrong_hits).expect("a file");
        let report = compared(path, line);
        let evaluated = accuracy(&report, 1);
        let counts = (evaluated.missed, evaluated.wrong_primitive, evaluated.t_off);
        assert_eq!(counts, (missed, Some(wrong), Some(off)), "{change:?}");
    }

    // Hits for other rays, and rays that are cut short.
    std::fs::write(path.join("short.rays"), &std::fs::read(path.join("bounce.rays")).expect("rays")[..1000])
        .expect("a file");
    for line in [
        "compare cornell --systems brute-force --ray-set eye --rays 7 --hits-file other=other.npy",
        "compare cornell --systems brute-force --rays-file short.rays",
    ] {
        assert_eq!(rasray(path, line).status.code(), Some(2), "{line}");
    }
}

#[test]
fn a_page_has_figures_and_a_hard_case_its_verdict() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let line = "compare cornell --systems mmrt,brute-force --ray-set camera --rays 300 --size 16x9";
    let report = compared(path, &format!("{line} --spp 1 --image --html r.html"));
    assert_eq!(report.runs.len(), 5);
    let image = report.runs[3].image.expect("an image");
    assert!(image.flip_mean.is_some_and(|mean| mean < 0.05), "{image:?}");
    let page = std::fs::read_to_string(path.join("r.html")).expect("a page");
    assert!(page.contains("data:image/png"), "pictures are in the page");
    let spread = report.runs[0].spread["trace_ms"];
    assert!(spread.count == 1 && spread.min == spread.max && spread.q1 == spread.q3, "{spread:?}");

    let report =
        compared(path, "compare hard:E5 --systems hu,mmrt,brute-force hu.coverage=exact --rays 300 --check");
    let met = |run: usize| report.runs[run].hard.as_ref().and_then(|hard| hard.met);
    // A law over fragments gives no verdict.
    assert_eq!([met(0), met(1), met(2)], [None, Some(true), Some(true)]);
    assert_eq!(report.scene.name, "hard:E5");
}

/// Times of passes and host add up to the figures, also where a pass is dispatched often, the host builds,
/// and the number of repetitions is even.
#[test]
fn passes_add_up_to_the_figures_of_a_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "compare spheres:10k --systems bvh,grid bvh.builder=sah,lbvh --ray-set eye --rays 300 --size 16x9 --spp 1 \
                --image --repetitions 4 --report r.json";
    let output = rasray(folder.path(), line);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let report = std::fs::read(folder.path().join("r.json")).expect("a report");
    let report: Report = serde_json::from_slice(&report).expect("the schema");
    let (mut often, mut by_host) = (0, 0);
    for run in report.runs.iter().filter(|run| run.times.build_ms.is_some()) {
        let figures = [
            (PassOf::Build, run.times.build_ms),
            (PassOf::Trace, run.times.trace_ms.filter(|_| run.ray_set.is_some())),
            (PassOf::Image, run.times.image_ms),
        ];
        for (of, figure) in figures {
            let passes = || run.passes.iter().filter(|pass| pass.of == Some(of));
            let sum: f64 = passes().map(|pass| pass.ms_share.expect("measured")).sum();
            let figure = figure.unwrap_or(0.0);
            assert!(
                (sum - figure).abs() <= 1.0e-9 * figure,
                "{} {of:?}: {sum} of {figure}",
                run.contestant()
            );
            often += passes().filter(|pass| pass.dispatches > Some(1)).count();
        }
        // A stage is what its passes are, whichever figure they belong to.
        assert!(run.passes.iter().all(|pass| pass.stage.is_some()), "{}", run.contestant());
        let sum_of = |is_part: fn(&str) -> bool| -> f64 {
            run.stages.iter().filter(|time| is_part(&time.stage)).map(|time| time.ms).sum()
        };
        let rest = if run.ray_set.is_some() { run.times.trace_ms } else { run.times.image_ms };
        for (sum, figure) in [
            (sum_of(|stage| stage == "build"), run.times.build_ms),
            (sum_of(|stage| stage != "build"), rest),
            (sum_of(|stage| stage.starts_with("trace-")), run.times.trace_ms),
        ] {
            let figure = figure.expect("measured");
            assert!((sum - figure).abs() <= 1.0e-9 * figure, "{}: {sum} of {figure}", run.contestant());
        }
        let host = run.passes.iter().find(|pass| pass.label == Pass::HOST).expect("its own part");
        assert_eq!(Some(host.ms_median), run.times.build_host_ms);
        by_host += usize::from(host.ms_share > run.times.build_ms.map(|whole| 0.25 * whole));
    }
    assert!(often > 0 && by_host > 0, "{often} {by_host}");
}

/// A table fits the width that is asked for, and is whole where nobody asks.
#[test]
fn a_table_is_as_wide_as_columns_say() {
    let folder = tempfile::tempdir().expect("a folder");
    let told = |columns: Option<&str>| {
        let line =
            "compare cornell --systems brute-force --ray-set eye --rays 50 --size 16x9 --repetitions 1";
        let mut command = Command::new(env!("CARGO_BIN_EXE_rasray"));
        command.args(line.split_whitespace()).current_dir(folder.path()).env_remove("COLUMNS");
        columns.map(|columns| command.env("COLUMNS", columns));
        let output = command.output().expect("the command starts");
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    let widest = |text: &str| text.lines().map(|line| line.chars().count()).max().unwrap_or(0);
    let (whole, narrow) = (told(None), told(Some("80")));
    assert!(widest(&whole) > 120, "{whole}");
    assert!(widest(&narrow) <= 80, "{narrow}");
    for title in ["build ms", "Mrays/s", "missed", "wrong", "|dt|/t 99 %"] {
        assert!(whole.contains(title) && narrow.contains(title), "{title}: {narrow}");
    }
}

/// Rays through hundreds of thousands of triangles in one place need more rounds than rays are given at
/// first: in a batch, in an image and for what is stored beside its colours.
#[test]
fn a_ray_through_very_many_triangles_has_its_answer() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut scene = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\n".to_owned();
    scene += &"f 1 2 3\n".repeat(400_000);
    std::fs::write(path.join("many.obj"), scene).expect("a scene");
    let report = compared(path, "compare many.obj --systems bvh --ray-set camera --rays 16 --size 4x4");
    let unfinished = report.runs[0].counters.as_ref().and_then(|counters| counters.unfinished);
    assert_eq!((unfinished, accuracy(&report, 0).missed), (Some(0), 0));
    for system in ["bvh", "brute-force"] {
        let line = "render many.obj --integrator raycast --size 4x4 --spp 1 --aov depth";
        let output = rasray(path, &format!("{line} --system {system} --output {system}.exr"));
        assert_eq!(output.status.code(), Some(0), "{system}: {}", String::from_utf8_lossy(&output.stderr));
    }
    let image = |system| {
        let read = exr::prelude::read_all_flat_layers_from_file(path.join(format!("{system}.exr")));
        read.expect("an image").layer_data[0].channel_data.clone()
    };
    assert_eq!(image("bvh"), image("brute-force"));
}

/// Reports, pages and rays that do not fit are refused whole: what was there under their names stays.
#[cfg(target_os = "linux")]
#[test]
fn what_does_not_fit_on_the_disk_leaves_what_was_there() {
    for (option, name) in
        [("--report r.json", "r.json"), ("--html p.html", "p.html"), ("--save-rays .", "E1.rays")]
    {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join(name), b"old").expect("a file");
        let line = format!("compare hard:E1 --systems brute-force --repetitions 1 {option}");
        let mut shell = Command::new("bash");
        // Files of a block; the driver keeps none of its own.
        shell.args(["-c", "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_rasray")]);
        shell.args(line.split(' ')).current_dir(folder.path()).env("MESA_SHADER_CACHE_DISABLE", "1");
        // Newer software drivers take device memory from a file, which the limit holds for as well.
        shell.env_remove("VK_DRIVER_FILES").env_remove("VK_ICD_FILENAMES");
        let output = shell.output().expect("bash starts");
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(4), "{option}: {text}");
        assert!(text.contains(name) && text.contains("help: "), "{option}: {text}");
        // Where several files are asked for, those that fit are there and whole.
        let left = std::fs::read_dir(folder.path()).expect("the folder").flatten();
        let left: Vec<_> = left.map(|entry| entry.file_name().into_string().expect("a name")).collect();
        assert!(left.iter().all(|left| left == name || left == "E1.triangles.npy"), "{option}: {left:?}");
        assert_eq!(std::fs::read(folder.path().join(name)).expect("the file"), b"old", "{option}");
    }
}

/// Where nothing was said of addressing, a pool beyond one binding is reached by address; where descriptors
/// were asked for, it is refused with the pool and the fix.
#[test]
fn a_pool_beyond_a_binding_is_reached_by_address_unless_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let large = "compare cornell --systems dirt --ray-set incoherent --rays 300 dirt.storage=sb dirt.tile=1 \
                 dirt.resolution=1024 dirt.buckets=8";
    let refused = rasray(folder.path(), &format!("{large} dirt.addressing=descriptor --repetitions 1"));
    if refused.status.code() == Some(0) {
        return println!("skipped: one binding of this device holds 200 million bytes");
    }
    let said = String::from_utf8_lossy(&refused.stderr);
    assert!(refused.status.code() == Some(2) || refused.status.code() == Some(3), "{said}");
    assert!(said.contains("lists") && said.contains("address"), "{said}");
    let report = compared(folder.path(), large);
    let memory = report.runs[0].memory.as_ref().expect("bytes are counted");
    assert!(memory.by_part["lists"] > 128 << 20, "{:?}", memory.by_part);
    assert_eq!(report.runs[0].paths["addressing"], "address");
    let evaluated = accuracy(&report, 0);
    assert_eq!((evaluated.missed, evaluated.false_hits, evaluated.wrong_primitive), (0, 0, Some(0)));
}
