//! Speed against error, one plot per workload and measure, with the front of the runs that no other run
//! beats.

use super::axes;
use super::markup::plot_text;
use super::names::{by_workload, look};
use super::pareto::{Point, front};
use super::section::{Plot, Section};
use rasray_metrics::Rate;
use rasray_report::figures::DepthErrors;
use rasray_report::grouped;
use rasray_report::{Report, Run};
use serde_json::{Value, json};

/// Run in a plot.
struct Entry<'a> {
    run: &'a Run,
    /// Coordinate from left to right.
    x: f64,
    /// Speed of the run; more is better.
    speed: f64,
    /// Error that was measured.
    error: f64,
    /// Interval of the error, where there is one.
    interval: Option<[f64; 2]>,
    /// Note on the run.
    note: String,
}

/// Axes of a plot.
struct Measure {
    id: &'static str,
    title: &'static str,
    x: &'static str,
    y: &'static str,
    /// True if faster runs stand to the right.
    faster_is_right: bool,
    /// Place of errors that are too small to be told from zero; absent on an axis that has a zero.
    floor: Option<f64>,
}

/// Returns the number of unambiguous rays.
pub(super) fn evaluated(run: &Run) -> Option<u64> {
    let accuracy = run.accuracy.as_ref()?;
    accuracy.rays.checked_sub(accuracy.ambiguous).filter(|rays| *rays > 0)
}

/// Returns the number of missed, false and wrong hits. Where the primitive is unknown, a hit is wrong if
/// rounding does not explain its t.
fn errors(run: &Run) -> Option<u64> {
    let accuracy = run.accuracy.as_ref()?;
    let wrong = accuracy.wrong_primitive.or(accuracy.t_off).unwrap_or(0);
    Some(accuracy.missed + accuracy.false_hits + wrong)
}

/// Returns the rate in millions of rays per second.
fn rate(run: &Run) -> Option<f64> {
    let by_time = || Some(run.times.rays? as f64 / run.times.trace_ms? / 1000.0);
    run.times.mrays_per_s.or_else(by_time).filter(|rate| rate.is_finite() && *rate > 0.0)
}

fn hits(run: &Run) -> Option<Entry<'_>> {
    let (speed, rays, errors) = (rate(run)?, evaluated(run)?, errors(run)?);
    let note = format!("{} errors of {} rays", grouped(errors), grouped(rays));
    let interval = Rate { count: errors, total: rays }.interval();
    Some(Entry { run, x: speed, speed, error: errors as f64 / rays as f64, interval, note })
}

fn depth(run: &Run) -> Option<Entry<'_>> {
    let (speed, error) = (rate(run)?, run.accuracy.as_ref()?.dt_rel_p99?);
    let note = format!("99 % of common hits within {error:.2e}");
    Some(Entry { run, x: speed, speed, error, interval: None, note })
}

fn picture(run: &Run) -> Option<Entry<'_>> {
    let milliseconds = run.times.frame_ms.or(run.times.trace_ms).filter(|time| *time > 0.0)?;
    let error = run.image.as_ref()?.flip_mean?;
    let note = format!("FLIP {error:.5}");
    Some(Entry { run, x: milliseconds, speed: 1.0 / milliseconds, error, interval: None, note })
}

/// Makes all plots. A workload without a run that has both numbers gets no plot.
pub(super) fn section(report: &Report) -> Option<Section> {
    let mut plots = Vec::new();
    for (position, (workload, indices)) in by_workload(&report.runs).into_iter().enumerate() {
        let runs = || indices.iter().map(|index| &report.runs[*index]);
        // Every run traces the rays of one set; the least number that was compared gives the safe floor.
        let rays = runs().filter_map(evaluated).min().unwrap_or(1);
        let kinds: [(Measure, Vec<Entry<'_>>); 3] = [
            (
                Measure {
                    id: "hits",
                    title: "wrong answers",
                    x: "Mrays/s (right is faster)",
                    faster_is_right: true,
                    y: "rate of missed, false and wrong hits",
                    floor: Some(3.0 / rays as f64),
                },
                runs().filter_map(hits).collect(),
            ),
            (
                Measure {
                    id: "depth",
                    title: "error in t",
                    x: "Mrays/s (right is faster)",
                    faster_is_right: true,
                    y: "|dt|/t, 99th percentile",
                    floor: Some(10_f64.powf(DepthErrors::LOW)),
                },
                runs().filter_map(depth).collect(),
            ),
            (
                Measure {
                    id: "picture",
                    title: "FLIP of the image",
                    x: "ms a frame (left is faster)",
                    faster_is_right: false,
                    y: "FLIP, mean",
                    floor: None,
                },
                runs().filter_map(picture).collect(),
            ),
        ];
        for (measure, entries) in kinds {
            if !entries.is_empty() {
                let rays = (measure.id == "hits").then_some(rays);
                plots.push(plot(report, position, &workload, &measure, &entries, rays));
            }
        }
    }
    Section::of_plots(
        "speed-error",
        "Speed against error",
        "Each run is a point; the line is the Pareto front: for a run on it no other run is faster without \
         being less exact. The front is decided by the measured numbers. A colour is a system, a symbol a \
         preset, a bar the 95 % interval of a rate. Where the structure does not know the primitive, a hit is wrong \
         if rounding does not explain its t. Hollow symbols mark errors of exactly zero.",
        plots,
    )
}

fn plot(
    report: &Report,
    position: usize,
    workload: &str,
    measure: &Measure,
    entries: &[Entry<'_>],
    rays: Option<u64>,
) -> Plot {
    let drawn = |entry: &Entry<'_>| entry.error.max(measure.floor.unwrap_or(0.0));
    let points: Vec<_> =
        entries.iter().map(|entry| Point { speed: entry.speed, error: entry.error }).collect();
    let best = front(&points);
    let floor = measure.floor.filter(|floor| entries.iter().any(|entry| entry.error < *floor));
    let (note, shapes) = caption(floor, rays);
    let y = match measure.floor {
        Some(_) => axes::decades(measure.y, entries.iter().map(drawn).chain(floor)),
        None => axes::around_zero(measure.y, entries.iter().map(drawn)),
    };
    let x = axes::close_log(measure.x, entries.iter().map(|entry| entry.x));
    let steps = best.iter().map(|index| [entries[*index].x, drawn(&entries[*index])]).collect();
    let mut data = vec![front_line(steps, measure.faster_is_right, &x, &y)];
    data.extend(entries.iter().map(|entry| marker(report, entry, drawn(entry))));
    let names: Vec<_> = best.iter().map(|index| entries[*index].run.contestant()).collect();
    Plot {
        id: format!("speed-error-{}-{position}", measure.id),
        title: format!("{workload}: speed and {}", measure.title),
        note,
        description: format!(
            "Scatter plot of speed against {} for {workload}. On the Pareto front, slowest first: {}.",
            measure.title,
            names.join(", ")
        ),
        height: 420,
        data,
        layout: json!({"xaxis": x, "yaxis": y, "shapes": shapes}),
    }
}

/// Draws the steps of the front, slowest run first, extended to both edges of the plot: any speed between two
/// runs is reached by the faster of the two, with its error, and any lower speed by the slowest run.
fn front_line(mut steps: Vec<[f64; 2]>, faster_is_right: bool, x: &Value, y: &Value) -> Value {
    if let (Some(slowest), Some(fastest)) = (steps.first().copied(), steps.last().copied())
        && let (Some([left, right]), Some([_, top])) = (axes::ends(x), axes::ends(y))
    {
        steps.insert(0, [if faster_is_right { left } else { right }, slowest[1]]);
        steps.push([fastest[0], top]);
    }
    json!({
        "type": "scatter", "mode": "lines", "name": "Pareto front", "hoverinfo": "skip",
        "x": steps.iter().map(|step| step[0]).collect::<Vec<_>>(),
        "y": steps.iter().map(|step| step[1]).collect::<Vec<_>>(),
        "line": {"shape": "vh", "width": 1.5, "color": "#8c8c8c"},
    })
}

/// Returns the note on the floor, and the line of the floor in the plot.
fn caption(floor: Option<f64>, rays: Option<u64>) -> (String, Vec<Value>) {
    let Some(floor) = floor else { return (String::new(), Vec::new()) };
    let note = match rays {
        Some(rays) => format!(
            "{} rays do not resolve rates under 3/N = {floor:.1e}: smaller ones, zero too, are drawn at that \
             dotted line.",
            grouped(rays)
        ),
        None => format!("Errors under {floor:.0e}, zero too, are drawn at that dotted line."),
    };
    let line = json!({
        "type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": floor, "y1": floor, "layer": "below",
        "line": {"dash": "dot", "width": 1, "color": "#8c8c8c"},
    });
    (note, vec![line])
}

fn marker(report: &Report, entry: &Entry<'_>, drawn: f64) -> Value {
    let look = look(&report.runs, entry.run);
    let symbol = if entry.error == 0.0 { format!("{}-open", look.symbol) } else { look.symbol.to_owned() };
    let mut lines = vec![plot_text(&entry.run.contestant()), plot_text(&entry.note)];
    let times = [("build", entry.run.times.build_ms), ("trace", entry.run.times.trace_ms)];
    for (name, value) in times {
        lines.extend(value.map(|value| format!("{name} {value:.3} ms")));
    }
    let mut trace = json!({
        "type": "scatter", "mode": "markers", "name": plot_text(&entry.run.contestant()),
        "x": [entry.x], "y": [drawn], "hovertext": [lines.join("<br>")], "hoverinfo": "text",
        "marker": {"color": look.colour, "symbol": symbol, "size": 12, "line": {"width": 2, "color": look.colour}},
        "cliponaxis": false,
    });
    if let Some([low, high]) = entry.interval.filter(|_| entry.error > 0.0) {
        trace["error_y"] = json!({
            "type": "data", "symmetric": false, "array": [(high - drawn).max(0.0)], "arrayminus": [(drawn - low).max(0.0)],
            "thickness": 1, "width": 4,
        });
    }
    trace
}
