//! Tests of denoising in the viewer.

use std::ffi::OsStr;

use rasray_denoise::{Denoiser, NoisyPicture};
use rasray_experiment::{Aov, AovSelection, Backend, open};
use rasray_scene_source::load;
use rasray_viewer::{Pixels, Rounded, Settings, Shown, Standpoint, Step, ViewerError};

use crate::{VALIDATED, engine, finished, integrator, radiance, rendered_as, settings, system, told};

/// Returns the library of this machine; without it, reports the test of this name as skipped.
fn library(test: &str) -> Option<Denoiser> {
    Denoiser::find().map_err(|error| eprintln!("skipped: {test}: {error}")).ok()
}

/// Renders the picture of settings as `rasray render --denoise` does: with noise, and denoised.
fn pictures(
    backend: &mut dyn Backend,
    denoiser: &Denoiser,
    settings: &Settings,
) -> (Vec<[f32; 3]>, Vec<[f32; 3]>) {
    let aovs = AovSelection::from_iter(Aov::FOR_DENOISING);
    let cornell = load(OsStr::new("cornell")).expect("a scene");
    let output = rendered_as(cornell, backend, settings, aovs);
    let [albedo, normal] = Aov::FOR_DENOISING.map(|aov| output.aovs[&aov].triples().expect("three channels"));
    let size = [output.width as usize, output.height as usize];
    let picture = NoisyPicture { size, colour: &output.beauty, albedo: &albedo, normal: &normal };
    let clean = denoiser.denoise(&picture).expect("it works");
    (output.beauty, clean)
}

#[test]
fn what_is_shown_without_noise_is_what_a_render_makes_without_it() {
    let Some(denoiser) = library("what_is_shown_without_noise_is_what_a_render_makes_without_it") else {
        return;
    };
    let mut backend = open(&VALIDATED).expect("a device");
    let mut settings = settings();
    settings.system = system("bvh");
    // The first integrator needs materials on the device anyway, the second only for the denoiser.
    for name in ["path", "ao"] {
        settings.frame.integrator = integrator(name);
        settings.frame.seed += 1;
        let (noisy, clean) = pictures(backend.as_mut(), &denoiser, &settings);
        assert!(noisy != clean, "{name}: there is noise");
        let mut engine = engine(&settings);
        assert!(radiance(&finished(&mut engine)) == noisy, "{name}");
        let on = Settings { denoised: true, ..settings.clone() };
        for (settings, expected) in [(&on, &clean), (&settings, &noisy), (&on, &clean)] {
            engine.apply(settings.clone());
            let (picture, told) = told(&mut engine);
            assert!(radiance(&picture) == expected, "{name}, {}", settings.denoised);
            let by = settings.denoised.then(|| denoiser.version());
            assert_eq!((picture.denoised.as_deref(), picture.samples), (by, settings.frame.spp), "{name}");
            let is_uploaded = told.iter().any(|text| text == "scene to the device");
            assert_eq!(is_uploaded, name == "ao", "{name}: {told:?}");
        }
        // Another picture has other surfaces.
        let placed =
            Rounded { eye: "0.5,1.25,3".into(), target: "0,1,0".into(), fov: "50".into(), lens: None };
        let moved = Settings { standpoint: Standpoint::Placed(placed), ..on };
        engine.apply(moved.clone());
        let (_, clean) = pictures(backend.as_mut(), &denoiser, &moved);
        assert!(radiance(&finished(&mut engine)) == clean, "{name}, from elsewhere");
    }
}

/// Checks that a picture with all samples is denoised without a new render, and that a refining picture is
/// shown from its first sample on.
#[test]
fn noise_is_taken_out_while_a_picture_refines_and_of_one_that_is_there() {
    let Some(_) = library("noise_is_taken_out_while_a_picture_refines_and_of_one_that_is_there") else {
        return;
    };
    let mut settings = settings();
    settings.system = system("bvh");
    settings.frame.integrator = integrator("path");
    settings.denoised = true;
    let mut engine = engine(&settings);
    let mut pictures = Vec::new();
    loop {
        match engine.step(&mut |_| ()).expect("a step") {
            Step::Working => (),
            Step::Picture(picture) => pictures.push(picture),
            Step::Done => break,
        }
    }
    let samples: Vec<_> = pictures.iter().map(|picture| picture.samples).collect();
    assert_eq!((samples.first(), samples.last()), (Some(&1), Some(&settings.frame.spp)));
    assert!(pictures.iter().all(|picture| picture.denoised.is_some()));
    for denoised in [false, true] {
        settings.denoised = denoised;
        engine.apply(settings.clone());
        let Ok(Step::Picture(picture)) = engine.step(&mut |_| ()) else { panic!("a picture at once") };
        assert_eq!((picture.denoised.is_some(), picture.is_finished()), (denoised, true));
        assert!(matches!(engine.step(&mut |_| ()), Ok(Step::Done)));
    }
    // Maps, and pictures while something moves, are not changed by denoising.
    settings.shown = Shown::Difference;
    engine.apply(settings.clone());
    let picture = finished(&mut engine);
    let Pixels::Map(_, legend) = &picture.pixels else { panic!("a map") };
    assert_eq!((legend.most, &picture.denoised), (0.0, &None));
    (settings.shown, settings.moving) = (Shown::Picture, true);
    engine.apply(settings);
    assert_eq!(finished(&mut engine).denoised, None);
}

#[test]
fn without_the_library_the_picture_goes_on_once_it_is_no_longer_asked_for() {
    let Err(missing) = Denoiser::find() else {
        return eprintln!(
            "skipped: without_the_library_the_picture_goes_on_once_it_is_no_longer_asked_for has the library"
        );
    };
    let plain = settings();
    let mut engine = engine(&plain);
    let first = finished(&mut engine);
    engine.apply(Settings { denoised: true, ..plain.clone() });
    match engine.step(&mut |_| ()) {
        Err(ViewerError::Denoise(error)) => assert_eq!(error.to_string(), missing.to_string()),
        Err(error) => panic!("{error}"),
        Ok(_) => panic!("nothing takes out noise"),
    }
    engine.apply(plain);
    assert!(radiance(&finished(&mut engine)) == radiance(&first));
}
