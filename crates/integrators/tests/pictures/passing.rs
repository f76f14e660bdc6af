//! Rays that pass any number of surfaces in a straight line.

use glam::DVec3;
use rasray_gpu::Timing;
use rasray_integrators::{GlassShadows, Integrator, PATH_LAYER_LIMIT, Path, PathOptions, Wave};
use rasray_scene::{AlphaMode, Filter, Image, Light, Material, Projection, Scene, Texture, TextureRef, Wrap};

use crate::pictures::common::*;

const SIZE: u32 = 8;

fn veil(alpha: f32) -> Material {
    let mut veil = lambert(0.0, 0.0);
    veil.base_color[3] = alpha;
    veil.alpha_mode = AlphaMode::Blend;
    veil
}

/// Makes a wall in the sun, behind layers at distances of `apart`.
fn behind(layers: u32, apart: f64, material: Material) -> Scene {
    let mut meshes = vec![square(DVec3::new(0.0, 0.0, -50.0), DVec3::X * 60.0, DVec3::Y * 60.0, 0)];
    meshes.extend((0..layers).map(|i| {
        square(DVec3::new(0.0, 0.0, -2.0 - apart * f64::from(i)), DVec3::X * 60.0, DVec3::Y * 60.0, 1)
    }));
    let mut scene = scene(meshes, vec![lambert(0.5, 0.0), material], [0.0; 3]);
    scene.lights.push(Light::Directional {
        direction: DVec3::new(0.1, -0.2, -1.0).normalize(),
        irradiance: [4.0, 3.0, 2.0],
    });
    scene
}

fn stage(device: &rasray_gpu::Device, scene: &Scene) -> Setup {
    let eye = camera(DVec3::ZERO, DVec3::X, DVec3::Y, Projection::Orthographic { half_height: 1.0 });
    Setup::new(device, scene, eye, SIZE, SIZE, 5)
}

#[test]
fn the_rest_of_a_wave_is_counted_until_it_is_rendered() {
    let device = device();
    let layered = stage(&device, &behind(50, 0.5, veil(0.0)));
    let path = Path::new(&layered.desc(), 1).expect("valid");
    let wave = Wave { first_pixel: 0, pixel_count: SIZE * SIZE, sample: 0 };
    device.submit(|recorder| path.record_reset(recorder)).expect("the reset runs");
    let traced = (&layered.structure).into();
    let submitted = device.submit(|recorder| path.record_wave(recorder, traced, wave)).expect("it runs");
    submitted.value.expect("the wave can be recorded");
    let faults = layered.film.read_faults(&device).expect("readable");
    assert_eq!((faults.unended, faults.cut), (SIZE * SIZE, 0));
    let pixels = layered.film.read_pixels(&device).expect("readable");
    assert!(pixels.iter().all(|pixel| pixel.samples == 0), "nothing is added that is not whole");
    while path.has_rest(&device).expect("readable") {
        let rest = device.submit(|recorder| path.record_rest(recorder, traced, wave)).expect("it runs");
        rest.value.expect("the rest can be recorded");
    }
    let continued = layered.film.read_pixels(&device).expect("readable");
    assert!(continued.iter().all(|pixel| pixel.samples == 1));

    // Recorded at once, the picture is the same, and equals that without layers.
    let whole = Path::new(&layered.desc(), 1).expect("valid");
    while whole.traces_per_wave() < 110 {
        assert!(whole.allow_more_rounds());
    }
    device.submit(|recorder| whole.record_reset(recorder)).expect("the reset runs");
    whole.render_wave(&device, Timing::None, traced, wave).expect("it runs");
    assert_eq!(layered.film.read_pixels(&device).expect("readable"), continued);
    let bare = stage(&device, &behind(0, 1.0, veil(0.0)));
    let expected = bare.render(&Path::new(&bare.desc(), 1).expect("valid"), 1);
    for (pixel, expected) in continued.iter().map(|pixel| pixel.mean()).zip(&expected) {
        for channel in 0..3 {
            let off = (pixel[channel] - expected[channel]).abs();
            assert!(off <= 1e-5 * expected[channel] && expected[channel] > 0.2, "{pixel:?} {expected:?}");
        }
    }
    assert_silent(&device);
}

#[test]
fn rounds_end_and_so_do_rays_which_is_counted() {
    let device = device();
    // There are two layers more than the camera's ray may pass; the wall's shadow ray would have passed them
    // all as well.
    let layered = stage(&device, &behind(PATH_LAYER_LIMIT + 2, 0.01, veil(0.0)));
    let path = Path::new(&layered.desc(), 1).expect("valid");
    let wave = Wave { first_pixel: 0, pixel_count: 2, sample: 0 };
    while path.allow_more_rounds() {}
    let rounds = path.traces_per_wave();
    assert!(rounds > PATH_LAYER_LIMIT && !path.allow_more_rounds() && path.traces_per_wave() == rounds);
    let few = Path::new(&layered.desc(), 1).expect("valid");
    device.submit(|recorder| few.record_reset(recorder)).expect("the reset runs");
    few.render_wave(&device, Timing::None, (&layered.structure).into(), wave).expect("it runs");
    let faults = layered.film.read_faults(&device).expect("readable");
    assert_eq!((faults.unended, faults.cut), (0, 2));
    let pixels = layered.film.read_pixels(&device).expect("readable");
    assert!(
        pixels[..2].iter().all(|pixel| pixel.samples == 1 && pixel.sum == [0.0; 3]),
        "{:?}",
        &pixels[..2]
    );
    assert_silent(&device);
}

/// Left of the middle a sheet is clear, right of it opaque, by the alpha of its texture.
#[test]
fn shadows_follow_the_alpha_of_textures() {
    let device = device();
    let mut sheet = veil(1.0);
    sheet.base_color_texture =
        Some(TextureRef { texture: 0, uv_set: 0, uv_transform: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] });
    // The sheet is between floor and sun, and above the camera.
    let mut above = square(DVec3::new(0.0, 0.0, 2.0), DVec3::X * 4.0, DVec3::Y * 4.0, 1);
    above.uvs[0] = Some(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]);
    let floor = square(DVec3::new(0.0, 0.0, -1.0), DVec3::X * 4.0, DVec3::Y * 4.0, 0);
    let mut scene = scene(vec![floor, above], vec![lambert(0.5, 0.0), sheet], [0.0; 3]);
    scene.images =
        vec![Image { name: "alpha".to_owned(), width: 2, height: 1, rgba8: vec![0, 0, 0, 0, 0, 0, 0, 255] }];
    scene.textures = vec![Texture {
        image: 0,
        wrap_u: Wrap::Clamp,
        wrap_v: Wrap::Clamp,
        filter: Filter::Nearest,
        mipmapped: false,
    }];
    scene.lights.push(Light::Directional { direction: DVec3::NEG_Z, irradiance: [3.0; 3] });
    let image = stage(&device, &scene);
    let pixels = image.render(&Path::new(&image.desc(), 2).expect("valid"), 1);
    let lit = 3.0 * 0.5 / std::f32::consts::PI;
    for (index, pixel) in pixels.iter().enumerate() {
        let is_left = index as u32 % SIZE < SIZE / 2;
        let expected = if is_left { lit } else { 0.0 };
        assert!((pixel[0] - expected).abs() <= 1e-5 * lit, "{index}: {pixel:?}");
    }
    assert_silent(&device);
}

/// Without a smooth thin pane or a blended material no further rounds are recorded; with one, the options
/// decide.
#[test]
fn only_scenes_that_let_light_pass_record_more() {
    let device = device();
    let thin =
        Material { transmission: 1.0, roughness: 0.0, thickness: 0.0, specular: 1.0, ..lambert(1.0, 0.0) };
    let rough = Material { roughness: 0.5, ..thin.clone() };
    let thick = Material { thickness: 0.1, ..thin.clone() };
    let opaque = |bounces| PathOptions { glass_shadows: GlassShadows::Opaque, ..PathOptions::from(bounces) };
    let (lean, passing) = (2 * 3 + 1, 2 * 3 + 1 + 8);
    for (material, tint, without) in [
        (lambert(0.5, 0.0), lean, lean),
        (rough, lean, lean),
        (thick, lean, lean),
        (thin, passing, lean),
        (veil(0.5), passing, passing),
    ] {
        let stage = stage(&device, &behind(1, 1.0, material));
        let traces =
            |options: PathOptions| Path::new(&stage.desc(), options).expect("valid").traces_per_wave();
        assert_eq!([traces(3.into()), traces(opaque(3))], [tint, without]);
        assert_eq!(
            traces(0.into()),
            if without == passing { 9 } else { 1 },
            "glass is opaque without bounces"
        );
    }
    assert_silent(&device);
}
