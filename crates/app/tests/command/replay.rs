//! `rasray compare … --replay INDEX` on a device: both sides of one ray.

use std::process::{Command, Output};

fn rasray(line: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rasray")).args(line.split(' ')).output().expect("the command starts")
}

#[test]
fn a_replay_shows_every_system_and_the_oracle() {
    let line = "compare cornell --systems mmrt,brute-force --ray-set incoherent --resolution 32 --replay 3";
    let output = rasray(line);
    let (text, complaints) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{complaints}");
    let places = [
        "ray 3 of incoherent",
        "mmrt robust",
        "cells that the ray truly crosses",
        "brute-force robust",
        "oracle: ",
    ]
    .map(|part| text.find(part).unwrap_or_else(|| panic!("no `{part}` in:\n{text}")));
    assert!(places.is_sorted(), "{text}");
    // Brute force and the oracle name the same triangle, and the log shows its test.
    let answer = |part: &str| {
        let after = &text[text.find(part).expect("checked above")..];
        let hit = after.lines().find(|line| line.starts_with("hit: triangle ") || line.starts_with("miss"));
        hit.map(|line| line.split(',').next().unwrap_or_default().to_owned())
    };
    assert!(answer("oracle: ").is_some_and(|hit| hit.starts_with("hit")), "{text}");
    assert_eq!(answer("brute-force robust"), answer("oracle: "), "{text}");
    assert!(text.contains(": accepted, t ") && text.contains("edges "), "{text}");
}

#[test]
fn a_ray_that_is_not_in_the_set_is_refused() {
    let output = rasray("compare cornell --systems brute-force --ray-set eye --rays 5 --replay 5");
    let complaints = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{complaints}");
    assert!(complaints.contains("no ray 5 in eye, which has 5"), "{complaints}");
}

#[test]
fn a_ray_of_a_hard_case_is_replayed() {
    let output = rasray("compare hard:E1 --systems brute-force --rays 5 --replay 2");
    let text = String::from_utf8_lossy(&output.stdout);
    let complaints = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{complaints}");
    assert!(text.starts_with("ray 2 of E1") && text.contains("oracle: "), "{text}");
}

#[test]
fn a_hard_case_that_is_a_file_has_no_ray_to_replay() {
    let id = rasray_hard_cases::file_ids()[0];
    let output = rasray(&format!("compare hard:{id} --systems brute-force --replay 0"));
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(error.contains(&format!("hard:{id} is a file and has no rays")), "{error}");
}
