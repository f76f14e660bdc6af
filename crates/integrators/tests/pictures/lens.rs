//! Cameras with a lens: points in focus stay sharp, and others are spread over circles of confusion.

use glam::DVec3;
use rasray_gpu::{Device, DeviceDesc, Timing};
use rasray_integrators::{AovPass, Bands, Integrator, Raycast, Traced, Visibility, Wave};
use rasray_scene::{Camera, Lens, Material, Projection, Scene};

use crate::pictures::common::{
    difference::{difference, path, raycast},
    scenes::{textured_room, veiled_room},
    *,
};

const FOV: f64 = 0.6;

fn open(aperture: f32, focus: f32) -> Camera {
    let pinhole = camera(DVec3::ZERO, DVec3::X, DVec3::Y, Projection::Perspective { fov_y: FOV as f32 });
    Camera { lens: Some(Lens { aperture, focus }), ..pinhole }
}

/// Makes a lamp of this half size before the camera, `depth` metres away, and no other object.
fn lamp(half: f64, depth: f64) -> Scene {
    let material = Material { base_color: [1.0; 4], unlit: true, ..lambert(0.0, 0.0) };
    let square = square(DVec3::new(0.0, 0.0, -depth), DVec3::X * half, DVec3::Y * half, 0);
    scene(vec![square], vec![material], [0.0; 3])
}

/// A lamp of side s at depth z lights, in the plane in focus at depth f, a square of side `s f / z` spread
/// over a disk of the diameter of the circle of confusion, `aperture |f - z| / z`. The mean of the squared
/// distance from the middle is the sum of that of the disk, `diameter^2 / 8`, and of `side^2 / 6` for the
/// square and for a pixel.
#[test]
fn what_is_out_of_focus_is_spread_over_a_circle_of_confusion() {
    let device = device();
    let size = 96;
    let half = 0.012;
    for (aperture, focus, depth) in [(0.2, 2.0, 4.0), (0.2, 4.0, 2.0), (0.05, 1.0, 0.5), (0.3, 3.0, 2.5)] {
        let scene = lamp(half * depth, depth);
        let pixel = 2.0 * (0.5 * FOV).tan() * focus / f64::from(size);
        let diameter = aperture * (focus - depth).abs() / depth;
        let side = 2.0 * half * focus;
        let expected = diameter * diameter / 8.0 + (side * side + pixel * pixel) / 6.0;
        let farthest = 0.5 * diameter + (0.5 * side + pixel) * std::f64::consts::SQRT_2;
        let stage = Setup::new(&device, &scene, open(aperture as f32, focus as f32), size, size, 3);
        let samples = 256;
        let image = stage.render(&Raycast::new(&stage.desc()).expect("valid"), samples);
        let (mut light, mut moment, mut sum) = (0.0, 0.0, [0.0; 2]);
        for (index, color) in image.iter().enumerate() {
            let at = |place: usize| (place as f64 + 0.5 - 0.5 * f64::from(size)) * pixel;
            let place = [at(index % size as usize), at(index / size as usize)];
            let squared = place[0] * place[0] + place[1] * place[1];
            let weight = f64::from(color[0]);
            assert!(weight == 0.0 || squared.sqrt() < farthest, "light {} m from the middle", squared.sqrt());
            light += weight;
            moment += weight * squared;
            sum = [sum[0] + weight * place[0], sum[1] + weight * place[1]];
        }
        let hits = light * f64::from(samples);
        let found = moment / light;
        println!("aperture {aperture}, focus {focus}, lamp at {depth}: {hits} hits, {found} for {expected}");
        // The squared distance in a disk has a standard deviation of `diameter^2 / (8 sqrt 3)`: the bound is
        // five of those of the mean.
        let error = 5.0 * (diameter * diameter / 8.0) / 3f64.sqrt() / hits.sqrt();
        assert!((found - expected).abs() < error && error < 0.1 * expected, "{found}, not {expected}");
        // A pinhole sees the lamp with the same total.
        let whole = (side / pixel).powi(2);
        assert!((light / whole - 1.0).abs() < 5.0 / hits.sqrt(), "{light} pixels, not {whole}");
        let middle = sum.map(|sum| (sum / light).abs());
        assert!(middle.iter().all(|off| *off < 2.5 * diameter / hits.sqrt()), "{middle:?}");
    }
    assert_silent(&device);
}

/// All rays of a sample meet in the plane in focus, so the image of that plane does not depend on the lens.
#[test]
fn what_is_in_focus_is_sharp() {
    let device = device();
    let depth = 3.0;
    let scene = lamp(0.31, depth);
    let size = 32;
    let image = |camera: Camera, samples: u32| {
        let stage = Setup::new(&device, &scene, camera, size, size, 3);
        stage.render(&Raycast::new(&stage.desc()).expect("valid"), samples)
    };
    let pinhole = image(Camera { lens: None, ..open(1.0, 1.0) }, 16);
    let sharp = image(open(0.3, depth as f32), 16);
    let off = pinhole.iter().zip(&sharp).filter(|(one, other)| one != other).count();
    assert!(off <= 2, "{off} pixels differ, where rounding decides at the edge");
    let blurred = image(open(0.3, 1.5), 16);
    let off = pinhole.iter().zip(&blurred).filter(|(one, other)| one != other).count();
    assert!(off > 100, "out of focus {off} pixels differ");
    assert_eq!(image(open(0.0, depth as f32), 16), pinhole, "an aperture of 0 is a pinhole, bit for bit");
}

#[test]
fn lenses_of_the_device_are_those_of_the_naive_integrators() {
    let scene = textured_room();
    let eye = DVec3::new(0.2, 0.3, 0.9);
    for (aperture, focus) in [(0.1, 2.5), (0.4, 1.2), (0.05, 1.0e18)] {
        let camera = Camera { lens: Some(Lens { aperture, focus }), ..forward_camera(eye) };
        let found = difference(&scene, &scene, &camera, 4, &raycast());
        found.assert_within(0.01, 1e-3, "camera rays");
    }
    let camera = Camera { lens: Some(Lens { aperture: 0.2, focus: 1.5 }), ..forward_camera(DVec3::Z * 0.9) };
    let found = difference(&veiled_room(), &veiled_room(), &camera, 4, &path(2));
    found.assert_within(0.02, 0.01, "a room with a veil");
}

/// Further images show the view through the centre of the lens.
#[test]
fn further_images_do_not_depend_on_the_lens() {
    let device = device();
    let scene = textured_room();
    let images = |lens| {
        let camera = Camera { lens, ..forward_camera(DVec3::new(0.0, 0.0, 0.9)) };
        let stage = Setup::new(&device, &scene, camera, 16, 16, 3);
        let bands = Bands::new(&device, [16, 16]).expect("a small image");
        let aov = AovPass::new(&device, &stage.scene, bands, 256).expect("valid");
        for wave in bands.waves([0], 256) {
            let traced = Traced::from(&stage.structure);
            let submitted = device.submit(|recorder| aov.record_wave(recorder, traced, wave));
            submitted.expect("it runs").value.expect("it can be recorded");
        }
        aov.read(&device, 16 * 16).expect("readable")
    };
    let open = Some(Lens { aperture: 0.3, focus: 1.0 });
    assert_eq!(images(open), images(None));
}

/// Drawing is through a pinhole: it answers no ray that a lens would change.
#[test]
fn what_is_drawn_has_no_answer_through_a_lens() {
    let requirements = Visibility::requirements();
    let desc = DeviceDesc { validation: true, requirements, ..DeviceDesc::default() };
    let device = Device::create(&desc).expect("the device draws");
    let wave = Wave { first_pixel: 0, pixel_count: 64, sample: 0 };
    for (aperture, unanswered) in [(0.0, 0), (0.1, 64)] {
        let stage = Setup::new(&device, &lamp(0.3, 3.0), open(aperture, 2.0), 8, 8, 3);
        let visibility = Visibility::new(&device, &stage.scene, false).expect("it draws the image");
        let raycast = Raycast::new(&stage.desc()).expect("valid");
        device
            .submit(|recorder| {
                raycast.record_reset(recorder);
                visibility.record_reset(recorder);
            })
            .expect("the reset runs");
        let traced = Traced::from(&stage.structure).with_primary(Some(&visibility));
        raycast.render_wave(&device, Timing::None, traced, wave).expect("it runs");
        let counters = raycast.queues()[0].download_counters(&device).expect("readable");
        assert_eq!(counters.not_ready, unanswered);
    }
    assert_silent(&device);
}
