//! What is being done, on stderr: a line that moves on a terminal, else a line now and then where something takes
//! long. Nothing where quiet was asked for.

use crate::terminal::{self, Talk};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rasray_experiment::Progress;
use std::io::{self, IsTerminal};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// After so long without a terminal a task is told of; then after twice that, and so on.
const FIRST_SIGN: Duration = Duration::from_secs(10);

/// Shows what is being done, how far it is and how long it will take.
#[derive(Debug)]
pub struct ProgressLine {
    bar: ProgressBar,
    task: String,
    signs: Option<Signs>,
}

impl ProgressLine {
    /// A line that shows itself with the first progress.
    pub fn new() -> Self {
        let says = terminal::says(Talk::Usual);
        let target = if says { ProgressDrawTarget::stderr_with_hz(8) } else { ProgressDrawTarget::hidden() };
        let signs = (says && !io::stderr().is_terminal()).then(|| Signs::new(FIRST_SIGN, terminal::note));
        Self { bar: ProgressBar::with_draw_target(None, target), task: String::new(), signs }
    }

    /// Shows how far the work is.
    pub fn show(&mut self, progress: Progress<'_>) {
        let task = rasray_report::one_line(&format!("{} ({})", progress.task, progress.unit));
        if let Some(signs) = &self.signs {
            signs.set(&task, progress);
        }
        if self.task != task {
            self.task = task;
            // Elapsed time and the estimate belong to one task.
            self.bar.reset();
            self.bar.enable_steady_tick(Duration::from_millis(250));
            self.bar.set_style(style(progress.total > 0));
            self.bar.set_message(self.task.clone());
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

/// Does work of which nothing is known but that it goes on: shows what it is.
pub(crate) fn during<T>(task: &str, unit: &str, work: impl FnOnce() -> T) -> T {
    let mut line = ProgressLine::new();
    line.show(Progress { task, done: 0, total: 0, unit });
    let result = work();
    line.finish();
    result
}

fn style(bounded: bool) -> ProgressStyle {
    let template = if bounded {
        "{msg} {wide_bar} {human_pos}/{human_len}, {elapsed} gone, {eta} to go"
    } else {
        "{msg} {spinner} {elapsed} gone"
    };
    ProgressStyle::with_template(template).expect("the templates are constants that a test reads")
}

/// Tells of tasks that take long, from a thread of its own, since the work may not come back for minutes.
#[derive(Debug)]
struct Signs {
    /// Gone when there are no more; the thread ends with it.
    sender: Option<Sender<Sign>>,
    thread: Option<JoinHandle<()>>,
}

/// How far a task is.
#[derive(Debug)]
struct Sign {
    task: String,
    done: u64,
    total: u64,
}

impl Sign {
    fn told(&self, gone: Duration) -> String {
        let count = match (self.done, self.total) {
            (_, 0) => String::new(),
            (done, total) => format!("{done} of {total}, "),
        };
        format!("{}: {count}{:.0} s gone", self.task, gone.as_secs_f64())
    }
}

impl Signs {
    /// Calls `tell` once a task has taken `first`, and again after each doubling of that.
    fn new(first: Duration, tell: impl Fn(&str) + Send + 'static) -> Self {
        let (sender, receiver) = mpsc::channel::<Sign>();
        let watch = move || {
            let Ok(mut sign) = receiver.recv() else { return };
            let (mut begun, mut next) = (Instant::now(), first);
            loop {
                match receiver.recv_timeout(next.saturating_sub(begun.elapsed())) {
                    Ok(new) => {
                        if new.task != sign.task {
                            (begun, next) = (Instant::now(), first);
                        }
                        sign = new;
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return,
                }
                if begun.elapsed() >= next {
                    tell(&sign.told(begun.elapsed()));
                    next *= 2;
                }
            }
        };
        // Without a thread there are no signs; the work does not depend on them.
        let thread = std::thread::Builder::new().name("signs of progress".to_owned()).spawn(watch).ok();
        Self { sender: Some(sender), thread }
    }

    fn set(&self, task: &str, progress: Progress<'_>) {
        let sign = Sign { task: task.to_owned(), done: progress.done, total: progress.total };
        // Nobody listens where the thread could not be made.
        _ = self.sender.as_ref().map(|sender| sender.send(sign));
    }
}

impl Drop for Signs {
    fn drop(&mut self) {
        self.sender = None;
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has told of it.
            _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::{Arc, Mutex};

    #[test]
    fn both_templates_are_valid() {
        style(true);
        style(false);
        let mut line = ProgressLine::new();
        line.show(Progress { task: "trace", done: 1, total: 2, unit: "samples" });
        line.show(Progress { task: "build", done: 1, total: 0, unit: "passes" });
        line.finish();
        assert_eq!(during("scene", "reading", || 7), 7);
    }

    #[test]
    fn only_what_takes_long_is_told_of_and_ever_more_seldom() {
        let told = Arc::new(Mutex::new(Vec::new()));
        let kept = Arc::clone(&told);
        let signs = Signs::new(Duration::from_millis(40), move |text| {
            kept.lock().expect("no panic").push(text.to_owned());
        });
        let progress = |done, total| Progress { task: "", done, total, unit: "" };
        signs.set("short", progress(0, 0));
        signs.set("long", progress(0, 0));
        std::thread::sleep(Duration::from_millis(60));
        signs.set("long", progress(3, 9));
        std::thread::sleep(Duration::from_millis(400));
        drop(signs);
        let told = told.lock().expect("no panic").clone();
        assert!(told.iter().all(|text| text.starts_with("long: ")), "{told:?}");
        assert!(told.first().is_some_and(|text| !text.contains("of 9")), "{told:?}");
        // After 40, 80, 160 and 320 ms; a machine that is busy elsewhere may miss some, and makes up for none.
        assert!(
            (2..=5).contains(&told.len()) && told.last().is_some_and(|text| text.contains("3 of 9")),
            "{told:?}"
        );
    }
}
