//! Options that address one of the systems of a comparison.

use clap::{Parser, ValueEnum};

use super::{entry, who_has, words};
use crate::error::AppError;
use crate::structure::{Preset, StructureOptions, SystemName};

/// An option of one system, or of one preset of it, with values that it takes in turns.
pub(super) struct Assigned {
    pub(super) name: SystemName,
    pub(super) preset: Option<Preset>,
    /// The option with each value, and how both were written.
    pub(super) values: Vec<(StructureOptions, String)>,
}

impl Assigned {
    /// Reads `mmrt.samples=50`, `mmrt.samples=50,100` or `mmrt-published.samples=50` with the parser of the
    /// command line, so that both know the same values.
    pub(super) fn read(text: &str) -> Result<Self, AppError> {
        #[derive(Parser)]
        #[command(no_binary_name = true, disable_help_flag = true)]
        struct One {
            #[command(flatten)]
            options: StructureOptions,
        }
        let shape = || {
            AppError::usage(
                format!("'{text}' is not of the form SYSTEM.OPTION=VALUE or SYSTEM-PRESET.OPTION=VALUE"),
                "write for example mmrt.samples=50",
            )
        };
        let (target, values) = text.split_once('=').ok_or_else(shape)?;
        let (system, option) = target.split_once('.').ok_or_else(shape)?;
        // Names of systems may have a hyphen of their own.
        let whole = SystemName::from_str(system, false).map(|name| (name, None));
        let with_preset = || {
            let (system, preset) = system.rsplit_once('-').ok_or_else(String::new)?;
            Ok((SystemName::from_str(system, false)?, Some(Preset::from_str(preset, false)?)))
        };
        let (name, preset) = whole.or_else(|_: String| with_preset()).map_err(|_: String| {
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
        let parse = |value: &str| {
            One::try_parse_from([format!("--{option}={value}")])
                .map(|parsed| (parsed.options, format!("{option}={value}")))
                .map_err(|error| {
                    crate::arguments::usage_error(&error, &format!("'{text}': "), Some("compare"))
                })
        };
        Ok(Self { name, preset, values: values.split(',').map(parse).collect::<Result<_, _>>()? })
    }
}

#[cfg(test)]
mod tests {
    use super::super::several;
    use super::*;

    #[test]
    fn an_option_may_address_one_preset() {
        let assigned = |text: &str| {
            let presets = [Preset::Robust, Preset::Published];
            let names = [SystemName::Dirt, SystemName::BruteForce];
            several(&names, &presets, &StructureOptions::default(), &[text.to_owned()])
        };
        let configs =
            assigned("dirt-robust.views=cube,axes").expect("published has no bricks and is left alone");
        let shape: Vec<_> = configs.iter().map(|c| (c.name, c.preset, c.variant.as_deref())).collect();
        assert_eq!(
            shape,
            [
                (SystemName::Dirt, Preset::Robust, Some("views=cube")),
                (SystemName::Dirt, Preset::Robust, Some("views=axes")),
                (SystemName::Dirt, Preset::Published, None),
                (SystemName::BruteForce, Preset::Robust, None),
            ]
        );
        assert!(assigned("dirt.views=cube,axes").is_err(), "published has no bricks");
        assert_eq!(assigned("brute-force-robust.buckets=4").expect_err("not its option").exit_code(), 2);
        assert_eq!(assigned("dirt-other.tile=4").expect_err("no preset").exit_code(), 2);
        let one = several(
            &[SystemName::Dirt],
            &[Preset::Robust],
            &StructureOptions::default(),
            &["dirt-published.tile=4".to_owned()],
        );
        assert!(one.expect_err("not compared").to_string().contains("published"));
    }
}
