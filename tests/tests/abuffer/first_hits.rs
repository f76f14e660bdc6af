//! First hits of camera rays that are read from the camera's view: where a cell is a pixel, those of traces
//! through the pixels' centres, however the lists are kept.

use rasray_ads::AdsError;
use rasray_experiment::{Built, DeviceScene};
use rasray_frame::{FrameError, ImagePasses, ImageRenderer};
use rasray_integrators::{AovPixel, Film, IntegratorDesc, Raycast};
use rasray_scene::needs::Needs;
use rasray_scene::{Scene, builtin};
use rasray_systems::Spec;
use rasray_tests::harness::Bench;

const SIZE: [u32; 2] = [96, 64];

/// A scene on the device.
struct Stage<'a> {
    bench: &'a Bench,
    shown: DeviceScene,
}

impl<'a> Stage<'a> {
    fn new(bench: &'a Bench, scene: &Scene) -> Self {
        let camera = &scene.cameras[0];
        let shown = DeviceScene::new(bench.device(), scene, camera, SIZE, 1, &Needs::all());
        Self { bench, shown: shown.expect("the scene is whole and fits") }
    }

    /// Hits of the rays through pixel centres.
    fn aovs(
        &self,
        system: &str,
        options: &[(&str, &str)],
        stored: bool,
    ) -> Result<Vec<AovPixel>, FrameError> {
        let device = self.bench.device();
        let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        let spec = Spec::new(system, "robust", given).expect("the options are the system's");
        let built = Built::new(device, &spec, &self.shown.scene, self.shown.scene.eye());
        let built = built.expect("the build completes");
        let film = Film::new(device, SIZE[0], SIZE[1]).expect("a small film fits");
        let raycast =
            Raycast::new(&IntegratorDesc::new(device, &self.shown.scene, &film)).expect("it is made");
        let passes = ImagePasses::from(Box::new(raycast));
        let passes = if stored { passes.with_stored_hits() } else { passes };
        let image = ImageRenderer::new(device, passes, 0..1).expect("the device works");
        let mut found = Vec::new();
        image.aovs(&self.shown.scene, built.structure(), |pixels| found.extend_from_slice(pixels))?;
        Ok(found)
    }

    /// [`Self::aovs`] through an A-buffer with a cell a pixel.
    fn of_view(&self, options: &[(&str, &str)], stored: bool) -> Vec<AovPixel> {
        let view = [("views", "camera"), ("camera-resolution", "96x64"), ("resolution", "64")];
        self.aovs("mmrt", &[&view, options].concat(), stored).expect("there are first hits")
    }
}

/// Pixels whose triangle is another, and the largest relative difference in distance of the others.
fn difference(found: &[AovPixel], expected: &[AovPixel]) -> (usize, f32) {
    let pairs = || found.iter().zip(expected);
    let same = pairs().filter(|(a, b)| a.primitive == b.primitive && a.primitive != u32::MAX);
    let farthest = same.map(|(a, b)| (a.distance - b.distance).abs() / b.distance).fold(0.0, f32::max);
    (pairs().filter(|(a, b)| a.primitive != b.primitive).count(), farthest)
}

#[test]
fn through_the_centres_of_cells_they_are_those_of_traces() {
    let bench = Bench::new();
    for name in ["cornell", "ruins:10k"] {
        let scene = builtin::builtin(name).expect("it is built in").expect("a scene");
        let stage = Stage::new(&bench, &scene);
        let exact = stage.aovs("brute-force", &[], false).expect("traces need nothing");
        let stored = stage.of_view(&[], true);
        let hits = exact.iter().filter(|pixel| pixel.primitive != u32::MAX).count();
        let (others, farthest) = difference(&stored, &exact);
        // The cells' centres are the rays' but for rounding, which decides on edges.
        assert!(
            hits > 2000 && others <= 6,
            "{name}: {others} of {} pixels have another triangle",
            exact.len()
        );
        assert!(farthest < 1.0e-4, "{name}: distances differ by {farthest}");
    }
}

#[test]
fn they_do_not_depend_on_how_lists_are_kept() {
    let bench = Bench::new();
    let scene = builtin::builtin("cornell").expect("it is built in").expect("it needs no parameter");
    let stage = Stage::new(&bench, &scene);
    let expected = stage.of_view(&[], true);
    for options in [
        &[("storage", "sb")][..],
        &[("storage", "ll"), ("buckets", "1")],
        &[("storage", "paged")],
        &[("inline", "on")],
        &[("sort", "off")],
        &[("buckets", "1")],
        &[("coverage", "conservative")],
        &[("views", "cube+camera")],
        &[("addressing", "address")],
        &[("accept", "interval")],
    ] {
        let found = stage.of_view(options, true);
        let same = |(a, b): (&AovPixel, &AovPixel)| {
            (a.primitive, a.distance.to_bits(), a.normal) == (b.primitive, b.distance.to_bits(), b.normal)
        };
        assert!(found.iter().zip(&expected).all(same), "{options:?}");
    }
}

#[test]
fn without_a_view_of_the_camera_they_are_refused() {
    let bench = Bench::new();
    let scene = builtin::builtin("cornell").expect("it is built in").expect("it needs no parameter");
    let stage = Stage::new(&bench, &scene);
    for (system, options) in [("mmrt", &[("views", "cube")][..]), ("bvh", &[])] {
        let error = stage.aovs(system, options, true).expect_err("no view of the camera");
        let text = error.to_string();
        let is_typed = matches!(
            error,
            FrameError::Integrator(rasray_integrators::IntegratorError::Ads(AdsError::NoFirstHits { .. }))
        );
        assert!(is_typed, "{text}");
    }
}
