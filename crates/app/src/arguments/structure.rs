//! Systems, presets and options of structures on the command line, made from the rows of the registry.

use clap::builder::TypedValueParser;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use rasray_experiment::{OccluderKind, OptionValues, Primary, RaySet, Refresh, Sampler, SystemRequest};
use rasray_scene::BackFaces;
use rasray_systems::{Group, OPTIONS, Preset, SYSTEMS, System};

use super::options::{arguments, choice, given};

/// Makes a parser that reads the name of a system.
pub fn system_parser() -> impl TypedValueParser<Value = &'static System> {
    choice(SYSTEMS, |system| (system.name, system.doc))
}

/// Makes a parser that reads the name of a system, or the word that leaves it to the job.
pub fn system_request_parser() -> impl TypedValueParser<Value = SystemRequest> {
    let named = SYSTEMS.iter().map(SystemRequest::Named);
    choice([SystemRequest::Automatic].into_iter().chain(named), |request| match request {
        SystemRequest::Automatic => {
            (SystemRequest::AUTOMATIC, "The fastest exact one for the job; the report says which")
        }
        SystemRequest::Named(system) => (system.name, system.doc),
    })
}

/// Makes a parser that reads the name of a preset.
pub fn preset_parser() -> impl TypedValueParser<Value = Preset> {
    choice(Preset::ALL, |preset| (preset.name(), preset.doc()))
}

/// Makes a parser that reads the name of a set of rays.
pub fn ray_set_parser() -> impl TypedValueParser<Value = RaySet> {
    choice(RaySet::ALL, |set| (set.name(), set.doc()))
}

/// Makes a parser that reads the name of a sampler.
pub fn sampler_parser() -> impl TypedValueParser<Value = Sampler> {
    choice(Sampler::ALL, |sampler| (sampler.name(), sampler.doc()))
}

/// Makes a parser that reads the parts of a structure that frames build.
pub fn refresh_parser() -> impl TypedValueParser<Value = Refresh> {
    choice(Refresh::ALL, |refresh| (refresh.name(), refresh.doc()))
}

/// Makes a parser that reads the method by which the camera's first hits are found.
pub fn primary_parser() -> impl TypedValueParser<Value = Primary> {
    choice(Primary::ALL, |primary| (primary.name(), primary.doc()))
}

/// Makes a parser that reads the occluder of shadow rays.
pub fn occluder_parser() -> impl TypedValueParser<Value = OccluderKind> {
    choice(OccluderKind::ALL, |occluder| (occluder.name(), occluder.doc()))
}

/// Makes a parser that reads the rays that pass the backs of surfaces.
pub fn back_faces_parser() -> impl TypedValueParser<Value = BackFaces> {
    choice(BackFaces::ALL, |back_faces| (back_faces.name(), back_faces.doc()))
}

/// The options of a structure on the command line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StructureArguments(
    /// Values of the options that were given.
    pub OptionValues,
);

fn heading(group: Group) -> &'static str {
    match group {
        Group::Size => "Structure: sizes (defaults follow the system and its preset)",
        Group::Method => "Structure: methods",
        Group::Speed => "Structure: speed",
        Group::Limit => "Structure: limits",
        Group::Diagnostic => "Structure: diagnostics",
    }
}

impl Args for StructureArguments {
    fn augment_args(command: Command) -> Command {
        Group::ALL.into_iter().fold(command, |command, group| {
            let of_group = OPTIONS.iter().filter(|option| option.group == group);
            // Options of size come first; all others are shown only in the full help.
            command.args(
                of_group.flat_map(|option| arguments(&option.row, option.row.help())).map(|argument| {
                    argument.help_heading(heading(group)).hide_short_help(group != Group::Size)
                }),
            )
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for StructureArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut options = Self::default();
        options.update_from_arg_matches(matches)?;
        Ok(options)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        for option in OPTIONS {
            if let Some(value) = given(&option.row, matches) {
                self.0.set(option.row.name, value);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_options::Value;
    use rasray_systems::Spec;

    fn read(words: &[&str]) -> Result<OptionValues, clap::Error> {
        let command = StructureArguments::augment_args(Command::new("options").no_binary_name(true));
        Ok(StructureArguments::from_arg_matches(&command.try_get_matches_from(words)?)?.0)
    }

    #[test]
    fn values_keep_what_was_typed() {
        let given = read(&["--buckets", "8", "--thickness", "0.1", "--sort", "on"]).expect("valid");
        assert_eq!((given.len(), given.get("buckets")), (3, Some(Value::Whole(8))));
        assert_eq!(given.text("thickness").as_deref(), Some("0.1"));
        assert_eq!(given.text("sort").as_deref(), Some("on"));
        let cells = read(&["--camera-resolution", "12"]).expect("valid");
        assert_eq!(cells.text("camera-resolution").as_deref(), Some("12x12"));
        for bad in [["--buckets", "65"], ["--sort", "maybe"], ["--thickness", "-1"], ["--grid", "x"]] {
            assert!(read(&bad).is_err(), "{bad:?}");
        }
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

    #[test]
    fn every_value_of_the_command_line_is_one_of_the_registry() {
        let command = StructureArguments::augment_args(Command::new("options"));
        let mut tried = 0;
        // `--decoupled` is another word for `--inline=off` and has no values.
        for argument in command.get_arguments().filter(|argument| argument.get_id() != "decoupled") {
            for value in argument.get_possible_values() {
                let option = argument.get_long().expect("every option has a name");
                let takes = |system: &System, preset: &str, accept: &str| {
                    let options = [("accept", accept), (option, value.get_name())]
                        .into_iter()
                        .filter(|(name, _)| system.has(name) || *name == option)
                        .map(|(name, word)| (name.to_owned(), word.to_owned()));
                    Spec::new(system.name, preset, options).is_ok()
                };
                // Planes exclude attributes and samples; conservative lists need planes.
                let accepted = SYSTEMS.iter().any(|system| {
                    let accepts = ["interval", "plane", "parity", "tolerance", "t"];
                    let takes = |preset: &str| accepts.iter().any(|accept| takes(system, preset, accept));
                    system.presets.iter().any(|preset| takes(preset.name()))
                });
                assert!(accepted, "no system takes --{option} {}", value.get_name());
                tried += 1;
            }
        }
        assert!(tried > 10);
    }
}
