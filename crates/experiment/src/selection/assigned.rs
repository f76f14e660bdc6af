//! Assigned options, each of which addresses one of the systems of a comparison.

use rasray_options::Value;
use rasray_systems::{Preset, System};

use super::error::SelectionError;

/// Option of one system, or of one preset of it, with values that it takes in turns.
pub(super) struct Assigned {
    pub(super) system: &'static System,
    pub(super) preset: Option<Preset>,
    pub(super) option: &'static str,
    /// Values, each with the option and value as they were written.
    pub(super) values: Vec<(Value, String)>,
}

impl Assigned {
    /// Reads `mmrt.samples=50`, `mmrt.samples=50,100` or `mmrt-published.samples=50`.
    pub(super) fn read(text: &str) -> Result<Self, SelectionError> {
        let shape = || SelectionError::Form { assignment: text.to_owned() };
        let (target, values) = text.split_once('=').ok_or_else(shape)?;
        let (system, option) = target.split_once('.').ok_or_else(shape)?;
        // Names of systems may have a hyphen of their own.
        let with_preset = || {
            let (system, preset) = system.rsplit_once('-')?;
            Some((System::named(system)?, Some(Preset::named(preset)?)))
        };
        let known = System::named(system).map(|system| (system, None)).or_else(with_preset);
        let (system, preset) = known.ok_or_else(|| SelectionError::UnknownSystem {
            assignment: text.to_owned(),
            system: system.to_owned(),
        })?;
        let row = system.option(option).map_err(|_| SelectionError::UnknownOption {
            assignment: text.to_owned(),
            system,
            option: option.to_owned(),
        })?;
        let parse = |value: &str| {
            let read = row.parse(value).map(|read| (read, format!("{option}={value}")));
            read.map_err(|source| SelectionError::Value { assignment: text.to_owned(), row, source })
        };
        let values = values.split(',').map(parse).collect::<Result<_, _>>()?;
        Ok(Self { system, preset, option: row.name, values })
    }
}

#[cfg(test)]
mod tests {
    use super::super::several_systems;
    use super::*;
    use crate::error::ExperimentError;
    use rasray_options::OptionValues;

    #[test]
    fn an_option_may_address_one_preset() {
        let assigned = |text: &str| {
            let presets = [Preset::Robust, Preset::Published];
            let names = ["mmrt", "brute-force"].map(|name| System::named(name).expect("a system"));
            several_systems(&names, &presets, &OptionValues::default(), &[text.to_owned()])
        };
        let configs = assigned("mmrt-robust.accept=interval,plane")
            .expect("published keeps no plane and is left alone");
        let shape: Vec<_> = configs.iter().map(|c| (c.system.name, c.preset, c.variant.as_deref())).collect();
        assert_eq!(
            shape,
            [
                ("mmrt", Preset::Robust, Some("accept=interval")),
                ("mmrt", Preset::Robust, Some("accept=plane")),
                ("mmrt", Preset::Published, None),
                ("brute-force", Preset::Robust, None),
            ]
        );
        assert!(assigned("mmrt.accept=interval,plane").is_err(), "published keeps no plane");
        for bad in ["brute-force-robust.buckets=4", "mmrt-other.samples=4"] {
            let error = assigned(bad).expect_err("no such option, no such preset");
            let is_option = matches!(error, ExperimentError::Selection(SelectionError::UnknownOption { .. }));
            assert_eq!(is_option, bad.starts_with("brute-force"), "{error:?}");
        }
        let one = several_systems(
            &[System::named("mmrt").expect("a system")],
            &[Preset::Robust],
            &OptionValues::default(),
            &["mmrt-published.samples=4".to_owned()],
        );
        assert!(one.expect_err("not compared").to_string().contains("published"));
    }
}
