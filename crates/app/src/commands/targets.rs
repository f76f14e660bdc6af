//! Where the results of a comparison go.

use super::steps::{destination, keep_inputs};
use crate::arguments::CompareArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{Destination, SaveTargets};
use rasray_report::figures::Figures;
use rasray_report::{Report, json_shown, markdown};
use std::ffi::OsStr;

/// Where results go.
pub(super) struct Targets {
    report: Option<Destination>,
    html: Option<Destination>,
    markdown: Option<Destination>,
    save: SaveTargets,
}

impl Targets {
    /// Checks every place before anything is begun.
    pub(super) fn check(given: &CompareArguments, scene: &OsStr) -> Result<Self, AppError> {
        let report = destination(given.report.as_deref())?;
        let html = destination(given.html.as_deref())?;
        let markdown = destination(given.markdown.as_deref())?;
        let named = [("--report", &report), ("--html", &html), ("--markdown", &markdown)];
        for (index, (option, place)) in named.iter().enumerate() {
            for (other, twin) in &named[..index] {
                if let (Some(place), Some(twin)) = (place, twin)
                    && place.same_as(twin)
                {
                    return Err(AppError::usage(
                        format!("{other} and {option} name the same file"),
                        "name two files",
                    ));
                }
            }
        }
        keep_inputs("--report", report.as_ref(), scene)?;
        keep_inputs("--html", html.as_ref(), scene)?;
        keep_inputs("--markdown", markdown.as_ref(), scene)?;
        let save = SaveTargets::check(given.files.save_rays.as_deref(), given.files.save_hits.as_deref())?;
        Ok(Self { report, html, markdown, save })
    }

    /// Whether a page is wanted, and with it figures.
    pub(super) fn has_page(&self) -> bool {
        self.html.is_some()
    }

    /// Whether a file goes to standard output, which then carries nothing else.
    pub(super) fn take_stdout(&self) -> bool {
        [&self.report, &self.html, &self.markdown].into_iter().flatten().any(Destination::is_stdout)
    }

    /// Where rays and hits go.
    pub(super) fn save(&self) -> &SaveTargets {
        &self.save
    }

    /// Whether a file keeps the runs.
    pub(super) fn any(&self) -> bool {
        self.report.is_some() || self.html.is_some() || self.markdown.is_some()
    }

    /// Writes the report and the page where they are wanted.
    pub(super) fn write(
        &self,
        report: &Report,
        figures: &Figures,
        interrupt: &Interrupt,
    ) -> Result<(), AppError> {
        if let Some(place) = &self.report {
            place.write(json_shown(&report.to_json()).as_bytes(), interrupt)?;
        }
        if let Some(place) = &self.markdown {
            place.write(markdown(report).as_bytes(), interrupt)?;
        }
        if let Some(place) = &self.html {
            let page = rasray_report_html::page(report, figures).map_err(|error| {
                let help =
                    "the page was not written; this is a defect, please report it with the command line";
                AppError::refused(error.to_string(), help)
            })?;
            place.write(&page, interrupt)?;
        }
        Ok(())
    }
}
