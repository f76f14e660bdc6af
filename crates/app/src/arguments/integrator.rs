//! Integrators and their options on the command line, made from the rows of the registry.

use clap::builder::TypedValueParser;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use rasray_experiment::{
    ExperimentError, FrameDefaults, INTEGRATORS, IntegratorRow, IntegratorSpec, OptionValues,
    integrator_options,
};

use super::options::{arguments, choice, given};
use crate::error::AppError;

/// Reads the name of an integrator.
pub fn integrator_parser() -> impl TypedValueParser<Value = &'static IntegratorRow> {
    choice(INTEGRATORS, |integrator| (integrator.name, integrator.doc))
}

/// Returns the names of the integrators that have an option.
fn who_has(option: &str) -> Vec<&'static str> {
    INTEGRATORS.iter().filter(|row| row.option(option).is_some()).map(|row| row.name).collect()
}

/// The options of an integrator on the command line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IntegratorArguments(OptionValues);

impl IntegratorArguments {
    /// Makes an integrator with the options that were given.
    ///
    /// # Errors
    /// An option belongs to an integrator that was not chosen.
    pub fn of(&self, integrator: &'static IntegratorRow) -> Result<IntegratorSpec, AppError> {
        self.over(&FrameDefaults { integrator, ..FrameDefaults::default() })
    }

    /// Makes the integrator of `defaults`, whose options the given ones override.
    ///
    /// # Errors
    /// An option belongs to an integrator that was not chosen.
    pub fn over(&self, defaults: &FrameDefaults) -> Result<IntegratorSpec, AppError> {
        let integrator = defaults.integrator;
        if let Some((option, _)) = self.0.iter().find(|(name, _)| integrator.option(name).is_none()) {
            let names = who_has(option).join(" or ");
            return Err(AppError::usage(
                format!("--{option} is an option of --integrator {names}"),
                format!("leave it out, or say --integrator {names}"),
            ));
        }
        let values = defaults.options.iter().chain(self.0.iter()).collect();
        Ok(IntegratorSpec::new(integrator, &values).map_err(ExperimentError::from)?)
    }
}

impl Args for IntegratorArguments {
    fn augment_args(command: Command) -> Command {
        command.args(integrator_options().into_iter().flat_map(|row| {
            let help = format!("With --integrator {}: {}", who_has(row.name).join(" or "), row.help());
            arguments(row, help)
        }))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for IntegratorArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut options = Self::default();
        options.update_from_arg_matches(matches)?;
        Ok(options)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        for row in integrator_options() {
            if let Some(value) = given(row, matches) {
                self.0.set(row.name, value);
            }
        }
        Ok(())
    }
}
