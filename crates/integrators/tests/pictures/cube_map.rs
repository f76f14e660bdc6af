//! Environment mapping against Whitted's ray tracing, and the point from which its map is drawn.

use glam::DVec3;
use rasray_integrators::{
    CubeMap, CubeMapOptions, IntegratorRow, IntegratorSpec, Wave, Whitted, WhittedOptions,
};
use rasray_scene::{AlphaMode, Camera, Environment, Light, Scene};

use crate::pictures::common::{difference::difference, *};
use crate::pictures::whitted::{ball, mirror};

fn cube_map() -> IntegratorSpec {
    IntegratorRow::named("cube-map").expect("it is registered").into()
}

fn of_resolution(resolution: u32) -> CubeMapOptions {
    CubeMapOptions { resolution, ..CubeMapOptions::default() }
}

fn render(stage: &Setup, options: CubeMapOptions, samples: u32) -> Vec<[f32; 3]> {
    let image = stage.render(&CubeMap::new(&stage.desc(), options).expect("valid"), samples);
    let faults = stage.film.read_faults(&stage.device).expect("readable");
    assert_eq!((faults.non_finite, faults.unended, faults.cut), (0, 0, 0));
    image
}

fn whitted(stage: &Setup, samples: u32) -> Vec<[f32; 3]> {
    stage.render(&Whitted::new(&stage.desc(), WhittedOptions::default()).expect("valid"), samples)
}

/// Makes a mirroring ball before the eye.
fn mirror_ball(environment: Environment) -> (Scene, Camera) {
    let mut scene = scene(vec![ball(DVec3::ZERO, 0.5, 0)], vec![mirror(0.8)], [0.0; 3]);
    scene.environment = environment;
    (scene, forward_camera(DVec3::Z * 1.3))
}

/// Returns the sum of the differences over the sum of the picture.
fn error(image: &[[f32; 3]], expected: &[[f32; 3]]) -> f64 {
    let light = expected.iter().flatten().map(|&light| f64::from(light)).sum::<f64>();
    let off = |(a, b): (&f32, &f32)| f64::from(a - b).abs();
    image.as_flattened().iter().zip(expected.as_flattened()).map(off).sum::<f64>() / light
}

/// The map of an infinitely distant environment shows the light that rays find, wherever they start.
#[test]
fn an_environment_alone_is_that_of_whitted_up_to_the_filter_of_texels() {
    let device = device();
    let (even, eye) = mirror_ball(Environment::Constant([0.25, 0.5, 1.0]));
    let stage = Setup::new(&device, &even, eye.clone(), 32, 24, 7);
    let (image, expected) = (render(&stage, of_resolution(4), 1), whitted(&stage, 1));
    let off = error(&image, &expected);
    println!("even: {off:e}");
    assert!(off < 1.0e-6, "blending four equal texels rounds: {off}");

    let radiance = (0..16 * 8).map(|i| [0.1 + (i % 5) as f32 * 0.2, 0.3, 0.2 + (i / 16) as f32 * 0.1]);
    let (sky, eye) = mirror_ball(Environment::LatLong { width: 16, height: 8, radiance: radiance.collect() });
    let stage = Setup::new(&device, &sky, eye, 32, 24, 7);
    let expected = whitted(&stage, 4);
    let mut last = f64::INFINITY;
    for resolution in [8, 32, 128] {
        let off = error(&render(&stage, of_resolution(resolution), 4), &expected);
        println!("a sky of texels, {resolution} texels a side: {off:e}");
        assert!(off < 0.5 * last, "{resolution}: {off}, before {last}");
        last = off;
    }
    assert!(last < 0.01, "{last}");
    assert_silent(&device);
}

/// Surroundings at a distance, of six colours, are seen from the centre and from the surface of a ball.
#[test]
fn the_error_falls_as_the_surroundings_recede() {
    let device = device();
    let mut errors = Vec::new();
    for half in [1.5, 3.0, 6.0, 12.0] {
        let (mut scene, eye) = mirror_ball(Environment::Constant([0.0; 3]));
        for (number, mut wall) in box_inside(half, 1).into_iter().enumerate() {
            wall.material += number;
            scene.meshes.push(wall);
            let mesh = scene.meshes.len() - 1;
            scene.instances.push(rasray_scene::Instance { mesh, ..scene.instances[0].clone() });
            scene.materials.push(lambert(0.0, 0.2 + 0.3 * number as f32));
        }
        let stage = Setup::new(&device, &scene, eye, 32, 24, 7);
        let off = error(&render(&stage, of_resolution(96), 2), &whitted(&stage, 2));
        println!("| {half} | {:.2} % |", 100.0 * off);
        errors.push(off);
    }
    assert!(errors[0] > 0.02, "the walls are near: {errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.75 * pair[0], "twice as far: {errors:?}");
    }
    assert_silent(&device);
}

/// Makes balls of mirrors, glass and veils around the point, under lights of both kinds.
fn surroundings() -> (Scene, Camera) {
    let (mut scene, eye) = mirror_ball(Environment::Constant([0.2, 0.3, 0.4]));
    let veil = |opacity: f32| {
        let mut veil = lambert(0.7, 0.0);
        veil.base_color[3] = opacity;
        veil.alpha_mode = AlphaMode::Blend;
        veil
    };
    scene.materials.extend([lambert(0.6, 0.0), lambert(0.0, 5.0), veil(0.4), mirror(0.9)]);
    scene.meshes.extend([
        square(DVec3::Y * -0.8, DVec3::X * 2.0, -DVec3::Z * 2.0, 1),
        square(DVec3::new(0.0, 2.0, 0.5), DVec3::X * 0.5, DVec3::Z * 0.5, 2),
        square(DVec3::new(1.0, 0.0, 0.0), DVec3::Z * 0.6, DVec3::Y * 0.6, 3),
        square(DVec3::new(-1.2, 0.0, 0.0), -DVec3::Z * 0.6, DVec3::Y * 0.6, 4),
    ]);
    for mesh in 1..scene.meshes.len() {
        scene.instances.push(rasray_scene::Instance { mesh, ..scene.instances[0].clone() });
    }
    let (position, range) = (DVec3::new(-0.9, 0.9, 0.8), f32::INFINITY);
    scene.lights.push(Light::Point { position, intensity: [0.8; 3], range });
    scene.name = "surroundings of a mirror".to_owned();
    (scene, eye)
}

#[test]
fn the_map_is_that_of_the_naive_integrator() {
    let (scene, eye) = surroundings();
    let with = |option, value: &'static str| {
        let row = cube_map().row().option(option).expect("its own");
        cube_map().with(option, row.parse(value).expect("valid")).expect("valid")
    };
    for spec in [with("cube-resolution", "40"), with("cube-resolution", "8")] {
        let found = difference(&scene, &scene, &eye, 4, &spec);
        println!("{:?}: {found:?}", spec.options());
        // Where the ball's facets meet, a ray may be reflected by one or by the next.
        found.assert_within(0.02, 0.01, format_args!("{:?}", spec.options()));
    }
}

#[test]
fn waves_and_ways_to_record_them_change_no_picture() {
    let device = device();
    let (scene, eye) = surroundings();
    let stage = Setup::new(&device, &scene, eye, 20, 15, 5);
    let options = of_resolution(16);
    let expected = render(&stage, options, 2);
    let features = stage.desc().features;
    let cut = CubeMap::new(&stage.desc_with(37, features), options).expect("valid");
    assert!(stage.render(&cut, 2) == expected, "nine waves a sample draw one map");

    // Frames are recorded with more rounds until no ray is left.
    let (width, height) = (20, 15);
    let whole = CubeMap::new(&stage.desc(), options).expect("valid");
    let wave = |sample| Wave { first_pixel: 0, pixel_count: width * height, sample };
    use rasray_integrators::Integrator as _;
    loop {
        device.submit(|recorder| whole.record_reset(recorder)).expect("the reset runs");
        for sample in 0..2 {
            let traced = (&stage.structure).into();
            let submitted = device.submit(|recorder| whole.record_wave(recorder, traced, wave(sample)));
            submitted.expect("it runs").value.expect("the wave can be recorded");
        }
        if stage.film.read_faults(&device).expect("readable").unended == 0 {
            break;
        }
        assert!(whole.allow_more_rounds());
    }
    assert!(stage.film.read(&device).expect("readable") == expected);
    assert_silent(&device);
}

/// There are more veils around the point than rounds that are recorded at first.
#[test]
fn what_lies_behind_many_veils_is_in_the_map() {
    let (mut scene, eye) = surroundings();
    scene.materials[3].base_color[3] = 0.05;
    for number in 1..=30 {
        let place = 1.0 + 0.02 * f64::from(number);
        scene.meshes.push(square(DVec3::X * place, DVec3::Z * 0.6, DVec3::Y * 0.6, 3));
        let mesh = scene.meshes.len() - 1;
        scene.instances.push(rasray_scene::Instance { mesh, ..scene.instances[0].clone() });
    }
    let spec = cube_map().with("cube-resolution", 24).expect("valid");
    let found = difference(&scene, &scene, &eye, 1, &spec);
    println!("{found:?}");
    found.assert_within(0.02, 0.01, format_args!("{:?}", spec.options()));
}

#[test]
fn options_out_of_their_ranges_are_refused() {
    let device = device();
    let stage = Setup::new(&device, &Scene::default(), forward_camera(DVec3::ZERO), 2, 2, 0);
    for (options, named) in [
        (of_resolution(0), "cube-resolution 0"),
        (
            CubeMapOptions { position: Some([0.0, f32::NAN, 0.0]), ..of_resolution(4) },
            "cube-position 0,NaN,0",
        ),
        (CubeMapOptions { mirror_roughness: -1.0, ..of_resolution(4) }, "mirror-roughness -1"),
    ] {
        let error = CubeMap::new(&stage.desc(), options).expect_err("refused");
        assert!(error.to_string().contains(named), "{error}");
    }
    assert_silent(&device);
}
