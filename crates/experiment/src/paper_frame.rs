//! Frames of papers, as settings of images.

use rasray_integrators::{INTEGRATORS, IntegratorRow};
use rasray_options::OptionValues;
use rasray_systems::{Preset, System};

use crate::SystemRequest;
use crate::frame::{OccluderKind, Primary};

/// Default settings of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameDefaults {
    /// Integrator.
    pub integrator: &'static IntegratorRow,
    /// Options of the integrator where they differ from the integrator's own defaults.
    pub options: OptionValues,
    /// Method that finds first hits.
    pub primary: Primary,
    /// Occluder of shadow rays.
    pub occluder: OccluderKind,
}

impl Default for FrameDefaults {
    /// Returns paths that are traced through the structure alone.
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
    /// Returns the frame of the paper for the published preset of a system, as far as the paper shows one.
    /// Other presets of the system find first hits as the paper does, and trace paths through the structure.
    ///
    /// # Panics
    /// The registry of systems names an integrator or an option that does not exist; a test reads all of its
    /// rows.
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
    /// Returns the default settings of images: [`FrameDefaults::of`] for a system that was named.
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
