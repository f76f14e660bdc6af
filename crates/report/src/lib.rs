//! Measurements as data: the schema `rasray-report/1`. The command and the full tier of the tests write
//! reports; pages, tables and merges read them.
//!
//! - [`Report`] is a report, with one [`Run`] per system and set of rays or image.
//! - [`Cell`] is one run of a comparison as a line of JSON; [`Campaign`] is the result of a plan.
//! - [`table()`] makes tables for terminals, [`markdown()`] tables for pages.

mod absent;
mod accuracy;
mod campaign;
mod campaign_text;
mod cell;
pub mod colour_scale;
mod cost;
pub mod figures;
mod markdown;
mod run_text;
mod schema;
mod table;
#[cfg(test)]
mod tests;
mod text;
mod words;

pub use accuracy::{Accuracy, Bound, HardRecord, ImageError, RateRecord};
pub use campaign::{Campaign, Experiment, Row, cell_settings, in_order};
pub use campaign_text::{COLUMNS, Column, campaign_markdown, number, rows_markdown};
pub use cell::{CampaignRecord, Cell, CellImage, CellRays, CellRecord, CellView, ExperimentRecord};
pub use cost::{Counters, ListRecord, Memory, Pass, PassOf, Spread, StageTime, Timer, Times};
pub use schema::{
    AdaptiveRecord, CameraRecord, Device, FramesRecord, PoseRecord, Report, Run, SCHEMA, SceneRecord,
    SmallerImageRecord, Statistics,
};

pub use markdown::markdown;
pub use run_text::list_rows;
pub use table::{table, table_within};
pub use text::{escaped, escaped_but, in_line, json_escaped, one_line};
pub use words::{bytes, columns, columns_within, duration, grouped, wrapped};

use rasray_metrics::confidence_of_each;
use serde_json::Value;
use std::collections::BTreeMap;

/// Confidence of each interval by itself.
const CONFIDENCE: f64 = 0.95;

/// Confidence that all family intervals of a report hold.
const FAMILY_CONFIDENCE: f64 = 0.95;

/// Program and command that made a report.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// Version of the program.
    pub version: String,
    /// Commit that the program was built from, where known.
    pub commit: Option<String>,
    /// The command line as it was typed.
    pub command: Option<String>,
}

impl Report {
    /// Makes a report of `runs` on a device and a scene. Each rate gets its family interval, which takes the
    /// number of all rates of the report into account.
    pub fn new(origin: Origin, device: Device, scene: SceneRecord, mut runs: Vec<Run>) -> Self {
        let statistics = widen_intervals(&mut runs);
        Self {
            schema: SCHEMA.to_owned(),
            version: origin.version,
            commit: origin.commit,
            command: origin.command,
            device,
            scene,
            camera: None,
            cell: None,
            statistics,
            runs,
        }
    }

    /// Adds the camera from which the scene was seen.
    #[must_use]
    pub fn seen_from(mut self, camera: CameraRecord) -> Self {
        self.camera = Some(camera);
        self
    }

    /// Writes the report as JSON text with a line break at its end. A number that is not finite is left out,
    /// like a number that was not measured, because JSON cannot represent it.
    pub fn to_json(&self) -> String {
        let mut text =
            serde_json::to_string_pretty(self).expect("strings, numbers and maps with string keys");
        text.push('\n');
        text
    }

    /// Writes the report as JSON in one line, without a line break at its end.
    pub fn to_json_line(&self) -> String {
        serde_json::to_string(self).expect("strings, numbers and maps with string keys")
    }
}

/// Converts options to the form of a report, in which numbers stay numbers.
pub fn options<'a>(resolved: impl IntoIterator<Item = (&'a str, String)>) -> BTreeMap<String, Value> {
    let value = |text: String| match (text.parse::<u64>(), text.parse::<f64>()) {
        (Ok(whole), _) => Value::from(whole),
        (_, Ok(number)) => Value::from(number),
        _ => Value::from(text),
    };
    resolved.into_iter().map(|(name, text)| (name.to_owned(), value(text))).collect()
}

/// Gives every rate its family interval, and returns the confidence of all rates; `None` if there are no
/// rates.
fn widen_intervals(runs: &mut [Run]) -> Option<Statistics> {
    let accuracies = || runs.iter().filter_map(|run| run.accuracy.as_ref());
    let rates = accuracies().map(|accuracy| accuracy.rates.len() as u64).sum();
    let each = confidence_of_each(FAMILY_CONFIDENCE, rates)?;
    for accuracy in runs.iter_mut().filter_map(|run| run.accuracy.as_mut()) {
        for rate in accuracy.rates.values_mut() {
            rate.family_interval = rate.counted().interval_at(each);
        }
    }
    Some(Statistics {
        rates,
        confidence: CONFIDENCE,
        family_confidence: FAMILY_CONFIDENCE,
        confidence_of_each: each,
    })
}

/// Compiles the examples of the readme as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
