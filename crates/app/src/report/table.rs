//! The report as text for people.

use super::schema::{Report, Run};
use std::fmt::Write;

/// Aligned columns: the first `left` to the left, the others to the right.
pub(crate) fn columns(rows: &[Vec<String>], left: usize) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let mut widths = vec![0; count];
    for (column, cell) in rows.iter().flat_map(|row| row.iter().enumerate()) {
        widths[column] = widths[column].max(cell.chars().count());
    }
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            _ = if column < left {
                write!(line, "  {cell:<width$}")
            } else {
                write!(line, "  {cell:>width$}")
            };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

fn milliseconds(value: f64) -> String {
    format!("{value:.3} ms")
}

/// Bytes with a binary unit, exact below 1 KiB.
pub(crate) fn bytes(value: u64) -> String {
    const UNITS: [&str; 4] = ["KiB", "MiB", "GiB", "TiB"];
    let mut scaled = value as f64;
    let mut unit = "B";
    for next in UNITS {
        if scaled < 1024.0 {
            break;
        }
        scaled /= 1024.0;
        unit = next;
    }
    if unit == "B" { format!("{value} B") } else { format!("{scaled:.2} {unit}") }
}

/// A whole number with its thousands apart.
pub(crate) fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (position, digit) in digits.chars().enumerate() {
        if position > 0 && (digits.len() - position).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
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

fn heading(run: &Run) -> String {
    let mut text = format!("{} {}", run.system, run.preset);
    for part in [&run.ray_set, &run.integrator].into_iter().flatten() {
        _ = write!(text, ", {part}");
    }
    if let (Some(width), Some(height)) = (run.width, run.height) {
        _ = write!(text, ", {width}x{height}");
    }
    if let Some(spp) = run.spp {
        _ = write!(text, ", {spp} spp");
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
            let spread = format!("({:.3} to {:.3})", pass.ms_min, pass.ms_max);
            vec![pass.label.clone(), milliseconds(pass.ms_median), spread]
        })
        .collect();
    let figures = [
        ("pose", times.pose_ms),
        ("build", times.build_ms),
        ("build, host", times.build_host_ms),
        ("trace", times.trace_ms),
        ("frame", times.frame_ms),
    ];
    rows.extend(figures.into_iter().filter_map(|(name, value)| row(name, value.map(milliseconds))));
    section(&mut text, " time", rows);

    let rate = times.mrays_per_s.map(|rate| format!("{rate:.3} Mrays/s"));
    let mut rows: Vec<_> =
        [row("rays", times.rays.map(grouped)), row("rate", rate)].into_iter().flatten().collect();
    if let Some(counters) = &run.counters {
        let per_ray = |value: Option<f64>| value.map(|value| format!("{value:.2}"));
        rows.extend(
            [
                row("fragments", counters.fragments.map(grouped)),
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
        let share = |count: u64| {
            let percent = if judged == 0 { 0.0 } else { 100.0 * count as f64 / judged as f64 };
            format!("{} ({percent:.4} %)", grouped(count))
        };
        let relative = |value: Option<f64>| value.map(|value| format!("{value:.2e}"));
        let rows = [
            row("rays", Some(grouped(accuracy.rays))),
            row("ambiguous", Some(grouped(accuracy.ambiguous))),
            row("ambiguous, lost", Some(grouped(accuracy.ambiguous_lost))),
            row("missed", Some(share(accuracy.missed))),
            row("false hits", Some(share(accuracy.false_hits))),
            row("wrong primitive", accuracy.wrong_primitive.map(share)),
            row("|dt|/t median", relative(accuracy.dt_rel_p50)),
            row("|dt|/t 99 %", relative(accuracy.dt_rel_p99)),
            row("|dt|/t largest", relative(accuracy.dt_rel_max)),
            row("not finite", Some(grouped(accuracy.non_finite))),
        ];
        section(&mut text, " hits against the oracle", rows.into_iter().flatten().collect());
    }
    if let Some(image) = &run.image {
        let number = |value: Option<f64>| value.map(|value| format!("{value:.5}"));
        let rows = [
            row("FLIP mean", number(image.flip_mean)),
            row("FLIP 99 %", number(image.flip_p99)),
            row("RMSE", number(image.rmse)),
            row("relMSE", number(image.relmse)),
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
    let mut rows = vec![
        ["run", "build ms", "trace ms", "Mrays/s", "memory", "missed", "false", "wrong", "FLIP"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for run in runs {
        let number = |value: Option<f64>| value.map_or_else(dash, |value| format!("{value:.3}"));
        let accuracy = run.accuracy.as_ref();
        let what = run.ray_set.as_deref().or(run.integrator.as_deref()).unwrap_or("");
        rows.push(vec![
            format!("{} {} {what}", run.system, run.preset).trim_end().to_owned(),
            number(run.times.build_ms),
            number(run.times.trace_ms),
            number(run.times.mrays_per_s),
            run.memory.as_ref().and_then(|memory| memory.structure_bytes).map_or_else(dash, bytes),
            accuracy.map_or_else(dash, |accuracy| grouped(accuracy.missed)),
            accuracy.map_or_else(dash, |accuracy| grouped(accuracy.false_hits)),
            accuracy.and_then(|accuracy| accuracy.wrong_primitive).map_or_else(dash, grouped),
            number(run.image.and_then(|image| image.flip_mean)),
        ]);
    }
    columns(&rows, 1)
}

/// The whole report for people: device and scene, each run in full, and with several runs one line
/// each for comparison.
pub fn table(report: &Report) -> String {
    let device = &report.device;
    let note = if device.software { "; times of software devices are for ratios on that device" } else { "" };
    let mut text = format!("device {} ({}){note}\n", device.name, device.driver);
    _ = writeln!(text, "scene  {}, {} triangles", report.scene.name, grouped(report.scene.triangles));
    for run in &report.runs {
        text.push('\n');
        text += &run_text(run);
    }
    if report.runs.len() > 1 {
        text.push('\n');
        text += &summary(&report.runs);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Accuracy, Device, SCHEMA, SceneRecord, Times};

    #[test]
    fn numbers_for_people() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(1_234_567), "1,234,567");
        assert_eq!(bytes(1023), "1023 B");
        assert_eq!(bytes(3 << 20), "3.00 MiB");
    }

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
        let report = Report {
            schema: SCHEMA.to_owned(),
            version: "1".to_owned(),
            commit: None,
            device: Device { name: "d".to_owned(), driver: "e".to_owned(), software: true },
            scene: SceneRecord { name: "box".to_owned(), triangles: 12_000, sha256: None },
            runs: vec![run("mmrt", Some(accuracy)), run("brute-force", None)],
        };
        let text = table(&report);
        assert!(text.contains("12,000 triangles") && text.contains("ratios on that device"), "{text}");
        assert!(text.contains("1 (0.1000 %)"), "{text}");
        let last = text.lines().last().expect("a summary");
        assert!(last.contains("brute-force robust eye") && last.trim_end().ends_with('-'), "{last}");
    }
}
