//! Results of the full tier as a report: a run for every row and case.

use rasray_ads::{Structure, StructureKind};
use rasray_experiment::device_record;
use rasray_report::{Accuracy, HardRecord, Origin, RateRecord, Report, Run, SceneRecord, Times};
use rasray_tests::conformance::{Measured, Prepared, Row};
use rasray_tests::harness::Bench;

/// The environment variable that names the file; without it nothing is written.
const FILE: &str = "RASRAY_CONFORMANCE_REPORT";

/// A row on a case, with what of the measurement breaks its demand.
pub fn run(
    row: &Row,
    structure: &dyn Structure,
    prepared: &Prepared,
    measured: &Measured,
    faults: &[String],
) -> Run {
    let case = &prepared.case;
    let target = match structure.description().kind {
        StructureKind::Primitive | StructureKind::LossyPrimitive => case.target.primitives,
        StructureKind::Fragment => case.target.fragments,
    };
    let limit = row.limit(case.id);
    let evaluated = measured.evaluated();
    let mut accuracy = Accuracy::from(&measured.confusion);
    let errors = RateRecord::of(evaluated).filter(|_| !row.is_exact());
    // The one rate that was evaluated, since there are a thousand runs; counts are next to it.
    accuracy.rates = errors.map(|errors| ("errors".to_owned(), errors)).into_iter().collect();
    let inadmissible = RateRecord::of(measured.inadmissible).filter(|_| !row.is_exact());
    accuracy.rates.extend(inadmissible.map(|rate| ("inadmissible".to_owned(), rate)));
    let reason = match faults {
        [] if row.is_exact() => format!("all {} answers are allowed; {limit}", case.rays.len()),
        [] => format!("{} of {} answers are wrong; {limit}", evaluated.count, evaluated.total),
        faults => faults.join("\n"),
    };
    let report = structure.report().expect("the header is readable");
    Run {
        system: row.system.to_owned(),
        structure: row.spec().structure().to_owned(),
        preset: row.preset.name().to_owned(),
        options: rasray_report::options(report.options),
        paths: report.paths.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
        ray_set: Some(case.id.to_owned()),
        seed: u32::try_from(case.scale.seed).ok(),
        times: Times { rays: Some(case.rays.len() as u64), ..Times::default() },
        accuracy: Some(accuracy),
        hard: Some(HardRecord {
            id: case.id.to_owned(),
            title: case.title.to_owned(),
            measure: case.measure.to_owned(),
            target: target.to_string(),
            triangles: case.triangles.len() as u64,
            met: Some(faults.is_empty()),
            reason,
            rejected: Some(measured.rejected.len() as u64),
            first_rejected: measured.rejected.first().map(|ray| *ray as u64),
            lost: Some(measured.lost as u64),
        }),
        ..Run::default()
    }
}

/// Writes the runs where the environment says so.
pub fn write(bench: &Bench, runs: Vec<Run>) {
    let Some(file) = std::env::var_os(FILE) else { return };
    let device = device_record(bench.device());
    let mut cases: Vec<_> = runs.iter().filter_map(|run| run.hard.as_ref()).collect();
    cases.sort_by(|a, b| (&a.id, a.triangles).cmp(&(&b.id, b.triangles)));
    cases.dedup_by(|a, b| (&a.id, a.triangles) == (&b.id, b.triangles));
    let triangles = cases.iter().map(|case| case.triangles).sum();
    let scene =
        SceneRecord { name: "hard:all".to_owned(), triangles, sha256: None, ..SceneRecord::default() };
    let origin = Origin {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: commit(),
        command: Some(format!(
            "RASRAY_FULL=1 {FILE}=FILE cargo test -p rasray-tests --test all -- conformance::rows::"
        )),
    };
    let report = Report::new(origin, device, scene, runs);
    std::fs::write(&file, report.to_json())
        .unwrap_or_else(|error| panic!("{FILE}={} cannot be written: {error}", file.display()));
}

/// The commit that is checked out, where git knows it, and whether files differ from it.
fn commit() -> Option<String> {
    let git = std::process::Command::new("git")
        .args(["describe", "--always", "--abbrev=12", "--dirty"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .ok()?;
    let text = String::from_utf8(git.stdout).ok()?;
    (git.status.success() && !text.trim().is_empty()).then(|| text.trim().to_owned())
}
