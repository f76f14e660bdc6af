//! Mistakes on the command line, as the command reports them.

use crate::error::AppError;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use rasray_report::one_line;
use rasray_scene::nearest::nearest;

/// Names that other renderers have for options of this one.
const OTHER_NAMES: [(&str, &[&str]); 14] = [
    ("size", &["width", "height", "dimensions", "image-size", "resolution", "res", "pixels"]),
    ("spp", &["samples", "samples-per-pixel", "num-samples", "nsamples"]),
    ("bounces", &["depth", "max-depth", "max-bounces", "path-length"]),
    ("output", &["out", "outfile", "output-file", "image", "file"]),
    ("eye", &["from", "origin", "position", "camera-position", "look-from", "lookfrom"]),
    ("target", &["to", "lookat", "look-at", "at", "direction"]),
    ("fov", &["angle", "fovy", "fov-y", "yfov", "field-of-view", "focal-length", "zoom"]),
    ("aperture", &["lens", "lens-radius", "aperture-radius", "f-stop", "fstop", "f-number", "bokeh"]),
    ("focus", &["focus-distance", "focal-distance", "focus-depth"]),
    ("environment", &["env", "envmap", "env-map", "background", "hdri", "hdr", "sky"]),
    ("exposure", &["ev", "brightness", "stops", "gain"]),
    ("frames", &["frame", "range", "start", "end"]),
    ("device", &["gpu", "adapter", "gpu-index"]),
    ("system", &["accel", "structure", "algorithm", "accelerator"]),
];

/// Turns an answer of the parser into one line of error and one of help. The help names the command whose
/// options are meant; `line` is the definition of the command line.
pub(super) fn usage_error(error: &clap::Error, command: Option<&str>, line: &clap::Command) -> AppError {
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
    if error.kind() == ErrorKind::UnknownArgument {
        // The parser's own suggestions depend on the first letters, by which --width would become --depths.
        help = match (error.get(ContextKind::InvalidArg), command) {
            (Some(ContextValue::String(word)), Some(command)) => meant(word, command, line),
            _ => String::new(),
        };
    }
    if help.is_empty() {
        help = match command {
            Some(command) => format!("'rasray {command} --help' lists what it takes, --help-all everything"),
            None => "'rasray --help' lists what there is".to_owned(),
        };
    }
    AppError::usage(message, help)
}

/// Returns a question after the option that was meant; empty if no option is similar.
fn meant(word: &str, command: &str, line: &clap::Command) -> String {
    let command = line.find_subcommand(command);
    let Some(name) = word.strip_prefix("--").map(|rest| rest.split('=').next().unwrap_or(rest)) else {
        return String::new();
    };
    let names: Vec<&str> =
        command.into_iter().flat_map(clap::Command::get_arguments).filter_map(clap::Arg::get_long).collect();
    let name = name.to_lowercase().replace('_', "-");
    let known = |option: &str| names.iter().copied().find(|known| *known == option);
    let elsewhere = OTHER_NAMES.iter().find(|(_, others)| others.contains(&name.as_str()));
    // Some commands take several of the values of which another takes one, by the plural of the option's
    // name.
    let elsewhere = elsewhere.and_then(|(option, _)| known(option).or_else(|| known(&format!("{option}s"))));
    match elsewhere.or_else(|| nearest(&name, names.iter().copied())) {
        Some("size") => "did you mean '--size WIDTHxHEIGHT', such as --size 640x360?".to_owned(),
        Some(option) => format!("did you mean '--{option}'?"),
        None => {
            let takes = |other: &&clap::Command| {
                other.get_arguments().any(|known| known.get_long() == Some(name.as_str()))
            };
            let other = line.get_subcommands().find(takes);
            other.map_or(String::new(), |other| format!("it is an option of 'rasray {}'", other.get_name()))
        }
    }
}
