//! From the words of the command line to rows of the registry: which system has which presets and
//! options, and how options given once reach several systems.

use crate::error::AppError;
use crate::structure::StructureOptions;
use clap::ValueEnum;
use rasray_scene::needs::{Integrator, Workload};
use rasray_scene::{Camera, Projection};
use rasray_systems::{Preset, SYSTEMS, Spec, System};

mod assigned;

use assigned::Assigned;

/// Most columns and rows of a camera's view.
const CAMERA_LIMIT: u32 = 8192;

/// A system with what was asked of it.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemConfig {
    /// The system.
    pub system: &'static System,
    /// Its preset.
    pub preset: Preset,
    /// Options over the preset; only such that the system has.
    pub options: StructureOptions,
    /// The options of several values, where the system takes part once with each.
    pub variant: Option<String>,
}

impl SystemConfig {
    /// The same for renders of a workload: published fragments carry what their paper keeps for occlusion
    /// where nothing else is asked for, unless a payload was given. Comparisons keep the preset's, since rays
    /// are compared in addition to the image.
    #[must_use]
    pub fn serving(mut self, workload: Workload) -> Self {
        let occlusion = workload.integrator == Integrator::AmbientOcclusion;
        if occlusion
            && self.preset == Preset::Published
            && self.options.text("payload").is_none()
            && let Some(word) = self.system.occlusion_payload
        {
            self.options = self.options.with("payload", word);
        }
        self
    }

    /// The same where a camera looks at the scene: published structures whose paper draws the camera's view draw it, a cell
    /// a pixel of the image, unless views were given. A parallel projection has no such view.
    #[must_use]
    pub fn seen_by(mut self, camera: &Camera, width: u32, height: u32) -> Self {
        let perspective = matches!(camera.projection, Projection::Perspective { .. });
        if let Some(views) = self.system.camera_views
            && perspective
            && self.preset == Preset::Published
            && self.options.text("views").is_none()
        {
            self.options = self.options.with("views", views);
            if self.options.text("camera-resolution").is_none() {
                let [columns, rows] = [width, height].map(|side| side.min(CAMERA_LIMIT));
                self.options = self.options.with("camera-resolution", format!("{columns}x{rows}"));
            }
        }
        self
    }

    /// What images of a workload lack: a warning where they shade and fragments carry nothing to shade by.
    pub fn shortcoming(&self, workload: Workload) -> Option<String> {
        let payload =
            self.options.text("payload").filter(|payload| ["normal", "plane"].contains(&payload.as_str()))?;
        (workload.integrator != Integrator::AmbientOcclusion).then(|| {
            let system = self.system.name;
            format!("{system}: fragments with --payload {payload} carry nothing to shade by, so that surfaces are white")
        })
    }

    /// What the registry makes the structure from.
    ///
    /// # Errors
    /// A usage error for values that do not go together; none for a config that [`single`] or
    /// [`several`] made.
    pub fn spec(&self) -> Result<Spec, AppError> {
        Spec::new(self.system.name, self.preset.name(), self.options.texts()).map_err(|error| {
            AppError::usage(error.to_string(), "change the option, or leave it to the preset")
        })
    }
}

/// The word of a value on the command line and in reports.
pub fn word(value: &impl ValueEnum) -> String {
    value.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

/// One system with its options, each of which it must have.
pub fn single(
    system: &'static System,
    preset: Preset,
    options: &StructureOptions,
) -> Result<SystemConfig, AppError> {
    if !system.presets.contains(&preset) {
        let own: Vec<_> = system.presets.iter().map(|preset| preset.name()).collect();
        let having: Vec<_> = SYSTEMS
            .iter()
            .filter(|system| system.presets.contains(&preset))
            .map(|system| system.name)
            .collect();
        return Err(AppError::usage(
            format!("system {} has no preset {}", system.name, preset.name()),
            format!("its presets: {}; choose another --system for it: {}", own.join(", "), having.join(", ")),
        ));
    }
    for option in options.given().keys() {
        if !system.has(option) {
            return Err(AppError::usage(
                format!("system {} has no option --{option}", system.name),
                format!("{}; leave it out or choose another --system", who_has(option)),
            ));
        }
    }
    let config = SystemConfig { system, preset, options: options.clone(), variant: None };
    config.spec()?;
    Ok(config)
}

/// Every named system with every named preset that it has. An option goes to the systems that have it;
/// `assignments` (`mmrt.samples=50`) address one system, or one preset of it (`mmrt-published.samples=50`),
/// which takes part once with each of several values (`mmrt.samples=50,100`) and with every combination of
/// them.
///
/// # Errors
/// A preset or an option that none of the named systems has, and a malformed assignment.
pub fn several(
    systems: &[&'static System],
    presets: &[Preset],
    options: &StructureOptions,
    assignments: &[String],
) -> Result<Vec<SystemConfig>, AppError> {
    for option in options.given().keys() {
        if !systems.iter().any(|system| system.has(option)) {
            return Err(AppError::usage(
                format!("none of the systems {} has an option --{option}", names(systems)),
                format!("{}; leave it out or add such a system to --systems", who_has(option)),
            ));
        }
    }
    for preset in presets {
        if !systems.iter().any(|system| system.presets.contains(preset)) {
            return Err(AppError::usage(
                format!("none of the systems {} has the preset {}", names(systems), preset.name()),
                "leave it out of --presets or add a system that has it to --systems",
            ));
        }
    }
    let assigned = assignments.iter().map(|text| Assigned::read(text)).collect::<Result<Vec<_>, _>>()?;
    if let Some(Assigned { system, .. }) =
        assigned.iter().find(|assigned| !systems.contains(&assigned.system))
    {
        return Err(AppError::usage(
            format!("an option addresses {}, which is not compared", system.name),
            format!("add {} to --systems or leave the option out", system.name),
        ));
    }
    let mut addressed = assigned.iter().filter_map(|assigned| assigned.preset);
    if let Some(preset) = addressed.find(|preset| !presets.contains(preset)) {
        return Err(AppError::usage(
            format!("an option addresses the preset {}, which is not compared", preset.name()),
            format!("add {} to --presets or leave the option out", preset.name()),
        ));
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
            for Assigned { values, .. } in assigned.iter().filter(addressed) {
                let combined = variants.iter().flat_map(|(own, variant)| {
                    values.iter().map(move |(over, word)| {
                        let words = [variant.as_str(), word.as_str()];
                        let several = words.into_iter().filter(|word| values.len() > 1 || *word != words[1]);
                        let variant = several.filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
                        (own.overlaid(over), variant)
                    })
                });
                variants = combined.collect();
            }
            for (own, variant) in variants {
                let variant = (!variant.is_empty()).then_some(variant);
                configs.push(SystemConfig { variant, ..single(system, *preset, &own)? });
            }
        }
    }
    Ok(configs)
}

fn names<'a>(systems: impl IntoIterator<Item = &'a &'static System>) -> String {
    systems.into_iter().map(|system| system.name).collect::<Vec<_>>().join(", ")
}

fn who_has(option: &str) -> String {
    let having: Vec<_> =
        SYSTEMS.iter().filter(|system| system.has(option)).map(|system| system.name).collect();
    if having.is_empty() {
        "no system has it".to_owned()
    } else {
        format!("it belongs to {}", having.join(", "))
    }
}

#[cfg(test)]
mod tests;
