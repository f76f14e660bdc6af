use glam::{DVec3, Vec2, Vec3};
use rasray_scene::{AlphaMode, Environment, Light, Material};

use crate::{
    integrators::PathOptions,
    shading::{PosedScene, Ray},
    testing::{assert_mean, cube, diffuse, quad, scene, view},
};

fn white_sky(material: Material, mesh: rasray_scene::Mesh) -> rasray_scene::Scene {
    let mut scene = scene(vec![material], vec![mesh]);
    scene.environment = Environment::Constant([1.0; 3]);
    scene
}

fn sheet() -> rasray_scene::Mesh {
    quad(Vec3::new(-5.0, -5.0, 0.0), Vec3::X * 10.0, Vec3::Y * 10.0, 0)
}

#[test]
fn a_medium_dims_light_by_the_way_through_it() {
    let clear = Material {
        transmission: 1.0,
        roughness: 0.0,
        thickness: 1.0,
        ior: 1.0,
        attenuation_color: [0.25, 0.5, 1.0],
        attenuation_distance: 1.0,
        ..diffuse(1.0)
    };
    let scene = white_sky(clear, cube(0.5, false, 0));
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let straight = crate::testing::parallel_view([0.0, 0.0, 4.0], [0.0; 3], 0.3, 4, 1);
    let image = posed.render_path(&straight, 3).expect("rendered");
    for pixel in &image.pixels {
        for (value, expected) in pixel.iter().zip([0.25, 0.5, 1.0]) {
            assert!((value - expected).abs() < 1.0e-5, "{pixel:?}");
        }
    }
}

/// A slab of glass transmits light with reflections between its sides: (1 - R) / (1 + R), R = 0.04.
#[test]
fn a_slab_of_glass_passes_its_share() {
    let glass =
        Material { metallic: 0.0, roughness: 0.0, transmission: 1.0, thickness: 1.0, ..Material::default() };
    let mut scene = white_sky(glass, cube(0.5, false, 0));
    // Only the lower half of the sky emits, and the view looks straight down.
    scene.environment = Environment::LatLong { width: 1, height: 2, radiance: vec![[0.0; 3], [1.0; 3]] };
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let down = crate::testing::parallel_view([0.0, 4.0, 0.0], [0.0; 3], 0.3, 32, 16);
    let image = posed.render_path(&down, 40).expect("rendered");
    assert_mean(&image, 0.923_077, 0.0, 0.02);
}

#[test]
fn blended_surfaces_let_their_share_pass() {
    let blended = Material { base_color: [0.0, 0.0, 0.0, 0.3], alpha_mode: AlphaMode::Blend, ..diffuse(0.0) };
    let scene = white_sky(blended, sheet());
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let image = posed.render_path(&view([0.0, 0.0, 5.0], [0.0; 3], 16, 64), 2).expect("rendered");
    assert_mean(&image, 0.7, 0.0, 0.04);
}

/// A floor behind a blended sheet is lit through it, by light samples and by scattered rays: it receives 0.7
/// of the sky's light, and 0.7 of its own light is seen.
#[test]
fn light_through_a_blended_sheet_is_counted_once() {
    let blended = Material { base_color: [0.0, 0.0, 0.0, 0.3], alpha_mode: AlphaMode::Blend, ..diffuse(0.0) };
    let mut scene =
        white_sky(blended, quad(Vec3::new(-90.0, -90.0, 0.01), Vec3::X * 180.0, Vec3::Y * 180.0, 0));
    scene.materials.push(diffuse(1.0));
    scene.meshes.push(quad(Vec3::new(-90.0, -90.0, 0.0), Vec3::X * 180.0, Vec3::Y * 180.0, 1));
    scene.instances.push(rasray_scene::Instance { mesh: 1, ..scene.instances[0].clone() });
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let image = posed.render_path(&view([0.0, 0.0, 5.0], [0.0; 3], 16, 96), 1).expect("rendered");
    assert_mean(&image, 0.7 * 0.7, 0.002, 0.04);
}

/// The sun stands above a pane and two blended sheets, seen from below: the test computes the light that each
/// transmits, without noise.
#[test]
fn the_sun_shines_through_what_lets_it_pass() {
    let blended = Material { base_color: [0.0, 0.0, 0.0, 0.3], alpha_mode: AlphaMode::Blend, ..diffuse(0.0) };
    let pane = Material {
        base_color: [0.9, 0.5, 0.2, 1.0],
        transmission: 1.0,
        roughness: 0.0,
        thickness: 0.0,
        specular: 0.0,
        ..diffuse(1.0)
    };
    let wide =
        |z: f32, material| quad(Vec3::new(-90.0, -90.0, z), Vec3::X * 180.0, Vec3::Y * 180.0, material);
    let meshes = vec![wide(0.0, 2), wide(6.0, 0), wide(6.5, 0), wide(7.0, 1)];
    let mut scene = scene(vec![blended, pane, diffuse(0.5)], meshes);
    let direction = DVec3::new(0.6, 0.0, -0.8);
    scene.lights.push(Light::Directional { direction, irradiance: [2.0; 3] });
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let eye = view([0.0, 0.0, 5.0], [0.0; 3], 4, 2);
    let lit = 0.5 / std::f32::consts::PI * 2.0 * 0.8 * 0.7 * 0.7;
    for pixel in posed.render_path(&eye, 1).expect("rendered").pixels {
        for (value, tint) in pixel.iter().zip([0.9, 0.5, 0.2]) {
            assert!((value - lit * tint).abs() < 1.0e-6, "{pixel:?}");
        }
    }
    let opaque = PathOptions { passes_panes: false, ..PathOptions::from(4) };
    let image = posed.render_path(&eye, opaque).expect("rendered");
    assert!(image.pixels.iter().all(|pixel| *pixel == [0.0; 3]));
}

/// Light samples choose a blended emitter, which sends its emission times its opacity; a scattered ray hits
/// the emitter with a probability of its opacity. An emitter that is clear all over is no light.
#[test]
fn blended_emitters_are_sampled_as_their_opacity_says() {
    let emitter = Material { base_color: [0.0, 0.0, 0.0, 0.5], emission: [1.0; 3], ..diffuse(0.0) };
    let floor = quad(Vec3::new(-0.5, -0.5, -0.5), Vec3::X, Vec3::Y, 1);
    let mut scene = scene(vec![emitter, diffuse(0.5)], vec![cube(1.0, true, 0), floor]);
    let down = Ray {
        origin: Vec3::ZERO,
        direction: Vec3::NEG_Z,
        t_max: f32::INFINITY,
        exclude_primitive: None,
        culls_back_faces: false,
        cone_width: 0.0,
        cone_spread: 0.0,
    };
    for (alpha_mode, alpha, sent) in [
        (AlphaMode::Opaque, 0.5, Some(1.0)),
        (AlphaMode::Blend, 0.5, Some(0.5)),
        (AlphaMode::Blend, 0.0, None),
        (AlphaMode::Mask { cutoff: 0.6 }, 0.5, Some(0.0)),
    ] {
        scene.materials[0].alpha_mode = alpha_mode;
        scene.materials[0].base_color[3] = alpha;
        let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
        let surface = posed.surface(&down, 0.5, 12, Vec2::new(0.25, 0.5));
        // Face x = 1 of the box has triangles 0 and 1; the floor has 12 and 13.
        let pdf = posed.light_pdf_emitter(0, surface.position, Vec3::new(1.0, 0.25, 0.0));
        let chosen = (0..64).find_map(|i| {
            let u = (i as f32 + 0.5) / 64.0;
            posed.light_sample(&surface, [0.5, u, 0.3, 0.7])
        });
        assert_eq!(chosen.map(|chosen| chosen.radiance), sent.map(Vec3::splat));
        assert_eq!(pdf > 0.0, sent.is_some());
    }
    // Every direction shows half of the emission, and the floor reflects half of that.
    scene.materials[0] = Material {
        alpha_mode: AlphaMode::Blend,
        base_color: [0.0, 0.0, 0.0, 0.5],
        ..scene.materials[0].clone()
    };
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let straight = crate::testing::parallel_view([0.0; 3], [0.0, 0.0, -0.5], 0.3, 32, 64);
    let image = posed.render_path(&straight, 1).expect("rendered");
    assert_mean(&image, 0.25, 0.002, 0.04);
}

#[test]
fn masked_surfaces_are_there_or_not() {
    for (alpha, cutoff, expected) in
        [(0.49, 0.5, 1.0), (0.51, 0.5, 0.0), (1.0, 1.0, 0.0), (1.0, f32::INFINITY, 1.0)]
    {
        let masked = Material {
            base_color: [0.0, 0.0, 0.0, alpha],
            alpha_mode: AlphaMode::Mask { cutoff },
            ..diffuse(0.0)
        };
        let scene = white_sky(masked, sheet());
        let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
        let image = posed.render_path(&view([0.0, 0.0, 5.0], [0.0; 3], 4, 1), 1).expect("rendered");
        assert!(image.pixels.iter().flatten().all(|value| *value == expected), "{alpha} {cutoff}");
    }
}

#[test]
fn unlit_surfaces_show_their_colour_from_both_sides() {
    let unlit = Material { base_color: [0.2, 0.4, 0.6, 1.0], unlit: true, ..Material::default() };
    let scene = white_sky(unlit, sheet());
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    for eye in [5.0, -5.0] {
        let image = posed.render_path(&view([0.0, 0.0, eye], [0.0; 3], 2, 1), 3).expect("rendered");
        assert!(image.pixels.iter().all(|pixel| *pixel == [0.2, 0.4, 0.6]));
    }
}
