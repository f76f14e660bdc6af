//! Options of systems as things to click on, made from the rows of the registry: none is named here.

use rasray_experiment::{ExperimentError, StructureOptions, SystemConfig, one_system};
use rasray_systems::{OptionRow, Preset, System, Values, Word};
use serde_json::Value;

/// What sets an option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// On or off.
    Switch,
    /// One of several words.
    Choice(&'static [Word]),
    /// A whole number from the first to the second.
    Whole(u32, u32),
    /// A number that is not negative, and what it counts.
    Number(&'static str),
    /// Columns and rows as text, such as `720x480`.
    Cells,
}

impl Control {
    /// The control of an option.
    pub fn of(row: &OptionRow) -> Self {
        match row.values {
            Values::Words(words) if is_switch(words) => Self::Switch,
            Values::Words(words) => Self::Choice(words),
            Values::Whole(lowest, highest) => Self::Whole(lowest, highest),
            Values::Metres => Self::Number("m"),
            Values::Share => Self::Number(""),
            Values::Cells => Self::Cells,
        }
    }
}

fn is_switch(words: &[Word]) -> bool {
    let has = |wanted| words.iter().any(|(word, _)| *word == wanted);
    words.len() == 2 && has("on") && has("off")
}

/// A system, its preset, and what was set of its options.
#[derive(Clone, Debug, PartialEq)]
pub struct OptionValues {
    system: &'static System,
    preset: Preset,
    set: StructureOptions,
}

impl OptionValues {
    /// As a configuration has them.
    pub fn new(config: &SystemConfig) -> Self {
        Self { system: config.system, preset: config.preset, set: config.options.clone() }
    }

    /// The system.
    pub fn system(&self) -> &'static System {
        self.system
    }

    /// The preset.
    pub fn preset(&self) -> Preset {
        self.preset
    }

    /// Whether anything was set.
    pub fn any_set(&self) -> bool {
        !self.set.given().is_empty()
    }

    /// What was set of an option, as it is typed; absent where the preset decides.
    pub fn text(&self, option: &str) -> Option<String> {
        self.set.text(option)
    }

    /// Sets an option.
    pub fn set(&mut self, option: &str, value: impl Into<Value>) {
        self.set = std::mem::take(&mut self.set).with(option, value);
    }

    /// Leaves an option to the preset.
    pub fn unset(&mut self, option: &str) {
        self.set = self.set.filtered(|name| name != option);
    }

    /// Leaves all options to the preset.
    pub fn unset_all(&mut self) {
        self.set = StructureOptions::default();
    }

    /// Changes to a system. Options mean something else there, so that all are left to the preset, which is kept where the
    /// system has it.
    pub fn choose_system(&mut self, system: &'static System) {
        if system != self.system {
            let preset = if system.presets.contains(&self.preset) { self.preset } else { system.presets[0] };
            *self = Self { system, preset, set: StructureOptions::default() };
        }
    }

    /// Changes to a preset.
    pub fn choose_preset(&mut self, preset: Preset) {
        self.preset = preset;
    }

    /// The configuration.
    ///
    /// # Errors
    /// Values that do not go together, in words.
    pub fn config(&self) -> Result<SystemConfig, ExperimentError> {
        one_system(self.system, self.preset, &self.set)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_systems::{OPTIONS, SYSTEMS};

    fn values(system: &str) -> OptionValues {
        let system = System::named(system).expect("a system");
        OptionValues::new(&SystemConfig {
            system,
            preset: system.presets[0],
            options: StructureOptions::default(),
            variant: None,
        })
    }

    #[test]
    fn every_option_has_a_control_and_every_word_is_reachable() {
        let mut kinds = [0; 3];
        for row in OPTIONS {
            match Control::of(row) {
                Control::Switch => kinds[0] += 1,
                Control::Choice(words) => {
                    assert!(!words.is_empty());
                    kinds[1] += 1;
                }
                Control::Whole(lowest, highest) => {
                    assert!(lowest < highest, "{}", row.name);
                    kinds[2] += 1;
                }
                Control::Number(_) | Control::Cells => (),
            }
        }
        assert!(kinds.iter().all(|count| *count > 0), "{kinds:?}");
    }

    #[test]
    fn what_is_set_is_in_the_configuration_and_what_is_left_is_not() {
        for system in SYSTEMS {
            let mut values = values(system.name);
            let rows = system.options();
            for row in &rows {
                values.set(row.name, row.tried()[0]);
            }
            assert_eq!(values.any_set(), !rows.is_empty());
            for row in &rows {
                assert_eq!(values.text(row.name).as_deref(), Some(row.tried()[0]));
                values.unset(row.name);
            }
            assert!(!values.any_set());
            let config = values.config().expect("a preset is valid");
            assert_eq!((config.system.name, config.options.given().len()), (system.name, 0));
        }
    }

    #[test]
    fn values_that_do_not_go_together_are_an_error_in_words() {
        let mut values = values("mmrt");
        values.choose_preset(Preset::Published);
        values.set("accept", "plane");
        assert!(values.config().expect_err("refused").to_string().contains("payload"));
        values.unset_all();
        assert!(values.config().is_ok());
    }

    #[test]
    fn another_system_keeps_the_preset_where_it_has_it() {
        let mut values = values("mmrt");
        values.choose_preset(Preset::Published);
        values.set("buckets", 2);
        values.choose_system(System::named("hu").expect("a system"));
        assert_eq!((values.preset(), values.any_set()), (Preset::Published, false));
        values.choose_system(System::named("brute-force").expect("a system"));
        assert_eq!(values.preset(), Preset::Robust);
    }
}
