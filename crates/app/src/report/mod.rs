//! What was measured, as text: tables and lines. The page is that of `rasray_report_html`, the JSON that of
//! `rasray_report`.

mod markdown;
mod run_text;
mod table;

pub use markdown::markdown;
pub use rasray_report::{
    Accuracy, Bound, CameraRecord, Counters, Device, HardRecord, ImageError, Memory, Origin, Pass,
    RateRecord, Report, Run, SCHEMA, SceneRecord, SmallerImageRecord, Spread, Statistics, Timer, Times,
    bytes, columns, grouped,
};
pub use table::table;

/// This build of the command, and the line that was typed.
pub fn origin(line: &str) -> Origin {
    Origin {
        version: crate::VERSION.to_owned(),
        commit: crate::COMMIT.map(str::to_owned),
        command: Some(line.to_owned()),
    }
}
