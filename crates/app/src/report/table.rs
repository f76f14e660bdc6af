//! The report as text for people.

use super::words::{bytes, columns, grouped};
use rasray_report::{Bound, HardRecord, RateRecord, Report, Run, Statistics};
use std::fmt::Write;

fn milliseconds(value: f64) -> String {
    format!("{value:.3} ms")
}

/// Least and greatest of repeated times, with the quartiles between them.
fn apart(least: f64, quartiles: Option<(f64, f64)>, greatest: f64) -> String {
    match quartiles {
        Some((first, third)) => format!("({least:.3} [{first:.3} to {third:.3}] {greatest:.3})"),
        None => format!("({least:.3} to {greatest:.3})"),
    }
}

fn section(text: &mut String, title: &str, rows: Vec<Vec<String>>) {
    if !rows.is_empty() {
        _ = writeln!(text, "{title}");
        *text += &columns(&rows, 1);
    }
}

fn row(name: &str, value: Option<String>) -> Option<Vec<String>> {
    value.map(|value| vec![name.to_owned(), value])
}

/// Where the true rate lies, in per cent.
fn interval(rate: &RateRecord) -> String {
    let [low, high] = rate.interval.map(|end| 100.0 * end);
    match (rate.bound, rate.count) {
        (Bound::OneSided, 0) => format!("at most {high:.4} %"),
        (Bound::OneSided, _) => format!("at least {low:.4} %"),
        (Bound::ClopperPearson, _) => format!("{low:.4} to {high:.4} %"),
    }
}

fn heading(run: &Run) -> String {
    let mut text = run.contestant();
    for part in [&run.ray_set, &run.integrator].into_iter().flatten() {
        _ = write!(text, ", {part}");
    }
    if let (Some(width), Some(height)) = (run.width, run.height) {
        _ = write!(text, ", {width}x{height}");
    }
    if let Some(spp) = run.spp {
        _ = write!(text, ", {spp} spp");
    }
    if let Some(seed) = run.seed {
        _ = write!(text, ", seed {seed}");
    }
    text
}

fn run_text(run: &Run) -> String {
    let mut text = heading(run);
    text.push('\n');
    let times = &run.times;
    let mut rows: Vec<_> = run
        .passes
        .iter()
        .map(|pass| {
            let quartiles = pass.ms_q1.zip(pass.ms_q3);
            vec![pass.label.clone(), milliseconds(pass.ms_median), apart(pass.ms_min, quartiles, pass.ms_max)]
        })
        .collect();
    let figures = [
        ("pose", "pose_ms", times.pose_ms),
        ("build", "build_ms", times.build_ms),
        ("build, host", "build_host_ms", times.build_host_ms),
        ("first build", "first_build_ms", times.first_build_ms),
        ("first use", "first_use_ms", times.first_use_ms),
        ("trace", "trace_ms", times.trace_ms),
        ("frame", "frame_ms", times.frame_ms),
    ];
    rows.extend(figures.into_iter().filter_map(|(name, key, value)| {
        let mut row = row(name, value.map(milliseconds))?;
        row.extend(run.spread.get(key).map(|s| apart(s.min, Some((s.q1, s.q3)), s.max)));
        Some(row)
    }));
    section(&mut text, " time", rows);

    let rate = times.mrays_per_s.map(|rate| format!("{rate:.3} Mrays/s"));
    let mut rows: Vec<_> =
        [row("rays", times.rays.map(grouped)), row("rate", rate)].into_iter().flatten().collect();
    if let Some(counters) = &run.counters {
        let per_ray = |value: Option<f64>| value.map(|value| format!("{value:.2}"));
        rows.extend(
            [
                row("fragments", counters.fragments.map(grouped)),
                row("lost triangles", counters.lost.map(grouped)),
                row("entries", counters.entries.map(grouped)),
                row("nodes per ray", per_ray(counters.nodes_per_ray)),
                row("cells per ray", per_ray(counters.cells_per_ray)),
                row("tests per ray", per_ray(counters.tests_per_ray)),
                row("demand", counters.demand.map(grouped)),
                row("capacity", counters.capacity.map(grouped)),
                row("overflow", counters.overflow.map(grouped)),
                row("regrows", counters.regrows.map(grouped)),
                row("unfinished", counters.unfinished.map(grouped)),
            ]
            .into_iter()
            .flatten(),
        );
    }
    section(&mut text, " counts", rows);

    if let Some(memory) = &run.memory {
        let parts = memory.by_part.iter().map(|(name, value)| vec![name.clone(), bytes(*value)]);
        let totals = [
            ("structure", memory.structure_bytes),
            ("by formula", memory.formula_bytes),
            ("capacity", memory.capacity_bytes),
            ("diagnostics", memory.diagnostic_bytes),
            ("device, peak", memory.device_peak_bytes),
        ];
        let totals = totals.into_iter().filter_map(|(name, value)| row(name, value.map(bytes)));
        section(&mut text, " memory", parts.chain(totals).collect());
    }
    if let Some(accuracy) = &run.accuracy {
        let judged = accuracy.rays.saturating_sub(accuracy.ambiguous);
        let counted = |name: &str, label: &str, count: Option<u64>| {
            let count = count?;
            let (of, bounds) = match accuracy.rates.get(name) {
                Some(rate) => (rate.of, Some(interval(rate))),
                None => (judged, None),
            };
            let percent = if of == 0 { 0.0 } else { 100.0 * count as f64 / of as f64 };
            let mut row = vec![label.to_owned(), format!("{} ({percent:.4} %)", grouped(count))];
            row.extend(bounds);
            Some(row)
        };
        let relative = |value: Option<f64>| value.map(|value| format!("{value:.2e}"));
        let rows = [
            row("rays", Some(grouped(accuracy.rays))),
            row("ambiguous", Some(grouped(accuracy.ambiguous))),
            row("ambiguous, lost", Some(grouped(accuracy.ambiguous_lost))),
            counted("missed", "missed", Some(accuracy.missed)),
            counted("false_hits", "false hits", Some(accuracy.false_hits)),
            counted("wrong_primitive", "wrong primitive", accuracy.wrong_primitive),
            counted("t_off", "t beyond rounding", accuracy.t_off),
            counted("non_finite", "not finite", Some(accuracy.non_finite)),
            row("|dt|/t median", relative(accuracy.dt_rel_p50)),
            row("|dt|/t 90 %", relative(accuracy.dt_rel_p90)),
            row("|dt|/t 99 %", relative(accuracy.dt_rel_p99)),
            row("|dt|/t 99.9 %", relative(accuracy.dt_rel_p999)),
            row("|dt|/t largest", relative(accuracy.dt_rel_max)),
        ];
        section(&mut text, " hits against the oracle", rows.into_iter().flatten().collect());
    }
    if let Some(hard) = &run.hard {
        let met = hard.met.map(|met| if met { "met" } else { "NOT MET" }).unwrap_or("one run cannot tell");
        let rows = [
            row("looked at", Some(hard.measure.clone())),
            row("target", Some(hard.target.clone())),
            row("verdict", Some(format!("{met}: {}", hard.reason))),
        ];
        let rows: Vec<Vec<String>> = rows.into_iter().flatten().collect();
        _ = writeln!(text, " hard case {}: {}", hard.id, hard.title);
        text += &columns(&rows, 2);
    }
    if let Some(image) = &run.image {
        let number = |value: Option<f64>| value.map(|value| format!("{value:.5}"));
        let rows = [
            row("FLIP mean", number(image.flip_mean)),
            row("FLIP 99 %", number(image.flip_p99)),
            row("FLIP largest", number(image.flip_max)),
            row("RMSE", number(image.rmse)),
            row("relMSE", number(image.relmse)),
            row("relMSE, trimmed", number(image.relmse_trimmed)),
            row(
                "bias",
                image.bias.map(|bias| match image.bias_sigma {
                    Some(sigma) => format!("{bias:.2e} (sigma {sigma:.1e})"),
                    None => format!("{bias:.2e}"),
                }),
            ),
            row("PSNR", image.psnr.map(|value| format!("{value:.2} dB"))),
            row("SSIM", number(image.ssim)),
        ];
        section(&mut text, " image against the reference", rows.into_iter().flatten().collect());
    }
    text
}

/// One row per run: speed beside error.
fn summary(runs: &[Run]) -> String {
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
        // A share with the upper end of its interval: what the count alone does not exclude.
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
        let verdict = |hard: &HardRecord| match hard.met {
            Some(true) => "met",
            Some(false) => "NOT MET",
            None => "-",
        };
        row.extend(hard.then(|| run.hard.as_ref().map_or("-", verdict).to_owned()));
        rows.push(row);
    }
    columns(&rows, 1)
}

/// How sure the rates are, one by one and together.
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

/// Runs up to which each is printed in full; more are read in a file.
const RUNS_IN_FULL: usize = 24;

/// The whole report for people: device and scene, each run in full unless they are very many, and with
/// several runs one line each for comparison.
pub fn table(report: &Report) -> String {
    let device = &report.device;
    let note = if device.software { "; times of software devices are for ratios on that device" } else { "" };
    let mut text = format!("device {} ({}){note}\n", device.name, device.driver);
    _ = writeln!(text, "scene  {}, {} triangles", report.scene.name, grouped(report.scene.triangles));
    if report.runs.len() <= RUNS_IN_FULL {
        for run in &report.runs {
            text.push('\n');
            text += &run_text(run);
        }
    } else {
        text += "each of the runs in full: --report or --html\n";
    }
    if report.runs.len() > 1 {
        text.push('\n');
        text += &summary(&report.runs);
    }
    if let Some(statistics) = &report.statistics {
        text += &certainty(statistics);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Accuracy, Device, Origin, SceneRecord, Spread, Times};
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
        let device = Device { name: "d".to_owned(), driver: "e".to_owned(), software: true };
        let scene = SceneRecord { name: "box".to_owned(), triangles: 12_000, sha256: None };
        let runs = vec![run("mmrt", Some(accuracy)), run("brute-force", None)];
        let text = table(&Report::new(Origin::default(), device, scene, runs));
        assert!(text.contains("12,000 triangles") && text.contains("ratios on that device"), "{text}");
        assert!(text.contains("1 (0.1000 %)"), "{text}");
        let last = text.lines().last().expect("a summary");
        assert!(last.contains("brute-force robust eye") && last.trim_end().ends_with('-'), "{last}");
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
        let scene = SceneRecord { name: "box".to_owned(), triangles: 12, sha256: None };
        let report = Report::new(Origin::default(), Device::default(), scene, vec![run.clone(), run]);
        let text = table(&report);
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
        // Very many runs have a line each and no more.
        let many = vec![report.runs[0].clone(); RUNS_IN_FULL + 1];
        let text = table(&Report::new(Origin::default(), Device::default(), report.scene, many));
        assert!(!text.contains("NOT MET: because") && text.contains("--report"), "{text}");
        assert_eq!(text.lines().filter(|line| line.ends_with("NOT MET")).count(), RUNS_IN_FULL + 1);
    }
}
