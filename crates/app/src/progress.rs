//! The progress line on stderr; hidden when stderr is not a terminal.

use crate::backend::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::Duration;

/// A line that shows what is being done, how far it is and how long it will take.
#[derive(Debug)]
pub struct ProgressLine {
    bar: ProgressBar,
    task: String,
}

impl ProgressLine {
    /// A line that shows itself with the first progress.
    pub fn new() -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(8));
        Self { bar, task: String::new() }
    }

    /// Shows how far the work is.
    pub fn show(&mut self, progress: Progress<'_>) {
        if self.task != progress.task {
            self.task = progress.task.to_owned();
            // Elapsed time and the estimate belong to one task.
            self.bar.reset();
            self.bar.enable_steady_tick(Duration::from_millis(250));
            self.bar.set_style(style(progress.total > 0));
            self.bar.set_message(format!("{} ({})", progress.task, progress.unit));
        }
        if progress.total > 0 {
            self.bar.set_length(progress.total);
        }
        self.bar.set_position(progress.done);
    }

    /// Takes the line away.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}

impl Default for ProgressLine {
    fn default() -> Self {
        Self::new()
    }
}

fn style(bounded: bool) -> ProgressStyle {
    let template = if bounded {
        "{msg} {wide_bar} {human_pos}/{human_len}, {elapsed} gone, {eta} to go"
    } else {
        "{msg} {spinner} {human_pos}, {elapsed} gone"
    };
    ProgressStyle::with_template(template).expect("the templates are constants that a test reads")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_templates_are_valid() {
        style(true);
        style(false);
        let mut line = ProgressLine::new();
        line.show(Progress { task: "trace", done: 1, total: 2, unit: "samples" });
        line.show(Progress { task: "build", done: 1, total: 0, unit: "passes" });
        line.finish();
    }
}
