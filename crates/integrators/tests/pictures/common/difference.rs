//! Comparison of a device image with the image of the CPU.

use std::fmt::{self, Debug, Display, Formatter};

use rasray_gpu_scene::Sampling;
use rasray_integrators::{IntegratorRow, IntegratorSpec};
use rasray_reference::integrators::NaiveIntegrator;
use rasray_reference::shading::{PosedScene, View};
use rasray_scene::{BackFaces, Camera, Sampler, Scene};

use super::{Setup, assert_silent, drawing_device, mean};
use crate::kept_pictures::Compared;

pub const WIDTH: u32 = 16;
pub const HEIGHT: u32 = 12;
const SEED: u32 = 11;

fn integrator(name: &str) -> IntegratorSpec {
    IntegratorRow::named(name).expect("it is registered").into()
}

/// Makes paths of at most so many bounces.
pub fn path(bounces: u32) -> IntegratorSpec {
    integrator("path").with("bounces", bounces).expect("valid")
}

/// Makes paths with panes that stop shadow rays.
pub fn opaque_panes(bounces: u32) -> IntegratorSpec {
    path(bounces).with("glass-shadows", "opaque").expect("valid")
}

/// Makes occlusion within so many metres.
pub fn occlusion(range: f32) -> IntegratorSpec {
    integrator("ao").with("ao-distance", range).expect("valid")
}

/// Makes ray casting.
pub fn raycast() -> IntegratorSpec {
    integrator("raycast")
}

/// Differences between an image and its reference.
pub struct Difference {
    /// Share of the pixels that differ by more than 1e-3 of their value.
    pub share: f64,
    /// Difference of the means over the mean of the reference.
    pub mean: f64,
    /// The image and its reference, [`WIDTH`] pixels a row.
    pictures: [Vec<[f32; 3]>; 2],
}

impl Difference {
    /// Fails the running test if a difference exceeds its bound; both pictures are kept.
    #[track_caller]
    pub fn assert_within(&self, share: f64, mean: f64, why: impl Display) {
        self.assert(self.share <= share && self.mean <= mean, why);
    }

    /// Fails the running test unless `holds`; both pictures are kept.
    #[track_caller]
    pub fn assert(&self, holds: bool, why: impl Display) {
        let [picture, reference] = &self.pictures;
        Compared { picture, reference, width: WIDTH }.assert(holds, format_args!("{why}: {self:?}"));
    }
}

impl Debug for Difference {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { share, mean, .. } = self;
        f.debug_struct("Difference").field("share", share).field("mean", mean).finish_non_exhaustive()
    }
}

/// Renders `shown` on the device and `scene` on the CPU.
pub fn difference(
    shown: &Scene,
    scene: &Scene,
    camera: &Camera,
    samples: u32,
    integrator: &IntegratorSpec,
) -> Difference {
    sampled_difference(shown, scene, camera, samples, integrator, Sampler::default())
}

/// Renders with rays that pass backs: `shown` on the device, and on the CPU with `back_faces`.
pub fn passing_difference(
    [shown, back_faces]: [BackFaces; 2],
    scene: &Scene,
    camera: &Camera,
    samples: u32,
    integrator: &IntegratorSpec,
) -> Difference {
    made_difference([scene, scene], camera, samples, integrator, Sampler::default(), [shown, back_faces])
}

/// Renders `shown` and `scene` with the numbers of a sampler.
pub fn sampled_difference(
    shown: &Scene,
    scene: &Scene,
    camera: &Camera,
    samples: u32,
    integrator: &IntegratorSpec,
    sampler: Sampler,
) -> Difference {
    made_difference([shown, scene], camera, samples, integrator, sampler, [BackFaces::default(); 2])
}

fn made_difference(
    [shown, scene]: [&Scene; 2],
    camera: &Camera,
    samples: u32,
    integrator: &IntegratorSpec,
    sampler: Sampler,
    [passed, back_faces]: [BackFaces; 2],
) -> Difference {
    let device = drawing_device();
    let mut stage = Setup::new(&device, shown, camera.clone(), WIDTH, HEIGHT, SEED);
    stage
        .scene
        .set_sampling(Sampling { sampler, samples, back_faces: passed })
        .expect("the frame can be written");
    let view = View { camera: camera.clone(), width: WIDTH, height: HEIGHT, samples, seed: SEED, sampler };
    let posed = PosedScene::new(scene, stage.scene.frame_origin()).expect("the scene is well formed");
    let posed = posed.with_back_faces(back_faces);
    let image = stage.render(integrator.make(&stage.desc()).expect("valid").as_ref(), samples);
    let naive = NaiveIntegrator::named(integrator.name()).expect("every integrator has a reference");
    let reference = naive.render(&posed, &view, &integrator.values()).expect("valid").pixels;
    let faults = stage.film.read_faults(&device).expect("readable");
    assert_eq!((faults.non_finite, faults.unended, faults.cut), (0, 0, 0));
    let differs = |(a, b): (&[f32; 3], &[f32; 3])| {
        (0..3).any(|channel| (a[channel] - b[channel]).abs() > 1e-3 * (b[channel].abs() + 1e-2))
    };
    let count = image.iter().zip(&reference).filter(|&pair| differs(pair)).count();
    let (mean_image, mean_reference) = (mean(&image), mean(&reference));
    assert!(mean_reference > 0.01, "{}: the reference is black", scene.name);
    assert_silent(&device);
    Difference {
        share: count as f64 / image.len() as f64,
        mean: (mean_image - mean_reference).abs() / mean_reference,
        pictures: [image, reference],
    }
}
