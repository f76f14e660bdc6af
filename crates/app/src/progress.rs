//! Progress of work on stderr: a line that is updated on a terminal, otherwise an occasional line for work
//! that takes long. Nothing is shown if quiet was asked for.

use crate::terminal::{self, Talk};
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use rasray_experiment::Progress;
use std::io::{self, IsTerminal};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Time after which a task is first reported without a terminal; later reports follow after twice that, and
/// so on.
const FIRST_SIGN: Duration = Duration::from_secs(10);

/// Line that shows the current task, its progress and the remaining time.
#[derive(Debug)]
pub struct ProgressLine {
    bar: ProgressBar,
    task: String,
    count: Count,
    signs: Option<Signs>,
}

impl ProgressLine {
    /// Makes a line that appears with the first progress.
    pub fn new() -> Self {
        let says = terminal::says(Talk::Usual);
        let target = if says { ProgressDrawTarget::stderr_with_hz(8) } else { ProgressDrawTarget::hidden() };
        let signs = (says && !io::stderr().is_terminal()).then(|| Signs::new(FIRST_SIGN, terminal::note));
        Self {
            bar: ProgressBar::with_draw_target(None, target),
            task: String::new(),
            count: Count::default(),
            signs,
        }
    }

    /// Shows the progress of the work.
    pub fn show(&mut self, progress: Progress<'_>) {
        let task = rasray_report::one_line(&format!("{} ({})", progress.task, progress.unit));
        if let Some(signs) = &self.signs {
            signs.set(&task, progress);
        }
        let begins = self.task != task;
        if begins {
            self.task = task;
            // The elapsed time belongs to one task.
            self.bar.reset();
            self.bar.enable_steady_tick(Duration::from_millis(250));
        }
        let to_go = self.count.time_left(progress, Instant::now());
        let words = to_go.map_or(String::new(), |left| format!(", {} to go", HumanDuration(left)));
        self.bar.set_prefix(words);
        if begins {
            self.bar.set_style(style(progress.total > 0));
            self.bar.set_message(self.task.clone());
        }
        if progress.total > 0 {
            self.bar.set_length(progress.total);
        }
        self.bar.set_position(progress.done);
    }

    /// Removes the line.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}

impl Default for ProgressLine {
    fn default() -> Self {
        Self::new()
    }
}

/// Does work of unknown length, and shows its name meanwhile.
pub(crate) fn during<T>(task: &str, unit: &str, work: impl FnOnce() -> T) -> T {
    let mut line = ProgressLine::new();
    line.show(Progress { task, done: 0, total: 0, unit });
    let result = work();
    line.finish();
    result
}

/// Counted work and its beginning: tasks with equal unit and total are parts of one piece of work.
#[derive(Debug, Default)]
struct Count {
    unit: String,
    total: u64,
    /// Time of the beginning, and the number of units done by then.
    begun: Option<(Instant, u64)>,
}

impl Count {
    /// Returns the time that the work will take from `now` on, at the pace so far; `None` before the first
    /// unit is done, and after the last.
    fn time_left(&mut self, progress: Progress<'_>, now: Instant) -> Option<Duration> {
        let Progress { done, total, unit, .. } = progress;
        if total == 0 {
            return None;
        }
        let same = self.unit == unit && self.total == total;
        let Some((begun, before)) = self.begun.filter(|(_, before)| same && *before <= done) else {
            *self = Self { unit: unit.to_owned(), total, begun: Some((now, done)) };
            return None;
        };
        let made = done - before;
        let left = total.saturating_sub(done);
        // Some work is left, so the result is at least a second.
        let seconds = || ((now - begun).as_secs_f64() * left as f64 / made as f64).ceil().max(1.0);
        (made > 0 && left > 0).then(|| Duration::from_secs(seconds() as u64))
    }
}

fn style(bounded: bool) -> ProgressStyle {
    let template = if bounded {
        "{msg} {wide_bar} {human_pos}/{human_len}, {elapsed} gone{prefix}"
    } else {
        "{msg} {spinner} {elapsed} gone"
    };
    ProgressStyle::with_template(template).expect("the templates are constants that a test reads")
}

/// Reporter of tasks that take long, in a thread of its own, since the work may not return for minutes.
#[derive(Debug)]
struct Signs {
    /// Sender, dropped when there is no more progress, which ends the thread.
    sender: Option<Sender<Sign>>,
    thread: Option<JoinHandle<()>>,
}

/// Progress of a task.
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
    /// Makes a reporter that calls `tell` once a task has taken `first`, and again after each doubling of
    /// that.
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
        // Without a thread there are no reports; the work does not depend on them.
        let thread = std::thread::Builder::new().name("signs of progress".to_owned()).spawn(watch).ok();
        Self { sender: Some(sender), thread }
    }

    fn set(&self, task: &str, progress: Progress<'_>) {
        let sign = Sign { task: task.to_owned(), done: progress.done, total: progress.total };
        // Without a thread nobody receives the progress.
        _ = self.sender.as_ref().map(|sender| sender.send(sign));
    }
}

impl Drop for Signs {
    fn drop(&mut self) {
        self.sender = None;
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has reported its panic.
            _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::{Arc, Mutex};

    #[test]
    fn an_estimate_begins_with_the_first_that_is_done_and_goes_on_over_tasks() {
        let start = Instant::now();
        let mut count = Count::default();
        let mut to_go = |task, done, seconds| {
            count.time_left(
                Progress { task, done, total: 12, unit: "runs" },
                start + Duration::from_secs(seconds),
            )
        };
        assert_eq!((to_go("camera", 0, 0), to_go("camera", 0, 5)), (None, None));
        assert_eq!(to_go("camera", 4, 8), Some(Duration::from_secs(16)));
        // The next set of rays belongs to the same count, and its first step does not set a pace of its own.
        assert_eq!(to_go("bounce", 4, 8), Some(Duration::from_secs(16)));
        assert_eq!((to_go("bounce", 8, 20), to_go("bounce", 12, 30)), (Some(Duration::from_secs(10)), None));
        assert_eq!(to_go("bounce", 11, 20), Some(Duration::from_secs(2)));
        // Another total begins another count, and so does a number that decreases.
        assert_eq!(to_go("bounce", 0, 31), None);
        let other = Progress { task: "render", done: 3, total: 64, unit: "waves" };
        assert_eq!(count.time_left(other, start), None);
        assert_eq!(
            count.time_left(Progress { task: "build", done: 0, total: 0, unit: "waves" }, start),
            None
        );
    }

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
        let first = Duration::from_millis(40);
        let told = Arc::new(Mutex::new(Vec::<String>::new()));
        let kept = Arc::clone(&told);
        let signs = Signs::new(first, move |text| {
            kept.lock().expect("no panic").push(text.to_owned());
        });
        let progress = |done, total| Progress { task: "", done, total, unit: "" };
        let begun = Instant::now();
        // The wait does not depend on the load of the machine.
        let wait_for = |text: &str| {
            while !told.lock().expect("no panic").iter().any(|told| told.contains(text)) {
                assert!(begun.elapsed() < Duration::from_secs(60), "nobody says {text}");
                std::thread::sleep(Duration::from_millis(5));
            }
        };
        signs.set("short", progress(0, 0));
        signs.set("long", progress(0, 0));
        let was_short = begun.elapsed() < first;
        wait_for("long: ");
        signs.set("long", progress(3, 9));
        wait_for("long: 3 of 9");
        drop(signs);
        let told = told.lock().expect("no panic").clone();
        assert!(!was_short || told.iter().all(|text| text.starts_with("long: ")), "{told:?}");
        assert!(!told[0].contains("of 9"), "{told:?}");
        // Reports follow after 40, 80, 160, 320 ms and so on, and at most one for the short task.
        let most = (begun.elapsed().as_secs_f64() / first.as_secs_f64()).log2() + 2.0;
        assert!(told.len() as f64 <= most, "{told:?}");
    }
}
