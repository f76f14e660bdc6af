//! Controls for options, made from the rows of the options; no option is named here.

use rasray_experiment::{ExperimentError, OptionValues, SystemConfig, one_system};
use rasray_options::{Least, OptionRow, Unit, Values, Word};
use rasray_systems::{Preset, System};

/// Control of an option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// Switch between on and off.
    Switch,
    /// Choice of one word among several.
    Choice(&'static [Word]),
    /// Whole number from the first to the second value.
    Whole(u32, u32),
    /// Number with its unit, and the least value, which tells whether it may be 0.
    Number(Unit, Least),
    /// Text with a hint of its form, such as `WxH` for `720x480`.
    Text(&'static str),
}

impl Control {
    /// Returns the control of an option.
    pub fn of(row: &OptionRow) -> Self {
        match row.values {
            values if values.is_switch() => Self::Switch,
            Values::Words(words) => Self::Choice(words),
            Values::Whole(lowest, highest) => Self::Whole(lowest, highest),
            Values::Number(unit, least) => Self::Number(unit, least),
            Values::Cells(_) => Self::Text("WxH"),
            Values::Point => Self::Text("X,Y,Z"),
        }
    }
}

/// Choice of a system, its preset, and the options that were set.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemChoice {
    system: &'static System,
    preset: Preset,
    /// Values of the options that were set; the preset decides all others.
    pub options: OptionValues,
}

impl SystemChoice {
    /// Makes the choice that a configuration has.
    pub fn new(config: &SystemConfig) -> Self {
        Self { system: config.system, preset: config.preset, options: config.options.clone() }
    }

    /// Returns the system.
    pub fn system(&self) -> &'static System {
        self.system
    }

    /// Returns the preset.
    pub fn preset(&self) -> Preset {
        self.preset
    }

    /// Changes to a system. All options return to the preset, since they mean something else there; the
    /// preset is kept if the system has it.
    pub fn choose_system(&mut self, system: &'static System) {
        if system != self.system {
            let preset = if system.presets.contains(&self.preset) { self.preset } else { system.presets[0] };
            *self = Self { system, preset, options: OptionValues::default() };
        }
    }

    /// Changes to a preset.
    pub fn choose_preset(&mut self, preset: Preset) {
        self.preset = preset;
    }

    /// Returns the configuration.
    ///
    /// # Errors
    /// Values do not go together.
    pub fn config(&self) -> Result<SystemConfig, ExperimentError> {
        one_system(self.system, self.preset, &self.options)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_systems::{OPTIONS, SYSTEMS, StructureOption};

    fn choice(system: &str) -> SystemChoice {
        let system = System::named(system).expect("a system");
        SystemChoice::new(&SystemConfig::new(system, system.presets[0], OptionValues::default()))
    }

    #[test]
    fn every_option_has_a_control_and_every_word_is_reachable() {
        let mut kinds = [0; 3];
        for StructureOption { row, .. } in OPTIONS {
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
                Control::Number(..) | Control::Text(_) => (),
            }
        }
        assert!(kinds.iter().all(|count| *count > 0), "{kinds:?}");
    }

    #[test]
    fn what_is_set_is_in_the_configuration_and_what_is_left_is_not() {
        for system in SYSTEMS {
            let mut choice = choice(system.name);
            let rows = system.options();
            for StructureOption { row, .. } in &rows {
                choice.options.set(row.name, row.parse(row.tried()[0]).expect("it is tried"));
            }
            assert_eq!(choice.options.len(), rows.len());
            for StructureOption { row, .. } in &rows {
                choice.options.unset(row.name);
            }
            let config = choice.config().expect("a preset is valid");
            assert_eq!((config.system.name, config.options.len()), (system.name, 0));
        }
    }

    #[test]
    fn values_that_do_not_go_together_are_an_error_in_words() {
        let mut choice = choice("mmrt");
        choice.choose_preset(Preset::Published);
        choice.options.set("accept", "plane");
        assert!(choice.config().expect_err("refused").to_string().contains("payload"));
        choice.options = OptionValues::default();
        assert!(choice.config().is_ok());
    }

    #[test]
    fn another_system_keeps_the_preset_where_it_has_it() {
        let mut choice = choice("mmrt");
        choice.choose_preset(Preset::Published);
        choice.options.set("buckets", 2);
        choice.choose_system(System::named("hu").expect("a system"));
        assert_eq!((choice.preset(), choice.options.len()), (Preset::Published, 0));
        choice.choose_system(System::named("brute-force").expect("a system"));
        assert_eq!(choice.preset(), Preset::Robust);
    }
}
