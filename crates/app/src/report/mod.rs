//! What was measured: the JSON that machines read and the table that people read.

pub mod figures;
pub mod html;
mod markdown;
mod schema;
mod table;

pub use markdown::markdown;
pub use schema::{
    Accuracy, Bound, Counters, Device, HardRecord, ImageError, Memory, Pass, RateRecord, Report, Run, SCHEMA,
    SceneRecord, Spread, Statistics, Timer, Times,
};
pub use table::table;
pub(crate) use table::{bytes, columns, grouped};

use crate::scene_source::LoadedScene;
use rasray_metrics::confidence_of_each;

/// Confidence of each interval by itself.
const CONFIDENCE: f64 = 0.95;

/// Confidence that all family intervals of a report hold.
const FAMILY_CONFIDENCE: f64 = 0.95;

impl Report {
    /// A report of `runs` on a device and a scene, with this build's version and commit. Gives each rate
    /// the interval that it has as one of all the report's rates.
    pub fn new(device: Device, scene: SceneRecord, command: Option<String>, mut runs: Vec<Run>) -> Self {
        let statistics = widen_intervals(&mut runs);
        Self {
            schema: SCHEMA.to_owned(),
            version: crate::VERSION.to_owned(),
            commit: crate::COMMIT.map(str::to_owned),
            command,
            device,
            scene,
            statistics,
            runs,
        }
    }

    /// The report as JSON text with a line break at its end. A number that is not finite is left out
    /// like one that was not measured: JSON has no word for it.
    pub fn to_json(&self) -> String {
        let mut text =
            serde_json::to_string_pretty(self).expect("strings, numbers and maps with string keys");
        text.push('\n');
        text
    }
}

impl SceneRecord {
    /// What reports say of a scene.
    pub fn of(scene: &LoadedScene) -> Self {
        Self { name: scene.scene.name.clone(), triangles: scene.triangles, sha256: scene.sha256.clone() }
    }
}

/// Gives every rate its family interval; absent if there are no rates.
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

#[cfg(test)]
mod tests;
