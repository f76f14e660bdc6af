//! Settings of a picture, and the parts to make anew after a change.

use crate::camera_control::Rounded;
use rasray_experiment::{Aov, AovSelection, Frame, SystemConfig};
use rasray_scene::needs::Workload;

/// Picture or map to show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shown {
    /// Picture of the scene.
    #[default]
    Picture,
    /// Difference to the picture through a structure whose hits are exact.
    Difference,
    /// Number of cells visited by the ray through each pixel's centre.
    Cells,
    /// Number of entries or nodes that this ray read.
    Entries,
    /// Number of primitives that this ray was tested against.
    Tests,
}

impl Shown {
    /// All pictures and maps.
    pub const ALL: [Self; 5] = [Self::Picture, Self::Difference, Self::Cells, Self::Entries, Self::Tests];

    /// Returns the label.
    pub fn name(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Difference => "difference",
            Self::Cells => "cells",
            Self::Entries => "entries",
            Self::Tests => "tests",
        }
    }

    /// Returns the description, one sentence.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Picture => "The picture",
            Self::Difference => {
                "Absolute difference to the same picture through a structure whose hits are exact"
            }
            Self::Cells => "Cells visited by the ray through each pixel's centre",
            Self::Entries => "List entries or nodes read by the ray through each pixel's centre",
            Self::Tests => "Primitives tested by the ray through each pixel's centre",
        }
    }

    /// True for maps of the costs of rays, for which no light is needed.
    pub fn is_work(self) -> bool {
        matches!(self, Self::Cells | Self::Entries | Self::Tests)
    }
}

/// Standpoint from which the scene is seen.
#[derive(Clone, Debug, PartialEq)]
pub enum Standpoint {
    /// Camera of the command line; a camera of the scene moves with the scene.
    AsGiven,
    /// Camera of the scene by its index, which moves with the scene.
    Camera(usize),
    /// Camera that these numbers describe.
    Placed(Rounded),
}

/// Settings: everything that a picture depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Number of the scene among those that were opened one after another, from 0.
    pub scene: u32,
    /// Standpoint from which the scene is seen.
    pub standpoint: Standpoint,
    /// Time of the animation, seconds; absent at rest.
    pub seconds: Option<f64>,
    /// System through which rays are traced.
    pub system: SystemConfig,
    /// Frame: size, integrator, number of samples and their seed.
    pub frame: Frame,
    /// Picture or map to show.
    pub shown: Shown,
    /// True if the picture is denoised; maps, and pictures while something moves, are never denoised.
    pub denoised: bool,
    /// True if something moves: the picture then has fewer pixels if that is needed to keep up.
    pub moving: bool,
}

impl Settings {
    /// Returns the workload of the settings' pictures on a scene.
    pub(crate) fn workload(&self) -> Workload {
        let fed = self.denoised.then_some(Aov::FOR_DENOISING).into_iter().flatten();
        AovSelection::from_iter(fed).workload(self.frame.workload())
    }
}

/// Parts that must be made anew. A part that is made from another is made anew with the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Redo {
    /// Scene on the device. A change of the time does not set this: moving parts are posed, and structures
    /// are built for the pose.
    pub scene: bool,
    /// Structure.
    pub structure: bool,
    /// Films and the kernels that fill them.
    pub film: bool,
    /// Samples on the films.
    pub samples: bool,
    /// Pixels that are shown of the samples.
    pub pixels: bool,
}

impl Redo {
    /// All parts.
    pub const ALL: Self = Self { scene: true, structure: true, film: true, samples: true, pixels: true };

    /// Returns the parts that must be made anew for `new` if everything exists for `old`.
    pub fn between(old: &Settings, new: &Settings) -> Self {
        if old == new {
            return Self::default();
        }
        if old.scene != new.scene {
            return Self::ALL;
        }
        // The scene on the device holds only the data that its pictures can show.
        let scene = old.workload() != new.workload();
        let structure = scene || old.system != new.system;
        let size = |frame: &Frame| [frame.width, frame.height];
        let film =
            scene || old.frame.integrator != new.frame.integrator || size(&old.frame) != size(&new.frame);
        // Denoising uses the existing samples.
        let samples = scene || *old != Settings { denoised: old.denoised, ..new.clone() };
        Self { scene, structure, film, samples, pixels: true }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use rasray_experiment::{IntegratorRow, IntegratorSpec, OccluderKind, OptionValues, Primary, Sampler};
    use rasray_systems::{Preset, SYSTEMS};

    /// Returns an integrator with its defaults.
    pub(crate) fn integrator(name: &str) -> IntegratorSpec {
        IntegratorRow::named(name).expect("it is registered").into()
    }

    /// Returns settings that tests start from.
    pub(crate) fn some() -> Settings {
        let frame = Frame {
            integrator: integrator("path").with("bounces", 3).expect("valid"),
            width: 40,
            height: 30,
            spp: 4,
            adaptive: None,
            seed: 1,
            sampler: Sampler::Sobol,
            primary: Primary::Trace,
            occluder: OccluderKind::Structure,
            back_faces: rasray_scene::BackFaces::Camera,
        };
        let system = SystemConfig::new(&SYSTEMS[0], Preset::Robust, OptionValues::default());
        let standpoint = Standpoint::AsGiven;
        let (shown, denoised, moving) = (Shown::Picture, false, false);
        Settings { scene: 0, standpoint, seconds: None, system, frame, shown, denoised, moving }
    }

    fn redo(change: impl FnOnce(&mut Settings)) -> Redo {
        let old = some();
        let mut new = old.clone();
        change(&mut new);
        Redo::between(&old, &new)
    }

    #[test]
    fn nothing_is_made_anew_for_nothing() {
        assert_eq!(redo(|_| ()), Redo::default());
    }

    #[test]
    fn a_camera_and_a_time_cost_samples_alone() {
        let samples = Redo { samples: true, pixels: true, ..Redo::default() };
        let from = |eye: &str| {
            Standpoint::Placed(Rounded {
                eye: eye.into(),
                target: "0,0,0".into(),
                fov: "45".into(),
                lens: None,
            })
        };
        assert_eq!(redo(|new| new.standpoint = from("1,0,0")), samples);
        assert_eq!(redo(|new| new.moving = true), samples);
        assert_eq!(redo(|new| new.standpoint = Standpoint::Camera(0)), samples);
        assert_eq!(redo(|new| new.seconds = Some(0.5)), samples);
        assert_eq!(redo(|new| new.frame.seed = 2), samples);
        assert_eq!(redo(|new| new.frame.spp = 8), samples);
        assert_eq!(redo(|new| new.shown = Shown::Cells), samples);
        let mut placed = some();
        placed.standpoint = from("1,0,0");
        let mut elsewhere = placed.clone();
        assert_eq!(Redo::between(&placed, &elsewhere), Redo::default());
        elsewhere.standpoint = from("0,1,0");
        assert_eq!(Redo::between(&placed, &elsewhere), samples);
    }

    #[test]
    fn an_option_costs_the_structure_and_not_the_film() {
        let structure = Redo { structure: true, samples: true, pixels: true, ..Redo::default() };
        assert_eq!(redo(|new| new.system.system = &SYSTEMS[1]), structure);
        let options = OptionValues::default().with("grid", 8);
        assert_eq!(redo(|new| new.system.options = options), structure);
    }

    #[test]
    fn a_size_costs_the_film_and_not_the_structure() {
        let film = Redo { film: true, samples: true, pixels: true, ..Redo::default() };
        assert_eq!(redo(|new| new.frame.width = 41), film);
    }

    #[test]
    fn noise_is_taken_out_of_the_samples_that_are_there() {
        let pixels = Redo { pixels: true, ..Redo::default() };
        assert_eq!(redo(|new| new.denoised = true), pixels);
        let with_seed = Redo { samples: true, ..pixels };
        assert_eq!(redo(|new| (new.denoised, new.frame.seed) = (true, 2)), with_seed);
        // For a picture without materials the device has no materials, but a denoiser reads their colours.
        let mut old = some();
        old.frame.integrator = integrator("ao");
        let new = Settings { denoised: true, ..old.clone() };
        assert_eq!(Redo::between(&old, &new), Redo { film: true, structure: true, ..Redo::ALL });
    }

    #[test]
    fn another_light_and_another_scene_cost_everything() {
        assert_eq!(redo(|new| new.scene = 1), Redo::ALL);
        assert_eq!(redo(|new| new.frame.integrator = integrator("raycast")), Redo::ALL);
    }
}
