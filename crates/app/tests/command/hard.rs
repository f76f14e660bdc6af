//! The built command on the hard cases: what it makes of their triangles is what they are, to the last bit,
//! for all of them in one run.

use rasray_report::Report;
use std::process::Command;

/// The report of a comparison that must hold what the cases demand.
fn held(line: &str) -> Report {
    let folder = tempfile::tempdir().expect("a folder");
    let output = Command::new(env!("CARGO_BIN_EXE_rasray"))
        .args(line.split_whitespace())
        .args(["--repetitions", "1", "--check", "--report", "r.json"])
        .current_dir(folder.path())
        .output()
        .expect("the command starts");
    assert_eq!(output.status.code(), Some(0), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&std::fs::read(folder.path().join("r.json")).expect("a report"))
        .expect("the schema")
}

#[test]
fn every_hard_case_is_run_and_held() {
    // Files that readers refuse are cases too.
    let cases = rasray_hard_cases::ids().len() + rasray_hard_cases::file_ids().len();
    // Brute force is the one system of triangles that builds nothing; the full tier builds lists of every
    // case.
    let is_full = std::env::var_os("RASRAY_FULL").is_some_and(|value| value == "1");
    let system = if is_full { "dirt" } else { "brute-force" };
    let report = held(&format!("compare hard:all --systems {system} --rays 3"));
    assert_eq!(report.runs.len(), cases);
}

/// Among its corners are -0.0 and 1e-40, which arithmetic would round or turn.
#[test]
fn triangles_of_a_case_keep_their_bits_for_every_structure_of_triangles() {
    let report = held("compare hard:C5 --systems dirt,bvh,brute-force --rays 200");
    assert_eq!(report.runs.len(), 3);
}
