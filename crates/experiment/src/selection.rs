//! Selection of systems from words: systems with presets and options of the registry, and options that are
//! given once for several systems.

use crate::error::ExperimentError;
use crate::system_config::SystemConfig;
use rasray_options::OptionValues;
use rasray_systems::{Preset, System};

mod assigned;
mod error;

use assigned::Assigned;
pub use error::SelectionError;

/// Makes the configuration of one system, which must have each of the options.
///
/// # Errors
/// The system does not have the preset or an option, or values do not go together.
pub fn one_system(
    system: &'static System,
    preset: Preset,
    options: &OptionValues,
) -> Result<SystemConfig, ExperimentError> {
    if !system.presets.contains(&preset) {
        return Err(SelectionError::NoPreset { system, preset }.into());
    }
    for (option, _) in options.iter() {
        if !system.has(option) {
            return Err(SelectionError::NoOption { system, option }.into());
        }
    }
    let config = SystemConfig::new(system, preset, options.clone());
    config.spec()?;
    Ok(config)
}

/// Makes the configurations of every named system with every named preset that it has. An option goes to the
/// systems that have it. An assignment (`mmrt.samples=50`) addresses one system, or one preset of it
/// (`mmrt-published.samples=50`); with several values (`mmrt.samples=50,100`) the system takes part once with
/// each value, and with every combination of several assignments.
///
/// # Errors
/// No named system has a preset or an option, or an assignment is malformed.
pub fn several_systems(
    systems: &[&'static System],
    presets: &[Preset],
    options: &OptionValues,
    assignments: &[String],
) -> Result<Vec<SystemConfig>, ExperimentError> {
    for (option, _) in options.iter() {
        if !systems.iter().any(|system| system.has(option)) {
            return Err(SelectionError::NoneHasOption { systems: systems.to_vec(), option }.into());
        }
    }
    for preset in presets {
        if !systems.iter().any(|system| system.presets.contains(preset)) {
            return Err(SelectionError::NoneHasPreset { systems: systems.to_vec(), preset: *preset }.into());
        }
    }
    let assigned = assignments.iter().map(|text| Assigned::read(text)).collect::<Result<Vec<_>, _>>()?;
    if let Some(Assigned { system, .. }) =
        assigned.iter().find(|assigned| !systems.contains(&assigned.system))
    {
        return Err(SelectionError::SystemNotCompared { system }.into());
    }
    let mut addressed = assigned.iter().filter_map(|assigned| assigned.preset);
    if let Some(preset) = addressed.find(|preset| !presets.contains(preset)) {
        return Err(SelectionError::PresetNotCompared { preset }.into());
    }
    let mut configs = Vec::new();
    for (position, system) in systems.iter().enumerate() {
        if systems[..position].contains(system) {
            continue;
        }
        for (position, preset) in presets.iter().enumerate() {
            if !system.presets.contains(preset) || presets[..position].contains(preset) {
                continue;
            }
            let addressed = |assigned: &&Assigned| {
                assigned.system == *system && assigned.preset.is_none_or(|addressed| addressed == *preset)
            };
            let mut variants = vec![(options.filtered(|option| system.has(option)), String::new())];
            for Assigned { option, values, .. } in assigned.iter().filter(addressed) {
                let combined = variants.iter().flat_map(|(own, variant)| {
                    values.iter().map(move |(value, word)| {
                        let words = [variant.as_str(), word.as_str()];
                        let several = words.into_iter().filter(|word| values.len() > 1 || *word != words[1]);
                        let variant = several.filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
                        (own.clone().with(option, *value), variant)
                    })
                });
                variants = combined.collect();
            }
            for (own, variant) in variants {
                let variant = (!variant.is_empty()).then_some(variant);
                configs.push(SystemConfig { variant, ..one_system(system, *preset, &own)? });
            }
        }
    }
    Ok(configs)
}

#[cfg(test)]
mod tests;
