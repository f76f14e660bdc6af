//! Inputs of a picture, and what must be made anew where they change.

use crate::camera_control::Rounded;
use rasray_experiment::{Aov, AovSelection, Frame, SystemConfig};
use rasray_scene::needs::Workload;

/// Picture or map to show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shown {
    /// The picture.
    #[default]
    Picture,
    /// Distance from the same picture through a structure whose hits are exact.
    Difference,
    /// Cells visited by the ray through each pixel's centre.
    Cells,
    /// Entries or nodes that it read.
    Entries,
    /// Primitives that it was tested against.
    Tests,
}

impl Shown {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Picture, Self::Difference, Self::Cells, Self::Entries, Self::Tests];

    /// A label.
    pub fn name(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Difference => "difference",
            Self::Cells => "cells",
            Self::Entries => "entries",
            Self::Tests => "tests",
        }
    }

    /// Description, one sentence.
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

    /// True for maps of what rays cost, for which no light is needed.
    pub fn is_work(self) -> bool {
        matches!(self, Self::Cells | Self::Entries | Self::Tests)
    }
}

/// From where the scene is seen.
#[derive(Clone, Debug, PartialEq)]
pub enum Standpoint {
    /// As the command line said; a camera of the scene moves with it.
    AsGiven,
    /// From a camera of the scene, by its position, and with it.
    Camera(usize),
    /// From where these numbers say.
    Placed(Rounded),
}

/// Everything that a picture depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Number of the scene among those that were opened one after the other, from 0.
    pub scene: u32,
    /// From where.
    pub standpoint: Standpoint,
    /// Time of the animation, seconds; absent at rest.
    pub seconds: Option<f64>,
    /// Through what.
    pub system: SystemConfig,
    /// Size, integrator, number of samples and their seed.
    pub frame: Frame,
    /// Picture or map to show.
    pub shown: Shown,
    /// True if noise is taken out of the picture; maps and pictures while something moves have none of it.
    pub denoised: bool,
    /// True if something moves: the picture then has fewer pixels where that is needed to follow.
    pub moving: bool,
}

impl Settings {
    /// Workload of its pictures on a scene.
    pub(crate) fn workload(&self) -> Workload {
        let fed = self.denoised.then_some(Aov::FOR_DENOISING).into_iter().flatten();
        AovSelection::from_iter(fed).workload(self.frame.workload())
    }
}

/// Parts that must be made anew. What is made from something that is made anew is made anew as well.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Redo {
    /// The scene on the device. What moves in it is posed, and structures are built for it, where the time
    /// has changed.
    pub scene: bool,
    /// The structure.
    pub structure: bool,
    /// Films, and what fills them.
    pub film: bool,
    /// The samples on the films.
    pub samples: bool,
    /// The pixels shown of the samples.
    pub pixels: bool,
}

impl Redo {
    /// Everything.
    pub const ALL: Self = Self { scene: true, structure: true, film: true, samples: true, pixels: true };

    /// Parts that must be made anew for `new` where everything is there for `old`.
    pub fn between(old: &Settings, new: &Settings) -> Self {
        if old == new {
            return Self::default();
        }
        if old.scene != new.scene {
            return Self::ALL;
        }
        // The scene on the device holds what its pictures can show, and no more.
        let scene = old.workload() != new.workload();
        let structure = scene || old.system != new.system;
        let size = |frame: &Frame| [frame.width, frame.height];
        let film =
            scene || old.frame.integrator != new.frame.integrator || size(&old.frame) != size(&new.frame);
        // Noise is taken out of the samples that are there.
        let samples = scene || *old != Settings { denoised: old.denoised, ..new.clone() };
        Self { scene, structure, film, samples, pixels: true }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use rasray_experiment::{IntegratorRow, IntegratorSpec, OccluderKind, OptionValues, Primary, Sampler};
    use rasray_systems::{Preset, SYSTEMS};

    /// An integrator with its defaults.
    pub(crate) fn integrator(name: &str) -> IntegratorSpec {
        IntegratorRow::named(name).expect("it is registered").into()
    }

    /// Settings that tests start from.
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
        // A picture without materials has none on the device, and a denoiser reads their colours.
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
