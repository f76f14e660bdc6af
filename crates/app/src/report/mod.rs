//! What was measured, for people and for machines: the table, the page, and the JSON of `rasray_report`.

pub mod figures;
pub mod html;
mod markdown;
mod run_text;
mod table;
mod words;

pub use markdown::markdown;
pub use rasray_report::{
    Accuracy, Bound, CameraRecord, Counters, Device, HardRecord, ImageError, Memory, Origin, Pass,
    RateRecord, Report, Run, SCHEMA, SceneRecord, SmallerImageRecord, Spread, Statistics, Timer, Times,
};
pub use table::table;
pub(crate) use words::{bytes, columns, grouped};

/// This build of the command, and the line that was typed.
pub fn origin(line: &str) -> Origin {
    Origin {
        version: crate::VERSION.to_owned(),
        commit: crate::COMMIT.map(str::to_owned),
        command: Some(line.to_owned()),
    }
}
