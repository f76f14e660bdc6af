//! Photons of many lights against the naive integrator, by every way to record waves.

use glam::DVec3;
use rasray_integrators::{Integrator, PhotonKind, Photons, Wave};
use rasray_scene::{Camera, Environment, Instance, Light, Projection, Scene};

use super::{floor, lit, options, photons, point_light, render};
use crate::kept_pictures::Compared;
use crate::pictures::common::*;
use crate::pictures::whitted::{ball, glass};

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
