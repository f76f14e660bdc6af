//! The figures that images are evaluated by, on a device's image: each must see what it is for.

use rasray_metrics::{Image, ImageError, flip};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{Studio, System};

use super::{SIZE, cornell, reference, rendered};

/// Stops at which an image in linear light is shown for FLIP.
const STOPS: [i32; 3] = [-4, 0, 4];

fn measure(test: &[[f32; 3]], truth: &[[f32; 3]]) -> ImageError {
    let [test, truth] =
        [test, truth].map(|p| Image::new(SIZE as usize, SIZE as usize, p).expect("sizes fit"));
    ImageError::measure(&test, &truth).expect("images can be compared")
}

/// FLIP of the image multiplied by 2^s, clamped, sRGB, for each of the stops; the largest of the means.
fn flip_of_exposures(test: &[[f32; 3]], truth: &[[f32; 3]]) -> f64 {
    let exposed = |stop: i32| {
        let [test, truth] = [test, truth]
            .map(|pixels| pixels.iter().map(|p| p.map(|x| x * 2_f32.powi(stop))).collect::<Vec<_>>());
        let [test, truth] =
            [&test, &truth].map(|p| Image::new(SIZE as usize, SIZE as usize, p).expect("sizes fit"));
        flip(&test, &truth).expect("images can be compared").mean
    };
    STOPS.into_iter().map(exposed).fold(0.0, f64::max)
}

#[test]
fn every_figure_sees_noise_and_none_sees_rounding() {
    let bench = Bench::new();
    let (scene, camera) = cornell();
    let mut stage = Studio::new(&bench, &scene, camera.clone(), SIZE, System::BruteForce);
    let origin = stage.scene().frame_origin();
    stage.reseed(5);
    let image = rendered(&stage);
    let same = reference(&scene, &camera, origin, 5);
    let other = reference(&scene, &camera, origin, 6);
    let (coupled, noise) = (measure(&image, &same), measure(&image, &other));
    eprintln!("same random numbers: {coupled:?}\nother random numbers: {noise:?}");
    assert!(coupled.psnr > noise.psnr + 20.0);
    assert!(coupled.ssim > 0.99 && noise.ssim < 0.95);
    assert!(coupled.flip.mean < 0.005 && noise.flip.mean > 0.05);
    assert!(coupled.relmse < 0.01 * noise.relmse && coupled.mae < 0.01 * noise.mae);
    // Noise has no bias: the same view with other random numbers is as bright.
    assert!(noise.bias.abs() < 6.0 * noise.bias_sigma);
    let brighter: Vec<[f32; 3]> = same.iter().map(|pixel| pixel.map(|x| x * 1.05)).collect();
    let biased = measure(&brighter, &same);
    assert!(biased.bias > 1e3 * coupled.bias.abs() && biased.relmse > 1e3 * coupled.relmse, "{biased:?}");
    // A lamp of twice the radiance is white all the same when shown; lower exposures tell.
    assert!(image.iter().flatten().any(|x| *x > 2.0), "the lamp is in the picture");
    let doubled: Vec<[f32; 3]> = image
        .iter()
        .map(|pixel| if pixel.iter().all(|x| *x > 2.0) { pixel.map(|x| 2.0 * x) } else { *pixel })
        .collect();
    let [shown, exposed] = [measure(&doubled, &image).flip.mean, flip_of_exposures(&doubled, &image)];
    eprintln!("a lamp of twice the radiance: FLIP {shown:.5} as shown, {exposed:.5} over exposures");
    assert!(shown == 0.0 && exposed > 1e-4, "{shown} {exposed}");
}
