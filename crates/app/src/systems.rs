//! From the words of the command line to rows of the registry: which system has which presets and
//! options, and how options given once reach several systems.

use crate::error::AppError;
use crate::structure::{Payload, Preset, StructureOptions, SystemName, Views};
use clap::ValueEnum;
use rasray_scene::needs::{Integrator, Workload};
use rasray_scene::{Camera, Projection};
use rasray_systems::{SYSTEMS, Spec, System};
use serde_json::Value;

mod assigned;

use assigned::Assigned;

/// Most columns and rows of a camera's view.
const CAMERA_LIMIT: u32 = 8192;

/// A system with what was asked of it.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemConfig {
    /// The system.
    pub name: SystemName,
    /// Its preset.
    pub preset: Preset,
    /// Options over the preset; only such that the system has.
    pub options: StructureOptions,
    /// The options of several values, where the system takes part once with each.
    pub variant: Option<String>,
}

impl SystemConfig {
    /// The system's row in the registry.
    pub fn entry(&self) -> &'static System {
        entry(self.name)
    }

    /// The same for renders of a workload: published fragments carry what their paper keeps for occlusion
    /// where nothing else is asked for, unless a payload was given. Comparisons keep the preset's, since rays
    /// are compared beside the image.
    #[must_use]
    pub fn serving(mut self, workload: Workload) -> Self {
        let occlusion = workload.integrator == Integrator::AmbientOcclusion;
        if occlusion && self.preset == Preset::Published && self.options.payload.is_none() {
            let word = self.entry().occlusion_payload;
            self.options.payload =
                word.map(|word| Payload::from_str(word, false).expect("a test looks it up"));
        }
        self
    }

    /// The same where a camera looks at the scene: published structures whose paper draws the camera's view draw it, a cell
    /// a pixel of the image, unless views were given. A parallel projection has no such view.
    #[must_use]
    pub fn seen_by(mut self, camera: &Camera, width: u32, height: u32) -> Self {
        let perspective = matches!(camera.projection, Projection::Perspective { .. });
        if let Some(views) = self.entry().camera_views
            && perspective
            && self.preset == Preset::Published
            && self.options.views.is_none()
        {
            self.options.views = Some(Views::from_str(views, false).expect("a test looks it up"));
            if self.options.camera_resolution.is_none() {
                let [columns, rows] = [width, height].map(|side| side.min(CAMERA_LIMIT));
                self.options.camera_resolution = Some(format!("{columns}x{rows}"));
            }
        }
        self
    }

    /// What images of a workload lack: a warning where they shade and fragments carry nothing to shade by.
    pub fn shortcoming(&self, workload: Workload) -> Option<String> {
        let unshaded =
            self.options.payload.filter(|payload| matches!(payload, Payload::Normal | Payload::Plane))?;
        (workload.integrator != Integrator::AmbientOcclusion).then(|| {
            let (system, payload) = (word(&self.name), word(&unshaded));
            format!("{system}: fragments with --payload {payload} carry nothing to shade by, so that surfaces are white")
        })
    }

    /// What the registry makes the structure from.
    ///
    /// # Errors
    /// A usage error for values that do not go together; none for a config that [`single`] or
    /// [`several`] made.
    pub fn spec(&self) -> Result<Spec, AppError> {
        let options = self.options.given().into_iter().map(|(name, value)| match value {
            Value::String(word) => (name, word),
            number => (name, number.to_string()),
        });
        Spec::new(self.entry().name, &word(&self.preset), options).map_err(|error| {
            AppError::usage(error.to_string(), "change the option, or leave it to the preset")
        })
    }
}

/// The word of a value on the command line and in reports.
pub fn word(value: &impl ValueEnum) -> String {
    value.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

/// The row of a system in the registry.
pub fn entry(name: SystemName) -> &'static System {
    let name = word(&name);
    SYSTEMS.iter().find(|row| row.name == name).expect("a test looks every name up")
}

/// Whether a system has a preset.
fn has_preset(system: &System, preset: Preset) -> bool {
    system.presets.iter().any(|known| known.name() == word(&preset))
}

/// One system with its options, each of which it must have.
pub fn single(
    name: SystemName,
    preset: Preset,
    options: &StructureOptions,
) -> Result<SystemConfig, AppError> {
    let entry = entry(name);
    if !has_preset(entry, preset) {
        let system = word(&name);
        return Err(AppError::usage(
            format!("system {system} has no preset {}", word(&preset)),
            format!(
                "its presets: {}",
                entry.presets.iter().map(|known| known.name()).collect::<Vec<_>>().join(", ")
            ),
        ));
    }
    for option in options.given().keys() {
        if !entry.options.contains(&option.as_str()) {
            return Err(AppError::usage(
                format!("system {} has no option --{option}", word(&name)),
                format!("{}; leave it out or choose another --system", who_has(option)),
            ));
        }
    }
    let config = SystemConfig { name, preset, options: options.filtered(|_| true), variant: None };
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
    names: &[SystemName],
    presets: &[Preset],
    options: &StructureOptions,
    assignments: &[String],
) -> Result<Vec<SystemConfig>, AppError> {
    for option in options.given().keys() {
        if !names.iter().any(|name| entry(*name).options.contains(&option.as_str())) {
            return Err(AppError::usage(
                format!("none of the systems {} has an option --{option}", words(names)),
                format!("{}; leave it out or add such a system to --systems", who_has(option)),
            ));
        }
    }
    for preset in presets {
        if !names.iter().any(|name| has_preset(entry(*name), *preset)) {
            return Err(AppError::usage(
                format!("none of the systems {} has the preset {}", words(names), word(preset)),
                "leave it out of --presets or add a system that has it to --systems",
            ));
        }
    }
    let assigned = assignments.iter().map(|text| Assigned::read(text)).collect::<Result<Vec<_>, _>>()?;
    if let Some(Assigned { name, .. }) = assigned.iter().find(|assigned| !names.contains(&assigned.name)) {
        return Err(AppError::usage(
            format!("an option addresses {}, which is not compared", word(name)),
            format!("add {} to --systems or leave the option out", word(name)),
        ));
    }
    let mut addressed = assigned.iter().filter_map(|assigned| assigned.preset);
    if let Some(preset) = addressed.find(|preset| !presets.contains(preset)) {
        return Err(AppError::usage(
            format!("an option addresses the preset {}, which is not compared", word(&preset)),
            format!("add {} to --presets or leave the option out", word(&preset)),
        ));
    }
    let mut configs = Vec::new();
    for (position, name) in names.iter().enumerate() {
        if names[..position].contains(name) {
            continue;
        }
        let entry = entry(*name);
        for (position, preset) in presets.iter().enumerate() {
            if !has_preset(entry, *preset) || presets[..position].contains(preset) {
                continue;
            }
            let addressed = |assigned: &&Assigned| {
                assigned.name == *name && assigned.preset.is_none_or(|addressed| addressed == *preset)
            };
            let mut variants =
                vec![(options.filtered(|option| entry.options.contains(&option)), String::new())];
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
                configs.push(SystemConfig { variant, ..single(*name, *preset, &own)? });
            }
        }
    }
    Ok(configs)
}

fn words<T: ValueEnum>(values: &[T]) -> String {
    values.iter().map(word).collect::<Vec<_>>().join(", ")
}

fn who_has(option: &str) -> String {
    let having: Vec<_> =
        SYSTEMS.iter().filter(|entry| entry.options.contains(&option)).map(|entry| entry.name).collect();
    if having.is_empty() {
        "no system has it".to_owned()
    } else {
        format!("it belongs to {}", having.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::Accept;

    fn with_buckets() -> StructureOptions {
        StructureOptions { buckets: Some(4), ..Default::default() }
    }

    #[test]
    fn the_command_line_knows_the_systems_of_the_registry() {
        let typed: Vec<_> = SystemName::value_variants().iter().map(word).collect();
        let registered: Vec<_> = SYSTEMS.iter().map(|row| row.name).collect();
        assert_eq!(typed, registered);
        for name in SystemName::value_variants() {
            let known = entry(*name).presets;
            let typed =
                Preset::value_variants().iter().filter(|preset| has_preset(entry(*name), **preset)).count();
            assert_eq!(typed, known.len());
        }
    }

    #[test]
    fn every_value_of_the_command_line_is_one_of_the_registry() {
        let command = <StructureOptions as clap::Args>::augment_args(clap::Command::new("options"));
        let mut tried = 0;
        // `--decoupled` is another word for `--inline=off` and has no values.
        for argument in command.get_arguments().filter(|argument| argument.get_id() != "decoupled") {
            for value in argument.get_possible_values() {
                let option = argument.get_long().expect("every option has a name");
                let takes = |system: &System, preset: &str, accept: &str| {
                    let options = [("accept", accept), (option, value.get_name())]
                        .into_iter()
                        .filter(|(name, _)| system.options.contains(name) || *name == option)
                        .map(|(name, word)| (name.to_owned(), word.to_owned()));
                    Spec::new(system.name, preset, options).is_ok()
                };
                // Planes exclude attributes and samples, bricks of triangles the rules of a paper; fringes need planes.
                let accepted = SYSTEMS.iter().any(|system| {
                    let accepts = ["interval", "plane", "parity", "tolerance", "t"];
                    let takes = |preset: &str| accepts.iter().any(|accept| takes(system, preset, accept));
                    system.presets.iter().any(|preset| takes(preset.name()))
                });
                assert!(accepted, "no system takes --{option} {}", value.get_name());
                tried += 1;
            }
        }
        assert!(tried > 10);
    }

    #[test]
    fn published_fragments_carry_what_their_paper_keeps_for_occlusion() {
        let occlusion = Workload { integrator: Integrator::AmbientOcclusion, bounces: 1 };
        let path = Workload { integrator: Integrator::Path, bounces: 1 };
        let plain = StructureOptions::default();
        for name in SystemName::value_variants() {
            let Ok(config) = single(*name, Preset::Published, &plain) else { continue };
            let payload = config.clone().serving(occlusion).options.payload.as_ref().map(word);
            assert_eq!(payload.as_deref(), entry(*name).occlusion_payload);
            assert!(config.clone().serving(occlusion).spec().is_ok());
            assert_eq!(config.clone().serving(path), config);
        }
        let given = StructureOptions { payload: Some(Payload::Attributes), ..plain.clone() };
        for (preset, options) in [(Preset::Published, &given), (Preset::Robust, &plain)] {
            let config = single(SystemName::Mmrt, preset, options).expect("valid");
            assert_eq!(config.clone().serving(occlusion), config);
        }
        assert_eq!(entry(SystemName::Mmrt).occlusion_payload, Some("normal"));
        let plane = StructureOptions { payload: Some(Payload::Plane), ..plain };
        let plane = single(SystemName::Mmrt, Preset::Robust, &plane).expect("valid");
        assert!(plane.shortcoming(path).expect("white surfaces").contains("--payload plane"));
        assert_eq!(plane.shortcoming(occlusion), None);
        let attributes = single(SystemName::Mmrt, Preset::Published, &given).expect("valid");
        assert_eq!(attributes.shortcoming(path), None);
    }

    #[test]
    fn published_views_are_those_of_the_paper() {
        let eye = glam::DVec3::new(0.0, 0.0, 4.0);
        let camera = rasray_scene::default_view::camera_looking_at("", eye, glam::DVec3::ZERO, 1.0);
        let plain = StructureOptions::default();
        for name in SystemName::value_variants() {
            for preset in [Preset::Robust, Preset::Published] {
                let Ok(config) = single(*name, preset, &plain) else { continue };
                let seen = config.clone().seen_by(&camera, 720, 480);
                let views = entry(*name).camera_views.filter(|_| preset == Preset::Published);
                assert_eq!(seen.options.views.as_ref().map(word).as_deref(), views);
                assert_eq!(seen.options.camera_resolution.as_deref(), views.map(|_| "720x480"));
                seen.spec().expect("the options go together");
            }
        }
        assert_eq!(entry(SystemName::Mmrt).camera_views, Some("cube+camera"));
        let published = single(SystemName::Mmrt, Preset::Published, &plain).expect("valid");
        let parallel = Camera { projection: Projection::Orthographic { half_height: 1.0 }, ..camera.clone() };
        assert_eq!(published.clone().seen_by(&parallel, 720, 480), published);
        let given = StructureOptions { views: Some(Views::Cube), ..plain };
        let given = single(SystemName::Mmrt, Preset::Published, &given).expect("valid");
        assert_eq!(given.clone().seen_by(&camera, 720, 480), given);
    }

    #[test]
    fn values_that_do_not_go_together_are_refused_before_a_device_is_opened() {
        let options = StructureOptions { accept: Some(Accept::Plane), ..Default::default() };
        let error =
            single(SystemName::Mmrt, Preset::Published, &options).expect_err("no plane in attributes");
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains("payload"), "{error}");
        assert!(single(SystemName::Mmrt, Preset::Robust, &options).is_ok());
    }

    #[test]
    fn every_option_named_in_a_row_exists_and_every_option_has_a_system() {
        let command = <StructureOptions as clap::Args>::augment_args(clap::Command::new("options"));
        let known: Vec<_> = command.get_arguments().filter_map(|argument| argument.get_long()).collect();
        for entry in SYSTEMS {
            for option in entry.options {
                assert!(known.contains(option), "{option}");
            }
        }
        // `--decoupled` is another word for `--inline=off`.
        for option in known.into_iter().filter(|option| *option != "decoupled") {
            assert!(SYSTEMS.iter().any(|entry| entry.options.contains(&option)), "{option}");
        }
    }

    #[test]
    fn an_option_of_another_system_is_refused_by_name() {
        let error =
            single(SystemName::BruteForce, Preset::Robust, &with_buckets()).expect_err("not its option");
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains("--buckets") && error.help().contains("mmrt"), "{error}");
        assert!(single(SystemName::Mmrt, Preset::Robust, &with_buckets()).is_ok());
    }

    #[test]
    fn in_a_comparison_an_option_goes_to_those_who_have_it() {
        let names = [SystemName::Mmrt, SystemName::BruteForce, SystemName::Mmrt];
        let presets = [Preset::Published, Preset::Robust];
        let configs =
            several(&names, &presets, &with_buckets(), &["mmrt.samples=50".to_owned()]).expect("valid");
        let shape: Vec<_> = configs.iter().map(|c| (c.name, c.preset, c.options.buckets)).collect();
        assert_eq!(
            shape,
            [
                (SystemName::Mmrt, Preset::Published, Some(4)),
                (SystemName::Mmrt, Preset::Robust, Some(4)),
                (SystemName::BruteForce, Preset::Robust, None),
            ]
        );
        assert_eq!(configs[0].options.samples, Some(50));
    }

    #[test]
    fn several_values_make_as_many_contestants() {
        let assigned = ["mmrt.samples=50,100".to_owned(), "mmrt.sort=on,off".to_owned()];
        let names = [SystemName::Mmrt, SystemName::BruteForce];
        let configs =
            several(&names, &[Preset::Robust], &StructureOptions::default(), &assigned).expect("valid");
        let shape: Vec<_> = configs.iter().map(|c| (c.name, c.options.samples, c.options.sort)).collect();
        assert_eq!(shape.len(), 5);
        assert_eq!(shape[4], (SystemName::BruteForce, None, None));
        let variants: Vec<_> = configs.iter().map(|config| config.variant.as_deref()).collect();
        let of = |samples, sort| format!("samples={samples} sort={sort}");
        assert_eq!(variants[0], Some(of(50, "on").as_str()));
        assert_eq!(variants[3], Some(of(100, "off").as_str()));
        assert_eq!(variants[4], None);
        for (index, samples) in [(0, 50), (1, 50), (2, 100), (3, 100)] {
            assert_eq!((shape[index].0, shape[index].1), (SystemName::Mmrt, Some(samples)));
        }
        assert!(shape[0].2.is_some() && shape[0].2 != shape[1].2 && shape[0].2 == shape[2].2);
    }

    #[test]
    fn in_a_comparison_what_nobody_has_is_refused() {
        let judge = [SystemName::BruteForce];
        let plain = StructureOptions::default();
        assert!(several(&judge, &[Preset::Robust], &with_buckets(), &[]).is_err());
        assert!(several(&judge, &[Preset::Published], &plain, &[]).is_err());
        for bad in [
            "mmrt.samples=50",
            "mmrt",
            "nobody.sort=on",
            "brute-force.sort=on",
            "mmrt.sort=x",
            "mmrt.sort=on,x",
            "mmrt.sort=on,",
        ] {
            let error = several(&judge, &[Preset::Robust], &plain, &[bad.to_owned()]).expect_err(bad);
            assert_eq!(error.exit_code(), 2);
        }
    }
}
