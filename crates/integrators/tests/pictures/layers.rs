//! Ray casting through layers: against closed forms, and against a count of all surfaces along a ray.

use glam::DVec3;
use rasray_gpu::Timing;
use rasray_gpu_scene::Sampling;
use rasray_integrators::{Integrator, Layers, PATH_LAYER_LIMIT, Raycast, Wave};
use rasray_reference::oracle::{Oracle, Outcome, Verdict};
use rasray_reference::shading::{View, camera_ray, pixel_position};
use rasray_scene::{AlphaMode, Camera, Environment, Material, Mesh, Projection, Sampler, Scene};

use crate::pictures::common::{scenes::veiled_room, *};

const SIZE: u32 = 16;
const SEED: u32 = 3;
const SKY: [f32; 3] = [0.25, 0.5, 1.0];

fn flat_camera() -> Camera {
    camera(DVec3::ZERO, DVec3::X, DVec3::Y, Projection::Orthographic { half_height: 1.0 })
}

/// Makes a material that emits on both sides.
fn shining(color: [f32; 3], alpha: f32) -> Material {
    let [r, g, b] = color;
    let mode = if alpha < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
    Material { base_color: [r, g, b, alpha], unlit: true, alpha_mode: mode, ..lambert(0.0, 0.0) }
}

/// Makes sheets across the view, one after the other, each with a colour and an opacity of its own.
fn sheets(count: u32, apart: f64) -> (Scene, Vec<([f64; 3], f64)>) {
    let of = |sheet: u32| {
        let alpha = if sheet % 3 == 2 { 1.0 } else { 0.2 + 0.05 * (sheet % 7) as f32 };
        (std::array::from_fn(|channel| 0.1 + 0.2 * ((sheet + channel as u32) % 5) as f32), alpha)
    };
    let meshes = (0..count).map(|sheet| {
        let place = DVec3::new(0.0, 0.0, -1.0 - apart * f64::from(sheet));
        square(place, DVec3::X * 9.0, DVec3::new(0.0, 9.0, 0.0), sheet as usize)
    });
    let materials = (0..count).map(of).map(|(color, alpha)| shining(color, alpha)).collect();
    let expected = (0..count).map(of).map(|(color, alpha)| (color.map(f64::from), f64::from(alpha)));
    (scene(meshes.collect(), materials, SKY), expected.collect())
}

/// Adds front to back the colour of each sheet, and the sky behind the last sheet that is shown.
fn closed_form(sheets: &[([f64; 3], f64)], limit: Option<u32>, opacity: f32) -> [f64; 3] {
    let (mut sum, mut left) = ([0.0; 3], 1.0);
    for (color, alpha) in &sheets[..limit.map_or(sheets.len(), |limit| sheets.len().min(limit as usize))] {
        let opacity = alpha * f64::from(opacity);
        sum = std::array::from_fn(|channel| sum[channel] + left * opacity * color[channel]);
        left *= 1.0 - opacity;
    }
    std::array::from_fn(|channel| sum[channel] + left * f64::from(SKY[channel]))
}

#[test]
fn sheets_add_up_front_to_back() {
    let device = device();
    let (scene, sheets) = sheets(11, 0.25);
    let stage = Setup::new(&device, &scene, flat_camera(), SIZE, SIZE, SEED);
    let mut seen = Vec::new();
    for opacity in [1.0, 0.5, 0.125] {
        for limit in [None, Some(1), Some(2), Some(5), Some(11), Some(PATH_LAYER_LIMIT)] {
            let layers = Layers::new(&stage.desc(), limit, opacity).expect("valid");
            let expected = closed_form(&sheets, limit, opacity);
            let image = stage.render(&layers, 2);
            for pixel in &image {
                for channel in 0..3 {
                    let off = (f64::from(pixel[channel]) - expected[channel]).abs();
                    assert!(off < 2e-6, "{limit:?} at {opacity}: {pixel:?}, not {expected:?}");
                }
            }
            seen.push(image[0]);
        }
    }
    // Opaque sheets hide the surfaces behind the third one, and no other sheet hides any.
    assert_eq!(seen[0], seen[3], "the fourth sheet and those behind it are hidden");
    assert!(seen[6] != seen[9] && seen[6] == seen[10] && seen[6] == seen[11]);
    let faults = stage.film.read_faults(&device).expect("readable");
    assert_eq!((faults.unended, faults.cut), (0, 0));
    assert_silent(&device);
}

/// One layer at full opacity equals ray casting, bit for bit.
#[test]
fn one_opaque_layer_is_ray_casting() {
    let device = device();
    let mut scene = veiled_room();
    scene.environment = Environment::Constant(SKY);
    scene.materials.iter_mut().for_each(|material| material.alpha_mode = AlphaMode::Opaque);
    let stage = Setup::new(&device, &scene, forward_camera(DVec3::new(0.0, 0.0, 0.9)), SIZE, SIZE, SEED);
    let raycast = stage.render(&Raycast::new(&stage.desc()).expect("valid"), 2);
    for limit in [Some(1), None] {
        let layers = stage.render(&Layers::new(&stage.desc(), limit, 1.0).expect("valid"), 2);
        assert_same(&device, &layers, &raycast, SIZE, format_args!("{limit:?}"));
    }
    let through = stage.render(&Layers::new(&stage.desc(), None, 0.5).expect("valid"), 2);
    assert!(!are_same(&device, &through, &raycast), "something lies behind");
}

/// Makes white triangles of half opacity before a black sky: n of them send `1 - 2^-n`, exactly.
fn soup(count: u32, seed: u32) -> Scene {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24) - 0.5
    };
    let meshes = (0..count).map(|_| {
        let mut place = || DVec3::new(random(), random(), random());
        let centre = DVec3::new(0.0, 0.0, -4.0) + place() * 3.0;
        let corners = [place(), place(), place()].map(|corner| (centre + corner * 3.0).as_vec3().to_array());
        Mesh {
            name: "triangle".to_owned(),
            positions: corners.to_vec(),
            indices: vec![0, 1, 2],
            ..Mesh::default()
        }
    });
    scene(meshes.collect(), vec![shining([1.0; 3], 1.0)], [0.0; 3])
}

#[test]
fn rays_pass_as_many_surfaces_as_there_are() {
    let device = device();
    let camera = forward_camera(DVec3::ZERO);
    let mut counts = [0u32; 25];
    for seed in 1..=3 {
        let scene = soup(160, seed);
        let mut stage = Setup::new(&device, &scene, camera.clone(), SIZE, SIZE, SEED);
        stage.scene.set_sampling(Sampling::default()).expect("the frame can be written");
        let image = stage.render(&Layers::new(&stage.desc(), None, 0.5).expect("valid"), 1);
        let view = View {
            camera: camera.clone(),
            width: SIZE,
            height: SIZE,
            samples: 1,
            seed: SEED,
            sampler: Sampler::default(),
        };
        // Each triangle is rendered alone, so that no ray goes on behind a surface.
        let alone: Vec<_> = scene
            .meshes
            .iter()
            .map(|mesh| Oracle::brute_force(&mesh.positions, &mesh.indices, None).expect("a triangle"))
            .collect();
        for (pixel, color) in image.iter().enumerate() {
            let numbers = view.numbers(pixel as u32, 0);
            let ray =
                camera_ray(&view, stage.scene.frame_origin(), pixel_position(SIZE, numbers)).to_oracle();
            let verdicts: Vec<_> = alone.iter().map(|oracle| oracle.closest(&ray)).collect();
            if verdicts.iter().any(|verdict| verdict.ambiguous) {
                continue;
            }
            let is_hit = |verdict: &&Verdict| matches!(verdict.outcome, Outcome::Hit { .. });
            let count = verdicts.iter().filter(is_hit).count();
            assert_eq!(color[0], 1.0 - 0.5f32.powi(count as i32), "pixel {pixel} of soup {seed}: {count}");
            counts[count] += 1;
        }
    }
    println!("rays by the number of surfaces: {counts:?}");
    let deep: u32 = counts[9..].iter().sum();
    assert!(counts[0] > 0 && deep > 50, "rays need more rounds than a wave has at first: {counts:?}");
    assert_silent(&device);
}

/// The rest of a wave is counted until it is rendered, and rays that pass too many surfaces stay counted.
#[test]
fn rounds_are_recorded_until_rays_end() {
    let device = device();
    let stage = |count| {
        let (scene, _) = sheets(count, 0.01);
        Setup::new(&device, &scene, flat_camera(), SIZE, SIZE, SEED)
    };
    let wave = Wave { first_pixel: 0, pixel_count: 2, sample: 0 };
    let reset = |layers: &Layers| device.submit(|recorder| layers.record_reset(recorder)).map(|_| ());
    let many = stage(20);
    let layers = Layers::new(&many.desc(), None, 0.5).expect("valid");
    reset(&layers).expect("the reset runs");
    let traced = (&many.structure).into();
    device
        .submit(|recorder| layers.record_wave(recorder, traced, wave))
        .expect("it runs")
        .value
        .expect("the wave can be recorded");
    assert_eq!(many.film.read_faults(&device).expect("readable").unended, 2);
    assert!(layers.has_rest(&device).expect("readable"));
    while layers.has_rest(&device).expect("readable") {
        let rest = device.submit(|recorder| layers.record_rest(recorder, traced, wave)).expect("it runs");
        rest.value.expect("the rest can be recorded");
    }
    let pixels = many.film.read_pixels(&device).expect("readable");
    assert!(pixels[..2].iter().all(|pixel| pixel.samples == 1) && pixels[2].samples == 0);
    assert!(layers.allow_more_rounds() && layers.traces_per_wave() == 16);

    // The scene has one surface more than a ray may pass. With a limit of so few, nothing is missing.
    let endless = stage(PATH_LAYER_LIMIT + 1);
    for (limit, cut) in [(None, 2), (Some(PATH_LAYER_LIMIT), 0)] {
        let layers = Layers::new(&endless.desc(), limit, 1e-3).expect("valid");
        while layers.allow_more_rounds() {}
        reset(&layers).expect("the reset runs");
        layers.render_wave(&device, Timing::None, (&endless.structure).into(), wave).expect("it runs");
        let faults = endless.film.read_faults(&device).expect("readable");
        assert_eq!((faults.unended, faults.cut), (0, cut), "{limit:?}");
    }
    assert_silent(&device);
}

#[test]
fn layers_that_cannot_be_are_refused() {
    let device = device();
    let (scene, _) = sheets(1, 1.0);
    let stage = Setup::new(&device, &scene, flat_camera(), 4, 4, SEED);
    for (limit, opacity, option) in [
        (Some(0), 0.5, "layer-limit"),
        (Some(PATH_LAYER_LIMIT + 1), 0.5, "layer-limit"),
        (None, 0.0, "layer-opacity"),
        (None, 1.5, "layer-opacity"),
        (None, f32::NAN, "layer-opacity"),
    ] {
        let error = Layers::new(&stage.desc(), limit, opacity).expect_err("refused").to_string();
        assert!(error.contains(option), "{error}");
    }
}
