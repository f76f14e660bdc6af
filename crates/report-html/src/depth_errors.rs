//! Distribution of |dt|/t: histograms and percentiles.

use super::axes;
use super::coincide::{Curve, covered, sentence};
use super::markup::plot_text;
use super::names::{by_workload, look};
use super::section::{Plot, Section};
use rasray_report::figures::{DepthErrors, Figures};
use rasray_report::{Accuracy, Report};
use serde_json::{Value, json};

/// Returns |dt|/t at the beginning of bin `index`.
fn edge(index: usize) -> f64 {
    10_f64.powf(DepthErrors::LOW + DepthErrors::WIDTH * index as f64)
}

/// Returns the first bin with a hit in any histogram, and the bin after the last.
fn used<'a>(histograms: impl Iterator<Item = &'a DepthErrors> + Clone) -> Option<(usize, usize)> {
    let filled = |histogram: &'a DepthErrors| {
        histogram.bins.iter().enumerate().filter(|(_, count)| **count > 0).map(|(index, _)| index)
    };
    let first = histograms.clone().filter_map(|one| filled(one).next()).min()?;
    let last = histograms.filter_map(|one| filled(one).next_back()).max()?;
    Some((first, last + 1))
}

/// Returns the number of hits in a histogram.
fn total(histogram: &DepthErrors) -> u64 {
    histogram.zero + histogram.bins.iter().sum::<u64>()
}

/// Makes the histograms, one plot per workload and one line per run.
pub(super) fn histograms(report: &Report, figures: &Figures) -> Option<Section> {
    let mut plots = Vec::new();
    for (position, (workload, indices)) in by_workload(&report.runs).into_iter().enumerate() {
        let own: Vec<&DepthErrors> = indices
            .iter()
            .filter_map(|index| figures.depth_errors.iter().find(|one| one.run == *index))
            .filter(|histogram| total(histogram) > 0)
            .collect();
        if own.is_empty() {
            continue;
        }
        let exact = own.iter().filter(|one| used(std::iter::once(**one)).is_none()).count();
        let Some(range) = used(own.iter().copied()) else {
            continue;
        };
        plots.push(histogram_plot(report, position, &workload, &own, range, exact));
    }
    Section::of_plots(
        "histograms",
        "Errors in t",
        "The share of a run's common hits per quarter of a decade of |dt|/t, on logarithmic axes; the \
         legend says which share has exactly the oracle's t, rounded to f32, and so stands in no bin. The \
         first and the last bin of the scale hold everything beyond.",
        plots,
    )
}

fn histogram_plot(
    report: &Report,
    position: usize,
    workload: &str,
    own: &[&DepthErrors],
    (first, end): (usize, usize),
    exact: usize,
) -> Plot {
    let most = own.iter().map(|one| total(one)).max().unwrap_or(1) as f64;
    // Empty bins are placed below the axis, so that lines leave the plot instead of ending in it.
    let below = 0.01 / most;
    let mut largest = 0.0_f64;
    let mut data = Vec::new();
    let (mut curves, mut names): (Vec<Curve>, Vec<String>) = (Vec::new(), Vec::new());
    for one in own.iter().filter(|one| one.bins.iter().any(|count| *count > 0)) {
        let run = &report.runs[one.run];
        let look = look(&report.runs, run);
        let hits = total(one) as f64;
        let share = |index: usize| one.bins.get(index).map_or(0.0, |count| *count as f64 / hits);
        let (mut x, mut y) = (vec![edge(first)], vec![below]);
        for index in first..end {
            let height = share(index).max(below);
            largest = largest.max(height);
            x.extend([edge(index), edge(index + 1)]);
            y.extend([height, height]);
        }
        x.push(edge(end));
        y.push(below);
        let zero = 100.0 * one.zero as f64 / hits;
        curves.push(y.iter().map(|height| Some(height.log10())).collect());
        names.push(run.contestant());
        data.push(json!({
            "type": "scatter", "mode": "lines", "x": x, "y": y,
            "name": format!("{}, {zero:.1} % exact", plot_text(&run.contestant())),
            "hovertemplate": "|dt|/t %{x:.1e}: %{y:.2%}",
            "line": {"color": look.colour, "dash": look.dash, "width": 2},
        }));
    }
    let mut y = axes::decades("share of common hits", std::iter::once(largest));
    y["range"] = json!([(0.5 / most).log10(), (largest * 2.0).log10().min(0.1)]);
    let [low, high] = [0, 1].map(|end| y["range"][end].as_f64().unwrap_or_default());
    let coinciding = spread_apart(&mut data, curves, &names, high - low);
    let note = match exact {
        0 => String::new(),
        1 => "One run is exact in every hit and has no line.".to_owned(),
        _ => format!("{exact} runs are exact in every hit and have no line."),
    };
    let note = [note, coinciding].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ");
    Plot {
        id: format!("histogram-{position}"),
        title: format!("{workload}: |dt|/t"),
        note,
        description: format!(
            "Histograms of the relative error in t for {workload}, one line a run, between {:.1e} and {:.1e}.",
            edge(first),
            edge(end)
        ),
        height: 400,
        data,
        layout: json!({
            "xaxis": axes::decades("|dt|/t", [edge(first), edge(end)].into_iter()), "yaxis": y,
        }),
    }
}

/// Widens lines that others cover, and describes in words which lines coincide. `decades` is the span of the
/// axis; heights are exponents.
fn spread_apart(data: &mut [Value], curves: Vec<Curve>, names: &[String], decades: f64) -> String {
    let shares = |curve: Curve| curve.into_iter().map(|height| height.map(|one| one / decades)).collect();
    let curves: Vec<Curve> = curves.into_iter().map(shares).collect();
    for (trace, below) in data.iter_mut().zip(covered(&curves)).filter(|(_, below)| *below > 0) {
        let wider = 3.5 * below as f64;
        trace["line"]["width"] = json!(trace["line"]["width"].as_f64().unwrap_or(2.0) + wider);
        trace["opacity"] = json!(0.6);
        if let Some(size) = trace["marker"]["size"].as_f64() {
            trace["marker"]["size"] = json!(size + wider);
        }
    }
    sentence(&curves, names)
}

/// Names of the percentiles, from left to right.
const PERCENTILES: [&str; 5] = ["median", "90 %", "99 %", "99.9 %", "largest"];

/// Returns the names and values of the percentiles that were measured.
fn measured(accuracy: &Accuracy) -> Vec<(&'static str, f64)> {
    let values = [
        accuracy.dt_rel_p50,
        accuracy.dt_rel_p90,
        accuracy.dt_rel_p99,
        accuracy.dt_rel_p999,
        accuracy.dt_rel_max,
    ];
    PERCENTILES
        .into_iter()
        .zip(values)
        .filter_map(|(name, value)| Some((name, value.filter(|value| value.is_finite())?)))
        .collect()
}

/// Makes the plots of percentiles, one plot per workload and one line per run.
pub(super) fn percentiles(report: &Report) -> Option<Section> {
    let mut plots = Vec::new();
    for (position, (workload, indices)) in by_workload(&report.runs).into_iter().enumerate() {
        let floor = edge(0);
        let mut drawn = Vec::new();
        let mut data: Vec<Value> = Vec::new();
        let (mut curves, mut names): (Vec<Curve>, Vec<String>) = (Vec::new(), Vec::new());
        for index in indices {
            let run = &report.runs[index];
            let Some(accuracy) = &run.accuracy else { continue };
            let values = measured(accuracy);
            if values.is_empty() {
                continue;
            }
            let look = look(&report.runs, run);
            let heights: Vec<f64> = values.iter().map(|(_, value)| value.max(floor)).collect();
            let symbols: Vec<String> = values
                .iter()
                .map(|(_, value)| format!("{}{}", look.symbol, if *value == 0.0 { "-open" } else { "" }))
                .collect();
            let words: Vec<String> =
                values.iter().map(|(name, value)| format!("{name}: {value:.2e}")).collect();
            data.push(json!({
                "type": "scatter", "mode": "lines+markers", "name": plot_text(&run.contestant()),
                "x": values.iter().map(|(name, _)| *name).collect::<Vec<_>>(), "y": heights,
                "hovertext": words, "hoverinfo": "text+name",
                "line": {"color": look.colour, "dash": look.dash, "width": 1.5},
                "marker": {"color": look.colour, "symbol": symbols, "size": 10, "line": {"width": 2, "color": look.colour}},
            }));
            curves.push(
                PERCENTILES
                    .map(|wanted| {
                        let found = values.iter().position(|(name, _)| *name == wanted)?;
                        Some(heights[found].log10())
                    })
                    .to_vec(),
            );
            names.push(run.contestant());
            drawn.extend(heights);
        }
        if data.is_empty() {
            continue;
        }
        let axis = axes::decades("|dt|/t", drawn.into_iter());
        let [low, high] = [0, 1].map(|end| axis["range"][end].as_f64().unwrap_or_default());
        let note = spread_apart(&mut data, curves, &names, high - low);
        plots.push(Plot {
            id: format!("percentiles-{position}"),
            title: format!("{workload}: percentiles of |dt|/t"),
            note,
            description: format!("Percentiles of the relative error in t for {workload}, one line a run."),
            height: 380,
            data,
            layout: json!({
                "xaxis": {"type": "category", "automargin": true},
                "yaxis": axis,
            }),
        });
    }
    Section::of_plots(
        "percentiles",
        "Percentiles of |dt|/t",
        "Over hits that the run and the oracle share. Hollow symbols are exact zeros; they, and everything \
         smaller than 1e-9, are drawn at 1e-9. Half a step of f32 is 6e-8.",
        plots,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_are_quarters_of_decades_from_the_lowest() {
        assert_eq!(edge(0), 1.0e-9);
        assert!((edge(4) / 1.0e-8 - 1.0).abs() < 1.0e-12);
        assert!((edge(DepthErrors::BINS) / 10.0 - 1.0).abs() < 1.0e-12);
    }

    #[test]
    fn only_bins_between_the_first_and_the_last_hit_are_drawn() {
        let with = |filled: &[usize]| {
            let mut bins = vec![0; DepthErrors::BINS];
            filled.iter().for_each(|index| bins[*index] = 5);
            DepthErrors { run: 0, zero: 1, bins }
        };
        let histograms = [with(&[7, 9]), with(&[]), with(&[3])];
        assert_eq!(used(histograms.iter()), Some((3, 10)));
        assert_eq!(used(histograms[1..2].iter()), None);
        assert_eq!(total(&histograms[0]), 11);
    }
}
