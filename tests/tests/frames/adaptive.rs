//! More samples where there is more noise: the pixels of an image are those of images with as many samples,
//! and their mean over many images is that of images with as many samples everywhere.

use std::ops::ControlFlow;

use rasray_experiment::{Built, DeviceScene};
use rasray_frame::{Adaptive, FrameError, ImagePasses, ImageRenderer};
use rasray_gpu::{Device, Timing};
use rasray_gpu_scene::View;
use rasray_integrators::{
    Film, FilmPixel, INTEGRATORS, Integrator, IntegratorDesc, IntegratorError, IntegratorSpec, Visibility,
};
use rasray_scene::needs::Needs;
use rasray_scene::{Material, Scene, builtin};
use rasray_tests::harness::Bench;

use super::pictures::spec;

pub const SIZE: [u32; 2] = [24, 16];

/// Fewer slots than there are pixels: the waves of a sample end within a row.
const SLOTS: u32 = 100;

const MOST: u32 = 12;

/// Every pixel gets so many samples.
const LEAST: u32 = 4;

pub fn rule(threshold: f64) -> Adaptive {
    Adaptive { threshold, least: LEAST }
}

pub fn cornell() -> Scene {
    builtin::builtin("cornell").expect("it is built in").expect("it needs no parameter")
}

/// [`cornell`] with a block that light goes straight through: other kernels add to the film.
pub fn glazed() -> Scene {
    let mut glazed = cornell();
    let block = glazed.meshes[glazed.instances.last().expect("a block").mesh].material;
    glazed.materials[block] =
        Material { transmission: 1.0, roughness: 0.0, metallic: 0.0, ..Material::default() };
    glazed
}

/// A scene on the device with what rays are traced through.
pub struct Stage<'a> {
    pub device: &'a Device,
    pub shown: DeviceScene,
    pub built: Built,
    view: View,
    /// Most pixels of a band of its films.
    pub band: u32,
}

impl<'a> Stage<'a> {
    pub fn new(device: &'a Device, scene: &Scene) -> Self {
        let view = View { camera: scene.cameras[0].clone(), width: SIZE[0], height: SIZE[1], seed: 7 };
        let shown = DeviceScene::new(device, scene, &view.camera, SIZE, view.seed, &Needs::all());
        let shown = shown.expect("the scene is whole and fits");
        let built = Built::new(device, &spec("bvh", &[]), &shown.scene, shown.scene.eye());
        Self { device, shown, built: built.expect("the build completes"), view, band: u32::MAX }
    }

    pub fn film(&self) -> Film {
        Film::with_bands(self.device, SIZE[0], SIZE[1], self.band).expect("a small film fits")
    }

    pub fn integrator(&self, spec: &IntegratorSpec, film: &Film) -> Box<dyn Integrator> {
        let desc = IntegratorDesc::new(self.device, &self.shown.scene, film);
        spec.make(&IntegratorDesc { wave_capacity: SLOTS, ..desc }).expect("the integrator is made")
    }

    /// An image in the making, of which some pixels get more samples than others.
    pub fn adaptive(&self, spec: &IntegratorSpec, threshold: f64) -> ImageRenderer {
        let film = self.film().listed(self.device).expect("the device works");
        let image = ImageRenderer::new(self.device, self.integrator(spec, &film), 0..MOST);
        image.and_then(|image| image.adapting(rule(threshold))).expect("the device works")
    }

    fn fixed(&self, spec: &IntegratorSpec) -> ImageRenderer {
        ImageRenderer::new(self.device, self.integrator(spec, &self.film()), 0..MOST)
            .expect("the device works")
    }

    /// Renders until `ends` says so of the samples that are done; all if it never does.
    pub fn render(&self, image: &mut ImageRenderer, ends: impl Fn(u32) -> bool) -> Vec<FilmPixel> {
        let after = |image: &ImageRenderer, _| match ends(image.samples_done()) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        image.render(self.built.structure(), Timing::None, after).expect("the waves fit");
        assert!(image.is_between_samples() && image.unfinished() == 0);
        image.film().read_pixels(self.device).expect("the device works")
    }
}

/// True if films that different kernels made are equal: bit for bit on a software device. Hardware may
/// contract a product and a sum in one kernel and not in another.
fn is_same(device: &Device, a: &FilmPixel, b: &FilmPixel) -> bool {
    let is_close = |(a, b): (&f32, &f32)| (a - b).abs() <= 1.0e-5 * b.abs();
    a.samples == b.samples
        && if device.is_software() { a.sum == b.sum } else { a.sum.iter().zip(&b.sum).all(is_close) }
}

/// Every pixel of an adaptive image is what it is in an image of as many samples everywhere; numbers of
/// samples differ.
fn check_pixels(stage: &Stage<'_>, spec: &IntegratorSpec) {
    // One ray decides between black and white in every pixel, or only the edges of surfaces have noise.
    let threshold = if spec.name() == "ao" { 0.35 } else { 0.1 };
    let mut image = stage.adaptive(spec, threshold);
    image.warm_up(stage.built.structure()).expect("the device works");
    let found = stage.render(&mut image, |_| false);
    assert_eq!((image.samples_done(), image.waves_done()), (MOST, image.waves()));
    let mut fixed = stage.fixed(spec);
    let mut by_samples = vec![Vec::new()];
    for sample in 1..=MOST {
        while fixed.samples_done() < sample {
            fixed.advance(stage.built.structure(), Timing::None).expect("the wave fits");
        }
        by_samples.push(fixed.film().read_pixels(stage.device).expect("the device works"));
    }
    for (number, pixel) in found.iter().enumerate() {
        let expected = &by_samples[pixel.samples as usize][number];
        assert!(
            is_same(stage.device, pixel, expected),
            "{spec:?}: pixel {number}: {pixel:?}, not {expected:?}"
        );
    }
    let having = |samples| found.iter().filter(|pixel| pixel.samples == samples).count();
    assert!(found.iter().all(|pixel| pixel.samples >= LEAST));
    let others = found.len() - having(MOST) - having(LEAST);
    assert!(others > 0 && having(MOST) < found.len(), "{spec:?}: numbers of samples do not differ");

    // The image again, given up after 6 samples: those of the first so many that the pixels get.
    image.clear().expect("the device works");
    let early = stage.render(&mut image, |done| done == 6);
    assert_eq!(image.samples_done(), 6);
    for (number, (pixel, whole)) in early.iter().zip(&found).enumerate() {
        let expected = &by_samples[whole.samples.min(6) as usize][number];
        assert!(is_same(stage.device, pixel, expected), "{spec:?}: pixel {number} of an early end");
    }
}

#[test]
fn pixels_are_those_of_images_with_as_many_samples() {
    let bench = Bench::new();
    let stage = Stage::new(bench.device(), &cornell());
    for row in INTEGRATORS {
        check_pixels(&stage, &row.into());
    }
    let stage = Stage::new(bench.device(), &glazed());
    for row in &INTEGRATORS[..2] {
        check_pixels(&stage, &row.into());
    }
}

#[test]
fn the_mean_over_many_images_is_that_of_as_many_samples_everywhere() {
    let bench = Bench::new();
    let mut stage = Stage::new(bench.device(), &cornell());
    let path = IntegratorSpec::from(&INTEGRATORS[0]).with("bounces", 2).expect("an option of paths");
    let (mut adaptive, mut fixed) = (stage.adaptive(&path, 0.1), stage.fixed(&path));
    let mean = |film: Vec<FilmPixel>| {
        film.iter().map(|pixel| f64::from(pixel.mean()[1])).sum::<f64>() / film.len() as f64
    };
    // Images of other random numbers each: the two ways are independent of each other.
    let mut differences = Vec::new();
    let mut taken = 0;
    for number in 0..100 {
        let mut of_seed = |image: &mut ImageRenderer, seed| {
            stage.view.seed = seed;
            stage.shown.scene.update_camera(&stage.view).expect("the frame can be written");
            image.clear().expect("the device works");
            stage.render(image, |_| false)
        };
        let film = of_seed(&mut adaptive, 2 * number);
        taken += film.iter().map(|pixel| pixel.samples).sum::<u32>();
        differences.push(mean(film) - mean(of_seed(&mut fixed, 2 * number + 1)));
    }
    let count = differences.len() as f64;
    let average = differences.iter().sum::<f64>() / count;
    let squares: f64 = differences.iter().map(|difference| (difference - average).powi(2)).sum();
    let error = (squares / (count - 1.0) / count).sqrt();
    assert!(average.abs() < 3.0 * error, "the means differ by {average} +- {error}");
    let share = f64::from(taken) / (count * f64::from(SIZE[0] * SIZE[1] * MOST));
    assert!((0.4..0.95).contains(&share), "{share} of the samples were taken");
}

#[test]
fn what_cannot_be_shared_is_refused() {
    let bench = Bench::new();
    let device = bench.device();
    let stage = Stage::new(device, &cornell());
    let spec = IntegratorSpec::from(&INTEGRATORS[0]);
    let refused = |passes: ImagePasses| {
        let image = ImageRenderer::new(device, passes, 0..MOST).expect("the device works");
        image.adapting(rule(0.1)).expect_err("it is refused")
    };
    let plain = refused(stage.integrator(&spec, &stage.film()).into());
    assert!(matches!(plain, FrameError::Integrator(IntegratorError::NotListed)), "{plain}");
    let film = stage.film().listed(device).expect("the device works");
    let drawn = Visibility::new(device, &stage.shown.scene, false).expect("the device draws");
    let passes = ImagePasses::from(stage.integrator(&spec, &film)).with_visibility(Some(drawn));
    let drawn = refused(passes);
    assert!(matches!(drawn, FrameError::DrawnAdaptively), "{drawn}");
    let beyond = film.write_list(device, 0, &[3, SIZE[0] * SIZE[1]]).expect_err("there is no such pixel");
    assert!(
        matches!(beyond, IntegratorError::NoPixel { pixel: 384, ref band } if *band == (0..384)),
        "{beyond}"
    );
    assert!(film.write_list(device, 0, &[0; 385]).is_err(), "more than the image has");
}
