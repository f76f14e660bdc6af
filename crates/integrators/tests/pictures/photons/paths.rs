//! Means of pictures by photons against means of pictures by paths.

use glam::DVec3;
use rasray_integrators::{Path, PhotonKind};
use rasray_scene::{Environment, Light, Material};

use super::{difference_of, estimate, floor, from_above, lit, options, photons, sample_means};
use crate::pictures::common::{scenes::cornell, *};
use crate::pictures::whitted::{ball, glass, mirror};

/// Means of whole pictures differ by their noise, and by the light of photons that is missing along edges: a
/// band as wide as the radius along the four sides of a square lacks less than half of them, and the boxes
/// have as many edges again.
#[test]
fn all_light_in_a_room_is_that_of_paths() {
    let (scene, eye) = cornell();
    let device = device();
    let stage = Setup::new(&device, &scene, eye, 32, 32, 2);
    let [lower, upper] = stage.scene.geometry().bounds();
    let side = (0..3).map(|axis| f64::from(upper[axis] - lower[axis])).fold(f64::INFINITY, f64::min);
    let radius = 0.01 * side;
    let by_photons = options(PhotonKind::All, 5, 1 << 13, radius as f32);
    let [by_photons, by_paths, direct]: [Vec<f64>; 3] = [
        sample_means(&stage, &photons(&stage, by_photons), 64),
        sample_means(&stage, &Path::new(&stage.desc(), 5).expect("valid"), 64),
        sample_means(&stage, &Path::new(&stage.desc(), 1).expect("valid"), 64),
    ];
    let [indirect, _] = difference_of(&by_paths, &direct);
    let [difference, noise] = difference_of(&by_photons, &by_paths);
    println!("photons differ by {difference} +- {noise} from paths, whose indirect light is {indirect}");
    assert!(indirect > 0.2 * estimate(by_paths)[0] && noise < 0.02 * indirect, "{indirect}, {noise}");
    let short = 2.0 * 0.5 * 4.0 * radius / side * indirect;
    assert!(difference.abs() < 4.0 * noise + short, "{difference}, noise {noise}, short of {short}");
    assert_silent(&device);
}

/// A ball of glass with smooth normals is under a lamp that paths find as well. The picture shows the floor
/// around all of the light that comes through the ball, so that the kernel moves next to none out of it.
#[test]
fn caustics_of_a_ball_are_those_that_paths_find() {
    let device = device();
    for (name, material) in [("glass", glass()), ("mirror", mirror(0.9))] {
        let lamp = Material { double_sided: false, ..lambert(0.0, 4.0) };
        let meshes = vec![
            floor(3.0, 0),
            ball(DVec3::Y * 0.6, 0.5, 1),
            square(DVec3::Y * 2.0, DVec3::X * 0.6, DVec3::Z * 0.6, 2),
        ];
        let scene = lit(meshes, vec![lambert(0.7, 0.0), material, lamp], None);
        // The camera is below the ball and sees the floor alone.
        let eye = from_above(0.05, 1.2);
        let stage = Setup::new(&device, &scene, eye, 32, 32, 4);
        let bounces = 4;
        let by_paths = sample_means(&stage, &Path::new(&stage.desc(), bounces).expect("valid"), 128);
        let direct = sample_means(&stage, &Path::new(&stage.desc(), 1).expect("valid"), 128);
        let [indirect, _] = difference_of(&by_paths, &direct);
        for kind in PhotonKind::ALL {
            let map = photons(&stage, options(kind, bounces, 1 << 11, 0.04));
            let found = sample_means(&stage, &map, 128);
            let [difference, noise] = difference_of(&found, &by_paths);
            println!("{name}, {kind:?}: {difference} +- {noise}, of {indirect} of indirect light");
            assert!(noise < 0.06 * indirect, "{name}, {kind:?}: {noise} of {indirect}");
            assert!(difference.abs() < 4.0 * noise + 0.01 * indirect, "{name}, {kind:?}: {difference}");
        }
    }
    assert_silent(&device);
}

/// A floor and a wall beyond it are lit once more by the light that they scatter. Each kind of light emits as
/// much as light samples find; at most half of the light within a radius of the edge between the two is
/// missing.
#[test]
fn photons_carry_what_each_kind_of_light_sends() {
    let device = device();
    let direction = DVec3::new(0.3, -1.0, 0.4).normalize();
    let position = DVec3::new(0.2, 1.2, 0.3);
    let intensity = [2.0; 3];
    let range = 2.5;
    let sky = (0..16 * 8).map(|i| [0.1 + (i % 5) as f32 * 0.2 + if i == 37 { 30.0 } else { 0.0 }; 3]);
    let sky = Environment::LatLong { width: 16, height: 8, radiance: sky.collect() };
    let spot = Light::Spot { position, direction, intensity, range, inner_cone: 0.3, outer_cone: 0.7 };
    for (name, light, environment) in [
        ("point", Some(Light::Point { position, intensity, range }), Environment::default()),
        ("spot", Some(spot), Environment::default()),
        ("sun", Some(Light::Directional { direction, irradiance: [2.0; 3] }), Environment::default()),
        ("even sky", None, Environment::Constant([0.5; 3])),
        ("sky", None, sky),
    ] {
        let wall = square(DVec3::new(0.0, 1.0, 1.0), DVec3::X, -DVec3::Y, 0);
        let mut scene = lit(vec![floor(1.0, 0), wall], vec![lambert(0.8, 0.0)], light);
        scene.environment = environment;
        let stage = Setup::new(&device, &scene, from_above(3.0, 1.0), 32, 32, 8);
        let by_photons = options(PhotonKind::All, 3, 1 << 12, 0.04);
        let [by_photons, by_paths, direct]: [Vec<f64>; 3] = [
            sample_means(&stage, &photons(&stage, by_photons), 64),
            sample_means(&stage, &Path::new(&stage.desc(), 3).expect("valid"), 64),
            sample_means(&stage, &Path::new(&stage.desc(), 1).expect("valid"), 64),
        ];
        let [indirect, _] = difference_of(&by_paths, &direct);
        let [difference, noise] = difference_of(&by_photons, &by_paths);
        println!("{name}: {difference} +- {noise}, of {indirect} of indirect light");
        assert!(indirect > 0.0 && noise < 0.04 * indirect, "{name}: {noise} of {indirect}");
        assert!(difference.abs() < 4.0 * noise + 0.04 * indirect, "{name}: {difference}, noise {noise}");
    }
    assert_silent(&device);
}
