//! Markdown table of the runs of a report side by side, for pages that publish them.

use crate::{Accuracy, Report, Run, grouped, in_line};

/// System and preset of the baseline, to whose rate the rates of other runs are related.
const BASELINE: (&str, &str) = ("bvh", "robust");

/// Variant that is the baseline where the report has several of this system and preset.
const BASELINE_VARIANT: &str = "builder=sah";

/// Headings of the columns; columns after the second are aligned to the right.
const HEADS: [&str; 15] = [
    "structure",
    "rays",
    "build ms",
    "of it host",
    "trace ms",
    "Mrays/s",
    "x bvh",
    "KiB",
    "B/triangle",
    "cells/ray",
    "entries/ray",
    "tests/ray",
    "missed",
    "false",
    "wrong",
];

/// Writes the table, one row per run, with the percentiles of |dt|/t behind the counts of wrong answers. A
/// measurement that was not made is an empty cell. Counts are over the unambiguous rays, whose number stands
/// above the table with the scene and the device.
pub fn markdown(report: &Report) -> String {
    let heads: Vec<&str> = HEADS.into_iter().chain(["dt/t p50", "dt/t p99"]).collect();
    let rules = (0..heads.len()).map(|column| if column < 2 { "---" } else { "---:" });
    let mut text = title(report);
    text += &row(heads.iter().map(|&head| head.to_owned()));
    text += &row(rules.map(str::to_owned));
    for run in report.runs.iter().filter(|run| run.ray_set.is_some()) {
        text += &row(cells(report, run));
    }
    text
}

fn title(report: &Report) -> String {
    let scene = &report.scene;
    let device = &report.device;
    let software = if device.software { ", a software driver: times are for ratios" } else { "" };
    let evaluated = report.runs.iter().filter_map(|run| run.accuracy.as_ref()).map(evaluated);
    let rays = match (evaluated.clone().min(), evaluated.max()) {
        (Some(least), Some(most)) if least == most => format!("{} unambiguous rays per set. ", grouped(most)),
        (Some(least), Some(most)) => {
            format!("{} to {} unambiguous rays per set. ", grouped(least), grouped(most))
        }
        _ => String::new(),
    };
    let command =
        report.command.as_ref().map(|line| format!("\n```\n{}\n```\n", in_line(line))).unwrap_or_default();
    let triangles = grouped(scene.triangles);
    let device = device.full_name();
    let (scene, device) = (in_line(&scene.name), in_line(&device));
    format!("**{scene}**, {triangles} triangles. {rays}Device: {device}{software}.\n{command}\n")
}

fn evaluated(accuracy: &Accuracy) -> u64 {
    accuracy.rays - accuracy.ambiguous
}

fn row(cells: impl IntoIterator<Item = String>) -> String {
    let cells: Vec<String> = cells.into_iter().collect();
    format!("| {} |\n", cells.join(" | "))
}

fn cells(report: &Report, run: &Run) -> Vec<String> {
    let number =
        |value: Option<f64>, digits: usize| value.map(|v| format!("{v:.digits$}")).unwrap_or_default();
    let count = |value: Option<u64>| value.map(grouped).unwrap_or_default();
    let tiny = |value: Option<f64>| value.map(|v| format!("{v:.1e}")).unwrap_or_default();
    let bytes = run.memory.as_ref().and_then(|memory| memory.structure_bytes).map(|bytes| bytes as f64);
    let counters = run.counters.as_ref();
    let accuracy = run.accuracy.as_ref();
    let triangles = (report.scene.triangles > 0).then_some(report.scene.triangles as f64);
    vec![
        run.contestant(),
        run.ray_set.clone().unwrap_or_default(),
        number(run.times.build_ms, 2),
        number(run.times.build_host_ms.filter(|&host| host >= 0.005), 2),
        number(run.times.trace_ms, 2),
        number(run.times.mrays_per_s, 3),
        number(relation(report, run), 2),
        number(bytes.map(|bytes| bytes / 1024.0), 0),
        number(bytes.zip(triangles).map(|(bytes, triangles)| bytes / triangles), 0),
        number(counters.and_then(|c| c.cells_per_ray), 2),
        number(counters.and_then(|c| c.nodes_per_ray), 2),
        number(counters.and_then(|c| c.tests_per_ray), 2),
        count(accuracy.map(|a| a.missed)),
        count(accuracy.map(|a| a.false_hits)),
        count(accuracy.and_then(|a| a.wrong_primitive)),
        tiny(accuracy.and_then(|a| a.dt_rel_p50)),
        tiny(accuracy.and_then(|a| a.dt_rel_p99)),
    ]
}

/// Returns the rays per second of a run over those of the baseline on the same rays. Absent if the baseline
/// was not traced, or if several runs are candidates and not exactly one of them has the variant of the
/// baseline.
fn relation(report: &Report, run: &Run) -> Option<f64> {
    let mut baselines: Vec<&Run> = report
        .runs
        .iter()
        .filter(|other| {
            (other.system.as_str(), other.preset.as_str()) == BASELINE && other.ray_set == run.ray_set
        })
        .collect();
    if baselines.len() > 1 {
        baselines.retain(|other| other.variant.as_deref() == Some(BASELINE_VARIANT));
    }
    let [baseline] = baselines[..] else { return None };
    Some(run.times.mrays_per_s? / baseline.times.mrays_per_s?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Device, Memory, Origin, SceneRecord, Times};

    fn run(system: &str, storage: &str, rate: f64) -> Run {
        Run {
            system: system.to_owned(),
            preset: "robust".to_owned(),
            ray_set: Some("eye".to_owned()),
            variant: (!storage.is_empty()).then(|| format!("storage={storage}")),
            times: Times { mrays_per_s: Some(rate), ..Times::default() },
            memory: Some(Memory { structure_bytes: Some(2048), ..Memory::default() }),
            accuracy: Some(Accuracy { rays: 1500, ambiguous: 500, missed: 7, ..Accuracy::default() }),
            ..Run::default()
        }
    }

    fn report(runs: Vec<Run>) -> Report {
        let scene =
            SceneRecord { name: "box".to_owned(), triangles: 16, sha256: None, ..SceneRecord::default() };
        let origin = Origin { command: Some("rasray compare box".to_owned()), ..Origin::default() };
        Report::new(origin, Device::default(), scene, runs)
    }

    fn lines(text: &str) -> Vec<Vec<&str>> {
        let rows = text.lines().filter(|line| line.starts_with('|'));
        rows.map(|line| line.trim_matches('|').split('|').map(str::trim).collect()).collect()
    }

    #[test]
    fn rates_are_put_in_relation_and_missing_figures_are_empty() {
        let image = Run { integrator: Some("path".to_owned()), ..Run::default() };
        let text = markdown(&report(vec![run("mmrt", "", 1.5), run("bvh", "", 3.0), image]));
        assert!(text.contains("1,000 unambiguous rays") && text.contains("rasray compare box"), "{text}");
        let rows = lines(&text);
        assert_eq!(rows.len(), 4, "{text}");
        assert!(rows.iter().all(|row| row.len() == rows[0].len()));
        let cell = |row: usize, head: &str| {
            let column = rows[0].iter().position(|&h| h == head).expect("a column of that head");
            rows[row][column]
        };
        assert_eq!(cell(2, "structure"), "mmrt robust");
        assert_eq!((cell(2, "x bvh"), cell(3, "x bvh")), ("0.50", "1.00"));
        assert_eq!((cell(2, "KiB"), cell(2, "B/triangle"), cell(2, "missed")), ("2", "128", "7"));
        assert_eq!((cell(2, "build ms"), cell(2, "wrong"), cell(2, "dt/t p50")), ("", "", ""));
    }

    #[test]
    fn variants_are_told_apart_and_have_no_one_baseline() {
        let text = markdown(&report(vec![run("bvh", "sb", 1.5), run("bvh", "ll", 3.0)]));
        let rows = lines(&text);
        assert_eq!((rows[2][0], rows[3][0]), ("bvh robust storage=sb", "bvh robust storage=ll"));
        let x = rows[0].iter().position(|&h| h == "x bvh").expect("the column");
        assert_eq!(rows[2][x], "", "nothing to be put in relation to");

        let built =
            |builder: &str, rate| Run { variant: Some(format!("builder={builder}")), ..run("bvh", "", rate) };
        let text = markdown(&report(vec![built("lbvh", 1.5), built("sah", 3.0)]));
        let rows = lines(&text);
        assert_eq!((rows[2][x], rows[3][x]), ("0.50", "1.00"), "the tree by surface area is the baseline");
    }
}
