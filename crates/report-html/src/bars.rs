//! Stacked bars, one per run: time of each pass and memory of each part.

use super::axes;
use super::markup::plot_text;
use super::names::{by_workload, milliseconds, part_colour};
use super::section::{Plot, Section};
use rasray_report::{Memory, Pass, PassOf, Report, Run};
use rasray_report::{bytes, grouped};
use serde_json::{Value, json};

/// Largest number of parts that get a colour of their own; all other parts share the last colour.
const COLOURED: usize = 7;

/// Number of bytes in a mebibyte.
const MEBIBYTE: f64 = 1_048_576.0;

/// Part of a build that the host does, hatched to tell it from passes of the device.
struct HostPart {
    name: &'static str,
    colour: &'static str,
    /// Name of the hatching pattern in the plots' library.
    pattern: &'static str,
}

const HOST_PARTS: [HostPart; 2] = [
    HostPart { name: Pass::HOST, colour: "#4d5866", pattern: "/" },
    HostPart { name: Pass::WAITING, colour: "#a9b2bc", pattern: "." },
];

/// Bar of a run: the run and its parts.
type Bar<'a> = (&'a Run, Vec<Part<'a>>);

/// Part of a run's bar.
struct Part<'a> {
    name: &'a str,
    size: f64,
    words: String,
}

/// Returns the milliseconds of a pass as its share of the figure.
fn share(pass: &Pass) -> f64 {
    pass.ms_share.unwrap_or(pass.ms_median)
}

fn pass_part(pass: &Pass) -> Part<'_> {
    let mut words = format!("{:.3} ms", share(pass));
    if let Some(dispatches) = pass.dispatches.filter(|count| *count > 1) {
        words += &format!(" in {} dispatches", grouped(dispatches));
    }
    if pass.count != Some(1) {
        words += &format!(
            "<br>over repetitions: median {:.3}, {:.3} to {:.3}",
            pass.ms_median, pass.ms_min, pass.ms_max
        );
        if let (Some(q1), Some(q3)) = (pass.ms_q1, pass.ms_q3) {
            words += &format!(", half of them {q1:.3} to {q3:.3}");
        }
    }
    Part { name: &pass.label, size: share(pass), words }
}

fn memory_parts(memory: &Memory) -> Vec<Part<'_>> {
    memory
        .by_part
        .iter()
        .map(|(name, value)| Part { name, size: *value as f64 / MEBIBYTE, words: bytes(*value) })
        .collect()
}

/// Returns the names of all parts, ordered by their largest size in any run, so that a part has one colour in
/// all plots of its kind.
fn ranked<'a>(parts: impl Iterator<Item = Part<'a>>) -> Vec<&'a str> {
    let mut sizes: Vec<(&str, f64)> = Vec::new();
    for part in parts {
        match sizes.iter_mut().find(|(name, _)| *name == part.name) {
            Some((_, size)) => *size = size.max(part.size),
            None => sizes.push((part.name, part.size)),
        }
    }
    sizes.sort_by(|a, b| b.1.total_cmp(&a.1));
    sizes.into_iter().map(|(name, _)| name).collect()
}

/// Returns a run's name on two lines, which leaves space for bars on a phone.
fn bar_name(run: &Run) -> String {
    let rest = [Some(&run.preset), run.variant.as_ref()];
    let rest = rest.into_iter().flatten().map(|word| plot_text(word)).collect::<Vec<_>>();
    format!("{}<br>{}", plot_text(&run.system), rest.join(" "))
}

/// Collects the bars of one part, from each run that has the part.
fn bars_of(runs: &[Bar<'_>], name: &str) -> Vec<(String, f64, String)> {
    let found = runs.iter().filter_map(|(run, parts)| {
        // Where passes overlap on a device, the time of waiting is negative; such a part is not drawn.
        let part = parts.iter().find(|part| part.name == name && part.size >= 0.0)?;
        Some((bar_name(run), part.size, part.words.clone()))
    });
    found.collect()
}

/// Makes one trace per part: the coloured parts, one trace of all other parts, then the parts of the host.
fn stacked(runs: &[Bar<'_>], ranking: &[&str]) -> Vec<Value> {
    let (host, ranking): (Vec<&str>, Vec<&str>) =
        ranking.iter().copied().partition(|name| HOST_PARTS.iter().any(|part| part.name == *name));
    // A single part beyond the colours is drawn by itself, since a group of one is not worth it.
    let coloured = if ranking.len() <= COLOURED + 1 { ranking.len() } else { COLOURED };
    let (own, others) = ranking.split_at(coloured);
    let mut traces = Vec::new();
    for (index, name) in own.iter().enumerate() {
        let found = bars_of(runs, name);
        if !found.is_empty() {
            traces.push(trace(name, part_colour(index), found));
        }
    }
    let rest: Vec<_> = runs
        .iter()
        .filter_map(|(run, parts)| {
            let of_rest = || parts.iter().filter(|part| others.contains(&part.name));
            let words: Vec<_> =
                of_rest().map(|part| format!("{} {}", plot_text(part.name), part.words)).collect();
            (!words.is_empty())
                .then(|| (bar_name(run), of_rest().map(|part| part.size).sum(), words.join("<br>")))
        })
        .collect();
    if !rest.is_empty() {
        traces.push(trace(&format!("{} others", others.len()), part_colour(COLOURED), rest));
    }
    for part in HOST_PARTS.iter().filter(|part| host.contains(&part.name)) {
        let found = bars_of(runs, part.name);
        if !found.is_empty() {
            let mut trace = trace(part.name, part.colour, found);
            trace["marker"]["pattern"] =
                json!({"shape": part.pattern, "fillmode": "overlay", "fgcolor": "#ffffff", "fgopacity": 0.7});
            traces.push(trace);
        }
    }
    traces
}

fn trace(name: &str, colour: &str, bars: Vec<(String, f64, String)>) -> Value {
    json!({
        "type": "bar", "orientation": "h", "name": plot_text(name), "marker": {"color": colour},
        "y": bars.iter().map(|bar| &bar.0).collect::<Vec<_>>(),
        "x": bars.iter().map(|bar| bar.1).collect::<Vec<_>>(),
        "hovertext": bars.iter().map(|bar| format!("{}<br>{}", plot_text(name), bar.2)).collect::<Vec<_>>(),
        "hoverinfo": "text",
    })
}

fn bar_height(runs: usize, traces: usize) -> usize {
    90 + 44 * runs + 22 * traces
}

/// Figure of a run, and the passes that add up to it.
struct Figure {
    of: Option<PassOf>,
    /// Name in titles, after the rays.
    name: &'static str,
    /// Function that returns the figure of a run, where it was measured.
    value: fn(&Run) -> Option<f64>,
}

const FIGURES: [Figure; 5] = [
    Figure { of: Some(PassOf::Pose), name: "pose", value: |run| run.times.pose_ms },
    Figure { of: Some(PassOf::Build), name: "build", value: |run| run.times.build_ms },
    Figure { of: Some(PassOf::Trace), name: "trace", value: |run| run.times.trace_ms },
    Figure { of: Some(PassOf::Image), name: "all passes of the image", value: |run| run.times.image_ms },
    Figure { of: None, name: "passes", value: |_| None },
];

/// Workloads whose runs took equal times in every part, and the runs of the first of these workloads.
struct SharedTimes<'a> {
    workloads: Vec<String>,
    runs: Vec<Bar<'a>>,
}

/// Makes the bars of the passes of each run, one plot per figure that the passes add up to. Builds are shown
/// once for all sets of rays that were traced through them.
pub(super) fn passes(report: &Report) -> Option<Section> {
    let mut plots = Vec::new();
    for figure in FIGURES {
        let ranking = ranked(report.runs.iter().flat_map(|run| in_shares(run, figure.of)));
        let mut shown: Vec<SharedTimes<'_>> = Vec::new();
        for (workload, indices) in by_workload(&report.runs) {
            let runs: Vec<Bar<'_>> = indices
                .iter()
                .map(|index| &report.runs[*index])
                .map(|run| {
                    (run, run.passes.iter().filter(|pass| pass.of == figure.of).map(pass_part).collect())
                })
                .filter(|(_, parts): &Bar<'_>| !parts.is_empty())
                .collect();
            if runs.is_empty() {
                continue;
            }
            match shown.iter_mut().find(|one| same_times(&one.runs, &runs)) {
                Some(same) => same.workloads.push(workload),
                None => shown.push(SharedTimes { workloads: vec![workload], runs }),
            }
        }
        for one in &shown {
            plots.push(pass_plot(plots.len(), &figure, one, &ranking));
        }
    }
    Section::of_plots(
        "passes",
        "Time per pass",
        "What each figure of the summary is made of: all dispatches of a pass together, in the repetition whose time is \
         the median, so that a bar is as long as the figure beside it. A label is the path of the pass's shader; what the \
         host does is hatched. Passes beyond the seven that are the largest parts of their bars share a colour.",
        plots,
    )
}

/// Returns the parts as shares of their bar, so that the parts of short bars are coloured too.
fn in_shares(run: &Run, of: Option<PassOf>) -> Vec<Part<'_>> {
    let passes = || run.passes.iter().filter(|pass| pass.of == of);
    let whole: f64 = passes().map(share).sum();
    passes()
        .map(|pass| Part { size: share(pass) / whole.max(f64::MIN_POSITIVE), ..pass_part(pass) })
        .collect()
}

fn same_times(a: &[Bar<'_>], b: &[Bar<'_>]) -> bool {
    let sizes =
        |parts: &[Part<'_>]| parts.iter().map(|part| (part.name.to_owned(), part.size)).collect::<Vec<_>>();
    let same =
        |(a, b): (&Bar<'_>, &Bar<'_>)| a.0.contestant() == b.0.contestant() && sizes(&a.1) == sizes(&b.1);
    a.len() == b.len() && a.iter().zip(b).all(same)
}

fn pass_plot(position: usize, figure: &Figure, one: &SharedTimes<'_>, ranking: &[&str]) -> Plot {
    let SharedTimes { workloads, runs } = one;
    let workloads = workloads.join(", ");
    let data = stacked(runs, ranking);
    // The figure of the summary is written at the end of each bar.
    let ends = runs.iter().map(|(run, parts)| {
        let length: f64 = parts.iter().map(|part| part.size.max(0.0)).sum();
        let value = (figure.value)(run).unwrap_or(length);
        json!({
            "x": length, "y": bar_name(run), "text": format!("{} ms", milliseconds(value)), "showarrow": false,
            "xanchor": "left", "xshift": 4,
        })
    });
    let layout = json!({
        "barmode": "stack", "xaxis": axes::linear("ms"), "yaxis": axes::names(runs.iter().map(|one| bar_name(one.0))),
        "annotations": ends.collect::<Vec<_>>(),
    });
    Plot {
        id: format!("passes-{position}"),
        title: format!("{workloads}: {}", figure.name),
        note: String::new(),
        description: format!(
            "Stacked bars of the time of each pass, {} for {workloads}: {}.",
            figure.name,
            totals(runs, |size| format!("{size:.3} ms"))
        ),
        height: bar_height(runs.len(), data.len()),
        data,
        layout,
    }
}

/// Describes each bar by its name and its length.
fn totals(runs: &[Bar<'_>], words: impl Fn(f64) -> String) -> String {
    let one = |(run, parts): &Bar<'_>| {
        format!("{} {}", run.contestant(), words(parts.iter().map(|part| part.size).sum()))
    };
    runs.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// Workloads whose runs agree in every byte, and the runs of the first of these workloads.
struct SharedMemory<'a> {
    workloads: Vec<String>,
    runs: Vec<(&'a Run, &'a Memory)>,
}

/// Number of bytes that is drawn as a mark on a bar, and is not a part of the bar.
struct Mark {
    name: &'static str,
    /// Name of the marker in the plots' library.
    symbol: &'static str,
    value: fn(&Memory) -> Option<u64>,
}

const MARKS: [Mark; 2] = [
    Mark { name: "by formula", symbol: "diamond", value: |memory| memory.formula_bytes },
    Mark { name: "capacity", symbol: "line-ns-open", value: |memory| memory.capacity_bytes },
];

/// Makes the bars of the bytes of each structure's parts, marked with the bytes that the formula of the
/// system's page gives.
pub(super) fn memory(report: &Report) -> Option<Section> {
    let parts = report.runs.iter().filter_map(|run| run.memory.as_ref()).flat_map(memory_parts);
    let ranking = ranked(parts);
    let mut shown: Vec<SharedMemory<'_>> = Vec::new();
    for (workload, indices) in by_workload(&report.runs) {
        let own: Vec<(&Run, &Memory)> = indices
            .iter()
            .map(|index| &report.runs[*index])
            .filter_map(|run| Some((run, run.memory.as_ref()?)))
            .filter(|(_, memory)| !memory.by_part.is_empty() || memory.structure_bytes.is_some())
            .collect();
        let same = |others: &[(&Run, &Memory)]| {
            others.len() == own.len()
                && others.iter().zip(&own).all(|(a, b)| a.0.contestant() == b.0.contestant() && a.1 == b.1)
        };
        if own.is_empty() {
            continue;
        }
        // Ray sets share the structure that was built once, and then share a plot.
        match shown.iter_mut().find(|other| same(&other.runs)) {
            Some(other) => other.workloads.push(workload),
            None => shown.push(SharedMemory { workloads: vec![workload], runs: own }),
        }
    }
    let plots = shown
        .iter()
        .enumerate()
        .map(|(position, one)| memory_plot(position, &one.workloads.join(", "), &one.runs, &ranking))
        .collect();
    Section::of_plots(
        "memory",
        "Memory",
        "The structure's allocations by part, in MiB; a part named slack is room that nothing takes up, which \
         the summary leaves out. A diamond is what the formula of the system's page gives for the counted \
         fragments, entries and cells; a line is all that is allocated, slack included.",
        plots,
    )
}

fn memory_plot(position: usize, workload: &str, own: &[(&Run, &Memory)], ranking: &[&str]) -> Plot {
    let whole = |memory: &Memory| -> Option<u64> {
        memory.by_part.is_empty().then_some(memory.structure_bytes).flatten()
    };
    let runs: Vec<Bar<'_>> = own
        .iter()
        .map(|(run, memory)| {
            let mut parts = memory_parts(memory);
            parts.extend(whole(memory).map(|value| Part {
                name: "structure",
                size: value as f64 / MEBIBYTE,
                words: bytes(value),
            }));
            (*run, parts)
        })
        .collect();
    let mut names = ranking.to_vec();
    if own.iter().any(|(_, memory)| whole(memory).is_some()) && !names.contains(&"structure") {
        names.push("structure");
    }
    let mut data = stacked(&runs, &names);
    for Mark { name, symbol, value } in MARKS {
        let found: Vec<_> =
            own.iter().filter_map(|(run, memory)| Some((bar_name(run), value(memory)?))).collect();
        if found.is_empty() {
            continue;
        }
        data.push(json!({
            "type": "scatter", "mode": "markers", "name": name,
            "y": found.iter().map(|one| &one.0).collect::<Vec<_>>(),
            "x": found.iter().map(|one| one.1 as f64 / MEBIBYTE).collect::<Vec<_>>(),
            "hovertext": found.iter().map(|one| format!("{name}<br>{}", bytes(one.1))).collect::<Vec<_>>(),
            "hoverinfo": "text",
            // The page's script gives these marks the colour of text.
            "marker": {"symbol": symbol, "size": 13, "line": {"width": 2}}, "meta": "text-colour",
        }));
    }
    Plot {
        id: format!("memory-{position}"),
        title: format!("{workload}: MiB by part"),
        note: String::new(),
        description: format!(
            "Stacked bars of the bytes of each part of the structures for {workload}: {}.",
            totals(&runs, |size| format!("{size:.3} MiB"))
        ),
        height: bar_height(runs.len(), data.len()),
        data,
        layout: json!({"barmode": "stack", "xaxis": axes::linear("MiB"), "yaxis": axes::names(runs.iter().map(|one| bar_name(one.0)))}),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(name: &str, size: f64) -> Part<'_> {
        Part { name, size, words: format!("{size}") }
    }

    #[test]
    fn parts_are_ranked_by_their_largest_size() {
        let parts = [part("a", 1.0), part("b", 5.0), part("a", 9.0), part("c", 2.0)];
        assert_eq!(ranked(parts.into_iter()), ["a", "b", "c"]);
    }

    #[test]
    fn no_part_is_lost_beyond_the_colours() {
        let run = Run { system: "s".to_owned(), ..Default::default() };
        let names: Vec<String> = (0..12).map(|index| format!("part {index}")).collect();
        let parts = || names.iter().enumerate().map(|(index, name)| part(name, 20.0 - index as f64));
        for count in [1, COLOURED, COLOURED + 1, COLOURED + 2, 12] {
            let ranking = ranked(parts().take(count));
            let traces = stacked(&[(&run, parts().take(count).collect())], &ranking);
            assert!(traces.len() <= COLOURED + 1);
            let drawn: f64 = traces.iter().map(|trace| trace["x"][0].as_f64().expect("a length")).sum();
            let wanted: f64 = parts().take(count).map(|part| part.size).sum();
            assert_eq!(drawn, wanted);
        }
    }
}
