//! SIGINT, SIGTERM and SIGHUP: one makes a valid partial image, two leave nothing.
#![cfg(unix)]

use crate::scripted::{READY, command, entries, stderr};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Output, Stdio};
use std::time::{Duration, Instant};

/// Sends signals, one right behind the other. Two of a kind would arrive as one.
fn send(child: &Child, signals: &[&str]) {
    let kills: Vec<_> = signals.iter().map(|signal| format!("kill -{signal} {}", child.id())).collect();
    let status =
        std::process::Command::new("bash").args(["-c", &kills.join(" && ")]).status().expect("bash starts");
    assert!(status.success());
}

/// Starts the command, sends signals once it renders, and waits for its end.
fn interrupted(folder: &Path, line: &str, signals: &[&str]) -> Output {
    let elsewhere = tempfile::tempdir().expect("a folder");
    let ready = elsewhere.path().join("ready");
    let mut child = command(folder, line)
        .env(READY, &ready)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    wait_until("the command does not begin", &mut child, |_| ready.exists());
    // Some samples shall be whole.
    std::thread::sleep(Duration::from_millis(150));
    send(&child, signals);
    wait_until("the command does not stop", &mut child, |child| child.try_wait().expect("a child").is_some());
    child.wait_with_output().expect("its output")
}

fn wait_until(otherwise: &str, child: &mut Child, mut done: impl FnMut(&mut Child) -> bool) {
    let start = Instant::now();
    while !done(child) {
        if start.elapsed() > Duration::from_secs(20) {
            child.kill().expect("a child that runs");
            panic!("{otherwise}");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn one_signal_makes_a_valid_image_of_the_samples_so_far() {
    for signal in ["INT", "TERM", "HUP"] {
        let folder = tempfile::tempdir().expect("a folder");
        let line = "render cornell --size 8x8 --spp 100000 --device slow -o a.exr --report r.json";
        let output = interrupted(folder.path(), line, &[signal]);
        let text = stderr(&output);
        assert_eq!(output.status.code(), Some(130), "{text}");
        assert_eq!(entries(folder.path()), ["a.exr", "r.json"]);
        let image =
            exr::prelude::read_all_flat_layers_from_file(folder.path().join("a.exr")).expect("an image");
        let samples = match image.layer_data[0].attributes.other.get(&exr::prelude::Text::from("samples")) {
            Some(exr::prelude::AttributeValue::I32(samples)) => *samples,
            other => panic!("{other:?}"),
        };
        assert!(samples > 0 && samples < 100_000);
        assert!(text.contains(&format!("stopped after {samples} of 100000 samples")), "{text}");
    }
}

/// A build, a compiler or a first wave that takes long is not waited for.
#[test]
fn one_signal_ends_within_two_seconds_where_nothing_is_finished() {
    for signal in ["INT", "TERM", "HUP"] {
        let folder = tempfile::tempdir().expect("a folder");
        let started = Instant::now();
        let line = "render cornell --size 8x8 --device stuck -o a.exr --report r.json";
        let output = interrupted(folder.path(), line, &[signal]);
        assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
        assert!(started.elapsed() < Duration::from_secs(15), "{:?}", started.elapsed());
        assert!(stderr(&output).contains("nothing was written"), "{}", stderr(&output));
        assert!(entries(folder.path()).is_empty(), "{:?}", entries(folder.path()));
    }
}

/// Nor is whoever reads what is said: a full pipe that nobody empties does not keep the command.
#[test]
fn one_signal_ends_within_two_seconds_where_nobody_reads_what_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let ready = folder.path().join("ready");
    let (unread, stderr) = std::io::pipe().expect("a pipe");
    let mut filler = stderr.try_clone().expect("a pipe");
    // Ends when nobody can read any more.
    let filling =
        std::thread::spawn(move || while std::io::Write::write_all(&mut filler, &[b'.'; 4096]).is_ok() {});
    std::thread::sleep(Duration::from_millis(200));
    let mut child = command(folder.path(), "render cornell --size 8x8 --device stuck -o a.png")
        .env(READY, &ready)
        .stdout(Stdio::null())
        .stderr(stderr)
        .spawn()
        .expect("the command starts");
    wait_until("the command does not begin", &mut child, |_| ready.exists());
    let started = Instant::now();
    send(&child, &["TERM"]);
    wait_until("the command does not stop", &mut child, |child| child.try_wait().expect("a child").is_some());
    // Two seconds, and what a busy machine may add.
    assert!(started.elapsed() < Duration::from_secs(8), "{:?}", started.elapsed());
    assert_eq!(child.wait().expect("its end").code(), Some(130));
    assert_eq!(entries(folder.path()), ["ready"]);
    drop(unread);
    filling.join().expect("the filler ends");
}

/// Reading a large scene and looking for its default view are not waited for either.
#[test]
fn one_signal_ends_within_two_seconds_while_a_scene_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    // A grid of half a million triangles.
    let mut scene = String::new();
    for place in 0..512 * 512 {
        scene += &format!("v {} {} {}\n", place % 512, (place * 7919) % 97, place / 512);
    }
    for corner in (1..=511 * 512).filter(|corner| corner % 512 != 0) {
        scene += &format!("f {corner} {} {} {}\n", corner + 1, corner + 513, corner + 512);
    }
    std::fs::write(folder.path().join("grid.obj"), scene).expect("a scene");
    let mut child = command(folder.path(), "render grid.obj --size 8x8 --device stuck -o a.png")
        // The first thing that is said, once signals are handled.
        .env("RASRAY_LOG", "[")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut said = BufReader::new(child.stderr.take().expect("piped"));
    let mut line = String::new();
    said.read_line(&mut line).expect("a line");
    assert!(line.contains("RASRAY_LOG"), "{line}");
    let started = Instant::now();
    send(&child, &["INT"]);
    wait_until("the command does not stop", &mut child, |child| child.try_wait().expect("a child").is_some());
    // Two seconds, and what a busy machine may add.
    assert!(started.elapsed() < Duration::from_secs(8), "{:?}", started.elapsed());
    std::io::Read::read_to_string(&mut said, &mut line).expect("text");
    assert_eq!(child.wait().expect("its end").code(), Some(130), "{line}");
    assert!(
        line.contains("stopping; nothing is finished yet") && line.contains("nothing was written"),
        "{line}"
    );
    assert_eq!(entries(folder.path()), ["grid.obj"]);
}

#[test]
fn two_signals_leave_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "compare cornell --systems mmrt,brute-force --device slow --report r.json";
    let output = interrupted(folder.path(), line, &["INT", "TERM"]);
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(entries(folder.path()).is_empty(), "{:?}", entries(folder.path()));
}

#[test]
fn one_signal_keeps_the_finished_runs_of_a_comparison() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "compare cornell --systems mmrt,brute-force --presets robust,published \
                --ray-set incoherent,camera,eye,bounce --device slow --report r.json";
    let output = interrupted(folder.path(), line, &["INT"]);
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(stderr(&output).contains("of 12 runs"), "{}", stderr(&output));
    assert_eq!(entries(folder.path()), ["r.json"]);
}

#[test]
fn one_signal_keeps_the_hard_cases_that_were_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "compare hard:all --systems mmrt --rays 3 --device slow --report r.json";
    let output = interrupted(folder.path(), line, &["INT"]);
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(130), "{text}");
    assert!(text.contains("stopped after 1 of ") && text.contains("the report holds them"), "{text}");
    let report = std::fs::read(folder.path().join("r.json")).expect("a report");
    let report: rasray_report::Report = serde_json::from_slice(&report).expect("the schema");
    let ids: Vec<_> = report.runs.iter().filter_map(|run| run.ray_set.as_deref()).collect();
    assert_eq!(ids, ["G1"]);
}

/// A terminal that goes away sends SIGHUP, and so does its shell: what is finished is written all the same.
#[test]
fn hanging_up_twice_is_hanging_up_once() {
    for signals in [["HUP", "HUP"], ["TERM", "HUP"]] {
        let folder = tempfile::tempdir().expect("a folder");
        let line = "render cornell --size 8x8 --spp 100000 --device slow -o a.exr";
        let mut child = command(folder.path(), line)
            .env(READY, folder.path().join("ready"))
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command starts");
        wait_until("the command does not begin", &mut child, |_| folder.path().join("ready").exists());
        std::thread::sleep(Duration::from_millis(150));
        for signal in signals {
            send(&child, &[signal]);
            std::thread::sleep(Duration::from_millis(5));
        }
        wait_until("the command does not stop", &mut child, |child| {
            child.try_wait().expect("a child").is_some()
        });
        let output = child.wait_with_output().expect("its output");
        assert_eq!(output.status.code(), Some(130), "{signals:?}: {}", stderr(&output));
        assert_eq!(entries(folder.path()), ["a.exr", "ready"], "{signals:?}: {}", stderr(&output));
    }
}

/// As under nohup: it was asked not to listen.
#[test]
fn hanging_up_is_ignored_where_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let ready = folder.path().join("ready");
    let inner = command(folder.path(), "render cornell --size 8x8 --spp 60 --device slow -o a.png");
    let mut outer = std::process::Command::new("bash");
    outer.args(["-c", "trap '' HUP; exec \"$0\" \"$@\""]).arg(inner.get_program()).args(inner.get_args());
    for (name, value) in inner.get_envs() {
        outer.env(name, value.expect("set"));
    }
    let mut child = outer
        .env(READY, &ready)
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("bash starts");
    wait_until("the command does not begin", &mut child, |_| ready.exists());
    send(&child, &["HUP"]);
    wait_until("the command does not end", &mut child, |child| child.try_wait().expect("a child").is_some());
    let output = child.wait_with_output().expect("its output");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(entries(folder.path()), ["a.png", "ready"]);
}
