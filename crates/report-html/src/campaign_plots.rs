//! Plots of an experiment: bars of each variant, curves over each parameter, speed against error.

use super::axes;
use super::markup::plot_text;
use super::names::part_colour;
use super::section::Plot;
use rasray_report::{Experiment, Row, number};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Least number of different values at which a setting of numbers counts as a parameter with curves over it.
const LEAST_POINTS: usize = 3;

/// Ratio of the greatest to the least value at which the axis of a parameter becomes logarithmic.
const LOG_FROM: f64 = 8.0;

/// Result that is drawn.
struct Measure {
    name: &'static str,
    title: &'static str,
    /// Label of the axis.
    words: &'static str,
    /// Name of the repeated times in the spread of a run, from which the error bar of the result is computed;
    /// absent where the result has no repeated times.
    spread: Option<&'static str>,
    is_error: bool,
}

const SPEED: Measure = Measure {
    name: "mrays_per_s",
    title: "trace",
    words: "Mrays/s (more is faster)",
    spread: Some("trace_ms"),
    is_error: false,
};

const IMAGE: Measure = Measure {
    name: "image_ms",
    title: "image",
    words: "ms of an image (less is faster)",
    spread: None,
    is_error: false,
};

const BUILD: Measure = Measure {
    name: "build_ms",
    title: "build",
    words: "ms of a build (less is faster)",
    spread: Some("build_ms"),
    is_error: false,
};

const WRONG: Measure = Measure {
    name: "error_share",
    title: "wrong hits",
    words: "share of hits missed, false or wrong",
    spread: None,
    is_error: true,
};

const FLIP: Measure =
    Measure { name: "image.flip_mean", title: "FLIP", words: "FLIP, mean", spread: None, is_error: true };

/// Name of a row in a plot, made of the settings in which rows differ.
struct Label {
    /// Name of the contestant: system, preset, options.
    contestant: String,
    /// Name of the workload: scene, and rays or image.
    workload: String,
}

impl Label {
    fn of(row: &Row, varied: &[&str]) -> Self {
        let options = row.report.cell.as_ref().map(|cell| &cell.depends_on.options);
        let mut contestant = vec![row.setting("system").to_owned(), row.setting("preset").to_owned()];
        let mut workload = Vec::new();
        for name in varied.iter().copied().filter(|name| row.settings.contains_key(*name)) {
            let value = row.setting(name);
            match name {
                "system" | "preset" | "seed" => {}
                name if options.is_some_and(|options| options.contains_key(name)) => {
                    contestant.push(format!("{name}={value}"));
                }
                "scene" | "ray-set" | "integrator" => workload.push(value.to_owned()),
                name => workload.push(format!("{name} {value}")),
            }
        }
        Self { contestant: contestant.join(" "), workload: workload.join(", ") }
    }
}

/// Point of a plot: the values of rows that differ only in the seed.
struct Point {
    middle: f64,
    low: f64,
    high: f64,
}

impl Point {
    fn of(rows: &[&Row], measure: &Measure) -> Option<Self> {
        let mut values: Vec<f64> =
            rows.iter().filter_map(|row| row.results.get(measure.name).copied()).collect();
        values.sort_by(f64::total_cmp);
        let (low, high) = (*values.first()?, *values.last()?);
        let middle = 0.5 * (values[(values.len() - 1) / 2] + values[values.len() / 2]);
        // With one seed the error bar is the spread of repetitions: half of them lie between the quartiles.
        if let ([row], Some(name)) = (rows, measure.spread)
            && let Some(spread) = row.run().spread.get(name)
        {
            let time = row.results.get(name).copied()?;
            let at = |ms: f64| if measure.name == name { ms } else { middle * time / ms };
            let (one, two) = (at(spread.q1), at(spread.q3));
            return Some(Self { middle, low: one.min(two).min(middle), high: one.max(two).max(middle) });
        }
        Some(Self { middle, low, high })
    }
}

/// Makes all plots of an experiment, whose anchors begin with `anchor`.
pub(super) fn plots(anchor: &str, experiment: &Experiment) -> Vec<Plot> {
    let mut plots = Vec::new();
    plots.extend(
        [(SPEED, WRONG), (IMAGE, FLIP)].iter().filter_map(|(x, y)| scatter(anchor, experiment, x, y)),
    );
    let parameters = parameters(experiment);
    for parameter in &parameters {
        let measures = [SPEED, IMAGE, BUILD, WRONG, FLIP];
        plots.extend(measures.iter().filter_map(|measure| curves(anchor, experiment, parameter, measure)));
    }
    // Bars of each value would repeat the curves.
    if parameters.is_empty() {
        plots.extend([SPEED, IMAGE, BUILD].iter().filter_map(|measure| bars(anchor, experiment, measure)));
    }
    plots
}

/// Returns the settings with several numbers as values.
fn parameters(experiment: &Experiment) -> Vec<&str> {
    let is_parameter = |name: &&str| {
        let values: BTreeSet<&str> =
            experiment.rows.iter().filter_map(|row| row.settings.get(*name).map(String::as_str)).collect();
        *name != "seed"
            && values.len() >= LEAST_POINTS
            && values.iter().all(|value| value.parse::<f64>().is_ok_and(f64::is_finite))
    };
    experiment.varied().into_iter().filter(is_parameter).collect()
}

/// Values with names, in order of appearance.
type Named<T> = Vec<(String, T)>;

/// Groups the rows that have the result by two names.
fn grouped<'a>(
    experiment: &'a Experiment,
    measure: &Measure,
    names: impl Fn(&'a Row) -> Option<(String, String)>,
) -> Named<Named<Vec<&'a Row>>> {
    let mut groups: Named<Named<Vec<&Row>>> = Vec::new();
    for row in experiment.rows.iter().filter(|row| row.results.contains_key(measure.name)) {
        let Some((outer, inner)) = names(row) else { continue };
        let group = place_of(&mut groups, outer);
        place_of(group, inner).push(row);
    }
    groups
}

/// Returns the value of a name, which is inserted if absent.
fn place_of<T: Default>(named: &mut Named<T>, name: String) -> &mut T {
    let place = named.iter().position(|(other, _)| *other == name).unwrap_or_else(|| {
        named.push((name, T::default()));
        named.len() - 1
    });
    &mut named[place].1
}

fn bars(anchor: &str, experiment: &Experiment, measure: &Measure) -> Option<Plot> {
    let varied = experiment.varied();
    let groups = grouped(experiment, measure, |row| {
        let label = Label::of(row, &varied);
        Some((label.workload, label.contestant))
    });
    let mut names: Vec<&str> = Vec::new();
    let mut data = Vec::new();
    for (index, (workload, bars)) in groups.iter().enumerate() {
        let (mut x, mut y, mut more, mut less) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (contestant, rows) in bars {
            let Some(point) = Point::of(rows, measure) else { continue };
            if !names.contains(&contestant.as_str()) {
                names.push(contestant);
            }
            y.push(plot_text(contestant));
            x.push(point.middle);
            more.push(point.high - point.middle);
            less.push(point.middle - point.low);
        }
        data.push(json!({
            "type": "bar", "orientation": "h", "name": plot_text(workload), "x": x, "y": y,
            "hovertemplate": "%{y}: %{x:.3g}", "marker": {"color": part_colour(index)},
            "error_x": {"type": "data", "symmetric": false, "array": more, "arrayminus": less, "thickness": 1},
        }));
    }
    let bars: usize = groups.iter().map(|(_, bars)| bars.len()).sum();
    (bars > 1).then(|| Plot {
        id: format!("{anchor}-bars-{}", measure.name),
        title: format!("{}: {}", measure.title, measure.words),
        note: String::new(),
        description: format!("Bars of {}: one for each of {}.", measure.words, names.join(", ")),
        height: 140 + 22 * bars + 14 * names.len(),
        data,
        layout: json!({
            "barmode": "group", "xaxis": axes::linear(measure.words),
            "yaxis": axes::names(names.iter().map(|name| plot_text(name))),
        }),
    })
}

fn curves(anchor: &str, experiment: &Experiment, parameter: &str, measure: &Measure) -> Option<Plot> {
    let others: Vec<_> = experiment.varied().into_iter().filter(|name| *name != parameter).collect();
    let groups = grouped(experiment, measure, |row| {
        let Label { contestant, workload } = Label::of(row, &others);
        let line = [contestant, workload].into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>();
        Some((line.join(", "), row.settings.get(parameter)?.clone()))
    });
    let lines: Named<Vec<(f64, Point)>> = groups
        .into_iter()
        .filter_map(|(name, values)| {
            let point = |(value, rows): &(String, Vec<&Row>)| {
                Some((value.parse::<f64>().ok()?, Point::of(rows, measure)?))
            };
            let mut points: Vec<_> = values.iter().filter_map(point).collect();
            points.sort_by(|one, two| one.0.total_cmp(&two.0));
            (points.len() > 1).then_some((name, points))
        })
        .collect();
    if lines.is_empty() {
        return None;
    }
    let of = |pick: fn(&(f64, Point)) -> f64| lines.iter().flat_map(move |line| line.1.iter().map(pick));
    let (least, most) = of(|point| point.0).fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
    let x_axis = if least > 0.0 && most >= LOG_FROM * least {
        axes::close_log(parameter, of(|point| point.0))
    } else {
        json!({"title": {"text": parameter}, "automargin": true})
    };
    let y_axis = if measure.is_error {
        axes::around_zero(measure.words, of(|point| point.1.high))
    } else {
        axes::close_log(measure.words, of(|point| point.1.middle))
    };
    let data = lines.iter().enumerate().map(|(index, (name, points))| {
        let each = |pick: fn(&Point) -> f64| points.iter().map(|point| pick(&point.1)).collect::<Vec<_>>();
        json!({
            "type": "scatter", "mode": "lines+markers", "name": plot_text(name),
            "x": points.iter().map(|point| point.0).collect::<Vec<_>>(), "y": each(|point| point.middle),
            "line": {"color": part_colour(index), "width": 2}, "marker": {"size": 7},
            "error_y": {
                "type": "data", "symmetric": false, "array": each(|point| point.high - point.middle),
                "arrayminus": each(|point| point.middle - point.low), "thickness": 1,
            },
        })
    });
    let names: Vec<_> = lines.iter().map(|line| line.0.as_str()).collect();
    Some(Plot {
        id: format!("{anchor}-{parameter}-{}", measure.name),
        title: format!("{} over {parameter}", measure.title),
        note: String::new(),
        description: format!("Lines of {} over {parameter}: {}.", measure.words, names.join("; ")),
        height: 420,
        data: data.collect(),
        layout: json!({"xaxis": x_axis, "yaxis": y_axis}),
    })
}

fn scatter(anchor: &str, experiment: &Experiment, speed: &Measure, error: &Measure) -> Option<Plot> {
    let varied = experiment.varied();
    let groups_by = |of: fn(Label) -> (String, String)| {
        let names = |row: &Row| row.results.contains_key(error.name).then(|| of(Label::of(row, &varied)));
        grouped(experiment, speed, names)
    };
    let mut groups = groups_by(|label| (label.contestant, label.workload));
    // Workloads tell the points of a single contestant apart.
    if groups.len() == 1 {
        groups = groups_by(|label| (label.workload, label.contestant));
    }
    let points: Vec<_> = groups
        .iter()
        .flat_map(|(contestant, loads)| loads.iter().map(move |(load, rows)| (contestant, load, rows)))
        .filter_map(|(contestant, load, rows)| {
            Some((contestant, load, Point::of(rows, speed)?, Point::of(rows, error)?))
        })
        .collect();
    if points.len() < 2 {
        return None;
    }
    // For shares of rays, the floor is the smallest share that so many rays resolve; zero is drawn there.
    let compared = |row: &Row| row.run().accuracy.as_ref().map(|accuracy| accuracy.rays - accuracy.ambiguous);
    let floor = match error.name {
        "error_share" => {
            let rays = experiment.rows.iter().filter_map(compared).filter(|rays| *rays > 0).min();
            rays.map_or(0.0, |rays| 1.0 / rays as f64)
        }
        _ => 0.0,
    };
    let drawn = |value: f64| value.max(floor);
    let note = if floor > 0.0 && points.iter().any(|point| point.3.middle < floor) {
        format!("Hollow symbols are at zero; so many rays resolve {}.", number(floor))
    } else {
        String::new()
    };
    let mut data: Vec<Value> = Vec::new();
    let colours: BTreeMap<&str, usize> =
        groups.iter().enumerate().map(|(index, group)| (group.0.as_str(), index)).collect();
    for (name, _) in &groups {
        let own: Vec<_> = points.iter().filter(|point| point.0 == name).collect();
        let colour = part_colour(colours[name.as_str()]);
        let symbol = |value: f64| if value == 0.0 { "circle-open" } else { "circle" };
        data.push(json!({
            "type": "scatter", "mode": "markers", "name": plot_text(name), "hoverinfo": "text",
            "x": own.iter().map(|point| point.2.middle).collect::<Vec<_>>(),
            "y": own.iter().map(|point| drawn(point.3.middle)).collect::<Vec<_>>(),
            "hovertext": own.iter().map(|(name, load, x, y)| {
                format!("{}<br>{}<br>{} {}<br>{} {}", plot_text(name), plot_text(load), speed.title,
                    number(x.middle), error.title, number(y.middle))
            }).collect::<Vec<_>>(),
            "marker": {
                "color": colour, "size": 11, "line": {"width": 2, "color": colour},
                "symbol": own.iter().map(|point| symbol(point.3.middle)).collect::<Vec<_>>(),
            },
        }));
    }
    let x_axis = axes::close_log(speed.words, points.iter().map(|point| point.2.middle));
    let errors = points.iter().map(|point| drawn(point.3.middle));
    let y_axis =
        if floor > 0.0 { axes::decades(error.words, errors) } else { axes::around_zero(error.words, errors) };
    let names: Vec<_> = groups.iter().map(|group| group.0.as_str()).collect();
    Some(Plot {
        id: format!("{anchor}-{}-{}", speed.name, error.name),
        title: format!("Speed against error: {}", error.title),
        note,
        description: format!("Points of {} against {}, of {}.", speed.words, error.words, names.join(", ")),
        height: 420,
        data,
        layout: json!({"xaxis": x_axis, "yaxis": y_axis}),
    })
}
