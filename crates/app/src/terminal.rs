//! Text for people: results on stdout, everything else on stderr. Whatever is shown passes through [`shown`], so
//! that no name in a file can steer a terminal: nothing before this layer escapes them.

use crate::error::AppError;
use rasray_scene::Scene;
use std::borrow::Cow;
use std::ffi::OsStr;
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicU8, Ordering};
use tracing_subscriber::EnvFilter;

/// How much is said beside results and errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Talk {
    /// Nothing.
    Quiet,
    /// Warnings, hints, progress, and what a run gave in short.
    #[default]
    Usual,
    /// The same, with every number.
    Verbose,
}

/// The [`Talk`] of this process as a number; one process runs one command.
static TALK: AtomicU8 = AtomicU8::new(Talk::Usual as u8);

/// Sets how much is said from now on.
pub(crate) fn set_talk(talk: Talk) {
    TALK.store(talk as u8, Ordering::Relaxed);
}

/// Whether so much is said.
pub(crate) fn says(talk: Talk) -> bool {
    TALK.load(Ordering::Relaxed) >= talk as u8
}

/// Text of one or several lines with every character that a terminal obeys written out, such as `\u{1b}`: controls but
/// line breaks and tabs, and those that turn the direction of what follows.
pub(crate) fn shown(text: &str) -> Cow<'_, str> {
    written_out(text, &['\n', '\t'])
}

/// The same for a name within a line, whose line breaks and tabs are written out as well.
pub(crate) fn in_line(text: &str) -> Cow<'_, str> {
    written_out(text, &[])
}

fn written_out<'a>(text: &'a str, kept: &[char]) -> Cow<'a, str> {
    let is_written_out = |character: char| is_obeyed(character) && !kept.contains(&character);
    if !text.contains(is_written_out) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::with_capacity(text.len() + 8);
    for character in text.chars() {
        if is_written_out(character) {
            escaped.extend(character.escape_default());
        } else {
            escaped.push(character);
        }
    }
    Cow::Owned(escaped)
}

fn is_obeyed(character: char) -> bool {
    let turns = matches!(character, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let separates = matches!(character, '\u{2028}' | '\u{2029}');
    character.is_control() || turns || separates
}

/// JSON text in which every such character is escaped as JSON does it, so that nothing is left for [`shown`]; in
/// valid JSON they stand in strings only, but for the line breaks between them.
pub(crate) fn json_shown(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        if is_obeyed(character) && character != '\n' {
            // None of them is beyond the sixteen bits that one escape holds.
            escaped += &format!("\\u{:04x}", u32::from(character));
        } else {
            escaped.push(character);
        }
    }
    escaped
}

/// The words of a text, with single spaces between them.
pub(crate) fn one_line(text: &str) -> String {
    in_line(&text.split_whitespace().collect::<Vec<_>>().join(" ")).into_owned()
}

/// Writes bytes to stdout as they are. A reader that has gone away, such as `head`, wants no more and is no error.
///
/// # Errors
/// What the system says.
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
/// [`AppError::Refused`] when stdout takes no more.
pub(crate) fn print(text: &str) -> Result<(), AppError> {
    write_out(shown(text).as_bytes()).map_err(|error| {
        AppError::refused(format!("stdout: {error}"), "send the output somewhere with room for it")
    })
}

/// Shows what a run gave: on stdout, or on stderr where a file takes stdout. Nothing where quiet was asked for.
///
/// # Errors
/// As [`print`].
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

/// Shows a text on stderr; there is nowhere left to complain when that fails.
pub(crate) fn complain(text: &str) {
    _ = io::stderr().lock().write_all(shown(text).as_bytes());
}

/// One line that is neither result nor error, unless quiet was asked for.
pub(crate) fn note(text: &str) {
    if says(Talk::Usual) {
        complain(&format!("{}\n", one_line(text)));
    }
}

/// One line of warning.
pub(crate) fn warn(text: &str) {
    note(&format!("warning: {text}"));
}

/// Says what was dropped or replaced in a scene, and that an empty one shows only its environment.
pub(crate) fn warn_of_scene(scene: &Scene, triangles: u64) {
    for warning in &scene.warnings {
        warn(&format!("{}: {} ({})", scene.name, warning.message, warning.kind));
    }
    // The reader may have said so, and why.
    if triangles == 0 && !scene.warnings.iter().any(|warning| warning.kind == "no-triangles") {
        warn(&format!(
            "{}: the scene has no triangles; only its environment will be seen (no-triangles)",
            scene.name
        ));
    }
}

/// Whether colours are wanted on stderr: where it is a terminal and NO_COLOR (no-color.org) is absent or empty.
fn colors(is_terminal: bool, no_color: Option<&OsStr>) -> bool {
    is_terminal && no_color.is_none_or(OsStr::is_empty)
}

/// Sends log messages to stderr. `RASRAY_LOG` sets the filter; unless it does, warnings are shown,
/// without those of scene files, which [`warn_of_scene`] shows; errors alone where quiet was asked for.
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
    // A second start in one process keeps the first one's settings.
    _ = logging.with_writer(move || Log { colors }).try_init();
}

/// Stderr for log lines, each of which comes in one piece.
struct Log {
    colors: bool,
}

impl Write for Log {
    fn write(&mut self, line: &[u8]) -> io::Result<usize> {
        let text = String::from_utf8_lossy(line);
        // Colours begin with an escape character; the formatter writes out those of the values itself.
        let kept: &[char] = if self.colors { &['\n', '\t', '\u{1b}'] } else { &['\n', '\t'] };
        _ = io::stderr().lock().write_all(written_out(&text, kept).as_bytes());
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
    fn nothing_that_a_terminal_obeys_is_shown_as_it_is() {
        assert_eq!(shown("wall\u{1b}[2J\r\u{7}\u{9b}31m\u{202e}x\0"), {
            "wall\\u{1b}[2J\\r\\u{7}\\u{9b}31m\\u{202e}x\\u{0}"
        });
        let plain = "Wände, 壁\n\tand 🧱";
        assert!(matches!(shown(plain), Cow::Borrowed(text) if text == plain));
        assert_eq!(in_line("a\nb\tc\u{2028}d"), r"a\nb\tc\u{2028}d");
        assert_eq!(one_line(" a\n  b\u{7} "), r"a b\u{7}");
    }

    #[test]
    fn colours_are_for_terminals_whose_owner_does_not_mind() {
        assert!(colors(true, None) && colors(true, Some(OsStr::new(""))));
        assert!(!colors(true, Some(OsStr::new("1"))) && !colors(true, Some(OsStr::new("0"))));
        assert!(!colors(false, None));
    }

    #[test]
    fn json_stays_json() {
        let name = "a\u{1b}\u{9b}\u{202e}\n\"b\"";
        let text = json_shown(&serde_json::to_string(name).expect("a string"));
        assert!(!text.contains(is_obeyed), "{text}");
        assert_eq!(serde_json::from_str::<String>(&text).expect("a string"), name);
    }
}
