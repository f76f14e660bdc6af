use glam::{DVec3, Vec3};
use rasray_scene::{Light, Material};

use crate::{
    shading::PosedScene,
    testing::{agrees, assert_mean, diffuse, parallel_view, quad, scene},
};

fn floor(albedo: f32) -> rasray_scene::Scene {
    scene(vec![diffuse(albedo)], vec![quad(Vec3::new(-5.0, 0.0, 5.0), Vec3::X * 10.0, Vec3::NEG_Z * 10.0, 0)])
}

fn direct(scene: &rasray_scene::Scene, point: [f64; 3]) -> f64 {
    let view = parallel_view([point[0], 4.0, point[2]], point, 1.0e-4, 2, 1);
    let posed = PosedScene::new(scene, DVec3::new(1.0, 2.0, 3.0)).expect("valid");
    posed.render_path(&view, 1).expect("rendered").mean()[0]
}

#[test]
fn a_point_light_falls_off_with_the_square_of_the_distance() {
    let mut scene = floor(0.7);
    scene.lights.push(Light::Point { position: DVec3::Y * 2.0, intensity: [3.0; 3], range: f32::INFINITY });
    for x in [0.0, 0.5, 2.0, 4.0_f64] {
        let squared = x * x + 4.0;
        let expected = 0.7 / std::f64::consts::PI * 3.0 * (2.0 / squared.sqrt()) / squared;
        let measured = direct(&scene, [x, 0.0, 0.0]);
        assert!((measured / expected - 1.0).abs() < 2.0e-4, "{x}: {measured} {expected}");
    }
}

#[test]
fn range_ends_a_point_light_smoothly() {
    let mut scene = floor(1.0);
    scene.lights.push(Light::Point { position: DVec3::Y, intensity: [1.0; 3], range: 2.0 });
    let measured = direct(&scene, [0.0, 0.0, 0.0]) * std::f64::consts::PI;
    assert!((measured - (1.0 - 1.0 / 16.0)).abs() < 1.0e-4, "{measured}");
    assert_eq!(direct(&scene, [2.0, 0.0, 0.0]), 0.0);
}

#[test]
fn parallel_light_and_spots_follow_their_cones() {
    let mut scene = floor(1.0);
    let direction = DVec3::new(0.0, -3.0, 4.0).normalize();
    scene.lights.push(Light::Directional { direction, irradiance: [2.0; 3] });
    let measured = direct(&scene, [1.0, 0.0, 1.0]) * std::f64::consts::PI;
    assert!((measured - 2.0 * 0.6).abs() < 1.0e-4, "{measured}");

    let (inner_cone, outer_cone) = (0.2_f32, 0.5_f32);
    scene.lights = vec![Light::Spot {
        position: DVec3::Y,
        direction: DVec3::NEG_Y,
        intensity: [1.0; 3],
        range: f32::INFINITY,
        inner_cone,
        outer_cone,
    }];
    for x in [0.0, 0.1, 0.3, 0.6_f64] {
        let cosine = 1.0 / (1.0 + x * x).sqrt();
        let (inner, outer) = (f64::from(inner_cone).cos(), f64::from(outer_cone).cos());
        let inside = ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0);
        let expected = inside * inside * cosine.powi(3);
        let measured = direct(&scene, [x, 0.0, 0.0]) * std::f64::consts::PI;
        assert!((measured - expected).abs() < 5.0e-4, "{x}: {measured} {expected}");
    }
}

#[test]
fn a_wall_between_light_and_floor_casts_a_shadow() {
    let mut scene = floor(1.0);
    scene.lights.push(Light::Point {
        position: DVec3::new(0.0, 2.0, 0.0),
        intensity: [1.0; 3],
        range: f32::INFINITY,
    });
    assert!(direct(&scene, [2.0, 0.0, 0.0]) > 0.0);
    scene.meshes.push(quad(Vec3::new(1.0, 0.0, -1.0), Vec3::Z * 2.0, Vec3::Y * 1.5, 0));
    scene.instances.push(rasray_scene::Instance { mesh: 1, ..scene.instances[0].clone() });
    assert_eq!(direct(&scene, [2.0, 0.0, 0.0]), 0.0);
    // From further out the light stands above the wall's top edge.
    assert!(direct(&scene, [4.9, 0.0, 0.0]) > 0.0);
}

fn squares(double_sided: bool, flipped: bool) -> rasray_scene::Scene {
    let emitter = Material { emission: [1.0; 3], double_sided, ..diffuse(0.0) };
    let corner = Vec3::new(-0.5, 1.0, -0.5);
    let (u, v) = if flipped { (Vec3::Z, Vec3::X) } else { (Vec3::X, Vec3::Z) };
    let receiver = quad(Vec3::new(-0.5, 0.0, 0.5), Vec3::X, Vec3::NEG_Z, 0);
    scene(vec![diffuse(1.0), emitter], vec![receiver, quad(corner, u, v, 1)])
}

/// The mean radiance of a white square below an emitting one is their form factor.
#[test]
fn parallel_squares_exchange_their_form_factor() {
    let view = parallel_view([0.0, 0.5, 0.0], [0.0; 3], 0.5, 32, 16);
    for (double_sided, flipped, seen) in [(false, false, true), (true, true, true), (false, true, false)] {
        // X x Z points down: if not flipped, the front faces the receiver.
        let scene = squares(double_sided, flipped);
        let image =
            PosedScene::new(&scene, DVec3::ZERO).expect("valid").render_path(&view, 1).expect("rendered");
        if seen {
            assert_mean(&image, 0.199_824_896, 0.0, 0.025);
        } else {
            assert!(image.pixels.iter().flatten().all(|value| *value == 0.0));
        }
    }
}

/// A texture that blackens half of the emitter removes that half's share.
#[test]
fn textured_emission_is_sampled_without_bias() {
    let mut scene = squares(false, false);
    scene.images.push(rasray_scene::Image {
        name: "half".to_owned(),
        width: 2,
        height: 1,
        rgba8: vec![0, 0, 0, 255, 255, 255, 255, 255],
    });
    scene.textures.push(rasray_scene::Texture {
        image: 0,
        wrap_u: rasray_scene::Wrap::Clamp,
        wrap_v: rasray_scene::Wrap::Clamp,
        filter: rasray_scene::Filter::Nearest,
        mipmapped: false,
    });
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    scene.materials[1].emission_texture =
        Some(rasray_scene::TextureRef { texture: 0, uv_set: 0, uv_transform: identity });
    let view = parallel_view([0.0, 0.5, 0.0], [0.0; 3], 0.5, 32, 16);
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let image = posed.render_path(&view, 1).expect("rendered");
    // By symmetry each half of the emitter sends half to the square.
    assert_mean(&image, 0.199_824_896 / 2.0, 0.0, 0.08);
    // The square is brighter below the bright half, for any rotation of the picture.
    let sum = |pixels: &dyn Fn(usize, usize) -> bool| -> f32 {
        (0..32 * 32).filter(|p| pixels(p / 32, p % 32)).map(|p| image.pixels[p][0]).sum()
    };
    let columns = sum(&|_, column| column < 8) / sum(&|_, column| column >= 24);
    let rows = sum(&|row, _| row < 8) / sum(&|row, _| row >= 24);
    assert!((columns - 1.0).abs().max((rows - 1.0).abs()) > 0.1, "{columns} {rows}");
}

/// A glossy receiver finds the emitter by scattering, a diffuse one by light samples. With both weighted the
/// image is the same as with scattering alone, here through an emitter that is not in the light list.
#[test]
fn light_samples_and_scattering_agree() {
    let view = parallel_view([0.0, 0.5, 0.0], [0.0; 3], 0.5, 24, 64);
    let mut scene = squares(false, false);
    scene.materials[0] = Material { roughness: 0.4, metallic: 0.5, specular: 1.0, ..diffuse(0.8) };
    let both = PosedScene::new(&scene, DVec3::ZERO).expect("valid").render_path(&view, 1).expect("rendered");
    scene.materials[1] = Material { unlit: true, ..diffuse(1.0) };
    let scattering =
        PosedScene::new(&scene, DVec3::ZERO).expect("valid").render_path(&view, 1).expect("rendered");
    let mean = scattering.mean()[0];
    assert!(agrees(&both, mean, 0.02 * mean), "{:?} {:?}", both.mean(), scattering.mean());
    assert!(!agrees(&both, mean * 1.2, 0.02 * mean));
}
