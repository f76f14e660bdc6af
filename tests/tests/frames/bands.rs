//! Images in bands: whatever a device binds at once, pictures are those of one band, bit for bit.

use std::ops::ControlFlow;

use rasray_frame::{Adaptive, FrameRenderer, ImagePasses, ImageRenderer};
use rasray_gpu::Timing;
use rasray_gpu_scene::{GpuScene, PosePass};
use rasray_integrators::{
    AovPixel, AovSurface, Film, FilmFaults, FilmPixel, INTEGRATORS, IntegratorDesc, IntegratorSpec, Path,
    Visibility,
};
use rasray_scene::{Light, Scene};
use rasray_shadow_maps::Config;
use rasray_tests::harness::Bench;
use rasray_tracer::FrameSettings;

use super::adaptive::{SIZE, Stage, cornell, glazed, rule};
use super::pictures::{input, pictures, spec, tables, view};

/// Bands that end within rows and within what would be a wave, and one that is all but a few pixels.
const BANDS: [u32; 2] = [70, 370];

/// A film bit for bit, and what was counted.
type Made = (Vec<([u32; 3], u32)>, FilmFaults, u64);

fn bits(pixels: &[FilmPixel]) -> Vec<([u32; 3], u32)> {
    pixels.iter().map(|pixel| (pixel.sum.map(f32::to_bits), pixel.samples)).collect()
}

/// Settings of an image.
#[derive(Clone, Copy)]
struct With {
    adaptive: Option<Adaptive>,
    raster: bool,
    maps: Option<Config>,
}

const PLAIN: With = With { adaptive: None, raster: false, maps: None };

fn image(stage: &Stage<'_>, spec: &IntegratorSpec, with: With) -> ImageRenderer {
    let (device, scene) = (stage.device, &stage.shown.scene);
    if let Some(rule) = with.adaptive {
        return stage.adaptive(spec, rule.threshold);
    }
    let passes = ImagePasses::from(stage.integrator(spec, &stage.film()));
    let drawn = with.raster.then(|| Visibility::new(device, scene, false).expect("the device draws"));
    let mut passes = passes.with_visibility(drawn);
    if let Some(config) = with.maps {
        passes = passes.with_shadow_maps(device, scene, config).expect("the device draws");
    }
    ImageRenderer::new(device, passes, 0..3).expect("the device works")
}

fn made(stage: &Stage<'_>, spec: &IntegratorSpec, with: With) -> Made {
    let mut image = image(stage, spec, with);
    image.warm_up(stage.built.structure()).expect("the device works");
    let pixels = stage.render(&mut image, |_| false);
    assert_eq!(image.waves_done(), image.waves());
    let faults = image.film().read_faults(stage.device).expect("the device works");
    (bits(&pixels), faults, image.waves())
}

/// Compares films in bands with those of one band.
fn check(scene: &Scene, specs: &[IntegratorSpec], with: With) {
    let bench = Bench::new();
    let mut stage = Stage::new(bench.device(), scene);
    for spec in specs {
        stage.band = u32::MAX;
        let (expected, faults, waves) = made(&stage, spec, with);
        assert!(expected.iter().any(|(sum, _)| *sum != [0; 3]), "{spec:?}: nothing is seen");
        for band in BANDS {
            stage.band = band;
            let found = made(&stage, spec, with);
            assert!(found.0 == expected && found.1 == faults, "{spec:?} in bands of {band}");
            assert!(found.2 >= waves, "{spec:?} in bands of {band}: {} waves of {waves}", found.2);
        }
    }
}

fn every_integrator() -> Vec<IntegratorSpec> {
    INTEGRATORS.iter().map(IntegratorSpec::from).collect()
}

#[test]
fn pictures_are_those_of_one_band() {
    check(&cornell(), &every_integrator(), PLAIN);
    check(&glazed(), &every_integrator()[..2], PLAIN);
}

/// The noise around a pixel reaches over the ends of bands.
#[test]
fn samples_are_shared_as_in_one_band() {
    for spec in every_integrator() {
        let threshold = if spec.name() == "ao" { 0.35 } else { 0.1 };
        check(&cornell(), &[spec], With { adaptive: Some(rule(threshold)), ..PLAIN });
    }
}

#[test]
fn what_is_drawn_is_that_of_one_band() {
    let mut scene = cornell();
    let (position, intensity) = (glam::DVec3::new(0.0, 0.3, -0.2), [0.3, 0.2, 0.2]);
    scene.lights.push(Light::Point { position, intensity, range: f32::INFINITY });
    check(&scene, &every_integrator(), With { raster: true, ..PLAIN });
    let maps = Some(Config { resolution: 64, bias: 1.0, points: 2 });
    check(&scene, &every_integrator()[..1], With { raster: true, maps, ..PLAIN });
}

#[test]
fn further_images_are_those_of_one_band() {
    let bench = Bench::new();
    let mut stage = Stage::new(bench.device(), &cornell());
    let mut aovs = |band, raster| {
        stage.band = band;
        let image = image(&stage, &IntegratorSpec::from(&INTEGRATORS[0]), With { raster, ..PLAIN });
        let mut found: Vec<AovPixel> = Vec::new();
        let mut sizes = Vec::new();
        let take = |pixels: &[AovPixel]| {
            found.extend_from_slice(pixels);
            sizes.push(pixels.len());
        };
        image.aovs(&stage.shown.scene, stage.built.structure(), take).expect("the rays finish");
        let (mut again, mut surfaces): (Vec<AovPixel>, Vec<AovSurface>) = Default::default();
        let take = |pixels: &[AovPixel], of_band: &[AovSurface]| {
            again.extend_from_slice(pixels);
            surfaces.extend_from_slice(of_band);
            sizes.push(of_band.len());
        };
        image.aovs_with_surfaces(&stage.shown.scene, stage.built.structure(), take).expect("the rays finish");
        assert!(found == again, "raster: {raster}");
        ((found, surfaces), sizes)
    };
    let (expected, sizes) = aovs(u32::MAX, false);
    assert_eq!(sizes, [384; 2]);
    assert!(expected.0.iter().any(|pixel| pixel.distance > 0.0));
    assert!(expected.1.iter().any(|surface| surface.albedo != [0.0; 3]));
    for raster in [false, true] {
        let (found, sizes) = aovs(100, raster);
        assert_eq!(sizes, [100, 100, 100, 84, 100, 100, 100, 84]);
        assert!(found == expected, "raster: {raster}");
    }
}

/// Frames in flight read their films band by band.
#[test]
fn frames_are_those_of_one_band() {
    let bench = Bench::new();
    let (device, scene) = (bench.device(), cornell());
    let tables = tables(&scene);
    let mut films = [u32::MAX, 70].map(|band| {
        let gpu = GpuScene::upload(device, &tables, &view(&scene, 0.0)).expect("it fits");
        let pose = PosePass::new(device, &scene, &tables, &gpu).expect("it fits");
        let [width, height] = gpu.image_size();
        let film = Film::with_bands(device, width, height, band).expect("it fits");
        let path = Path::new(&IntegratorDesc::new(device, &gpu, &film), 1).expect("it fits");
        let spec = spec("bvh", &[("builder", "lbvh")]);
        let structure = spec.create(device, gpu.geometry(), Some(gpu.binding())).expect("valid");
        let rest = (FrameSettings { slots: 2, ..FrameSettings::default() }, Timing::None, true);
        let renderer = FrameRenderer::new(device, (gpu, Some(pose)), structure, Box::new(path), rest);
        let mut renderer = renderer.expect("the device works");
        let inputs = [0.0, 0.01, 0.02].map(|moved| input(view(&scene, moved), None, 0..2, false));
        let (shown, _) = pictures(&mut renderer, inputs.to_vec());
        shown.iter().map(|picture| bits(&picture.film.pixels)).collect::<Vec<_>>()
    });
    let [one, many] = &mut films;
    assert_eq!(one.len(), 3);
    assert!(one == many && one[0] != one[1]);
}

/// Each is of the samples of its pixel alone; reading films for them changes no picture.
#[test]
fn variances_are_those_of_one_band() {
    let bench = Bench::new();
    let mut stage = Stage::new(bench.device(), &cornell());
    for adaptive in [None, Some(rule(0.1))] {
        let spec = &every_integrator()[0];
        let mut measured = [u32::MAX, BANDS[0]].map(|band| {
            stage.band = band;
            let mut image = image(&stage, spec, With { adaptive, ..PLAIN }).measuring();
            let pixels = bits(&stage.render(&mut image, |_| false));
            (pixels, image.variances().expect("measured").collect::<Vec<_>>())
        });
        let [one, many] = &mut measured;
        assert!(one == many && one.1.iter().flatten().any(|variance| *variance > 0.0));
        stage.band = BANDS[0];
        assert!(one.0 == made(&stage, spec, With { adaptive, ..PLAIN }).0, "the picture stays");
    }
}

/// An image that is given up ends between samples, also in bands.
#[test]
fn an_early_end_is_between_samples() {
    let bench = Bench::new();
    let mut stage = Stage::new(bench.device(), &cornell());
    stage.band = 70;
    let mut image = image(&stage, &IntegratorSpec::from(&INTEGRATORS[0]), PLAIN);
    let structure = stage.built.structure();
    image.render(structure, Timing::None, |_, _| ControlFlow::Break(())).expect("the waves fit");
    let film = image.film().read_pixels(stage.device).expect("the device works");
    assert_eq!((image.samples_done(), image.waves_done(), image.waves()), (1, 6, 18));
    assert_eq!(film.len(), (SIZE[0] * SIZE[1]) as usize);
    assert!(film.iter().all(|pixel| pixel.samples == 1));
}
