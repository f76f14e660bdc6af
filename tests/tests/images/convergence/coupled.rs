//! Device and reference with the same random numbers: what remains is no noise.

use rasray_reference::shading::{PosedScene, View};
use rasray_scene::Sampler;
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{Studio, System};

use super::{SIZE, cornell, reference, rendered};
use crate::kept_pictures::Compared;

/// Difference between two images.
#[derive(Clone, Copy, Debug)]
struct Difference {
    /// Pixels that differ by more than a thousandth of their value.
    share: f64,
    /// Root of the mean square.
    rms: f64,
    /// Root mean square over the pixels that agree.
    rms_of_others: f64,
}

fn difference(image: &[[f32; 3]], truth: &[[f32; 3]]) -> Difference {
    let apart =
        |(a, b): &(&[f32; 3], &[f32; 3])| (0..3).any(|c| (a[c] - b[c]).abs() > 1e-3 * (b[c].abs() + 1e-2));
    let square =
        |(a, b): (&[f32; 3], &[f32; 3])| (0..3).map(|c| f64::from(a[c] - b[c]).powi(2)).sum::<f64>() / 3.0;
    let pairs = || image.iter().zip(truth);
    let different = pairs().filter(apart).count();
    let others: f64 = pairs().filter(|pair| !apart(pair)).map(square).sum();
    let count = image.len() as f64;
    Difference {
        share: different as f64 / count,
        rms: (pairs().map(square).sum::<f64>() / count).sqrt(),
        rms_of_others: (others / (image.len() - different).max(1) as f64).sqrt(),
    }
}

#[test]
fn exact_hits_leave_rounding_and_fragments_leave_their_law() {
    let bench = Bench::new();
    let (scene, camera) = cornell();
    let systems = [System::BruteForce, System::Fragments(64), System::Fragments(256)];
    let mut shares = Vec::new();
    for system in systems {
        let mut stage = Studio::new(&bench, &scene, camera.clone(), SIZE, system);
        let origin = stage.scene().frame_origin();
        stage.reseed(5);
        let image = rendered(&stage);
        let truth = reference(&scene, &camera, origin, 5);
        let compared = Compared { picture: &image, reference: &truth, width: SIZE };
        let coupled = difference(&image, &truth);
        let noise = difference(&image, &reference(&scene, &camera, origin, 6));
        eprintln!("{system:?}: coupled {coupled:?}, other random numbers {noise:?}");
        // With other random numbers next to nothing agrees, so the comparison can fail.
        assert!(noise.share > 0.5 && noise.rms > 0.05, "{noise:?}");
        if system == System::BruteForce {
            // Rounding, but for the odd path that falls the other way at an edge or a threshold.
            compared.assert(coupled.share <= 0.01, format_args!("{coupled:?}"));
            let is_rounding = coupled.rms_of_others <= 1e-4 * noise.rms;
            compared.assert(is_rounding, format_args!("{coupled:?} {noise:?}"));
        }
        shares.push(coupled.share);
    }
    // More cells, fewer wrong hits; the factor is a bound of regression.
    assert!(shares[2] < 0.8 * shares[1], "four times the cells: {shares:?}");
}

/// One occlusion ray per pixel: the share of wrong answers is at most 12 over the cells along a side, a bound
/// of regression.
#[test]
fn wrong_occlusion_falls_with_the_size_of_a_cell() {
    let bench = Bench::new();
    let (scene, camera) = cornell();
    for (system, limit) in [
        (System::BruteForce, 0.0),
        (System::Fragments(64), 12.0 / 64.0),
        (System::Fragments(256), 12.0 / 256.0),
    ] {
        let mut stage = Studio::new(&bench, &scene, camera.clone(), SIZE, system);
        stage.reseed(5);
        let image = stage.render(&stage.occlusion(f32::INFINITY), 0..1).pixels;
        let share = |seed| {
            let view = View {
                camera: camera.clone(),
                width: SIZE,
                height: SIZE,
                samples: 1,
                seed,
                sampler: Sampler::default(),
            };
            let posed = PosedScene::new(&scene, stage.scene().frame_origin()).expect("the scene is whole");
            let truth = posed.render_ambient_occlusion(&view, f32::INFINITY).expect("the image has pixels");
            difference(&image, &truth.pixels).share
        };
        let (coupled, other) = (share(5), share(6));
        eprintln!("occlusion, {system:?}: {coupled:.4} wrong, other random numbers {other:.4}");
        assert!(coupled <= limit, "{system:?}: {coupled}");
        assert!(other > 0.2, "other random numbers pass: {other}");
    }
}
