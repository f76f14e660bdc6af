//! The command `rasray` as a library: command line, scenes, images, reports, signals and exit codes. The
//! program and its tests call [`run`].
//!
//! - [`run`] runs a command line and returns its exit code.
//! - [`arguments`] has the options of each command.
//! - [`output`] writes images and reports.
//! - [`AppError`] is an error with advice and an exit code.
//!
//! Rendering and comparing are behind [`rasray_experiment::Backend`].

pub mod arguments;
mod commands;
mod error;
mod hints;
mod interrupt;
pub mod output;
mod progress;
mod terminal;
mod version;

pub use error::{
    AppError, EXIT_DEFECT, EXIT_DEVICE, EXIT_INTERRUPTED, EXIT_OK, EXIT_REFUSED, EXIT_TARGET, EXIT_USAGE,
};
pub use interrupt::Interrupt;
pub use version::{COMMIT, VERSION, version_text};

use arguments::{Command, CommandLine, Refusal, TalkArguments};
use rasray_experiment::OpenBackend;
use std::ffi::OsString;
use terminal::Talk;

/// Runs the command: program name first in `arguments`; `open` makes the backend that renders. Returns the
/// exit code: 0 done, 1 missed targets with `--check`, 2 bad input or usage, 3 device, 4 refused to lose
/// data, 5 a defect, 130 stopped by a signal.
///
/// Takes over SIGINT, SIGTERM and SIGHUP and writes to stdout and stderr; call it once per process.
pub fn run(arguments: impl IntoIterator<Item = OsString>, open: &mut OpenBackend<'_>) -> u8 {
    let arguments: Vec<_> = arguments.into_iter().collect();
    let words = arguments.iter().skip(1).map(|word| word.to_string_lossy());
    let line = std::iter::once("rasray".into()).chain(words).collect::<Vec<_>>().join(" ");
    let result = match arguments::parse(arguments) {
        Ok(parsed) => execute(parsed, &line, open),
        Err(Refusal::Text(text)) => terminal::print(&text),
        Err(Refusal::Error(error)) => Err(error),
    };
    match result {
        Ok(()) => EXIT_OK,
        Err(error) => {
            terminal::complain(&error.lines());
            error.exit_code()
        }
    }
}

fn execute(parsed: CommandLine, line: &str, open: &mut OpenBackend<'_>) -> Result<(), AppError> {
    terminal::set_talk(match parsed.talk {
        TalkArguments { quiet: true, .. } => Talk::Quiet,
        TalkArguments { verbose: true, .. } => Talk::Verbose,
        TalkArguments { .. } => Talk::Usual,
    });
    let interrupt = Interrupt::install().map_err(AppError::Signals)?;
    terminal::start_logging();
    match parsed.command {
        Command::Render(given) => commands::render(&given, line, open, &interrupt),
        Command::Merge(given) => commands::merge(&given, &interrupt),
        Command::Compare(given) => commands::compare(&given, line, open, &interrupt),
        Command::Ablate(given) => commands::ablate(&given, line, open, &interrupt),
        Command::Replicate(given) => commands::replicate(&given, line, open, &interrupt),
        Command::View(given) => commands::view(&given, &interrupt),
        Command::Info(given) => commands::info(&given, open),
        Command::Completions(given) => commands::completions(&given),
        Command::Man(given) => commands::man(&given),
    }
}
