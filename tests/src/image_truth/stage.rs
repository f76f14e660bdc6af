//! A scene on the device with a structure, a film and a camera.

use std::ops::Range;

use rasray_abuffer::{ABuffer, Config};
use rasray_ads::{BruteForce, RayQueue, Structure};
use rasray_gpu::Timing;
use rasray_gpu_scene::{GpuScene, Parts, Sampler, Sampling, SceneTables, View};
use rasray_integrators::{AmbientOcclusion, Film, Integrator, IntegratorDesc, Path, Wave};
use rasray_scene::{Camera, Scene};
use rasray_tracer::build_until_complete;

use super::Estimate;
use crate::harness::Bench;

/// What rays are traced through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// Every triangle: exact.
    BruteForce,
    /// The A-buffer's robust preset with this many cells a side.
    MmrtRobust(u32),
}

/// A rendered image.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Means of the samples, rows from the top.
    pub pixels: Vec<[f32; 3]>,
    /// Samples that were not finite.
    pub non_finite: u32,
}

/// Everything that renders one scene.
pub struct Stage<'a> {
    bench: &'a Bench,
    scene: GpuScene,
    structure: Box<dyn Structure>,
    film: Film,
    view: View,
}

impl<'a> Stage<'a> {
    /// Uploads the scene and builds the structure around the camera.
    ///
    /// # Panics
    /// If the scene is broken or the device fails.
    pub fn new(bench: &'a Bench, scene: &Scene, camera: Camera, size: u32, system: System) -> Self {
        let device = bench.device();
        let view = View { camera, width: size, height: size, seed: 1 };
        let origin = SceneTables::default_frame_origin(scene, view.eye());
        let tables = SceneTables::new(scene, origin, &Parts::ALL).expect("the scene is whole");
        let scene = GpuScene::upload(device, &tables, &view).expect("the scene fits");
        let (geometry, binding) = (scene.geometry(), Some(scene.binding()));
        let structure: Box<dyn Structure> = match system {
            System::BruteForce => {
                Box::new(BruteForce::new(device, geometry, binding, false).expect("pipelines are made"))
            }
            System::MmrtRobust(resolution) => {
                let config = Config::robust(resolution);
                Box::new(ABuffer::new(device, config, geometry, binding).expect("pipelines are made"))
            }
        };
        let film = Film::new(device, size, size).expect("a small film fits");
        let mut stage = Self { bench, scene, structure, film, view };
        stage.build();
        stage
    }

    fn build(&mut self) {
        let eye = self.scene.eye();
        build_until_complete(self.bench.device(), self.structure.as_mut(), eye, Timing::None)
            .expect("the build completes");
    }

    /// Moves the camera, and the structure's eye with it.
    ///
    /// # Panics
    /// If the device fails.
    pub fn look(&mut self, camera: Camera) {
        self.view.camera = camera;
        self.scene.update_camera(&self.view).expect("the frame can be written");
        self.build();
    }

    /// Draws other random numbers from now on.
    ///
    /// # Panics
    /// If the device fails.
    pub fn reseed(&mut self, seed: u32) {
        self.view.seed = seed;
        self.scene.update_camera(&self.view).expect("the frame can be written");
    }

    /// Draws independent random numbers from now on, whose errors have a law.
    ///
    /// # Panics
    /// If the device fails.
    pub fn sample_independently(&mut self) {
        let sampling = Sampling { sampler: Sampler::Pcg, ..Sampling::default() };
        self.scene.set_sampling(sampling).expect("the frame can be written");
    }

    /// What is rendered.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// The scene as uploaded.
    pub fn scene(&self) -> &GpuScene {
        &self.scene
    }

    /// Paths of at most `bounces` scatterings.
    ///
    /// # Panics
    /// If the device fails.
    pub fn path(&self, bounces: u32) -> Path {
        Path::new(&self.desc(), bounces).expect("the integrator is made")
    }

    /// Ambient occlusion within `range` metres.
    ///
    /// # Panics
    /// If the device fails.
    pub fn occlusion(&self, range: f32) -> AmbientOcclusion {
        AmbientOcclusion::new(&self.desc(), range).expect("the integrator is made")
    }

    fn desc(&self) -> IntegratorDesc<'_> {
        IntegratorDesc::new(self.bench.device(), &self.scene, &self.film)
    }

    /// Renders the samples with these indices.
    ///
    /// # Panics
    /// If the device fails or a ray was not finished.
    pub fn render(&self, integrator: &dyn Integrator, samples: Range<u32>) -> Picture {
        self.render_each(integrator, samples)
    }

    /// Renders samples in the order given; an index that comes again repeats its random numbers.
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
            let submitted = device
                .submit(|recorder| integrator.record_wave(recorder, self.structure.as_ref().into(), wave))
                .expect("the device works");
            submitted.value.expect("the wave fits");
        }
        for queue in integrator.queues() {
            let header = device.download_as(queue.header(), 0, 1).expect("the device works");
            let counters = RayQueue::counters(&header[0]);
            let faults = (counters.unfinished, counters.not_ready, counters.corrupted);
            assert_eq!(faults, (0, 0, 0), "rays are left over");
        }
        Picture {
            pixels: self.film.read(device).expect("the film is readable"),
            non_finite: self.film.read_faults(device).expect("the film is readable").non_finite,
        }
    }

    /// The image's mean over `samples` samples a pixel, an even number.
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
