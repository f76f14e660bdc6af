//! Tables of the summary with one row per run, which a click on a heading sorts.

use super::markup::Markup;
use super::names::{milliseconds, workload};
use super::section::Section;
use super::sortable::{Heading, table};
use rasray_report::{Accuracy, Counters, ImageError, ListRecord, RateRecord, Report, Run, Statistics};
use rasray_report::{bytes, grouped};

/// Cell of a table: its text, and the value by which it is sorted.
struct Cell {
    text: String,
    value: f64,
    /// Confidence interval of the value, in small print.
    range: Option<String>,
}

impl Cell {
    fn new(text: String, value: f64) -> Option<Self> {
        value.is_finite().then_some(Self { text, value, range: None })
    }

    fn with_range(self, range: Option<String>) -> Option<Self> {
        Some(Self { range, ..self })
    }
}

/// Column: its heading, its meaning, and a function for the value of a run, where it was measured.
struct Column {
    heading: &'static str,
    meaning: &'static str,
    cell: fn(&Run) -> Option<Cell>,
    /// True if the column stands beside speed and error in the first table, which is as wide as a page; the
    /// other columns have a table of their own.
    is_main: bool,
}

fn number(value: Option<f64>, digits: usize) -> Option<Cell> {
    let value = value?;
    Cell::new(format!("{value:.digits$}"), value)
}

fn scientific(value: Option<f64>) -> Option<Cell> {
    let value = value?;
    Cell::new(if value == 0.0 { "0".to_owned() } else { format!("{value:.2e}") }, value)
}

fn count(value: Option<u64>) -> Option<Cell> {
    value.and_then(|value| Cell::new(grouped(value), value as f64))
}

/// Makes the cell of a median with its quartiles.
fn median(run: &Run, name: &str, value: Option<f64>) -> Option<Cell> {
    let quartiles = run
        .spread
        .get(name)
        .map(|spread| format!("{} – {}", milliseconds(spread.q1), milliseconds(spread.q3)));
    Cell::new(milliseconds(value?), value?)?.with_range(quartiles)
}

/// Makes the cell of a count with the interval of its rate.
fn rate(run: &Run, name: &str, value: Option<u64>) -> Option<Cell> {
    let record = run.accuracy.as_ref().and_then(|accuracy| accuracy.rates.get(name));
    count(value)?.with_range(record.map(interval))
}

/// Writes the confidence interval of the true rate.
fn interval(record: &RateRecord) -> String {
    let [low, high] = record.interval;
    let words =
        if record.count == 0 { format!("<\u{a0}{high:.1e}") } else { format!("{low:.1e} – {high:.1e}") };
    // A line may break between the two bounds, but not at the sign of an exponent.
    words.replace("e-", "e\u{2011}")
}

fn accuracy<T>(run: &Run, field: impl Fn(&Accuracy) -> Option<T>) -> Option<T> {
    run.accuracy.as_ref().and_then(field)
}

fn counter<T>(run: &Run, field: impl Fn(&Counters) -> Option<T>) -> Option<T> {
    run.counters.as_ref().and_then(field)
}

/// Returns the counts of the lists of all cells together.
fn all_lists(run: &Run) -> Option<&ListRecord> {
    run.counters.as_ref()?.lists.first()
}

fn image(run: &Run, field: impl Fn(&ImageError) -> Option<f64>) -> Option<f64> {
    run.image.as_ref().and_then(field)
}

const COLUMNS: &[Column] = &[
    Column {
        heading: "build ms",
        is_main: true,
        meaning: "posed positions to traceable, host work included; median, and quartiles where repeated",
        cell: |run| median(run, "build_ms", run.times.build_ms),
    },
    Column {
        heading: "trace ms",
        is_main: true,
        meaning: "rays in to hits out; median, and quartiles where repeated",
        cell: |run| median(run, "trace_ms", run.times.trace_ms),
    },
    Column {
        heading: "frame ms",
        is_main: true,
        meaning: "everything; median",
        cell: |run| number(run.times.frame_ms, 3),
    },
    Column {
        heading: "Mrays/s",
        is_main: true,
        meaning: "millions of rays per second of trace time",
        cell: |run| number(run.times.mrays_per_s, 3),
    },
    Column {
        heading: "memory",
        is_main: true,
        meaning: "the structure's allocations after the final build",
        cell: |run| {
            let value = run.memory.as_ref()?.structure_bytes?;
            Cell::new(bytes(value), value as f64)
        },
    },
    Column {
        heading: "image B/pixel",
        is_main: false,
        meaning: "bytes of film, queues and states per pixel of an image",
        cell: |run| number(run.memory.as_ref()?.frame_bytes_per_pixel, 1),
    },
    Column {
        heading: "traced on",
        is_main: false,
        meaning: "share of an image's samples whose first surface sent a mirrored or a refracted ray on",
        cell: |run| number(counter(run, |counters| counters.selected_share), 4),
    },
    Column {
        heading: "cells/ray",
        is_main: false,
        meaning: "cells stepped per ray",
        cell: |run| number(counter(run, |counters| counters.cells_per_ray), 2),
    },
    Column {
        heading: "entries/ray",
        is_main: false,
        meaning: "list entries or tree nodes read per ray",
        cell: |run| number(counter(run, |counters| counters.nodes_per_ray), 2),
    },
    Column {
        heading: "tests/ray",
        is_main: false,
        meaning: "primitive tests per ray",
        cell: |run| number(counter(run, |counters| counters.tests_per_ray), 2),
    },
    Column {
        heading: "views/ray",
        is_main: false,
        meaning: "views entered per ray",
        cell: |run| number(counter(run, |counters| counters.views_per_ray), 2),
    },
    Column {
        heading: "rejected",
        is_main: false,
        meaning: "share of the cells stepped in which nothing was read: empty, or rejected by bounds, buckets or masks",
        cell: |run| number(counter(run, |counters| counters.rejected_share), 4),
    },
    Column {
        heading: "layers",
        is_main: false,
        meaning: "fragments or triangles of a cell that holds any, on average",
        cell: |run| number(all_lists(run)?.layers_mean, 2),
    },
    Column {
        heading: "most layers",
        is_main: false,
        meaning: "of the cell that has most",
        cell: |run| count(Some(all_lists(run)?.layers_most)),
    },
    Column {
        heading: "rays compared",
        is_main: false,
        meaning: "unambiguous rays that the oracle compared",
        cell: |run| count(accuracy(run, |hits| hits.rays.checked_sub(hits.ambiguous))),
    },
    Column {
        heading: "missed",
        is_main: true,
        meaning: "hits that were not found, and the interval of their rate",
        cell: |run| rate(run, "missed", accuracy(run, |hits| Some(hits.missed))),
    },
    Column {
        heading: "false",
        is_main: true,
        meaning: "hits where there is nothing, and the interval of their rate",
        cell: |run| rate(run, "false_hits", accuracy(run, |hits| Some(hits.false_hits))),
    },
    Column {
        heading: "wrong",
        is_main: true,
        meaning: "hits of another primitive, and the interval of their rate; absent where the structure does \
                  not know the primitive",
        cell: |run| rate(run, "wrong_primitive", accuracy(run, |hits| hits.wrong_primitive)),
    },
    Column {
        heading: "t off",
        is_main: true,
        meaning: "hits with a t that the rounding of a careful f32 test does not explain, and the interval of \
                  their rate",
        cell: |run| rate(run, "t_off", accuracy(run, |hits| hits.t_off)),
    },
    Column {
        heading: "not finite",
        is_main: false,
        meaning: "answers that are not finite numbers",
        cell: |run| rate(run, "non_finite", accuracy(run, |hits| Some(hits.non_finite))),
    },
    Column {
        heading: "|dt|/t p50",
        is_main: false,
        meaning: "median of the relative error in t over common hits",
        cell: |run| scientific(accuracy(run, |hits| hits.dt_rel_p50)),
    },
    Column {
        heading: "|dt|/t p99",
        is_main: true,
        meaning: "99th percentile of the relative error in t over common hits",
        cell: |run| scientific(accuracy(run, |hits| hits.dt_rel_p99)),
    },
    Column {
        heading: "|dt|/t max",
        is_main: false,
        meaning: "largest relative error in t over common hits",
        cell: |run| scientific(accuracy(run, |hits| hits.dt_rel_max)),
    },
    Column {
        heading: "FLIP",
        is_main: true,
        meaning: "mean of FLIP against the reference, 0 for equal images",
        cell: |run| number(image(run, |error| error.flip_mean), 5),
    },
    Column {
        heading: "FLIP p99",
        is_main: true,
        meaning: "99th percentile of FLIP",
        cell: |run| number(image(run, |error| error.flip_p99), 5),
    },
    Column {
        heading: "FLIP max",
        is_main: false,
        meaning: "FLIP of the worst pixel",
        cell: |run| number(image(run, |error| error.flip_max), 3),
    },
    Column {
        heading: "FLIP > 0.1",
        is_main: false,
        meaning: "share of the pixels whose FLIP is above 0.1",
        cell: |run| number(image(run, |error| error.flip_visible), 5),
    },
    Column {
        heading: "RMSE",
        is_main: true,
        meaning: "root of the mean squared error of linear colours",
        cell: |run| scientific(image(run, |error| error.rmse)),
    },
    Column {
        heading: "relMSE",
        is_main: false,
        meaning: "relative mean squared error",
        cell: |run| scientific(image(run, |error| error.relmse)),
    },
    Column {
        heading: "PSNR dB",
        is_main: true,
        meaning: "peak signal to noise ratio; absent also where the images are equal",
        cell: |run| number(image(run, |error| error.psnr), 2),
    },
    Column {
        heading: "SSIM",
        is_main: true,
        meaning: "structural similarity, 1 for equal images",
        cell: |run| number(image(run, |error| error.ssim), 5),
    },
];

/// Makes the tables of runs on rays and of runs of images, since the two have different columns: first speed
/// and error, at most as wide as a page, then all other counts.
pub(super) fn section(report: &Report) -> Option<Section> {
    if report.runs.is_empty() {
        return None;
    }
    let (images, rays): (Vec<&Run>, Vec<&Run>) =
        report.runs.iter().partition(|run| run.ray_set.is_none() && run.integrator.is_some());
    let mut body = Markup::default();
    body.fixed(
        "<p class=\"script-only\">A heading sorts by its column; a second time turns the order around.</p>\n",
    );
    let mut explained: Vec<&Column> = Vec::new();
    let tables = [
        ("Rays against the oracle", &rays, true),
        ("Images against the reference", &images, true),
        ("More of rays", &rays, false),
        ("More of images", &images, false),
    ];
    for (title, runs, is_main) in tables {
        // Only columns with a value in some run are shown.
        let measured = |column: &&Column| runs.iter().any(|run| (column.cell)(run).is_some());
        let columns: Vec<&Column> =
            COLUMNS.iter().filter(|column| column.is_main == is_main).filter(measured).collect();
        if runs.is_empty() || (columns.is_empty() && !is_main) {
            continue;
        }
        rows(&mut body, title, runs, &columns);
        for column in columns {
            if !explained.iter().any(|known| known.heading == column.heading) {
                explained.push(column);
            }
        }
    }
    if let Some(statistics) = &report.statistics {
        certainty(&mut body, statistics);
    }
    body.fixed("<details><summary>What the columns mean</summary><dl>");
    for column in explained {
        body.leaf("dt", &[], column.heading).leaf("dd", &[], column.meaning);
    }
    body.fixed("</dl></details>\n");
    Some(Section::new("summary", "Summary", body))
}

/// Writes the confidence of the rates, one by one and together.
fn certainty(body: &mut Markup, statistics: &Statistics) {
    let percent = |part: f64| {
        let digits = format!("{:.4}", 100.0 * part);
        digits.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    body.leaf(
        "p",
        &[],
        format_args!(
            "Small print: quartiles of times; intervals of rates that hold with {} % each (Clopper and Pearson's, or \
             the bound 3/N where nothing was counted). For all {} rates to hold with {} % together each needs {} %: \
             those intervals stand with every run in full.",
            percent(statistics.confidence),
            grouped(statistics.rates),
            percent(statistics.family_confidence),
            percent(statistics.confidence_of_each)
        ),
    );
}

/// Writes a table with one row per run.
fn rows(body: &mut Markup, title: &'static str, runs: &[&Run], columns: &[&Column]) {
    let numbers = columns.iter().map(|column| Heading::number(column.heading, Some(column.meaning)));
    let headings = ["system", "preset", "rays"].map(Heading::words).into_iter().chain(numbers);
    table(body, title, headings, |table| {
        for run in runs {
            row(table, run, columns);
        }
    });
}

fn row(table: &mut Markup, run: &Run, columns: &[&Column]) {
    table.element("tr", &[], |row| {
        row.leaf("th", &[("scope", "row"), ("title", &run.contestant())], &run.system);
        let preset = [Some(run.preset.as_str()), run.variant.as_deref()];
        let preset = preset.into_iter().flatten().collect::<Vec<_>>().join(" ");
        row.leaf("td", &[("class", "wrapped")], preset).leaf("td", &[("class", "wrapped")], workload(run));
        for column in columns {
            match (column.cell)(run) {
                Some(cell) => {
                    let number = [("class", "number"), ("data-value", &cell.value.to_string())];
                    row.element("td", &number, |inside| {
                        inside.text(cell.text);
                        if let Some(range) = cell.range {
                            inside.leaf("span", &[("class", "interval")], range);
                        }
                    })
                }
                None => row.fixed(
                    "<td class=\"number\"><span class=\"absent\" aria-label=\"not measured\">–</span></td>",
                ),
            };
        }
    });
    table.fixed("\n");
}
