//! Values that were given for options, and the setters that take them.

use rasray_options::{Value, ValueError};

use crate::{Spec, SystemsError};

/// Name of an option, and the function that sets a value of it in a configuration.
pub(crate) type Setter<C> = (&'static str, fn(&mut C, &OptionValue) -> Result<(), SystemsError>);

/// Returns the names of the options of these setters.
pub(crate) fn names<C>(setters: &[Setter<C>]) -> Vec<&'static str> {
    setters.iter().map(|(name, _)| *name).collect()
}

/// Option of a spec with its value, which the row of the option has accepted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OptionValue {
    system: &'static str,
    /// Name of the option.
    name: &'static str,
    value: Value,
}

impl OptionValue {
    /// Sets all options of a spec in a configuration.
    pub(crate) fn apply_all<C>(
        spec: &Spec,
        setters: &[Setter<C>],
        config: &mut C,
    ) -> Result<(), SystemsError> {
        let system = spec.system().name;
        spec.options().iter().try_for_each(|(name, value)| {
            let unknown = || SystemsError::UnknownOption { system, option: name.to_owned() };
            let setter = setters.iter().find(|(known, _)| *known == name).ok_or_else(unknown)?;
            (setter.1)(config, &OptionValue { system, name, value })
        })
    }

    /// Returns the value as a whole number.
    pub(crate) fn whole(&self) -> Result<u32, SystemsError> {
        self.value.whole().ok_or_else(|| self.refused("must be a whole number".to_owned()))
    }

    /// Returns the value as columns and rows.
    pub(crate) fn cells(&self) -> Result<[u32; 2], SystemsError> {
        self.value.cells().ok_or_else(|| self.refused("must be columns x rows".to_owned()))
    }

    /// Returns the value as a number.
    pub(crate) fn number(&self) -> Result<f32, SystemsError> {
        self.value.number().ok_or_else(|| self.refused("must be a number".to_owned()))
    }

    /// Returns true for `on` and false for `off`.
    pub(crate) fn switch(&self) -> Result<bool, SystemsError> {
        self.choice(&[("on", true), ("off", false)])
    }

    /// Returns the meaning of the value, which has to be one of `words`: the words of the option's row that
    /// the system knows.
    pub(crate) fn choice<T: Copy>(&self, words: &[(&str, T)]) -> Result<T, SystemsError> {
        let known = words.iter().find(|(word, _)| self.value.word() == Some(word));
        known.map(|(_, meaning)| *meaning).ok_or_else(|| {
            let known: Vec<_> = words.iter().map(|(word, _)| *word).collect();
            self.refused(format!("must be one of: {}", known.join(", ")))
        })
    }

    /// Returns the error for a value that the system does not take.
    fn refused(&self, expected: String) -> SystemsError {
        let Self { system, name, value } = *self;
        SystemsError::Value {
            system,
            source: ValueError { option: name, value: value.to_string(), expected },
        }
    }
}
