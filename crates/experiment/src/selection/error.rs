//! Errors of systems, presets and options that do not go together.

use rasray_options::{OptionRow, ValueError};
use rasray_systems::{Preset, System};

/// Reason for which systems, presets and options do not go together.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SelectionError {
    /// A system lacks a preset.
    #[error("system {} has no preset {}", system.name, preset.name())]
    NoPreset {
        /// The system.
        system: &'static System,
        /// The preset.
        preset: Preset,
    },
    /// A system lacks an option.
    #[error("system {} has no option {option}", system.name)]
    NoOption {
        /// The system.
        system: &'static System,
        /// The option.
        option: &'static str,
    },
    /// None of several systems has an option.
    #[error("none of the systems {} has an option {option}", names(systems))]
    NoneHasOption {
        /// Systems without the option.
        systems: Vec<&'static System>,
        /// The option.
        option: &'static str,
    },
    /// None of several systems has a preset.
    #[error("none of the systems {} has the preset {}", names(systems), preset.name())]
    NoneHasPreset {
        /// Systems without the preset.
        systems: Vec<&'static System>,
        /// The preset.
        preset: Preset,
    },
    /// An option addresses a system that takes no part.
    #[error("an option addresses {}, which is not compared", system.name)]
    SystemNotCompared {
        /// The system.
        system: &'static System,
    },
    /// An option addresses a preset that takes no part.
    #[error("an option addresses the preset {}, which is not compared", preset.name())]
    PresetNotCompared {
        /// The preset.
        preset: Preset,
    },
    /// The assignment addresses nothing.
    #[error("'{assignment}' is not of the form SYSTEM.OPTION=VALUE or SYSTEM-PRESET.OPTION=VALUE")]
    Form {
        /// Assignment as it was written.
        assignment: String,
    },
    /// An assignment addresses a system that is not registered.
    #[error("'{assignment}': there is no system {system}")]
    UnknownSystem {
        /// Assignment as it was written.
        assignment: String,
        /// Name of the system.
        system: String,
    },
    /// An assignment addresses an option that its system lacks.
    #[error("'{assignment}': system {} has no option {option}", system.name)]
    UnknownOption {
        /// Assignment as it was written.
        assignment: String,
        /// The system.
        system: &'static System,
        /// The name of the option.
        option: String,
    },
    /// An assignment has a value that its option does not take.
    #[error("'{assignment}': {source}")]
    Value {
        /// Assignment as it was written.
        assignment: String,
        /// Option that the assignment addresses.
        row: &'static OptionRow,
        /// Error that names the accepted values.
        source: ValueError,
    },
}

/// Joins names with commas.
fn names(systems: &[&'static System]) -> String {
    systems.iter().map(|system| system.name).collect::<Vec<_>>().join(", ")
}
