//! Comparisons whose runs are lines of a file: stopped, resumed, divided and merged, they are the report of
//! one process.

use std::path::Path;
use std::time::{Duration, Instant};

use rasray_report::{Report, Run};

use crate::scripted::{command, done, entries, rasray, read, scripted, stderr};

/// Three sets of rays by two systems.
const SIX: &str = "compare cornell --systems mmrt,bvh --ray-set incoherent,camera,eye";

/// A report, or each line of one; without the command line, which says where it was written.
fn reports(folder: &Path, name: &str) -> Vec<Report> {
    let text = read(folder, name);
    let report = |text: &str| Report { command: None, ..serde_json::from_str(text).expect("a report") };
    if name.ends_with(".jsonl") { text.lines().map(report).collect() } else { vec![report(&text)] }
}

#[test]
fn a_comparison_goes_on_behind_any_line_also_a_torn_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    done(folder, &format!("{SIX} --report whole.jsonl"));
    done(folder, &format!("{SIX} --report whole.json"));
    let whole = reports(folder, "whole.jsonl");
    let places: Vec<_> = whole.iter().filter_map(|line| line.cell.as_ref()).map(|cell| cell.place).collect();
    assert_eq!(places, [0, 1, 2, 3, 4, 5]);
    let text = read(folder, "whole.jsonl");
    let ends: Vec<_> = text.match_indices('\n').map(|(end, _)| end + 1).collect();
    for (number, torn) in [(0, 0), (0, 100), (1, 0), (2, 1), (3, 700), (5, 300), (6, 0)] {
        let start = if number == 0 { 0 } else { ends[number - 1] };
        std::fs::write(folder.join("part.jsonl"), &text[..start + torn]).expect("a file");
        let said = done(folder, &format!("{SIX} --report part.jsonl --resume"));
        assert_eq!(said.contains("torn-line"), torn > 0, "{said}");
        let told = format!("{number} of 6 runs are there already, {} are made", 6 - number);
        assert_eq!(said.contains(&told), number > 0, "{said}");
        assert!(said.contains("part.jsonl holds 6 of 6 cells"), "{said}");
        assert_eq!(reports(folder, "part.jsonl"), whole, "{number} lines and {torn} bytes");
    }
    done(folder, "merge merged.json part.jsonl");
    assert_eq!(reports(folder, "merged.json"), reports(folder, "whole.json"));
    done(folder, "merge merged.jsonl part.jsonl whole.jsonl");
    assert_eq!(reports(folder, "merged.jsonl"), whole, "each cell once");
    for (name, words) in [("merged.html", "<html"), ("merged.md", "| ")] {
        done(folder, &format!("merge {name} part.jsonl"));
        assert!(read(folder, name).contains(words), "{name}");
    }
    // Without --resume all is made anew.
    assert!(!done(folder, &format!("{SIX} --report part.jsonl")).contains("there already"));
}

#[test]
fn what_a_kill_leaves_is_whole_and_is_resumed() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    done(folder, &format!("{SIX} --report whole.jsonl"));
    let mut killed = command(folder, &format!("{SIX} --report part.jsonl --resume --device slow"))
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .expect("the command starts");
    let started = Instant::now();
    let lines = || std::fs::read_to_string(folder.join("part.jsonl")).unwrap_or_default().lines().count();
    while lines() < 2 {
        assert!(started.elapsed() < Duration::from_secs(60), "no line");
        std::thread::sleep(Duration::from_millis(5));
    }
    let other = scripted(folder, &format!("{SIX} --report part.jsonl --resume"));
    assert!(stderr(&other).contains("part.jsonl: is being written by another command"), "{}", stderr(&other));
    assert_eq!(other.status.code(), Some(2));
    killed.kill().expect("it runs");
    killed.wait().expect("it ends");
    assert!((2..6).contains(&lines()), "{} lines", lines());
    done(folder, &format!("{SIX} --report part.jsonl --resume"));
    assert_eq!(reports(folder, "part.jsonl"), reports(folder, "whole.jsonl"));
}

#[test]
fn three_shares_are_the_report_of_one_process() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    for (line, cells) in [(SIX, 2), ("compare hard:all --systems mmrt,bvh --rays 3", 20)] {
        done(folder, &format!("{line} --report whole.json"));
        for share in 1..=3 {
            done(folder, &format!("{line} --report {share}.jsonl --shard {share}/3"));
            assert!(reports(folder, &format!("{share}.jsonl")).len() >= cells);
        }
        let sets = |name: &str| -> Vec<_> {
            reports(folder, name).iter().map(|line| line.runs[0].ray_set.clone()).collect()
        };
        assert_eq!(sets("1.jsonl")[0], sets("1.jsonl")[1], "the systems of a set take turns");
        done(folder, "merge merged.json 3.jsonl 1.jsonl 2.jsonl");
        assert_eq!(reports(folder, "merged.json"), reports(folder, "whole.json"), "{line}");
        let output = scripted(folder, "merge few.json 3.jsonl 1.jsonl");
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains("3.jsonl: is of a comparison of"), "{}", stderr(&output));
        // A process that has two shares makes what is missing.
        done(folder, &format!("{line} --report 1.jsonl --shard 2/3 --resume"));
        done(folder, "merge merged.json 3.jsonl 1.jsonl");
        assert_eq!(reports(folder, "merged.json"), reports(folder, "whole.json"), "{line}");
    }
}

#[test]
fn lines_of_something_else_are_refused_by_the_name_of_their_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    done(folder, &format!("{SIX} --report a.jsonl"));
    let text = read(folder, "a.jsonl");
    let version = format!("\"version\":\"{}\"", env!("CARGO_PKG_VERSION"));
    let write = |name: &str, text: String| std::fs::write(folder.join(name), text).expect("a file");
    assert!(text.contains(&version));
    write("program.jsonl", text.replacen(&version, "\"version\":\"0.0.9\"", 1));
    write("device.jsonl", text.replacen("\"name\":\"scripted\"", "\"name\":\"another\"", 1));
    write("key.jsonl", text.replacen("\"place\":0", "\"place\":1", 1));
    write("cut.jsonl", text.replacen('\n', "\n{\"schema\":\n", 1));
    write(
        "frame.jsonl",
        format!(
            "{}\n",
            read(folder, "a.jsonl").lines().next().expect("a line").replace("\"cell\":", "\"cells\":")
        ),
    );
    write("empty.jsonl", String::new());
    let before = entries(folder);
    let resumed = |options: &str| format!("{SIX} --resume --report {options}");
    for (line, says) in [
        (resumed("a.jsonl --seed 2"), "a.jsonl: line 1: is of another comparison, made by: rasray compare"),
        (resumed("a.jsonl --rays 7"), "a.jsonl: line 1: is of another comparison"),
        (resumed("a.jsonl mmrt.buckets=4"), "a.jsonl: line 1: is of another comparison"),
        (resumed("program.jsonl"), "program.jsonl: line 1: was made by rasray 0.0.9"),
        (
            resumed("device.jsonl"),
            "device.jsonl: line 1: was measured on another (none 1), and not on scripted",
        ),
        (resumed("key.jsonl"), "key.jsonl: line 1: is of a cell that its comparison does not have"),
        (resumed("cut.jsonl"), "cut.jsonl: line 2: is not a report"),
        (resumed("frame.jsonl"), "frame.jsonl: line 1: is not a report"),
        (resumed("r.json"), "--resume is of a report with a line per run"),
        (format!("{SIX} --report r.json --shard 1/2"), "--shard is of a report with a line per run"),
        (format!("{SIX} --report r.jsonl --shard 4/4"), "--shard 4/4 has none of 3 sets"),
        (format!("{SIX} --resume"), "--report"),
        ("merge o.json a.jsonl program.jsonl".to_owned(), "program.jsonl: line 1: was made by"),
        ("merge o.jsonl a.jsonl device.jsonl".to_owned(), "device.jsonl: line 1: was measured on"),
        ("merge o.json a.jsonl key.jsonl".to_owned(), "key.jsonl: line 1: is of a cell"),
        ("merge o.json a.jsonl cut.jsonl".to_owned(), "cut.jsonl: line 2: is not a report"),
        ("merge o.json a.jsonl absent.jsonl".to_owned(), "absent.jsonl: there is no such file"),
        ("merge o.json empty.jsonl".to_owned(), "empty.jsonl: holds no cell"),
        ("merge a.jsonl a.jsonl".to_owned(), "a.jsonl: is a part and the result"),
        ("merge o.json a.jsonl --exposure 1".to_owned(), "--exposure"),
    ] {
        let output = scripted(folder, &line);
        assert_eq!(output.status.code(), Some(2), "{line}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{line}: {}", stderr(&output));
        assert_eq!(entries(folder), before, "{line}");
    }
    // A run that is not whole gets no line.
    let output = scripted(folder, &format!("{SIX} --report b.jsonl --device unfinished"));
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(!folder.join("b.jsonl").exists());
}

/// On a device: all but times and what the process held is the same.
#[test]
fn shares_on_a_device_say_what_one_process_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let line = "compare cornell --systems bvh,brute-force --ray-set incoherent,bounce --rays 300 --repetitions 1 \
                --image --size 8x6 --spp 1 --report";
    let run = |line: &str| {
        let output = rasray(folder, line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
    };
    run(&format!("{line} whole.json"));
    run(&format!("{line} 1.jsonl --shard 1/2"));
    run(&format!("{line} 2.jsonl --shard 2/2"));
    run("merge merged.json 2.jsonl 1.jsonl");
    let comparable = |name: &str| -> Report {
        let mut report = reports(folder, name).swap_remove(0);
        for Run { times, spread, stages, passes, memory, .. } in &mut report.runs {
            *times = rasray_report::Times { rays: times.rays, timer: times.timer, ..Default::default() };
            spread.clear();
            stages.clear();
            passes.clear();
            memory.iter_mut().for_each(|memory| memory.device_peak_bytes = None);
        }
        report
    };
    let (whole, merged) = (comparable("whole.json"), comparable("merged.json"));
    assert_eq!(merged.runs.len(), 7, "two sets and images of two systems, and noise");
    for (merged, whole) in merged.runs.iter().zip(&whole.runs) {
        assert_eq!(merged, whole);
    }
    assert!(merged == whole, "what the runs have in common");
    assert!(merged.runs.iter().filter_map(|run| run.accuracy.as_ref()).all(|accuracy| accuracy.missed == 0));
}
