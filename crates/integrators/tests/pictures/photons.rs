//! Photon maps: the stored photons, the gathered light, and comparisons with closed forms and paths.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use rasray_gpu::Timing;
use rasray_gpu_scene::Sampling;
use rasray_integrators::{
    Integrator, IntegratorError, Path, PathOptions, Photon, PhotonKind, PhotonOptions, Photons, Wave,
};
use rasray_reference::shading::{View, camera_ray, pixel_position};
use rasray_scene::{Camera, Environment, Instance, Light, Material, Mesh, Projection, Sampler, Scene};

use crate::kept_pictures::Compared;
use crate::pictures::common::{scenes::cornell, *};
use crate::pictures::whitted::{ball, glass, mirror, reflected};

fn options(kind: PhotonKind, bounces: u32, photon_paths: u32, radius: f32) -> PhotonOptions {
    PhotonOptions { paths: PathOptions::from(bounces), kind, photon_paths, radius: Some(radius) }
}

fn photons(stage: &Setup, options: PhotonOptions) -> Photons {
    Photons::new(&stage.desc(), options).expect("valid")
}

fn render(stage: &Setup, options: PhotonOptions, samples: u32) -> Vec<[f32; 3]> {
    let image = stage.render(&photons(stage, options), samples);
    let faults = stage.film.read_faults(&stage.device).expect("readable");
    assert_eq!((faults.non_finite, faults.unended, faults.cut, faults.crowded), (0, 0, 0, 0));
    image
}

/// Makes a camera that looks down at the floor from a height, and sees `half` of it to each side of its
/// centre.
fn from_above(height: f64, half: f32) -> Camera {
    let projection = Projection::Orthographic { half_height: half };
    camera(DVec3::Y * height, DVec3::X, -DVec3::Z, projection)
}

fn lit(meshes: Vec<Mesh>, materials: Vec<Material>, light: Option<Light>) -> Scene {
    Scene { lights: light.into_iter().collect(), ..scene(meshes, materials, [0.0; 3]) }
}

fn floor(half: f64, material: usize) -> Mesh {
    square(DVec3::ZERO, DVec3::X * half, -DVec3::Z * half, material)
}

fn point_light(height: f64, intensity: f32) -> Option<Light> {
    let position = DVec3::Y * height;
    Some(Light::Point { position, intensity: [intensity; 3], range: f32::INFINITY })
}

/// Iterates over the positions of the pixel centres of a square picture, in metres from the middle of the
/// picture of [`from_above`].
fn places(side: u32, half: f64) -> impl Iterator<Item = [f64; 2]> {
    let place = move |index: u32| (2.0 * (f64::from(index) + 0.5) / f64::from(side) - 1.0) * half;
    (0..side * side).map(move |pixel| [place(pixel % side), place(pixel / side)])
}

/// Returns the mean of the picture of each sample.
fn sample_means(stage: &Setup, integrator: &dyn Integrator, samples: u32) -> Vec<f64> {
    let [width, height] = stage.scene.image_size();
    let mean_of = |sample| {
        stage.device.submit(|recorder| integrator.record_reset(recorder)).expect("the reset runs");
        let wave = Wave { first_pixel: 0, pixel_count: width * height, sample };
        let traced = (&stage.structure).into();
        integrator.render_wave(&stage.device, Timing::None, traced, wave).expect("the wave runs");
        mean(&stage.film.read(&stage.device).expect("readable"))
    };
    (0..samples).map(mean_of).collect()
}

/// Returns the mean of numbers and its standard error.
fn estimate(numbers: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let numbers: Vec<f64> = numbers.into_iter().collect();
    let count = numbers.len() as f64;
    let average = numbers.iter().sum::<f64>() / count;
    let squares: f64 = numbers.iter().map(|number| (number - average).powi(2)).sum();
    [average, (squares / (count - 1.0) / count).sqrt()]
}

/// Returns the mean difference of two kinds of samples with the same random numbers, and its standard error.
fn difference_of(samples: &[f64], others: &[f64]) -> [f64; 2] {
    estimate(samples.iter().zip(others).map(|(sample, other)| sample - other))
}

/// The scene is a closed box whose walls emit inwards and reflect the same share everywhere.
#[test]
fn a_furnace_keeps_its_flux() {
    const ALBEDO: f64 = 0.7;
    const RADIANCE: f64 = 0.5;
    const PATHS: u32 = 40_000;
    let wall = Material { double_sided: false, ..lambert(ALBEDO as f32, RADIANCE as f32) };
    let furnace = scene(box_inside(1.0, 0), vec![wall], [0.0; 3]);
    let device = device();
    let eye = camera(DVec3::ZERO, DVec3::X, DVec3::Y, Projection::Orthographic { half_height: 0.5 });
    let stage = Setup::new(&device, &furnace, eye, 16, 16, 3);
    let map = photons(&stage, options(PhotonKind::All, 6, PATHS, 0.1));
    let [average, error] = estimate(sample_means(&stage, &map, 16));
    let emitted = PI * RADIANCE * 24.0;
    let stored = map.read_map(&device).expect("readable");
    assert_eq!(stored.photons.iter().map(|photon| photon.bounce).max(), Some(5));
    for bounce in 1..=5_u32 {
        let flux: f64 = stored
            .photons
            .iter()
            .filter(|photon| photon.bounce == bounce)
            .map(|photon| f64::from(photon.flux[1]))
            .sum();
        let expected = emitted * ALBEDO.powi(bounce as i32);
        println!("after {bounce} scatterings: {flux} W, expected {expected}");
        // Paths may be ended at random from the scattering after the third on: the number of the remaining
        // ones is binomial.
        let left = ALBEDO.powi(if bounce > 3 { 4 } else { 0 }) * ALBEDO.powi((bounce as i32 - 4).max(0));
        let deviation = ((1.0 - left) / (left * f64::from(PATHS))).sqrt();
        assert!((flux / expected - 1.0).abs() < 1.0e-4 + 4.0 * deviation, "{bounce}: {flux}, not {expected}");
    }
    // The light was scattered 0 to 6 times.
    let expected: f64 = (0..=6).map(|bounce| RADIANCE * ALBEDO.powi(bounce)).sum();
    println!("radiance {average} +- {error}, expected {expected}");
    assert!((average - expected).abs() < 4.0 * error && error < 0.01 * expected);
    assert_silent(&device);
}

/// A mirror above a lamp sends light to the floor like an image of the lamp above the mirror, through a hole.
#[test]
fn light_by_a_plane_mirror_is_that_of_an_image_of_the_lamp() {
    const SIDE: u32 = 32;
    let (albedo, half) = (0.5, 0.3);
    let mirror_above = square(DVec3::Y * 2.0, DVec3::X * 0.4, DVec3::Z * 0.4, 1);
    let scene = lit(
        vec![floor(2.0, 0), mirror_above],
        vec![lambert(albedo, 0.0), mirror(1.0)],
        point_light(1.0, 3.0),
    );
    let device = device();
    let stage = Setup::new(&device, &scene, from_above(0.9, half), SIDE, SIDE, 5);
    let irradiance =
        |[x, z]: [f64; 2], height: f64| 3.0 * height / (height * height + x * x + z * z).powf(1.5);
    let of_light = |light: f64| f64::from(albedo) / PI * light;
    let mut errors = Vec::new();
    for photon_paths in [1 << 14, 1 << 18] {
        let image = render(&stage, options(PhotonKind::Caustic, 2, photon_paths, 0.15), 1);
        let (mut squares, mut sum, mut expected) = (0.0, 0.0, 0.0);
        for (pixel, place) in image.iter().zip(places(SIDE, f64::from(half))) {
            let caustic = f64::from(pixel[0]) - of_light(irradiance(place, 1.0));
            let right = of_light(irradiance(place, 3.0));
            squares += (caustic - right).powi(2);
            (sum, expected) = (sum + caustic, expected + right);
        }
        let error = (squares / f64::from(SIDE * SIDE)).sqrt() / (expected / f64::from(SIDE * SIDE));
        println!("{photon_paths} paths: error {error}, mean {} of what is expected", sum / expected);
        errors.push((error, sum / expected));
    }
    assert!(errors[1].0 < 0.4 * errors[0].0, "16 times the photons, a quarter of the noise: {errors:?}");
    assert!(errors[1].0 < 0.2 && (errors[1].1 - 1.0).abs() < 0.03, "{errors:?}");
    assert_silent(&device);
}

/// A plate of glass stands between a lamp and the floor: all light on the floor was refracted twice.
#[test]
fn light_through_a_plate_of_glass_is_that_of_the_closed_form() {
    const SIDE: u32 = 16;
    let (albedo, half, intensity) = (0.8, 0.25_f32, 2.0);
    // The lamp is at 1, the plate from 0.6 to 0.4, so that 0.8 of the way is in air.
    let plate = |height: f64, up: f64| square(DVec3::Y * height, DVec3::X * 3.0, -DVec3::Z * 3.0 * up, 1);
    let meshes = vec![floor(3.0, 0), plate(0.6, 1.0), plate(0.4, -1.0)];
    let scene = lit(meshes, vec![lambert(albedo, 0.0), glass()], point_light(1.0, intensity));
    let device = device();
    let stage = Setup::new(&device, &scene, from_above(0.3, half), SIDE, SIDE, 9);
    let map = photons(&stage, options(PhotonKind::Caustic, 3, 1 << 16, 0.05));
    let [found, error] = estimate(sample_means(&stage, &map, 8));
    // The closed form goes by the angle in air: metres from the middle, and the flux of a ring over its area.
    let away = |angle: f64| {
        let inside = (angle.sin() / 1.5).asin();
        0.8 * angle.tan() + 0.2 * inside.tan()
    };
    let irradiance = |radius: f64| {
        let (mut low, mut high) = (0.0, 1.5_f64);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if away(middle) < radius { low = middle } else { high = middle }
        }
        let step = 1.0e-5;
        let slope = (away(low + step) - away(low - step)) / (2.0 * step);
        let passed = (1.0 - reflected(low.cos())).powi(2);
        f64::from(intensity) * passed * low.sin() / (radius * slope)
    };
    let count = f64::from(SIDE * SIDE);
    let lit = places(SIDE, f64::from(half)).map(|[x, z]| irradiance(x.hypot(z))).sum::<f64>() / count;
    let expected = f64::from(albedo) / PI * lit;
    println!("{found} +- {error}, expected {expected}");
    assert!((found - expected).abs() < 4.0 * error + 0.002 * expected && error < 0.02 * expected);
    // Paths do not find this light at all.
    let paths = Path::new(&stage.desc(), 3).expect("valid");
    assert_eq!(mean(&stage.render(&paths, 1)), 0.0);
    assert_silent(&device);
}

/// The reference sums every photon within the radius, once, in f64: on a diffuse floor each counts the same
/// share of its flux.
#[test]
fn what_is_gathered_is_the_sum_over_all_photons() {
    const SIDE: u32 = 24;
    let (albedo, half, seed) = (0.6, 0.5_f32, 21);
    let ceiling = square(DVec3::Y * 2.0, DVec3::X * 2.0, DVec3::Z * 2.0, 0);
    let wall = square(DVec3::new(-1.0, 1.0, 0.0), -DVec3::Z * 2.0, DVec3::Y, 0);
    let scene = lit(vec![floor(1.0, 0), ceiling, wall], vec![lambert(albedo, 0.0)], point_light(0.9, 1.0));
    let device = device();
    let eye = from_above(0.8, half);
    let stage = Setup::new(&device, &scene, eye.clone(), SIDE, SIDE, seed);
    // The direct light has the same random numbers.
    let direct = stage.render(&Path::new(&stage.desc(), 1).expect("valid"), 1);
    for (photon_paths, radius) in [(3000, 0.2), (20_000, 0.03), (1000, 3.0)] {
        let map = photons(&stage, options(PhotonKind::All, 4, photon_paths, radius));
        let image = stage.render(&map, 1);
        let stored = map.read_map(&device).expect("readable");
        assert!((stored.radius - radius).abs() < 1.0e-6 && stored.photons.len() > photon_paths as usize / 2);
        let view = View {
            camera: eye.clone(),
            width: SIDE,
            height: SIDE,
            samples: 1,
            seed,
            sampler: Sampler::Sobol,
        };
        let (mut most, mut lit) = (0.0_f64, 0);
        for (number, (pixel, direct)) in image.iter().zip(&direct).enumerate() {
            let ray = camera_ray(
                &view,
                stage.scene.frame_origin(),
                pixel_position(SIDE, view.numbers(number as u32, 0)),
            );
            let place = ray.origin + ray.direction * (ray.origin.y / -ray.direction.y);
            let expected = naive(&stored.photons, place, f64::from(radius)) * f64::from(albedo) / PI;
            let found = f64::from(pixel[0]) - f64::from(direct[0]);
            let scale = f64::from(pixel[0]).max(1.0e-6);
            most = most.max((found - expected).abs() / scale);
            lit += usize::from(expected > 0.0);
        }
        println!("{photon_paths} paths within {radius}: {most:e} off at most, {lit} pixels with photons");
        assert!(most < 2.0e-5 && lit > image.len() / 2, "{most}, {lit}");
    }
    assert_silent(&device);
}

/// Returns W/m^2 by the kernel 2 (1 - d^2 / r^2) / (pi r^2), of photons that the floor sees.
fn naive(photons: &[Photon], place: Vec3, radius: f64) -> f64 {
    let of_photon = |photon: &Photon| {
        let apart = (Vec3::from(photon.position) - place).as_dvec3().length() / radius;
        let is_seen = apart < 1.0 && photon.direction[1] > 0.0;
        if is_seen {
            f64::from(photon.flux[0]) * 2.0 * (1.0 - apart * apart) / (PI * radius * radius)
        } else {
            0.0
        }
    };
    photons.iter().map(of_photon).sum()
}

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

/// Makes lights of all kinds, a ball of glass and a veil.
fn many_lights() -> (Scene, Camera) {
    let mut veil = lambert(0.7, 0.0);
    veil.base_color[3] = 0.4;
    veil.alpha_mode = rasray_scene::AlphaMode::Blend;
    let meshes = vec![
        floor(2.0, 0),
        ball(DVec3::Y * 0.5, 0.3, 1),
        square(DVec3::new(0.5, 2.0, 0.0), DVec3::X * 0.3, DVec3::Z * 0.3, 2),
        square(DVec3::new(-0.3, 0.9, 0.0), DVec3::X * 0.3, -DVec3::Z * 0.3, 3),
    ];
    let mut scene =
        lit(meshes, vec![lambert(0.7, 0.0), glass(), lambert(0.1, 5.0), veil], point_light(1.5, 2.0));
    let radiance = (0..16 * 8).map(|i| [0.1 + (i % 5) as f32 * 0.2, 0.3, 0.2 + (i / 16) as f32 * 0.1]);
    scene.environment = Environment::LatLong { width: 16, height: 8, radiance: radiance.collect() };
    let direction = DVec3::new(0.3, -1.0, -0.2).normalize();
    scene.lights.push(Light::Directional { direction, irradiance: [1.5; 3] });
    scene.lights.push(Light::Spot {
        position: DVec3::new(-0.4, 1.6, 0.3),
        direction: DVec3::new(0.4, -1.1, -0.3).normalize(),
        intensity: [4.0; 3],
        range: 4.0,
        inner_cone: 0.2,
        outer_cone: 0.5,
    });
    let eye = camera(
        DVec3::new(0.0, 1.2, 2.5),
        DVec3::X,
        DVec3::new(0.0, 0.95, -0.31).normalize(),
        Projection::Perspective { fov_y: 0.8 },
    );
    (scene, eye)
}

#[test]
fn photons_of_all_lights_are_those_of_the_naive_integrator() {
    let (scene, eye) = many_lights();
    let of = |kind: &'static str| {
        let spec: rasray_integrators::IntegratorSpec =
            rasray_integrators::IntegratorRow::named("photons").expect("registered").into();
        let spec = spec.with("photons", kind).and_then(|spec| spec.with("photon-paths", 4000));
        spec.and_then(|spec| spec.with("radius", 0.2)).expect("valid")
    };
    for spec in [of("caustic"), of("all")] {
        let found = difference::difference(&scene, &scene, &eye, 4, &spec);
        println!("{:?}: {found:?}", spec.options());
        // Where the ball's facets meet, a photon may be refracted by one or by the next.
        found.assert_within(0.05, 0.005, format_args!("{:?}", spec.options()));
    }
}

#[test]
fn waves_and_ways_to_record_them_change_no_picture() {
    let device = device();
    let (mut scene, eye) = many_lights();
    // There are more veils than rounds that are recorded at first.
    for number in 1..=20 {
        scene.meshes.push(square(DVec3::Y * (1.0 + 0.01 * f64::from(number)), DVec3::X, -DVec3::Z, 3));
        let mesh = scene.meshes.len() - 1;
        scene.instances.push(Instance { mesh, ..scene.instances[0].clone() });
    }
    scene.materials[3].base_color[3] = 0.05;
    let stage = Setup::new(&device, &scene, eye, 20, 15, 5);
    for kind in PhotonKind::ALL {
        let options = options(kind, 4, 2000, 0.2);
        let expected = render(&stage, options, 2);
        let cut = Photons::new(&stage.desc_with(37, stage.desc().features), options).expect("valid");
        let by_waves = stage.render(&cut, 2);
        let compared = |picture| Compared { picture, reference: &expected, width: 20 };
        compared(&by_waves).assert_bits("nine waves a sample gather one map");

        // Frames are recorded with more rounds until no ray is left.
        let whole = photons(&stage, options);
        loop {
            device.submit(|recorder| whole.record_reset(recorder)).expect("the reset runs");
            for sample in 0..2 {
                let wave = Wave { first_pixel: 0, pixel_count: 300, sample };
                let traced = (&stage.structure).into();
                let submitted = device.submit(|recorder| whole.record_wave(recorder, traced, wave));
                submitted.expect("it runs").value.expect("the wave can be recorded");
            }
            if stage.film.read_faults(&device).expect("readable").unended == 0 {
                break;
            }
            assert!(whole.allow_more_rounds());
        }
        let recorded = stage.film.read(&device).expect("readable");
        compared(&recorded).assert_bits(format_args!("{kind:?}, as frames record it"));
    }
    assert_silent(&device);
}

/// Formula of the page, and its value.
const FORMULA: &str = "44 N (B - 1) + 4 max(1024, 2 ceil2(N)) + 56 N + 12 bytes";

fn formula_bytes(photon_paths: u64, bounces: u64) -> u64 {
    44 * photon_paths * (bounces - 1)
        + 4 * 1024.max(2 * photon_paths.next_power_of_two())
        + 56 * photon_paths
        + 12
}

/// Bytes by which the device enlarges the buffers of a map and its queue for alignment.
const ALIGNMENT: u64 = 10 * 256;

#[test]
fn a_map_takes_the_bytes_that_the_page_says() {
    let page = include_str!("../../../../docs/photons.md");
    assert!(page.contains(FORMULA), "docs/photons.md: {FORMULA}");
    let (scene, eye) = cornell();
    let device = device();
    let stage = Setup::new(&device, &scene, eye, 8, 8, 0);
    for (paths, bounces) in [(1, 1), (100, 2), (3000, 3), (4096, 8), (4097, 5)] {
        let before = device.allocated_bytes();
        let path = Path::new(&stage.desc(), bounces).expect("valid");
        let of_path = device.allocated_bytes() - before;
        let map = photons(&stage, options(PhotonKind::All, bounces, paths, 1.0));
        let of_map = device.allocated_bytes() - before - 2 * of_path;
        let queue: u64 =
            map.queues().last().expect("it has one").bytes_by_part().map(|(_, bytes)| bytes).sum();
        let expected = formula_bytes(paths.into(), bounces.into());
        println!("{paths} paths, {bounces} bounces: {of_map} bytes, of which {queue} are the queue's");
        let measured = expected + queue..=expected + queue + ALIGNMENT;
        assert!(measured.contains(&of_map), "{paths} paths, {bounces} bounces: {of_map}, not {measured:?}");
        assert_eq!(map.state_bytes() - path.state_bytes(), expected, "as reports say it");
    }
}

/// Returns the exponent with which numbers fall by a count: the slope of a line through their logarithms.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let logarithms = || points.iter().map(|(count, number)| (count.ln(), number.ln()));
    let count = points.len() as f64;
    let [x, y] = logarithms().fold([0.0, 0.0], |sum, (x, y)| [sum[0] + x / count, sum[1] + y / count]);
    let along: f64 = logarithms().map(|(a, b)| (a - x) * (b - y)).sum();
    along / logarithms().map(|(a, _)| (a - x).powi(2)).sum::<f64>()
}

/// Returns the variance of a mean of samples over that of the first, if the variance of a sample is as one
/// over the area in which photons are gathered.
fn variance(samples: u32) -> f64 {
    let (mut of_sample, mut sum) = (1.0, 0.0);
    for sample in 1..=samples {
        sum += of_sample;
        of_sample *= (f64::from(sample) + 1.0) / (f64::from(sample) + 2.0 / 3.0);
    }
    sum / f64::from(samples).powi(2)
}

/// The squared errors are those of light by a plane mirror on the floor, in its middle and at its border. In
/// the middle they are noise.
#[test]
fn squared_errors_fall_as_the_page_says() {
    const SIDE: u32 = 32;
    const COUNTS: [u32; 5] = [1, 4, 16, 64, 256];
    const SEEDS: u32 = 3;
    let (albedo, half, end) = (0.5, 0.3_f32, 1.2);
    let mirror_above = square(DVec3::Y * 2.0, DVec3::X * 0.4, DVec3::Z * 0.4, 1);
    let materials = vec![lambert(albedo, 0.0), mirror(1.0)];
    let scene = lit(vec![floor(2.0, 0), mirror_above], materials, point_light(1.0, 3.0));
    let device = device();
    // The closed form uses an image of the lamp at a height of 3, seen through the outline of the mirror.
    let light = |x: f64, z: f64| {
        let is_lit = x.abs() < end && z.abs() < end;
        if is_lit { f64::from(albedo) / PI * 9.0 / (9.0 + x * x + z * z).powf(1.5) } else { 0.0 }
    };
    let within: Vec<[f64; 2]> = places(16, f64::from(half) / f64::from(SIDE)).collect();
    let predicted = exponent(&COUNTS.map(|count| (f64::from(count), variance(count))));
    println!("noise falls with the exponent {predicted:.3} over these numbers of samples");
    for (name, middle) in [("in the middle", 0.0), ("at the end", end)] {
        let of_pixel = |[x, z]: [f64; 2]| {
            let sum: f64 = within.iter().map(|[u, v]| light(middle + x + u, z + v)).sum();
            sum / within.len() as f64
        };
        let expected: Vec<f64> = places(SIDE, f64::from(half)).map(of_pixel).collect();
        let power: f64 = expected.iter().map(|light| light * light).sum();
        let [of_sobol, of_pcg] = [Sampler::Sobol, Sampler::Pcg].map(|sampler| {
            let mut squares = [0.0; COUNTS.len()];
            for seed in 0..SEEDS {
                let mut eye = from_above(0.9, half);
                eye.world_from_camera.translation.x += middle;
                let mut stage = Setup::new(&device, &scene, eye, SIDE, SIDE, seed);
                let sampling = Sampling { sampler, ..Sampling::default() };
                stage.scene.set_sampling(sampling).expect("the frame can be written");
                let map = photons(&stage, options(PhotonKind::Caustic, 2, 1 << 13, 0.15));
                // Direct light has the same random numbers.
                let direct = Path::new(&stage.desc(), 1).expect("valid");
                let found = pictures_after(&stage, &map, COUNTS);
                let direct = pictures_after(&stage, &direct, COUNTS);
                for (square, (found, direct)) in squares.iter_mut().zip(found.iter().zip(&direct)) {
                    let by_photons = found.iter().zip(direct).map(|(a, b)| f64::from(a[0]) - f64::from(b[0]));
                    let errors = by_photons.zip(&expected).map(|(found, right)| (found - right).powi(2));
                    *square += errors.sum::<f64>() / power / f64::from(SEEDS);
                }
            }
            let points: [_; COUNTS.len()] = std::array::from_fn(|at| (f64::from(COUNTS[at]), squares[at]));
            let slope = exponent(&points);
            println!("{name}, {}: {squares:.5?}, exponent {slope:.3}", sampler.name());
            assert!(squares.is_sorted_by(|more, less| more > less), "{name}: {squares:?}");
            (squares, slope)
        });
        assert!(of_sobol.0.iter().zip(of_pcg.0).all(|(sobol, pcg)| *sobol < pcg), "{name}");
        if middle == 0.0 {
            assert!((of_pcg.1 - predicted).abs() < 0.1, "{}, not {predicted}", of_pcg.1);
        }
    }
    assert_silent(&device);
}

/// Returns the pictures after each of several numbers of samples, in ascending order.
fn pictures_after<const N: usize>(
    stage: &Setup,
    integrator: &dyn Integrator,
    counts: [u32; N],
) -> [Vec<[f32; 3]>; N] {
    stage.device.submit(|recorder| integrator.record_reset(recorder)).expect("the reset runs");
    let mut done = 0;
    counts.map(|count| {
        for wave in stage.film.bands().waves(done..count, integrator.wave_capacity()) {
            let traced = (&stage.structure).into();
            integrator.render_wave(&stage.device, Timing::None, traced, wave).expect("the wave runs");
        }
        done = count;
        stage.film.read(&stage.device).expect("readable")
    })
}

/// More photons around a surface than one invocation processes are an error, and not a darker picture.
#[test]
fn crowds_and_options_out_of_their_ranges_are_refused() {
    let device = device();
    let wall = Material { double_sided: false, ..lambert(0.9, 1.0) };
    let furnace = scene(box_inside(1.0, 0), vec![wall], [0.0; 3]);
    let stage = Setup::new(&device, &furnace, forward_camera(DVec3::ZERO), 2, 2, 0);
    let error =
        |options: PhotonOptions| Photons::new(&stage.desc(), options).expect_err("refused").to_string();
    let valid = options(PhotonKind::All, 8, 40_000, 10.0);
    for (options, named) in [
        (PhotonOptions { photon_paths: 0, ..valid }, "photon-paths 0"),
        (PhotonOptions { radius: Some(0.0), ..valid }, "radius 0"),
        (PhotonOptions { radius: Some(f32::NAN), ..valid }, "radius NaN"),
        (PhotonOptions { paths: PathOptions::from(1025), ..valid }, "bounces 1025"),
        (PhotonOptions { photon_paths: 1 << 20, paths: PathOptions::from(1024), ..valid }, "bytes"),
    ] {
        assert!(error(options).contains(named), "{named}: {}", error(options));
    }
    // The scene has light but no surfaces.
    let mut empty = Scene { environment: Environment::Constant([0.5; 3]), ..Scene::default() };
    empty.lights.extend(point_light(1.0, 1.0));
    let sky = Setup::new(&device, &empty, forward_camera(DVec3::ZERO), 2, 2, 0);
    let of_sky = PhotonOptions { photon_paths: 100, radius: None, ..valid };
    assert_eq!(render(&sky, of_sky, 1), [[0.5; 3]; 4]);
    let crowded = photons(&stage, valid);
    device.submit(|recorder| crowded.record_reset(recorder)).expect("the reset runs");
    let wave = Wave { first_pixel: 0, pixel_count: 4, sample: 0 };
    let made = crowded.render_wave(&device, Timing::None, (&stage.structure).into(), wave);
    assert!(matches!(made, Err(IntegratorError::Crowded { surfaces: 4, .. })), "{made:?}");
    assert_silent(&device);
}
