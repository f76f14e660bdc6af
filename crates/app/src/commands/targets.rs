//! Destinations of the results of a comparison.

use super::steps::{destination, keep_inputs};
use crate::arguments::CompareArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{Destination, Rows, SaveTargets};
use rasray_campaign::csv_table;
use rasray_report::figures::Figures;
use rasray_report::{Campaign, Report, campaign_markdown, json_escaped, markdown};
use std::ffi::OsStr;
use std::path::Path;

/// Destinations of the results.
pub(super) struct Targets {
    report: Option<Destination>,
    /// Report with a line for each cell.
    lines: Option<Destination>,
    html: Option<Destination>,
    markdown: Option<Destination>,
    save: SaveTargets,
}

impl Targets {
    /// Checks every destination before any work begins.
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
        let takes_lines = given.report.as_deref().is_some_and(Rows::are_in);
        if !takes_lines && (given.resume || given.shard.is_some()) {
            let option = if given.resume { "--resume" } else { "--shard" };
            return Err(AppError::usage(
                format!("{option} is of a report with a line per run"),
                "name a .jsonl: --report NAME.jsonl; rasray merge makes a .json of it",
            ));
        }
        let (report, lines) = if takes_lines { (None, report) } else { (report, None) };
        Ok(Self { report, lines, html, markdown, save })
    }

    /// Returns the report with a line for each cell.
    pub(super) fn lines(&self) -> Option<&Destination> {
        self.lines.as_ref()
    }

    /// True if a page is wanted, and with it figures.
    pub(super) fn has_page(&self) -> bool {
        self.html.is_some()
    }

    /// True if a file goes to standard output, which then carries nothing else.
    pub(super) fn take_stdout(&self) -> bool {
        [&self.report, &self.html, &self.markdown].into_iter().flatten().any(Destination::is_stdout)
    }

    /// Returns the destinations of rays and hits.
    pub(super) fn save(&self) -> &SaveTargets {
        &self.save
    }

    /// True if a file keeps the runs.
    pub(super) fn any(&self) -> bool {
        [&self.report, &self.lines, &self.html, &self.markdown].into_iter().any(Option::is_some)
    }

    /// Writes the report and the page, if they are wanted.
    pub(super) fn write(
        &self,
        report: &Report,
        figures: &Figures,
        interrupt: &Interrupt,
    ) -> Result<(), AppError> {
        let forms = [(Form::Json, &self.report), (Form::Markdown, &self.markdown), (Form::Page, &self.html)];
        for (form, place) in forms {
            if let Some(place) = place {
                place.write(&form.of(report, figures)?, interrupt)?;
            }
        }
        Ok(())
    }
}

/// Form of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// JSON with everything that was measured.
    Json,
    /// Markdown table of all ray sets.
    Markdown,
    /// HTML page.
    Page,
    /// CSV of campaigns, with a row per run.
    Csv,
}

impl Form {
    /// Returns the form that a file's name asks for.
    pub(super) fn named(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        Some(match extension.as_str() {
            "json" => Self::Json,
            "md" => Self::Markdown,
            "html" => Self::Page,
            "csv" => Self::Csv,
            _ => return None,
        })
    }

    /// Returns the bytes of the file of a campaign.
    pub(super) fn of_campaign(self, campaign: &Campaign) -> Result<Vec<u8>, AppError> {
        match self {
            Self::Json => Err(AppError::usage(
                "a campaign has no report of one comparison",
                "name a .jsonl, .csv, .md or .html",
            )),
            Self::Markdown => Ok(json_escaped(&campaign_markdown(campaign)).into()),
            Self::Page => Ok(rasray_report_html::campaign_page(campaign)),
            Self::Csv => Ok(csv_table(campaign)),
        }
    }

    /// Returns the bytes of the file of a report.
    pub(super) fn of(self, report: &Report, figures: &Figures) -> Result<Vec<u8>, AppError> {
        Ok(match self {
            Self::Json => json_escaped(&report.to_json()).into(),
            Self::Markdown => markdown(report).into(),
            Self::Csv => {
                return Err(AppError::usage("a .csv is of campaigns", "name a .json, .md, .html or .jsonl"));
            }
            Self::Page => rasray_report_html::page(report, figures).map_err(|error| AppError::Defect {
                message: format!("{error}; the page was not written"),
            })?,
        })
    }
}
