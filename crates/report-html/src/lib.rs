//! Pages of reports: `rasray compare --html` and campaigns write a report as one file that needs no other
//! file, no server and no network.
//!
//! - [`page()`] makes the page of a [`Report`].
//! - [`campaign_page`] makes the page of a campaign.
//!
//! Each section of a page is made by a module of its own, and is absent where its data was not measured.
//! Figures are computed here; the script of the page only draws, sorts and slides.

mod axes;
mod bars;
mod campaign;
mod campaign_plots;
mod coincide;
mod depth_errors;
mod details;
mod document;
mod error;
mod hard;
mod images;
mod markup;
mod names;
mod pareto;
mod picture;
mod section;
mod sortable;
mod speed_error;
mod summary;
mod work;

pub use campaign::campaign_page;
pub use error::HtmlError;

use error::misfit;
use rasray_report::Report;
use rasray_report::figures::Figures;

/// Writes the page of a report as UTF-8 text.
///
/// # Errors
/// Figures do not fit the report: they belong to a run that is not there, or a picture lacks pixels.
pub fn page(report: &Report, figures: &Figures) -> Result<Vec<u8>, HtmlError> {
    check(report, figures)?;
    // Charts stand before tables, because charts are understood at once. With many hard cases the verdicts
    // are the summary, and the table with a row per run is for looking up.
    let (summary, hard) = (summary::section(report), hard::section(report));
    let many = names::hard_cases(&report.runs) > names::MOST_HARD_CASES;
    let [first, second] = if many { [hard, summary] } else { [summary, hard] };
    let sections: Vec<_> = [
        speed_error::section(report),
        bars::passes(report),
        bars::memory(report),
        depth_errors::histograms(report, figures),
        depth_errors::percentiles(report),
        first,
        second,
        work::section(report, figures)?,
        images::section(report, figures)?,
        details::section(report)?,
    ]
    .into_iter()
    .flatten()
    .collect();
    Ok(document::of_report(report, &sections).into_bytes())
}

fn check(report: &Report, figures: &Figures) -> Result<(), HtmlError> {
    let runs = figures.work.iter().map(|map| map.run).chain(figures.depth_errors.iter().map(|one| one.run));
    let images = figures.images.iter().flat_map(|images| &images.systems).map(|system| system.run);
    match runs.chain(images).find(|run| *run >= report.runs.len()) {
        Some(run) => Err(misfit(format!("a figure belongs to run {run} of {}", report.runs.len()))),
        None => Ok(()),
    }
}

/// Compiles the examples of the readme as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
