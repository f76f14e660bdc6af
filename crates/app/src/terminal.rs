//! Text for people: results on stdout, everything else on stderr. All text passes through [`escaped`], so
//! that no name in a file can control a terminal: nothing before this layer escapes names.

use crate::error::AppError;
use rasray_report::{escaped, escaped_but, one_line};
use rasray_scene::{Scene, Warning};
use std::ffi::OsStr;
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use tracing_subscriber::EnvFilter;

/// Amount of messages in addition to results and errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Talk {
    /// No messages.
    Quiet,
    /// Warnings, hints, progress, and a short summary of a run.
    #[default]
    Usual,
    /// Messages as [`Talk::Usual`], with every number of a run.
    Verbose,
}

/// Value of [`Talk`] for this process as a number; one process runs one command.
static TALK: AtomicU8 = AtomicU8::new(Talk::Usual as u8);

/// Sets the amount of messages from now on.
pub(crate) fn set_talk(talk: Talk) {
    TALK.store(talk as u8, Ordering::Relaxed);
}

/// True if messages of this amount are shown.
pub(crate) fn says(talk: Talk) -> bool {
    TALK.load(Ordering::Relaxed) >= talk as u8
}

/// Returns the number of characters in a line of results: the value of COLUMNS, otherwise the width of
/// stdout's terminal; `None` if stdout is not a terminal, for files and other programs.
pub(crate) fn width() -> Option<usize> {
    let asked = std::env::var("COLUMNS").ok();
    // The width is fixed for a program; a terminal that does not report its width is taken to have the
    // traditional one.
    width_of(asked.as_deref(), || {
        let terminal = console::Term::stdout();
        terminal.is_term().then(|| terminal.size_checked().map_or(80, |(_, columns)| columns.into()))
    })
}

/// Least number of characters at which a line is broken: below it, nothing of a table fits.
const LEAST_WIDTH: usize = 20;

fn width_of(asked: Option<&str>, terminal: impl FnOnce() -> Option<usize>) -> Option<usize> {
    let asked = asked.and_then(|text| text.trim().parse().ok()).filter(|columns: &usize| *columns > 0);
    asked.or_else(terminal).map(|columns| columns.max(LEAST_WIDTH))
}

/// Flag that is set once the terminal of this process was hung up, so that nobody can read messages.
static HUNG_UP: AtomicBool = AtomicBool::new(false);

/// Notes that failures of output are no longer errors.
pub(crate) fn hang_up() {
    HUNG_UP.store(true, Ordering::Relaxed);
}

/// Writes bytes to stdout unchanged. A reader that has gone away, such as `head`, wants no more, which is not
/// an error.
///
/// # Errors
/// The error of the operating system.
pub(crate) fn write_out(bytes: &[u8]) -> io::Result<()> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error),
        _ => Ok(()),
    }
}

/// Shows a text on stdout.
///
/// # Errors
/// [`AppError::Refused`] if stdout accepts no more.
pub(crate) fn print(text: &str) -> Result<(), AppError> {
    match write_out(escaped(text).as_bytes()) {
        Err(_) if HUNG_UP.load(Ordering::Relaxed) => Ok(()),
        other => other.map_err(|error| {
            AppError::refused(format!("stdout: {error}"), "send the output somewhere with space for it")
        }),
    }
}

/// Shows the results of a run: on stdout, or on stderr if a file takes stdout. Nothing is shown if quiet was
/// asked for.
///
/// # Errors
/// As for [`print`].
pub(crate) fn summarize(text: &str, stdout_is_taken: bool) -> Result<(), AppError> {
    if !says(Talk::Usual) {
        return Ok(());
    }
    if stdout_is_taken {
        complain(text);
        return Ok(());
    }
    print(text)
}

/// Shows a text on stderr. A failure is ignored, since there is no other place to report it.
pub(crate) fn complain(text: &str) {
    _ = io::stderr().lock().write_all(escaped(text).as_bytes());
}

/// Shows one line that is neither result nor error, unless quiet was asked for.
pub(crate) fn note(text: &str) {
    if says(Talk::Usual) {
        complain(&format!("{}\n", one_line(text)));
    }
}

/// Shows one line of warning.
pub(crate) fn warn(text: &str) {
    note(&format!("warning: {text}"));
}

/// Warns of data that was dropped or replaced in a scene, and that an empty scene shows only its environment.
pub(crate) fn warn_of_scene(scene: &Scene, triangles: u64) {
    for warning in &scene.warnings {
        warn(&format!("{}: {} ({})", scene.name, warning.message, warning.kind));
    }
    // The reader of the scene may have warned already, with the reason.
    if triangles == 0 && !scene.warnings.iter().any(|warning| warning.kind == "no-triangles") {
        warn(&format!(
            "{}: the scene has no triangles; only its environment will be seen (no-triangles)",
            scene.name
        ));
    }
}

/// Shows the warnings about the frame that is shown, except those `said` about the frame before.
pub(crate) fn warn_of_frame(scene: &Scene, said: &[Warning]) {
    for warning in scene.animation.deformer_warnings.iter().filter(|warning| !said.contains(warning)) {
        warn(&format!("{}: {} ({})", scene.name, warning.message, warning.kind));
    }
}

/// True if colours are wanted on stderr: it is a terminal and NO_COLOR (no-color.org) is absent or empty.
fn colors(is_terminal: bool, no_color: Option<&OsStr>) -> bool {
    is_terminal && no_color.is_none_or(OsStr::is_empty)
}

/// Sends log messages to stderr. `RASRAY_LOG` sets the filter; by default warnings are shown, without those
/// of scene files, which [`warn_of_scene`] shows, and only errors if quiet was asked for.
pub(crate) fn start_logging() {
    let usual = || EnvFilter::new(if says(Talk::Usual) { "warn,rasray_scene=error" } else { "error" });
    let filter = match std::env::var("RASRAY_LOG") {
        Ok(text) => EnvFilter::try_new(&text).unwrap_or_else(|error| {
            warn(&format!("RASRAY_LOG={text} is no log filter: {error}"));
            usual()
        }),
        Err(_) => usual(),
    };
    let colors = colors(io::stderr().is_terminal(), std::env::var_os("NO_COLOR").as_deref());
    let logging = tracing_subscriber::fmt().with_env_filter(filter).with_ansi(colors).without_time();
    // A second start in one process keeps the settings of the first.
    _ = logging.with_writer(move || Log { colors }).try_init();
}

/// Writer of log lines to stderr, each of which arrives in one piece.
struct Log {
    colors: bool,
}

impl Write for Log {
    fn write(&mut self, line: &[u8]) -> io::Result<usize> {
        let text = String::from_utf8_lossy(line);
        // Colours begin with an escape character; the formatter itself escapes the characters of values.
        let text = if self.colors { escaped_but(&text, &['\u{1b}']) } else { escaped(&text) };
        _ = io::stderr().lock().write_all(text.as_bytes());
        Ok(line.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_width_is_asked_for_or_a_terminals() {
        assert_eq!(width_of(Some("100"), || Some(80)), Some(100));
        assert_eq!((width_of(None, || Some(80)), width_of(None, || None)), (Some(80), None));
        for nothing in ["", "0", "-3", "wide"] {
            assert_eq!(width_of(Some(nothing), || None), None, "{nothing}");
        }
        assert_eq!(width_of(Some("3"), || None), Some(LEAST_WIDTH));
    }

    #[test]
    fn colours_are_for_terminals_whose_owner_does_not_mind() {
        assert!(colors(true, None) && colors(true, Some(OsStr::new(""))));
        assert!(!colors(true, Some(OsStr::new("1"))) && !colors(true, Some(OsStr::new("0"))));
        assert!(!colors(false, None));
    }
}
