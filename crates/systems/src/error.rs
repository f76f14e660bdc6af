//! Errors of the registry.

use rasray_ads::AdsError;
use rasray_options::ValueError;

/// Why a system cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SystemsError {
    /// No system of that name.
    #[error("there is no system `{name}`; the systems are {known}")]
    UnknownSystem {
        /// The requested name or value.
        name: String,
        /// Names of all systems.
        known: String,
    },
    /// The system lacks that preset.
    #[error("system {system} has no preset `{preset}`")]
    UnknownPreset {
        /// The system.
        system: &'static str,
        /// The requested name or value.
        preset: String,
    },
    /// The system lacks that option.
    #[error("system {system} has no option `{option}`")]
    UnknownOption {
        /// The system.
        system: &'static str,
        /// The requested name or value.
        option: String,
    },
    /// The option has no such value.
    #[error("{system}: {source}")]
    Value {
        /// The system.
        system: &'static str,
        /// The option and what it takes.
        source: ValueError,
    },
    /// The structure refused.
    #[error(transparent)]
    Ads(#[from] AdsError),
}
