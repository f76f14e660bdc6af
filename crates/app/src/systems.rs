//! Which system has which presets and options, and how options given once reach several systems.

use crate::error::AppError;
use crate::structure::{Preset, StructureOptions, SystemName};
use clap::{Parser, ValueEnum};

/// What the command line knows of a system.
#[derive(Clone, Copy, Debug)]
pub struct SystemEntry {
    /// The system.
    pub name: SystemName,
    /// The structure that it traces, as reports name it.
    pub structure: &'static str,
    /// The presets that it has.
    pub presets: &'static [Preset],
    /// The options of [`StructureOptions`] that it has, by their names on the command line.
    pub options: &'static [&'static str],
}

/// Every system the command can run.
pub const SYSTEMS: [SystemEntry; 2] = [
    SystemEntry {
        name: SystemName::Mmrt,
        structure: "abuffer",
        presets: &[Preset::Robust, Preset::Published],
        options: &[
            "resolution",
            "buckets",
            "storage",
            "payload",
            "march",
            "accept",
            "thickness",
            "coverage",
            "sort",
            "skip",
            "views",
            "addressing",
            "capacity",
        ],
    },
    SystemEntry {
        name: SystemName::BruteForce,
        structure: "brute-force",
        presets: &[Preset::Robust],
        options: &["addressing"],
    },
];

/// A system with what was asked of it.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemConfig {
    /// The system.
    pub name: SystemName,
    /// Its preset.
    pub preset: Preset,
    /// Options over the preset; only such that the system has.
    pub options: StructureOptions,
}

impl SystemConfig {
    /// The system's row in [`SYSTEMS`].
    pub fn entry(&self) -> &'static SystemEntry {
        entry(self.name)
    }
}

/// The word of a value on the command line and in reports.
pub fn word(value: &impl ValueEnum) -> String {
    value.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

/// The row of a system.
pub fn entry(name: SystemName) -> &'static SystemEntry {
    SYSTEMS.iter().find(|entry| entry.name == name).expect("every system has a row")
}

/// One system with its options, each of which it must have.
pub fn single(
    name: SystemName,
    preset: Preset,
    options: &StructureOptions,
) -> Result<SystemConfig, AppError> {
    let entry = entry(name);
    if !entry.presets.contains(&preset) {
        let system = word(&name);
        return Err(AppError::usage(
            format!("system {system} has no preset {}", word(&preset)),
            format!("its presets: {}", words(entry.presets)),
        ));
    }
    for option in options.given().keys() {
        if !entry.options.contains(&option.as_str()) {
            return Err(AppError::usage(
                format!("system {} has no option --{option}", word(&name)),
                format!("{}; leave it out or choose another --system", who_has(option)),
            ));
        }
    }
    Ok(SystemConfig { name, preset, options: options.clone() })
}

/// Every named system with every named preset that it has. An option goes to the systems that have
/// it; `assignments` (`mmrt.storage=sb`) address one system.
///
/// # Errors
/// A preset or an option that none of the named systems has, and a malformed assignment.
pub fn several(
    names: &[SystemName],
    presets: &[Preset],
    options: &StructureOptions,
    assignments: &[String],
) -> Result<Vec<SystemConfig>, AppError> {
    for option in options.given().keys() {
        if !names.iter().any(|name| entry(*name).options.contains(&option.as_str())) {
            return Err(AppError::usage(
                format!("none of the systems {} has an option --{option}", words(names)),
                format!("{}; leave it out or add such a system to --systems", who_has(option)),
            ));
        }
    }
    for preset in presets {
        if !names.iter().any(|name| entry(*name).presets.contains(preset)) {
            return Err(AppError::usage(
                format!("none of the systems {} has the preset {}", words(names), word(preset)),
                "leave it out of --presets or add a system that has it to --systems",
            ));
        }
    }
    let assigned = assignments.iter().map(|text| assignment(text)).collect::<Result<Vec<_>, _>>()?;
    if let Some((name, _)) = assigned.iter().find(|(name, _)| !names.contains(name)) {
        return Err(AppError::usage(
            format!("an option addresses {}, which is not compared", word(name)),
            format!("add {} to --systems or leave the option out", word(name)),
        ));
    }
    let mut configs = Vec::new();
    for (position, name) in names.iter().enumerate() {
        if names[..position].contains(name) {
            continue;
        }
        let entry = entry(*name);
        let mut own = options.filtered(|option| entry.options.contains(&option));
        for (_, over) in assigned.iter().filter(|(target, _)| target == name) {
            own = own.overlaid(over);
        }
        for (position, preset) in presets.iter().enumerate() {
            if entry.presets.contains(preset) && !presets[..position].contains(preset) {
                configs.push(single(*name, *preset, &own)?);
            }
        }
    }
    Ok(configs)
}

/// Reads `mmrt.storage=sb` with the parser of the command line, so that both know the same values.
fn assignment(text: &str) -> Result<(SystemName, StructureOptions), AppError> {
    #[derive(Parser)]
    #[command(no_binary_name = true, disable_help_flag = true)]
    struct One {
        #[command(flatten)]
        options: StructureOptions,
    }
    let shape = || {
        AppError::usage(
            format!("'{text}' is not of the form SYSTEM.OPTION=VALUE"),
            "write for example mmrt.storage=sb",
        )
    };
    let (target, value) = text.split_once('=').ok_or_else(shape)?;
    let (system, option) = target.split_once('.').ok_or_else(shape)?;
    let name = SystemName::from_str(system, false).map_err(|_| {
        AppError::usage(
            format!("'{text}': there is no system {system}"),
            format!("the systems: {}", words(SystemName::value_variants())),
        )
    })?;
    if !entry(name).options.contains(&option) {
        return Err(AppError::usage(
            format!("'{text}': system {system} has no option {option}"),
            who_has(option),
        ));
    }
    let parsed = One::try_parse_from([format!("--{option}={value}")])
        .map_err(|error| crate::arguments::usage_error(&error, &format!("'{text}': "), Some("compare")))?;
    Ok((name, parsed.options))
}

fn words<T: ValueEnum>(values: &[T]) -> String {
    values.iter().map(word).collect::<Vec<_>>().join(", ")
}

fn who_has(option: &str) -> String {
    let having: Vec<_> = SYSTEMS
        .iter()
        .filter(|entry| entry.options.contains(&option))
        .map(|entry| word(&entry.name))
        .collect();
    if having.is_empty() {
        "no system has it".to_owned()
    } else {
        format!("it belongs to {}", having.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::Storage;

    fn with_buckets() -> StructureOptions {
        StructureOptions { buckets: Some(4), ..Default::default() }
    }

    #[test]
    fn every_option_named_in_a_row_exists_and_every_option_has_a_system() {
        let command = <StructureOptions as clap::Args>::augment_args(clap::Command::new("options"));
        let known: Vec<_> = command.get_arguments().filter_map(|argument| argument.get_long()).collect();
        for entry in SYSTEMS {
            for option in entry.options {
                assert!(known.contains(option), "{option}");
            }
        }
        for option in known {
            assert!(SYSTEMS.iter().any(|entry| entry.options.contains(&option)), "{option}");
        }
    }

    #[test]
    fn an_option_of_another_system_is_refused_by_name() {
        let error =
            single(SystemName::BruteForce, Preset::Robust, &with_buckets()).expect_err("not its option");
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains("--buckets") && error.help().contains("mmrt"), "{error}");
        assert!(single(SystemName::Mmrt, Preset::Robust, &with_buckets()).is_ok());
    }

    #[test]
    fn in_a_comparison_an_option_goes_to_those_who_have_it() {
        let names = [SystemName::Mmrt, SystemName::BruteForce, SystemName::Mmrt];
        let presets = [Preset::Published, Preset::Robust];
        let configs =
            several(&names, &presets, &with_buckets(), &["mmrt.storage=sb".to_owned()]).expect("valid");
        let shape: Vec<_> = configs.iter().map(|c| (c.name, c.preset, c.options.buckets)).collect();
        assert_eq!(
            shape,
            [
                (SystemName::Mmrt, Preset::Published, Some(4)),
                (SystemName::Mmrt, Preset::Robust, Some(4)),
                (SystemName::BruteForce, Preset::Robust, None),
            ]
        );
        assert_eq!(configs[0].options.storage, Some(Storage::Sb));
    }

    #[test]
    fn in_a_comparison_what_nobody_has_is_refused() {
        let judge = [SystemName::BruteForce];
        let plain = StructureOptions::default();
        assert!(several(&judge, &[Preset::Robust], &with_buckets(), &[]).is_err());
        assert!(several(&judge, &[Preset::Published], &plain, &[]).is_err());
        for bad in
            ["mmrt.storage=sb", "mmrt", "nobody.sort=on", "brute-force.sort=on", "brute-force.addressing=x"]
        {
            let error = several(&judge, &[Preset::Robust], &plain, &[bad.to_owned()]).expect_err(bad);
            assert_eq!(error.exit_code(), 2);
        }
    }
}
