//! Commands `rasray completions` and `rasray man`, made from the definition of the command line.

use crate::arguments::{CommandLine, CompletionsArguments, ManArguments};
use crate::error::AppError;
use crate::terminal;
use clap::{Command, CommandFactory};
use std::io;

/// Name of the command in scripts and pages.
const NAME: &str = "rasray";

/// Writes the script that completes this command line.
///
/// # Errors
/// Stdout accepts no more.
pub(crate) fn completions(given: &CompletionsArguments) -> Result<(), AppError> {
    let mut script = Vec::new();
    clap_complete::generate(given.shell, &mut CommandLine::command(), NAME, &mut script);
    terminal::write_out(&script).map_err(|error| full(&error))
}

/// Writes a page of the manual as roff: of the whole, or of one command.
///
/// # Errors
/// There is no such command, or stdout accepts no more.
pub(crate) fn man(given: &ManArguments) -> Result<(), AppError> {
    let mut line = CommandLine::command();
    // This call gives commands their whole names, and the options that every command has.
    line.build();
    let command = match &given.command {
        None => line,
        Some(name) => command_page(&line, name)?,
    };
    let mut page = Vec::new();
    clap_mangen::Man::new(command).render(&mut page).map_err(|error| full(&error))?;
    terminal::write_out(&page).map_err(|error| full(&error))
}

fn command_page(line: &Command, name: &str) -> Result<Command, AppError> {
    let found = line.find_subcommand(name).ok_or_else(|| {
        let known: Vec<_> = line.get_subcommands().map(Command::get_name).collect();
        AppError::usage(
            format!("there is no command '{name}'"),
            format!("its commands: {}", known.join(", ")),
        )
    })?;
    Ok(found.clone())
}

fn full(error: &io::Error) -> AppError {
    AppError::refused(format!("stdout: {error}"), "send the output somewhere with space for it")
}
