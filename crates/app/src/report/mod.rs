//! What was measured, as text: tables and lines. The page is that of `rasray_report_html`, the JSON that of
//! `rasray_report`.

mod camera;
mod markdown;
mod run_text;
mod table;

pub(crate) use camera::described;
pub use markdown::markdown;
pub use table::table;

use rasray_report::Origin;

/// This build of the command, and the line that was typed.
pub fn origin(line: &str) -> Origin {
    Origin {
        version: crate::version::VERSION.to_owned(),
        commit: crate::version::COMMIT.map(str::to_owned),
        command: Some(line.to_owned()),
    }
}
