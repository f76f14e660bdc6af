//! What is given for one option, and how it is read.

use rasray_ads::Addressing;

use crate::{Spec, SystemsError};

/// An option by its name, and what a value of it sets in a configuration.
pub(crate) type Setter<C> = (&'static str, fn(&mut C, &Given<'_>) -> Result<(), SystemsError>);

/// Names of options.
pub(crate) fn names<C>(setters: &[Setter<C>]) -> Vec<&'static str> {
    setters.iter().map(|(name, _)| *name).collect()
}

/// An option of a spec with its value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Given<'a> {
    system: &'static str,
    /// Name of the option.
    pub(crate) name: &'a str,
    value: &'a str,
}

impl<'a> Given<'a> {
    /// Sets what the options of a spec stand for.
    pub(crate) fn apply_all<C>(
        spec: &'a Spec,
        setters: &[Setter<C>],
        config: &mut C,
    ) -> Result<(), SystemsError> {
        Self::all(spec).try_for_each(|given| {
            let setter =
                setters.iter().find(|(name, _)| *name == given.name).ok_or_else(|| given.unknown())?;
            (setter.1)(config, &given)
        })
    }

    /// All options over the preset, by name.
    pub(crate) fn all(spec: &'a Spec) -> impl Iterator<Item = Self> {
        let system = spec.system().name;
        spec.options().iter().map(move |(name, value)| Given { system, name, value })
    }

    /// A whole number.
    pub(crate) fn number(&self) -> Result<u32, SystemsError> {
        self.value.parse().map_err(|_| self.refused("a whole number is expected"))
    }

    /// Columns and rows, or one number for both.
    pub(crate) fn cells(&self) -> Result<[u32; 2], SystemsError> {
        let (columns, rows) = self.value.split_once('x').unwrap_or((self.value, self.value));
        let side =
            |text: &str| text.parse().map_err(|_| self.refused("write columns x rows, such as 720x480"));
        Ok([side(columns)?, side(rows)?])
    }

    /// A length in metres.
    pub(crate) fn length(&self) -> Result<f32, SystemsError> {
        self.value.parse().map_err(|_| self.refused("a length in metres is expected"))
    }

    /// A share of a whole.
    pub(crate) fn share(&self) -> Result<f32, SystemsError> {
        self.value.parse().map_err(|_| self.refused("a number from 0 to 1 is expected"))
    }

    /// `on` or `off`.
    pub(crate) fn switch(&self) -> Result<bool, SystemsError> {
        self.choice(&[("on", true), ("off", false)])
    }

    /// One of several words.
    pub(crate) fn choice<T: Copy>(&self, words: &[(&str, T)]) -> Result<T, SystemsError> {
        words.iter().find(|(word, _)| *word == self.value).map(|(_, meaning)| *meaning).ok_or_else(|| {
            let known: Vec<_> = words.iter().map(|(word, _)| *word).collect();
            self.refused(&format!("it is one of: {}", known.join(", ")))
        })
    }

    /// How shaders reach the pools.
    pub(crate) fn addressing(&self) -> Result<Addressing, SystemsError> {
        self.choice(
            &[Addressing::Descriptor, Addressing::Address].map(|addressing| (addressing.name(), addressing)),
        )
    }

    /// An option that the system does not have.
    fn unknown(&self) -> SystemsError {
        SystemsError::UnknownOption { system: self.system, option: self.name.to_owned() }
    }

    /// A value that the system does not take.
    fn refused(&self, expected: &str) -> SystemsError {
        SystemsError::Value {
            system: self.system,
            option: self.name.to_owned(),
            value: self.value.to_owned(),
            expected: expected.to_owned(),
        }
    }
}
