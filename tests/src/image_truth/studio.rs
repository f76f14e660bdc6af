//! Studio: a scene on the device with a structure, a film and a camera.

use std::ops::Range;

use rasray_experiment::{Built, DeviceScene};
use rasray_gpu::Timing;
use rasray_gpu_scene::{GpuScene, Sampling, View};
use rasray_integrators::{AmbientOcclusion, Film, Integrator, IntegratorDesc, Path, PathOptions, Wave};
use rasray_scene::needs::Needs;
use rasray_scene::{Camera, Sampler, Scene};
use rasray_systems::Spec;

use super::Estimate;
use crate::harness::Bench;

/// System through which rays are traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// Brute force over every triangle, which is exact.
    BruteForce,
    /// A-buffer with this many cells along a side, whose rays meet fragments at the centres of cells.
    Fragments(u32),
}

impl System {
    /// Returns the specification of the system.
    fn spec(self) -> Spec {
        let spec = match self {
            Self::BruteForce => Spec::new("brute-force", "robust", []),
            Self::Fragments(resolution) => {
                let options = [("resolution", resolution.to_string()), ("coverage", "exact".to_owned())];
                Spec::new("mmrt", "robust", options.map(|(name, value)| (name.to_owned(), value)))
            }
        };
        spec.expect("both systems are registered")
    }
}

/// Rendered image.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Means of the samples, rows from the top.
    pub pixels: Vec<[f32; 3]>,
    /// Number of samples that were not finite.
    pub non_finite: u32,
}

/// Studio with everything that renders one scene.
pub struct Studio<'a> {
    bench: &'a Bench,
    stage: DeviceScene,
    built: Built,
    film: Film,
    view: View,
}

impl<'a> Studio<'a> {
    /// Uploads the scene and builds the structure around the camera.
    ///
    /// # Panics
    /// If the scene is broken or the device fails.
    pub fn new(bench: &'a Bench, scene: &Scene, camera: Camera, size: u32, system: System) -> Self {
        let device = bench.device();
        let view = View { camera, width: size, height: size, seed: 1 };
        let stage = DeviceScene::new(device, scene, &view.camera, [size, size], view.seed, &Needs::all())
            .expect("the scene is whole and fits");
        let built =
            Built::new(device, &system.spec(), &stage.scene, stage.scene.eye()).expect("the build completes");
        let film = Film::new(device, size, size).expect("a small film fits");
        Self { bench, stage, built, film, view }
    }

    /// Moves the camera, and the structure's eye with it.
    ///
    /// # Panics
    /// If the device fails.
    pub fn look(&mut self, camera: Camera) {
        self.view.camera = camera;
        self.stage.scene.update_camera(&self.view).expect("the frame can be written");
        self.built.follow(self.bench.device(), &self.stage.scene, &[false]).expect("the build completes");
    }

    /// Changes the random numbers from now on.
    ///
    /// # Panics
    /// If the device fails.
    pub fn reseed(&mut self, seed: u32) {
        self.view.seed = seed;
        self.stage.scene.update_camera(&self.view).expect("the frame can be written");
    }

    /// Draws independent random numbers from now on, whose errors follow a law.
    ///
    /// # Panics
    /// If the device fails.
    pub fn sample_independently(&mut self) {
        let sampling = Sampling { sampler: Sampler::Pcg, ..Sampling::default() };
        self.stage.scene.set_sampling(sampling).expect("the frame can be written");
    }

    /// Returns the view that is rendered.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Returns the scene as uploaded.
    pub fn scene(&self) -> &GpuScene {
        &self.stage.scene
    }

    /// Makes an integrator of paths; a number of bounces is enough as options.
    ///
    /// # Panics
    /// If the device fails.
    pub fn path(&self, options: impl Into<PathOptions>) -> Path {
        Path::new(&self.desc(), options).expect("the integrator is made")
    }

    /// Makes an integrator of ambient occlusion within `range` metres.
    ///
    /// # Panics
    /// If the device fails.
    pub fn occlusion(&self, range: f32) -> AmbientOcclusion {
        AmbientOcclusion::new(&self.desc(), range).expect("the integrator is made")
    }

    fn desc(&self) -> IntegratorDesc<'_> {
        IntegratorDesc::new(self.bench.device(), &self.stage.scene, &self.film)
    }

    /// Renders the samples with these indices.
    ///
    /// # Panics
    /// If the device fails or a ray was not finished.
    pub fn render(&self, integrator: &dyn Integrator, samples: Range<u32>) -> Picture {
        self.render_each(integrator, samples)
    }

    /// Renders samples in the order given; a repeated index repeats its random numbers.
    ///
    /// # Panics
    /// If the device fails or a ray was not finished.
    pub fn render_each(
        &self,
        integrator: &dyn Integrator,
        samples: impl IntoIterator<Item = u32>,
    ) -> Picture {
        let device = self.bench.device();
        let pixel_count = self.film.pixel_count();
        assert!(integrator.wave_capacity() >= pixel_count, "small images are one wave");
        device.submit(|recorder| integrator.record_reset(recorder)).expect("the device works");
        for sample in samples {
            let wave = Wave { first_pixel: 0, pixel_count, sample };
            let traced = self.built.structure().into();
            integrator.render_wave(device, Timing::None, traced, wave).expect("the wave fits");
        }
        for queue in integrator.queues() {
            let counters = queue.download_counters(device).expect("the device works");
            let faults = (counters.unfinished, counters.not_ready, counters.corrupted);
            assert_eq!(faults, (0, 0, 0), "rays are left over");
        }
        let faults = self.film.read_faults(device).expect("the film is readable");
        assert_eq!((faults.unended, faults.cut), (0, 0), "surfaces are left to pass");
        let pixels = self.film.read(device).expect("the film is readable");
        Picture { pixels, non_finite: faults.non_finite }
    }

    /// Estimates the image's mean over `samples` samples per pixel, an even number.
    ///
    /// # Panics
    /// If the device fails or a sample was not finite.
    pub fn estimate(&self, integrator: &dyn Integrator, samples: u32) -> Estimate {
        let half = (samples / 2).max(1);
        let pictures = [self.render(integrator, 0..half), self.render(integrator, half..2 * half)];
        assert!(pictures.iter().all(|picture| picture.non_finite == 0), "samples are not finite");
        Estimate::of_pair(&pictures[0].pixels, &pictures[1].pixels)
    }
}
