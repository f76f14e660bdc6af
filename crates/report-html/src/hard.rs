//! Hard cases: the demand of each case, and the runs that passed.

use super::markup::Markup;
use super::names::{MOST_HARD_CASES, hard_cases};
use super::section::Section;
use super::sortable::{Heading, table};
use rasray_report::grouped;
use rasray_report::{HardRecord, Report, Run};

/// Returns the verdict in words, and the name of its style.
fn verdict(hard: &HardRecord) -> (&'static str, &'static str) {
    match hard.met {
        Some(true) => ("met", "verdict met"),
        Some(false) => ("not met", "verdict broken"),
        None => ("one run cannot tell", "verdict"),
    }
}

/// Makes the verdicts per contestant, then each verdict with its reason; absent unless hard cases were
/// traced.
pub(super) fn section(report: &Report) -> Option<Section> {
    let runs: Vec<(&Run, &HardRecord)> =
        report.runs.iter().filter_map(|run| Some((run, run.hard.as_ref()?))).collect();
    if runs.is_empty() {
        return None;
    }
    let mut body = Markup::default();
    let cases = hard_cases(&report.runs);
    if cases > MOST_HARD_CASES {
        body.element("p", &[], |text| {
            text.text(format_args!(
                "{} cases have no plots of their own in this page; compare one of them alone to see its plots.",
                grouped(cases as u64)
            ));
        });
    }
    scores(&mut body, &runs);
    verdicts(&mut body, &runs);
    Some(Section::new("hard-cases", "Hard cases", body))
}

/// Writes the number of cases that each contestant passed.
fn scores(body: &mut Markup, runs: &[(&Run, &HardRecord)]) {
    let mut names: Vec<String> = Vec::new();
    for (run, _) in runs {
        let name = run.contestant();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let verdicts = ["met", "not met", "one run cannot tell"].map(|name| Heading::number(name, None));
    let headings = [Heading::words("contestant")].into_iter().chain(verdicts);
    table(body, "Verdicts of each contestant", headings, |rows| {
        for name in &names {
            let count = |wanted: Option<bool>| {
                let own = runs.iter().filter(|(run, hard)| run.contestant() == *name && hard.met == wanted);
                own.count() as u64
            };
            rows.element("tr", &[], |row| {
                row.leaf("th", &[("scope", "row")], name);
                for wanted in [Some(true), Some(false), None] {
                    let count = count(wanted);
                    let cell = [("class", "number"), ("data-value", &count.to_string())];
                    row.leaf("td", &cell, grouped(count));
                }
            });
            rows.fixed("\n");
        }
    });
}

fn verdicts(body: &mut Markup, runs: &[(&Run, &HardRecord)]) {
    let headings = ["case", "contestant", "verdict", "why", "looked at", "target", "what the case is"];
    table(body, "Every verdict", headings.map(Heading::words), |rows| {
        for (run, hard) in runs {
            let (words, look) = verdict(hard);
            rows.element("tr", &[], |row| {
                row.leaf("th", &[("scope", "row")], &hard.id).leaf("td", &[], run.contestant());
                row.element("td", &[], |cell| {
                    cell.leaf("span", &[("class", look)], words);
                });
                for text in [&hard.reason, &hard.measure, &hard.target, &hard.title] {
                    row.leaf("td", &[("class", "prose")], text);
                }
            });
            rows.fixed("\n");
        }
    });
}
