//! Work of each pixel's ray: heat maps of cells, entries and tests, with one scale per quantity.

use super::markup::Markup;
use super::picture::{address, ramp};
use super::section::Section;
use crate::error::HtmlError;
use rasray_report::Report;
use rasray_report::colour_scale::{VIRIDIS, colour, place};
use rasray_report::figures::{Figures, WorkMap};
use rasray_report::grouped;

/// Quantity that the maps hold.
struct Quantity {
    title: &'static str,
    unit: &'static str,
    values: fn(&WorkMap) -> &[u32],
}

const QUANTITIES: [Quantity; 3] = [
    Quantity { title: "Cells stepped per ray", unit: "cells", values: |map| &map.cells },
    Quantity {
        title: "List entries or tree nodes read per ray",
        unit: "entries",
        values: |map| &map.entries,
    },
    Quantity { title: "Primitive tests per ray", unit: "tests", values: |map| &map.tests },
];

/// Returns the counts that the legend labels: 0, powers of ten or halves of them where few fit, and the
/// largest.
fn ticks(most: u32) -> Vec<u32> {
    let steps: &[u32] = if most < 100 { &[1, 3] } else { &[1] };
    let mut ticks = vec![0];
    let mut power = 1_u32;
    loop {
        for step in steps {
            let tick = power.saturating_mul(*step);
            // Labels that would overlap the label of the largest count are left out.
            if place(tick, most) < 0.88 {
                ticks.push(tick);
            }
        }
        match power.checked_mul(10) {
            Some(next) if next < most => power = next,
            _ => break,
        }
    }
    if most > 0 {
        ticks.push(most);
    }
    ticks.dedup();
    ticks
}

/// Makes the maps. A quantity that is zero for all runs is left out.
///
/// # Errors
/// A map lacks pixels.
pub(super) fn section(report: &Report, figures: &Figures) -> Result<Option<Section>, HtmlError> {
    let mut body = Markup::default();
    let mut shown = false;
    for quantity in &QUANTITIES {
        let most = figures.work.iter().flat_map(|map| (quantity.values)(map)).copied().max().unwrap_or(0);
        if most == 0 {
            continue;
        }
        if !shown {
            body.leaf(
                "p",
                &[],
                "One ray through each pixel's centre. All maps of a quantity share one logarithmic scale; runs that \
                 spent none of it have no map.",
            );
        }
        shown = true;
        body.leaf("h3", &[], quantity.title);
        legend(&mut body, quantity, most)?;
        body.fixed("<div class=\"pictures\">\n");
        // A structure without the quantity has no map of the quantity.
        for map in figures.work.iter().filter(|map| (quantity.values)(map).iter().any(|count| *count > 0)) {
            picture(&mut body, report, map, quantity, most)?;
        }
        body.fixed("</div>\n");
    }
    Ok(shown.then(|| Section::new("work", "Work per ray", body)))
}

fn legend(body: &mut Markup, quantity: &Quantity, most: u32) -> Result<(), HtmlError> {
    let source = ramp(VIRIDIS)?;
    let words = format!("From 0 (dark) to {} (bright) {}", grouped(most.into()), quantity.unit);
    body.element("div", &[("class", "legend")], |body| {
        body.empty("img", &[("src", &source), ("alt", &words)]);
        body.element("div", &[("aria-hidden", "true")], |body| {
            for tick in ticks(most) {
                let left = format!("left:{:.2}%", 100.0 * place(tick, most));
                body.leaf("span", &[("style", &left)], grouped(tick.into()));
            }
        });
    });
    body.fixed("\n");
    Ok(())
}

fn picture(
    body: &mut Markup,
    report: &Report,
    map: &WorkMap,
    quantity: &Quantity,
    most: u32,
) -> Result<(), HtmlError> {
    let values = (quantity.values)(map);
    let rgb: Vec<u8> = values.iter().flat_map(|count| colour(VIRIDIS, place(*count, most))).collect();
    let source = address(map.width, map.height, &rgb)?;
    let mean = values.iter().map(|count| f64::from(*count)).sum::<f64>() / values.len() as f64;
    let largest = values.iter().copied().max().unwrap_or(0);
    let name = report.runs[map.run].contestant();
    let caption = format!("{name}: mean {mean:.2}, most {}", grouped(largest.into()));
    let size = [map.width, map.height].map(|length| length.to_string());
    body.element("figure", &[], |figure| {
        let attributes = [
            ("src", source.as_str()),
            ("alt", &format!("{} of {caption}", quantity.title)),
            ("width", &size[0]),
            ("height", &size[1]),
        ];
        figure.empty("img", &attributes);
        figure.leaf("figcaption", &[], &caption);
    });
    body.fixed("\n");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_runs_from_nothing_to_the_largest_count() {
        assert_eq!((place(0, 50), place(50, 50), place(0, 0)), (0.0, 1.0, 0.0));
        assert!(place(3, 50) > place(2, 50));
    }

    #[test]
    fn labels_ascend_from_zero_to_the_largest_and_stay_apart() {
        for most in [1, 2, 7, 40, 99, 100, 1234, u32::MAX] {
            let found = ticks(most);
            assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "{most}: {found:?}");
            assert_eq!((found[0], found[found.len() - 1]), (0, most));
            assert!(found.len() <= 12, "{most}: {found:?}");
        }
        assert_eq!(ticks(40), [0, 1, 3, 10, 40]);
    }
}
