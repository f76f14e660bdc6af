//! The frames of papers, as images take them.

use rasray_integrators::{INTEGRATORS, IntegratorRow};
use rasray_options::OptionValues;
use rasray_systems::{Preset, System};

use crate::SystemRequest;
use crate::frame::{OccluderKind, Primary};

/// Settings of an image where none are given.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameDefaults {
    /// The integrator.
    pub integrator: &'static IntegratorRow,
    /// Its options where they differ from its own defaults.
    pub options: OptionValues,
    /// Way in which first hits are found.
    pub primary: Primary,
    /// Occluder of shadow rays.
    pub occluder: OccluderKind,
}

impl Default for FrameDefaults {
    /// Paths through the structure alone.
    fn default() -> Self {
        Self {
            integrator: &INTEGRATORS[0],
            options: OptionValues::default(),
            primary: Primary::default(),
            occluder: OccluderKind::default(),
        }
    }
}

impl FrameDefaults {
    /// The frame of its paper for the published preset of a system, as far as a paper shows one. Other
    /// presets of the same system draw first hits as the paper does, and trace paths through the structure.
    ///
    /// # Panics
    /// The registry of systems names what there is not; a test reads all of its rows.
    pub fn of(system: &System, preset: Preset) -> Self {
        let Some(frame) = system.frame else { return Self::default() };
        let primary = Primary::named(frame.primary).expect("a way to first hits");
        if preset != Preset::Published {
            return Self { primary, ..Self::default() };
        }
        let integrator = IntegratorRow::named(frame.integrator).expect("a registered integrator");
        let option = |(name, text): &(&str, &str)| {
            let row = integrator.option(name).expect("an option of the integrator");
            (row.name, row.parse(text).expect("a value of the option"))
        };
        Self {
            integrator,
            options: frame.options.iter().map(option).collect(),
            primary,
            occluder: OccluderKind::named(frame.occluder).expect("an occluder"),
        }
    }
}

impl SystemRequest {
    /// Settings of images where none are given: [`FrameDefaults::of`] for a system that was named.
    pub fn frame_defaults(self, preset: Preset) -> FrameDefaults {
        match self {
            Self::Automatic => FrameDefaults::default(),
            Self::Named(system) => FrameDefaults::of(system, preset),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_integrators::IntegratorSpec;
    use rasray_systems::SYSTEMS;

    #[test]
    fn published_presets_have_the_frame_of_their_paper_and_others_its_first_hits() {
        for system in SYSTEMS {
            for preset in system.presets {
                let frame = FrameDefaults::of(system, *preset);
                IntegratorSpec::new(frame.integrator, &frame.options).expect("values that are taken");
                let plain = FrameDefaults { primary: frame.primary, ..FrameDefaults::default() };
                let is_published = *preset == Preset::Published;
                assert!(is_published || frame == plain, "{} {preset:?}", system.name);
                let is_drawn = frame.primary == Primary::Raster;
                assert_eq!(is_drawn, system.frame.is_some(), "{} {preset:?}", system.name);
            }
            assert_eq!(
                system.frame.is_some(),
                system.presets.contains(&Preset::Published),
                "{}",
                system.name
            );
        }
    }
}
