//! Errors of the registry.

use rasray_ads::AdsError;
use rasray_options::ValueError;

/// Reason why a system cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SystemsError {
    /// There is no system with this name.
    #[error("there is no system `{name}`; the systems are {known}")]
    UnknownSystem {
        /// Name that was requested.
        name: String,
        /// Names of all systems.
        known: String,
    },
    /// The system has no preset with this name.
    #[error("system {system} has no preset `{preset}`")]
    UnknownPreset {
        /// Name of the system.
        system: &'static str,
        /// Name that was requested.
        preset: String,
    },
    /// The system has no option with this name.
    #[error("system {system} has no option `{option}`")]
    UnknownOption {
        /// Name of the system.
        system: &'static str,
        /// Name that was requested.
        option: String,
    },
    /// The option does not take this value.
    #[error("{system}: {source}")]
    Value {
        /// Name of the system.
        system: &'static str,
        /// Error with the option, the value and the values that the option takes.
        source: ValueError,
    },
    /// The structure has refused its configuration, the device or the geometry.
    #[error(transparent)]
    Ads(#[from] AdsError),
}
