//! Mistakes on the command line, as the command reports them.

use crate::error::AppError;
use rasray_report::one_line;

/// Turns an answer of the parser into one line of error and one of help; the help names the command
/// whose options are meant.
pub(super) fn usage_error(error: &clap::Error, command: Option<&str>) -> AppError {
    let text = error.render().to_string();
    let (mut message, mut help) = (String::new(), String::new());
    for paragraph in text.split("\n\n") {
        let paragraph = paragraph.trim();
        if let Some(rest) = paragraph.strip_prefix("error: ") {
            message = one_line(rest);
        } else if paragraph.starts_with("tip: ") {
            let tips = paragraph.lines().filter_map(|line| line.trim().strip_prefix("tip: "));
            help = tips.collect::<Vec<_>>().join("; ");
        }
    }
    if help.is_empty() {
        help = match command {
            Some(command) => format!("'rasray {command} --help' lists what it takes, --help-all everything"),
            None => "'rasray --help' lists what there is".to_owned(),
        };
    }
    AppError::usage(message, help)
}
