//! Text of a report for people.

use crate::run_text::{heading, run_text, verdict};
use crate::{
    HardRecord, Report, Run, Statistics, bytes, columns, columns_within, duration, grouped, in_line, wrapped,
};
use std::fmt::Write;

/// Writes one row per run: speed next to error.
fn summary(runs: &[Run], width: Option<usize>) -> String {
    let dash = || "-".to_owned();
    let titles = [
        "run",
        "build ms",
        "trace ms",
        "Mrays/s",
        "memory",
        "missed",
        "false",
        "wrong",
        "lost",
        "|dt|/t 99 %",
        "FLIP",
    ];
    let hard = runs.iter().any(|run| run.hard.is_some());
    let mut rows: Vec<Vec<String>> = vec![titles.map(str::to_owned).to_vec()];
    rows[0].extend(hard.then(|| "target".to_owned()));
    for run in runs {
        let number = |value: Option<f64>| value.map_or_else(dash, |value| format!("{value:.3}"));
        let accuracy = run.accuracy.as_ref();
        // A share is shown with the upper end of its interval, which the count alone does not exclude.
        let share = |name: &str, count: Option<u64>| {
            let Some(count) = count else { return dash() };
            let rate = accuracy.and_then(|accuracy| accuracy.rates.get(name));
            rate.map_or_else(
                || grouped(count),
                |rate| format!("{} (<{:.2}%)", grouped(count), 100.0 * rate.interval[1]),
            )
        };
        let what = run.ray_set.as_deref().or(run.integrator.as_deref()).unwrap_or("");
        let dt = accuracy.and_then(|accuracy| accuracy.dt_rel_p99);
        let mut row = vec![
            format!("{} {what}", run.contestant()).trim_end().to_owned(),
            number(run.times.build_ms),
            number(run.times.trace_ms),
            number(run.times.mrays_per_s),
            run.memory.as_ref().and_then(|memory| memory.structure_bytes).map_or_else(dash, bytes),
            share("missed", accuracy.map(|accuracy| accuracy.missed)),
            share("false_hits", accuracy.map(|accuracy| accuracy.false_hits)),
            share("wrong_primitive", accuracy.and_then(|accuracy| accuracy.wrong_primitive)),
            accuracy.map_or_else(dash, |accuracy| grouped(accuracy.ambiguous_lost)),
            dt.map_or_else(dash, |dt| format!("{dt:.1e}")),
            number(run.image.and_then(|image| image.flip_mean)),
        ];
        let met = |hard: &HardRecord| match hard.met {
            Some(true) => "met",
            Some(false) => "NOT MET",
            None => "-",
        };
        row.extend(hard.then(|| run.hard.as_ref().map_or("-", met).to_owned()));
        rows.push(row);
    }
    width.map_or_else(|| columns(&rows, 1), |width| columns_within(&rows, 1, width))
}

/// Writes the note on the confidence of the rates, one by one and together.
fn certainty(statistics: &Statistics) -> String {
    format!(
        "<: upper end of the interval; intervals hold with {} % each (Clopper-Pearson; 3/N where nothing or everything happened); for all {} rates \
         to hold with {} % together each needs {:.4} % (family_interval in the report)\n",
        100.0 * statistics.confidence,
        grouped(statistics.rates),
        100.0 * statistics.family_confidence,
        100.0 * statistics.confidence_of_each
    )
}

/// Largest number of runs that are each printed in full; more runs are easier to read in a file.
const RUNS_IN_FULL: usize = 24;

/// Writes the report for people: the device, the scene, and the words of the `camera` from which it was seen;
/// then the results of the runs in short or, with `full`, every number of each run unless there are very many
/// runs; and with several runs one line for each, for comparison.
pub fn table(report: &Report, camera: Option<&str>, full: bool) -> String {
    table_within(report, camera, full, None)
}

/// Writes [`table()`] in lines of at most `width` characters, where a width is given. Columns that do not fit
/// follow below in further blocks. Longer lines are broken between words, except the camera's line, which is
/// meant to be copied.
pub fn table_within(report: &Report, camera: Option<&str>, full: bool, width: Option<usize>) -> String {
    let whole = unbroken(report, camera, full, width);
    let Some(width) = width else { return whole };
    let fit = |line: &str| {
        let label = line.starts_with("device ")
            || ["scene  ", "image  ", "system "].iter().any(|label| line.starts_with(label));
        let is_camera = line.starts_with("camera ");
        if is_camera {
            format!("{line}\n")
        } else {
            wrapped(&format!("{line}\n"), width, if label { 7 } else { 4 })
        }
    };
    whole.lines().map(fit).collect()
}

fn unbroken(report: &Report, camera: Option<&str>, full: bool, width: Option<usize>) -> String {
    let device = &report.device;
    let note = if device.software { "; times of software devices are for ratios on that device" } else { "" };
    let mut text = format!("device {} ({}){note}\n", device.full_name(), device.driver);
    _ = writeln!(
        text,
        "scene  {}, {} triangles",
        in_line(&report.scene.name),
        grouped(report.scene.triangles)
    );
    for image in report.scene.smaller_images.iter().filter(|_| full) {
        let ([width, height], [from_width, from_height]) = (image.to, image.from);
        _ = writeln!(
            text,
            "image  {} as {width}x{height}, not {from_width}x{from_height}",
            in_line(&image.name)
        );
    }
    if let Some(camera) = camera {
        _ = writeln!(text, "camera {}", in_line(camera));
    }
    // Only reports of a chosen system have a reason; comparisons are told what to compare.
    if let [Run { system, chosen: Some(reason), .. }, ..] = report.runs.as_slice() {
        _ = writeln!(text, "system {system}: {reason}");
    }
    match report.runs.as_slice() {
        [run] if !full && run.accuracy.is_none() && run.hard.is_none() => text += &in_short(run),
        runs => {
            if full && runs.len() <= RUNS_IN_FULL {
                for run in runs {
                    text.push('\n');
                    text += &run_text(run);
                }
            }
            if !full || runs.len() > 1 {
                text.push('\n');
                text += &summary(runs, width);
            }
            if !full {
                text += &verdicts(runs);
            }
            if !full || runs.len() > RUNS_IN_FULL {
                text += "each of the runs in full: --verbose, --report or --html\n";
            }
        }
    }
    if let Some(statistics) = &report.statistics {
        text += &certainty(statistics);
    }
    text
}

/// Writes a run and its times in two lines.
fn in_short(run: &Run) -> String {
    let times = &run.times;
    let took = |name: &str, value: Option<f64>| value.map(|value| format!("{name} {}", duration(value)));
    let parts = [
        took("first build", times.first_build_ms),
        took("build", times.build_ms),
        took("trace", times.trace_ms),
        took("frame", times.frame_ms),
        times.rays.map(|rays| format!("{} rays", grouped(rays))),
        run.memory
            .as_ref()
            .and_then(|memory| memory.structure_bytes)
            .map(|size| format!("structure {}", bytes(size))),
    ];
    let parts: Vec<_> = parts.into_iter().flatten().collect();
    format!("image  {}\n       {}\n", heading(run), parts.join(", "))
}

/// Writes a line for each verdict on a hard case.
fn verdicts(runs: &[Run]) -> String {
    let rows: Vec<_> = runs
        .iter()
        .filter_map(|run| {
            let hard = run.hard.as_ref()?;
            Some(vec![hard.id.clone(), run.contestant(), verdict(hard).to_owned(), hard.reason.clone()])
        })
        .collect();
    columns(&rows, 4)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Accuracy, Device, Origin, RateRecord, SceneRecord, Spread, Times};
    use rasray_metrics::Rate;

    #[test]
    fn several_runs_get_a_line_each_and_what_is_missing_a_dash() {
        let run = |system: &str, accuracy| Run {
            system: system.to_owned(),
            preset: "robust".to_owned(),
            ray_set: Some("eye".to_owned()),
            times: Times { trace_ms: Some(1.5), ..Default::default() },
            accuracy,
            ..Default::default()
        };
        let accuracy = Accuracy { rays: 1000, missed: 1, ..Default::default() };
        let device = Device { name: "d".to_owned(), driver: "e".to_owned(), software: true, processor: None };
        let scene =
            SceneRecord { name: "box".to_owned(), triangles: 12_000, sha256: None, ..SceneRecord::default() };
        let runs = vec![run("mmrt", Some(accuracy)), run("brute-force", None)];
        let text = table(&Report::new(Origin::default(), device, scene, runs), None, true);
        assert!(text.contains("12,000 triangles") && text.contains("ratios on that device"), "{text}");
        assert!(text.contains("1 (0.1000 %)"), "{text}");
        let last = text.lines().last().expect("a summary");
        assert!(last.contains("brute-force robust eye") && last.trim_end().ends_with('-'), "{last}");
    }

    /// Checks that every cell of a table is shown once, however narrow a terminal is.
    #[test]
    fn a_table_fits_its_terminal() {
        let rate = RateRecord::of(Rate { count: 812, total: 199_000 }).expect("something was tried");
        let accuracy =
            Accuracy { missed: 812, rates: [("missed".to_owned(), rate)].into(), ..Default::default() };
        let hard = HardRecord { met: Some(true), reason: "many words ".repeat(20), ..Default::default() };
        let run = Run {
            system: "selective".to_owned(),
            preset: "published".to_owned(),
            ray_set: Some("incoherent".to_owned()),
            times: Times { trace_ms: Some(12_345.678), build_ms: Some(987.5), ..Default::default() },
            accuracy: Some(accuracy),
            hard: Some(hard),
            ..Default::default()
        };
        let name = "llvmpipe (LLVM 15.0.6, 128 bits)".to_owned();
        let device = Device { name, driver: "Mesa 25.0.7".to_owned(), software: true, processor: None };
        let report = Report::new(Origin::default(), device, SceneRecord::default(), vec![run.clone(), run]);
        let whole = table(&report, None, false);
        assert!(whole.lines().any(|line| line.chars().count() > 132));
        for width in [60, 80, 100, 132] {
            let text = table_within(&report, None, false, Some(width));
            for line in text.lines() {
                assert!(line.chars().count() <= width, "{width}: {line}");
            }
            for title in ["build ms", "12345.678", "missed", "812 (<", "FLIP", "target"] {
                assert_eq!(
                    text.matches(title).count(),
                    whole.matches(title).count(),
                    "{width}, {title}: {text}"
                );
            }
        }
        assert_eq!(table_within(&report, None, false, Some(1000)), whole);
    }

    #[test]
    fn rates_and_times_come_with_how_sure_they_are() {
        let rate = |count, total| RateRecord::of(Rate { count, total }).expect("something was tried");
        let rates = [("missed", rate(0, 1000)), ("false_hits", rate(2, 50))];
        let accuracy = Accuracy {
            rays: 1100,
            false_hits: 2,
            rates: rates.map(|(name, rate)| (name.to_owned(), rate)).into(),
            ..Default::default()
        };
        let spread = Spread { count: 5, min: 1.0, q1: 1.25, q3: 2.0, max: 9.0 };
        let hard = HardRecord {
            id: "E5".to_owned(),
            met: Some(false),
            reason: "because".to_owned(),
            ..Default::default()
        };
        let run = Run {
            times: Times { trace_ms: Some(1.5), ..Default::default() },
            spread: [("trace_ms".to_owned(), spread)].into(),
            seed: Some(7),
            accuracy: Some(accuracy),
            hard: Some(hard),
            ..Default::default()
        };
        let scene =
            SceneRecord { name: "box".to_owned(), triangles: 12, sha256: None, ..SceneRecord::default() };
        let report = Report::new(Origin::default(), Device::default(), scene, vec![run.clone(), run]);
        let text = table(&report, None, true);
        for words in [
            "at most 0.2996 %",
            "2 (4.0000 %)",
            "0.4881 to 13.7138 %",
            "1.500 ms  (1.000 [1.250 to 2.000] 9.000)",
            "seed 7",
            "NOT MET: because",
            "all 4 rates to hold with 95 %",
        ] {
            assert!(text.contains(words), "{words}: {text}");
        }
        assert!(text.lines().any(|line| line.trim_end().ends_with("NOT MET")), "{text}");
        // Very many runs have one line each and nothing more.
        let many = vec![report.runs[0].clone(); RUNS_IN_FULL + 1];
        let text =
            table(&Report::new(Origin::default(), Device::default(), report.scene.clone(), many), None, true);
        assert!(!text.contains("NOT MET: because") && text.contains("--report"), "{text}");
        assert_eq!(text.lines().filter(|line| line.ends_with("NOT MET")).count(), RUNS_IN_FULL + 1);
    }

    #[test]
    fn in_short_a_run_has_a_line_and_a_verdict_its_reason() {
        let run = |hard| Run {
            system: "mmrt".to_owned(),
            preset: "robust".to_owned(),
            integrator: Some("path".to_owned()),
            times: Times { trace_ms: Some(1500.0), first_build_ms: Some(2.25), ..Default::default() },
            hard,
            ..Default::default()
        };
        let scene =
            SceneRecord { name: "box".to_owned(), triangles: 12, sha256: None, ..SceneRecord::default() };
        let report = |runs| Report::new(Origin::default(), Device::default(), scene.clone(), runs);
        let text = table(&report(vec![run(None)]), None, false);
        assert!(
            text.contains("mmrt robust, path") && text.contains("first build 2.2 ms, trace 1.50 s"),
            "{text}"
        );
        assert_eq!(text.lines().count(), 4, "{text}");
        let hard = HardRecord { id: "E5".to_owned(), reason: "because".to_owned(), ..Default::default() };
        let text = table(&report(vec![run(None), run(Some(hard))]), None, false);
        assert!(
            text.contains("E5") && text.contains("one run cannot tell") && text.contains("because"),
            "{text}"
        );
        assert!(text.contains("--verbose") && !text.contains(" time\n"), "{text}");
    }
}
