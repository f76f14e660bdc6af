//! Text of a run with every number, for people.

use crate::{Bound, HardRecord, ListRecord, RateRecord, Run, StageTime, bytes, columns, grouped};
use std::fmt::Write;

/// Writes a time in milliseconds. A sum of no terms is -0 in Rust, and is written as 0 here.
fn milliseconds(value: f64) -> String {
    format!("{:.3} ms", value + 0.0)
}

/// Writes the least and greatest of repeated times, with the quartiles between them.
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

/// Writes the confidence interval of the true rate in per cent.
fn interval(rate: &RateRecord) -> String {
    let [low, high] = rate.interval.map(|end| 100.0 * end);
    match (rate.bound, rate.count) {
        (Bound::OneSided, 0) => format!("at most {high:.4} %"),
        (Bound::OneSided, _) => format!("at least {low:.4} %"),
        (Bound::ClopperPearson, _) => format!("{low:.4} to {high:.4} %"),
    }
}

/// Returns the counts of lists as rows of a table below their headings; no row if there are none.
pub fn list_rows(lists: &[ListRecord]) -> Vec<Vec<String>> {
    let head =
        ["cells of", "cells", "occupied", "layers", "on average", "at most", "entries", "slots", "unfilled"];
    let heads = (!lists.is_empty()).then(|| head.map(str::to_owned).to_vec());
    let rows = lists.iter().map(|list| {
        vec![
            list.cells_of.clone(),
            grouped(list.cells),
            grouped(list.occupied),
            grouped(list.layers),
            list.layers_mean.map_or_else(|| "-".to_owned(), |mean| format!("{mean:.2}")),
            grouped(list.layers_most),
            grouped(list.entries),
            grouped(list.slots),
            bytes(list.waste_bytes),
        ]
    });
    heads.into_iter().chain(rows).collect()
}

/// Returns the verdict on a target in words.
pub(super) fn verdict(hard: &HardRecord) -> &'static str {
    hard.met.map_or("one run cannot tell", |met| if met { "met" } else { "NOT MET" })
}

/// Writes the description of a run.
pub(super) fn heading(run: &Run) -> String {
    let mut text = run.contestant();
    for part in [&run.ray_set, &run.integrator].into_iter().flatten() {
        _ = write!(text, ", {part}");
    }
    if let (Some(width), Some(height)) = (run.width, run.height) {
        _ = write!(text, ", {width}x{height}");
    }
    if let Some(spp) = run.spp {
        _ = match &run.adaptive {
            Some(adaptive) => write!(text, ", {:.1} of {spp} spp", adaptive.samples_mean),
            None => write!(text, ", {spp} spp"),
        };
    }
    if let Some(seed) = run.seed {
        _ = write!(text, ", seed {seed}");
    }
    text
}

/// Writes every number of a run.
pub(super) fn run_text(run: &Run) -> String {
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
        ("image, all passes", "image_ms", times.image_ms),
        ("frame", "frame_ms", times.frame_ms),
    ];
    rows.extend(figures.into_iter().filter_map(|(name, key, value)| {
        let mut row = row(name, value.map(milliseconds))?;
        row.extend(run.spread.get(key).map(|s| apart(s.min, Some((s.q1, s.q3)), s.max)));
        Some(row)
    }));
    section(&mut text, " time", rows);
    let stages = run.stages.iter().map(|StageTime { stage, ms, spread }| {
        let spread = apart(spread.min, Some((spread.q1, spread.q3)), spread.max);
        vec![stage.clone(), milliseconds(*ms), spread]
    });
    section(&mut text, " stages", stages.collect());

    let rate = times.mrays_per_s.map(|rate| format!("{rate:.3} Mrays/s"));
    let mut rows: Vec<_> =
        [row("rays", times.rays.map(grouped)), row("rate", rate)].into_iter().flatten().collect();
    if let Some(counters) = &run.counters {
        let per_ray = |value: Option<f64>| value.map(|value| format!("{value:.2}"));
        let share = |value: Option<f64>| value.map(|value| format!("{:.2} %", 100.0 * value));
        rows.extend(
            [
                row("fragments", counters.fragments.map(grouped)),
                row("lost triangles", counters.lost.map(grouped)),
                row("entries", counters.entries.map(grouped)),
                row("nodes per ray", per_ray(counters.nodes_per_ray)),
                row("cells per ray", per_ray(counters.cells_per_ray)),
                row("tests per ray", per_ray(counters.tests_per_ray)),
                row("views per ray", per_ray(counters.views_per_ray)),
                row("cells rejected", share(counters.rejected_share)),
                row("demand", counters.demand.map(grouped)),
                row("capacity", counters.capacity.map(grouped)),
                row("overflow", counters.overflow.map(grouped)),
                row("regrows", counters.regrows.map(grouped)),
                row("unfinished", counters.unfinished.map(grouped)),
                row("cut rays", counters.cut.map(grouped)),
                row("samples traced on", share(counters.selected_share)),
            ]
            .into_iter()
            .flatten(),
        );
    }
    section(&mut text, " counts", rows);
    section(
        &mut text,
        " lists",
        run.counters.as_ref().map(|counters| list_rows(&counters.lists)).unwrap_or_default(),
    );

    if let Some(memory) = &run.memory {
        let parts = memory.by_part.iter().map(|(name, value)| vec![name.clone(), bytes(*value)]);
        let totals = [
            ("structure", memory.structure_bytes),
            ("by formula", memory.formula_bytes),
            ("capacity", memory.capacity_bytes),
            ("diagnostics", memory.diagnostic_bytes),
            ("image", memory.frame_bytes),
            ("device, peak", memory.device_peak_bytes),
        ];
        let totals = totals.into_iter().filter_map(|(name, value)| row(name, value.map(bytes)));
        let per_pixel = memory.frame_bytes_per_pixel.map(|bytes| format!("{bytes:.1} B"));
        let totals = totals.chain(row("image, per pixel", per_pixel));
        section(&mut text, " memory", parts.chain(totals).collect());
    }
    if let Some(accuracy) = &run.accuracy {
        let evaluated = accuracy.rays.saturating_sub(accuracy.ambiguous);
        let counted = |name: &str, label: &str, count: Option<u64>| {
            let count = count?;
            let (of, bounds) = match accuracy.rates.get(name) {
                Some(rate) => (rate.of, Some(interval(rate))),
                None => (evaluated, None),
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
        let rows = [
            row("looked at", Some(hard.measure.clone())),
            row("target", Some(hard.target.clone())),
            row("verdict", Some(format!("{}: {}", verdict(hard), hard.reason))),
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
            row(
                "FLIP above 0.1",
                image.flip_visible.map(|share| format!("{:.2} % of pixels", 100.0 * share)),
            ),
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
