use rasray_scene::{Environment, Light, Material};

use crate::{
    shading::PosedScene,
    testing::{assert_mean, cube, diffuse, parallel_view, scene, sphere, view},
};

/// A closed diffuse enclosure with emission 1 and albedo rho shows (1 - rho^(n+1)) / (1 - rho) after
/// n bounces, everywhere.
#[test]
fn an_enclosure_adds_up_the_series_of_its_albedo() {
    for albedo in [0.5_f64, 0.8] {
        let material = Material { emission: [1.0; 3], ..diffuse(albedo as f32) };
        let scene = scene(vec![material], vec![cube(1.0, true, 0)]);
        let posed = PosedScene::new(&scene, glam::DVec3::ZERO).expect("valid");
        for bounces in [0, 1, 2, 3, 6] {
            let view = view([0.2, 0.1, 0.3], [-0.5, 0.3, -0.9], 16, if bounces == 0 { 1 } else { 48 });
            let image = posed.render_path(&view, bounces).expect("rendered");
            let expected = (1.0 - albedo.powi(bounces as i32 + 1)) / (1.0 - albedo);
            if bounces == 0 {
                assert!(image.pixels.iter().flatten().all(|value| *value == 1.0));
            } else {
                assert_mean(&image, expected, 0.0, 0.06);
            }
        }
    }
}

/// Without light samples only the noise changes: both techniques share the light by weight.
#[test]
fn a_lambertian_surface_under_a_white_sky_shows_its_albedo() {
    let mut scene = scene(vec![diffuse(0.6)], vec![sphere(3, false, false, 0)]);
    scene.environment = Environment::Constant([1.0; 3]);
    let view = view([0.0, 0.0, 5.0], [0.0; 3], 8, 128);
    let image =
        PosedScene::new(&scene, glam::DVec3::ZERO).expect("valid").render_path(&view, 1).expect("rendered");
    // Pixels at the corners may miss the sphere: only pixels on it are compared.
    let mut inner = image.clone();
    inner.pixels = (0..64)
        .filter(|p| (2..6).contains(&(p % 8)) && (2..6).contains(&(p / 8)))
        .map(|p| image.pixels[p])
        .collect();
    assert_mean(&inner, 0.6, 0.0, 0.03);
}

#[test]
fn a_sphere_around_a_point_light_is_one() {
    // Direct light I / r^2 = pi gives rho; each further bounce gives rho times as much: 1 - 2^-n in all.
    let mut scene = scene(vec![diffuse(0.5)], vec![sphere(4, true, false, 0)]);
    scene.lights.push(Light::Point {
        position: glam::DVec3::ZERO,
        intensity: [std::f32::consts::PI; 3],
        range: f32::INFINITY,
    });
    let posed = PosedScene::new(&scene, glam::DVec3::new(0.0, 1.0, 0.0)).expect("valid");
    let view = view([0.1, 0.2, 0.3], [0.5, 1.0, -2.0], 16, 16);
    for bounces in [1, 2, 4, 12] {
        let image = posed.render_path(&view, bounces).expect("rendered");
        // Facets lie up to 0.3 percent inside the sphere.
        assert_mean(&image, 1.0 - 0.5_f64.powi(bounces as i32), 0.006, 0.05);
    }
}

#[test]
fn lossless_mirrors_and_glass_vanish_in_a_white_sky() {
    let mirror = Material { roughness: 0.0, ..Material::default() };
    let glass = Material { metallic: 0.0, transmission: 1.0, thickness: 1.0, ..mirror.clone() };
    let thin = Material { thickness: 0.0, ..glass.clone() };
    for material in [mirror, glass, thin] {
        let mut scene = scene(vec![material], vec![sphere(4, false, false, 0)]);
        scene.environment = Environment::Constant([1.0; 3]);
        let posed = PosedScene::new(&scene, glam::DVec3::ZERO).expect("valid");
        let image = posed.render_path(&view([0.0, 0.0, 4.0], [0.0; 3], 12, 64), 400).expect("rendered");
        // Roulette ends five percent of the paths after the third scattering and compensates for it.
        assert_mean(&image, 1.0, 1.0e-3, 0.03);
    }
}

/// Rough glass without absorption reflects and transmits all light, clear and milky.
#[test]
fn rough_glass_vanishes_in_a_white_sky() {
    for (roughness, transmission) in [(0.2, 1.0), (0.4, 1.0), (1.0, 1.0), (0.4, 0.5), (1.0, 0.5)] {
        let material =
            Material { metallic: 0.0, roughness, transmission, thickness: 1.0, ..Material::default() };
        let mut scene = scene(vec![material], vec![sphere(4, false, true, 0)]);
        scene.environment = Environment::Constant([1.0; 3]);
        let posed = PosedScene::new(&scene, glam::DVec3::ZERO).expect("valid");
        // Every pixel shows the ball.
        let image = posed
            .render_path(&parallel_view([0.0, 0.0, 4.0], [0.0; 3], 0.65, 16, 256), 400)
            .expect("rendered");
        // Roulette ends five percent of the paths after the third scattering and compensates for it.
        assert_mean(&image, 1.0, 5.0e-3, 0.05);
    }
}

#[test]
fn a_map_of_equal_texels_is_a_constant_sky() {
    let mut scene = scene(vec![diffuse(0.8)], vec![sphere(2, false, true, 0)]);
    scene.environment = Environment::LatLong { width: 8, height: 5, radiance: vec![[1.0; 3]; 40] };
    let posed = PosedScene::new(&scene, glam::DVec3::ZERO).expect("valid");
    let view = view([0.0, 0.0, 9.0], [0.0; 3], 8, 256);
    let mut image = posed.render_path(&view, 1).expect("rendered");
    image.pixels = (0..64)
        .filter(|p| (3..5).contains(&(p % 8)) && (3..5).contains(&(p / 8)))
        .map(|p| image.pixels[p])
        .collect();
    assert!(crate::testing::agrees(&image, 0.8, 0.01), "{:?}", image.mean());
}
