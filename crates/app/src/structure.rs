//! Systems, presets and options of structures on the command line, made from the rows of the registry.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use rasray_systems::{Group, OPTIONS, OptionRow, Preset, SYSTEMS, System, Values};
use serde_json::{Map, Value};

use crate::arguments::values;

/// Reads the name of a system.
pub fn system_parser() -> impl TypedValueParser<Value = &'static System> {
    let names = SYSTEMS.iter().map(|system| PossibleValue::new(system.name).help(system.doc));
    PossibleValuesParser::new(names)
        .map(|name| System::named(&name).expect("only names of systems are possible values"))
}

/// Reads the name of a preset.
pub fn preset_parser() -> impl TypedValueParser<Value = Preset> {
    let names = Preset::ALL.map(|preset| PossibleValue::new(preset.name()).help(preset.doc()));
    PossibleValuesParser::new(names)
        .map(|name| Preset::named(&name).expect("only names of presets are possible values"))
}

/// What was asked of a structure, by option; what is left out follows the system's preset. Numbers are numbers, all else
/// words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StructureOptions(Map<String, Value>);

impl StructureOptions {
    /// The options that were given, by name.
    pub fn given(&self) -> &Map<String, Value> {
        &self.0
    }

    /// What was given for an option, as it is typed.
    pub fn text(&self, option: &str) -> Option<String> {
        self.0.get(option).map(text)
    }

    /// Every option that was given, as it is typed.
    pub fn texts(&self) -> impl Iterator<Item = (String, String)> {
        self.0.iter().map(|(name, value)| (name.clone(), text(value)))
    }

    /// The same with a word for an option.
    #[must_use]
    pub fn with(mut self, option: &str, word: impl Into<Value>) -> Self {
        self.0.insert(option.to_owned(), word.into());
        self
    }

    /// The options that were given and whose names `keep` accepts.
    #[must_use]
    pub fn filtered(&self, keep: impl Fn(&str) -> bool) -> Self {
        Self(self.0.clone().into_iter().filter(|(name, _)| keep(name)).collect())
    }

    /// These options with those of `over` in place of their own where it has any.
    #[must_use]
    pub fn overlaid(&self, over: &Self) -> Self {
        Self(self.0.clone().into_iter().chain(over.0.clone()).collect())
    }
}

fn text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

fn heading(group: Group) -> &'static str {
    match group {
        Group::Size => "Structure: sizes (defaults follow the system and its preset)",
        Group::Method => "Structure: methods",
        Group::Speed => "Structure: speed",
        Group::Limit => "Structure: limits",
        Group::Diagnostic => "Structure: diagnostics",
    }
}

/// A word that stands for the value `off` of an option.
fn off_argument(row: &'static OptionRow, name: &'static str) -> Arg {
    Arg::new(name)
        .long(name)
        .action(ArgAction::SetTrue)
        .conflicts_with(row.name)
        .help(format!("The same as --{}=off", row.name))
}

/// The argument of an option.
fn argument(row: &'static OptionRow) -> Arg {
    let argument = Arg::new(row.name).long(row.name).help(row.doc);
    let argument = match row.values {
        Values::Words(words) => {
            let words = words.iter().map(|(word, doc)| PossibleValue::new(*word).help(*doc));
            argument.value_name("WORD").value_parser(PossibleValuesParser::new(words))
        }
        Values::Whole(lowest, highest) => {
            argument.value_name("N").value_parser(values::whole(lowest, highest))
        }
        Values::Metres => argument.value_name("METRES").value_parser(values::not_negative),
        Values::Share => argument.value_name("SHARE").value_parser(values::not_negative),
        Values::Cells => argument.value_name("WxH").value_parser(values::cells),
    };
    match row.off_name {
        Some(_) => argument.num_args(0..=1).require_equals(true).default_missing_value("on"),
        None => argument,
    }
}

/// What was given for an option.
fn value(row: &OptionRow, matches: &ArgMatches) -> Option<Value> {
    match row.values {
        Values::Words(_) | Values::Cells => matches.get_one::<String>(row.name).cloned().map(Value::from),
        Values::Whole(..) => matches.get_one::<u32>(row.name).copied().map(Value::from),
        Values::Metres | Values::Share => matches.get_one::<f32>(row.name).map(|number| {
            // By way of text, which is as short as it can be: 0.1, not 0.10000000149.
            serde_json::from_str(&number.to_string()).expect("a finite number")
        }),
    }
}

impl Args for StructureOptions {
    fn augment_args(command: Command) -> Command {
        Group::ALL.into_iter().fold(command, |command, group| {
            let rows = OPTIONS.iter().filter(|row| row.group == group);
            let arguments = rows.flat_map(|row| {
                [Some(argument(row)), row.off_name.map(|name| off_argument(row, name))].into_iter().flatten()
            });
            // Sizes first; what else there is, is shown where everything is asked for.
            let arguments = arguments
                .map(|argument| argument.help_heading(heading(group)).hide_short_help(group != Group::Size));
            command.args(arguments)
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for StructureOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut options = Self::default();
        options.update_from_arg_matches(matches)?;
        Ok(options)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        for row in OPTIONS {
            let given = value(row, matches);
            let off = row.off_name.is_some_and(|name| matches.get_flag(name)).then(|| Value::from("off"));
            if let Some(given) = given.or(off) {
                self.0.insert(row.name.to_owned(), given);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(words: &[&str]) -> Result<StructureOptions, clap::Error> {
        let command = StructureOptions::augment_args(Command::new("options").no_binary_name(true));
        StructureOptions::from_arg_matches(&command.try_get_matches_from(words)?)
    }

    #[test]
    fn values_keep_what_was_typed() {
        let given = read(&["--buckets", "8", "--thickness", "0.1", "--sort", "on"]).expect("valid");
        assert_eq!(given.given().len(), 3);
        assert_eq!(given.given()["buckets"], 8);
        assert_eq!(given.given()["thickness"].to_string(), "0.1");
        assert_eq!(given.text("sort").as_deref(), Some("on"));
        let cells = read(&["--camera-resolution", "12"]).expect("valid");
        assert_eq!(cells.text("camera-resolution").as_deref(), Some("12x12"));
        for bad in [["--buckets", "65"], ["--sort", "maybe"], ["--thickness", "-1"], ["--grid", "x"]] {
            assert!(read(&bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn overlaying_replaces_only_what_is_given() {
        let base = StructureOptions::default().with("buckets", 4).with("sort", "on");
        let over = StructureOptions::default().with("buckets", 8).with("thickness", "0.1");
        let both = base.overlaid(&over);
        assert_eq!(both, base.with("buckets", 8).with("thickness", "0.1"));
        let kept = both.filtered(|name| name != "buckets");
        assert_eq!((kept.text("buckets"), kept.given().len()), (None, 2));
    }

    #[test]
    fn a_word_of_its_own_turns_an_option_off() {
        let of = |words: &[&str]| read(words).expect("valid").text("inline");
        assert_eq!(of(&["--inline"]).as_deref(), Some("on"));
        assert_eq!(of(&["--inline=off"]).as_deref(), Some("off"));
        assert_eq!(of(&["--decoupled"]).as_deref(), Some("off"));
        assert_eq!(of(&[]), None);
        assert!(read(&["--decoupled", "--inline"]).is_err());
    }
}
