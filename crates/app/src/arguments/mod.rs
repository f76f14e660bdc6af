//! Command line: its definition, and the answers to mistakes.

mod campaign;
mod compare;
mod documents;
mod info;
mod integrator;
mod merge;
mod mistakes;
mod options;
mod ray_files;
mod render;
mod shared;
mod structure;
mod tone;
pub mod values;
mod view;

pub use campaign::{AblateArguments, CampaignArguments, PaperChoice, ReplicateArguments};
pub use compare::CompareArguments;
pub use documents::{CompletionsArguments, ManArguments};
pub use info::InfoArguments;
pub use merge::MergeArguments;
pub use ray_files::{NamedFile, RayFileArguments};
pub use render::RenderArguments;
pub use shared::{
    DeviceArguments, FrameArguments, NeedsName, SceneArguments, TalkArguments, ViewArguments, WorkArguments,
};
pub use structure::StructureArguments;
pub use tone::ToneArguments;
pub use view::ViewerArguments;

use crate::error::AppError;
use clap::parser::ValueSource;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand, error::ErrorKind};
use mistakes::usage_error;
use std::ffi::OsString;

const ABOUT: &str = "Traces rays through structures that the rasterizer builds, on any Vulkan 1.2 device.";

const AFTER_HELP: &str = "\
Examples:
  rasray render cornell --output cornell.png
  rasray render scene.glb --integrator ao --ao-distance 2 --spp 64 --output ao.exr
  rasray compare spheres:10k --systems mmrt,brute-force --rays 20000 --report r.json
  rasray ablate plan.toml --output results
  rasray view scene.glb
  rasray info scene.glb
  rasray merge scene.png part.*.exr

A scene is a file (.gltf .glb .obj .ply) or a built-in with parameters (cornell, spheres:300k).

Exit codes:
  0    done
  1    compare hard:... --check: a target was not met
  2    bad input or usage
  3    no suitable device, or the device failed
  4    refused to lose data: the result could not be written, or was not complete
  5    a defect of rasray; please report it
  130  stopped by SIGINT, SIGTERM or SIGHUP; what was finished is written, unless stopped twice

RASRAY_LOG sets the log filter, for example RASRAY_LOG=debug. NO_COLOR=1 keeps colours out of it.";

/// The whole command line.
#[derive(Debug, Parser)]
#[command(name = "rasray", version = crate::version::version_text(), about = ABOUT, after_help = AFTER_HELP)]
#[command(arg_required_else_help = true, disable_help_flag = true)]
pub struct CommandLine {
    /// Command to run.
    #[command(subcommand)]
    pub command: Command,
    /// Amount of messages.
    #[command(flatten)]
    pub talk: TalkArguments,
}

/// Commands of the program.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a scene to an image
    Render(Box<RenderArguments>),
    /// Put shares of a picture's samples, or reports of frames, together
    Merge(MergeArguments),
    /// Trace the same rays through several systems and compare speed and error
    Compare(Box<CompareArguments>),
    /// Make every comparison of a plan: lists of options, scenes, sizes, seeds
    Ablate(AblateArguments),
    /// Make tables and figures of the five papers again, ours beside what was published
    Replicate(ReplicateArguments),
    /// Look at a scene in a window, which moves and refines (builds with the cargo feature viewer)
    View(Box<ViewerArguments>),
    /// Show the device, or what a scene holds and needs
    Info(InfoArguments),
    /// Print completions of this command line for a shell
    Completions(CompletionsArguments),
    /// Print a page of the manual
    Man(ManArguments),
}

/// Words of the commands in [`Command`].
const COMMANDS: [&str; 9] =
    ["render", "merge", "compare", "ablate", "replicate", "view", "info", "completions", "man"];

/// Result of parsing without a command to run.
#[derive(Debug)]
pub enum Refusal {
    /// Text for stdout, as help or version was asked for.
    Text(String),
    /// The command line is wrong.
    Error(AppError),
}

/// Parses a command line, program name first.
///
/// # Errors
/// [`Refusal::Text`] for help and version; a usage error otherwise.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<CommandLine, Refusal> {
    let arguments: Vec<_> = arguments.into_iter().collect();
    let command = arguments.get(1).and_then(|word| word.to_str()).filter(|word| COMMANDS.contains(word));
    match read(&arguments) {
        Ok(line) => Ok(line),
        Err(error) => Err(match error.kind() {
            ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => Refusal::Text(error.render().to_string()),
            ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => Refusal::Error(AppError::usage(
                "nothing was asked for",
                "say render, compare, view or info; 'rasray help' explains them, with examples",
            )),
            _ => Refusal::Error(usage_error(&error, command, &CommandLine::command())),
        }),
    }
}

/// Parses the comparison that words of `rasray compare` ask for, the scene first.
///
/// # Errors
/// Those of `rasray compare`; also words that ask for help.
pub fn comparison(words: &[String]) -> Result<CompareArguments, AppError> {
    let line = ["rasray", "compare"].map(OsString::from);
    match parse(line.into_iter().chain(words.iter().map(OsString::from))) {
        Ok(CommandLine { command: Command::Compare(given), .. }) => Ok(*given),
        Err(Refusal::Error(error)) => Err(error),
        _ => Err(AppError::usage("these are no options of a comparison", "see rasray compare --help")),
    }
}

/// Reads the words, and notes the options among them.
fn read(arguments: &[OsString]) -> Result<CommandLine, clap::Error> {
    let matches = CommandLine::command().try_get_matches_from(with_negative_values(arguments))?;
    let mut line = CommandLine::from_arg_matches(&matches)?;
    if let Command::Compare(given) = &mut line.command {
        given.typed = matches.subcommand().map(|(_, own)| typed(own)).unwrap_or_default();
    }
    Ok(line)
}

/// Joins negative numbers to the long options before them: `--spp -1` becomes `--spp=-1`. The parser would
/// take such numbers for unknown short options, and report these.
fn with_negative_values(words: &[OsString]) -> Vec<OsString> {
    let mut joined: Vec<OsString> = Vec::with_capacity(words.len());
    let mut options = true;
    for word in words {
        let text = word.to_str().unwrap_or_default();
        options &= text != "--";
        let before = joined.last().and_then(|last| last.to_str());
        let takes =
            before.is_some_and(|last| last.len() > 2 && last.starts_with("--") && !last.contains('='));
        let is_short = before == Some("-o");
        match joined.last_mut() {
            Some(last) if options && (takes || is_short) && is_negative(text) => {
                last.push(if is_short { "" } else { "=" });
                last.push(word);
            }
            _ => joined.push(word.clone()),
        }
    }
    joined
}

/// True if a word begins like a negative number.
fn is_negative(word: &str) -> bool {
    let Some(rest) = word.strip_prefix('-') else { return false };
    let digits = rest.strip_prefix('.').unwrap_or(rest);
    let lower = rest.to_ascii_lowercase();
    digits.starts_with(|first: char| first.is_ascii_digit())
        || lower.starts_with("inf")
        || lower.starts_with("nan")
}

/// Returns the long names of the options that were typed, not left to their defaults.
fn typed(matches: &ArgMatches) -> Vec<String> {
    let on_line = |id: &&clap::Id| matches.value_source(id.as_str()) == Some(ValueSource::CommandLine);
    matches.ids().filter(on_line).map(|id| id.as_str().replace('_', "-")).collect()
}

#[cfg(test)]
mod tests;
