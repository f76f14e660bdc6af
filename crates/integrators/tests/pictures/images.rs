//! Images with known values, rendered with the brute-force structure.

use crate::pictures::common::*;
use glam::DVec3;
use rasray_ads::Ray;
use rasray_gpu_scene::ShadingFeatures;
use rasray_gpu_scene::layout::EmissiveTriangle;
use rasray_integrators::{
    AmbientOcclusion, AovPass, Bands, Film, Integrator, IntegratorError, Path, Raycast, Wave, Whitted,
    WhittedOptions,
};
use rasray_scene::{Light, Material, Projection, Scene};

#[test]
fn a_scene_without_triangles_shows_its_environment() {
    let device = device();
    let empty =
        Scene { environment: rasray_scene::Environment::Constant([0.25, 0.5, 2.0]), ..Scene::default() };
    let stage = Setup::new(&device, &empty, forward_camera(DVec3::new(1.0, 2.0, 3.0)), 5, 3, 1);
    let path = Path::new(&stage.desc(), 2).expect("valid");
    assert_eq!(stage.render(&path, 2), vec![[0.25, 0.5, 2.0]; 15]);
    let raycast = Raycast::new(&stage.desc()).expect("valid");
    assert_eq!(stage.render(&raycast, 1), vec![[0.25, 0.5, 2.0]; 15]);
    let occlusion = AmbientOcclusion::new(&stage.desc(), f32::INFINITY).expect("valid");
    assert_eq!(stage.render(&occlusion, 1), vec![[1.0; 3]; 15]);
    assert_silent(&device);
}

#[test]
fn ambient_occlusion_sees_what_is_within_its_range() {
    let device = device();
    // A floor lies under a ceiling, 2 m above, that covers all of its sky.
    let meshes = vec![
        square(DVec3::new(0.0, 0.0, -4.0), DVec3::X, -DVec3::Z, 0),
        square(DVec3::new(0.0, 2.0, 0.0), DVec3::X * 1e4, DVec3::Z * 1e4, 0),
    ];
    let scene = scene(meshes, vec![lambert(0.5, 0.0)], [0.0; 3]);
    let down = camera(
        DVec3::new(0.0, 1.0, -4.0),
        DVec3::X,
        -DVec3::Z,
        Projection::Orthographic { half_height: 0.5 },
    );
    let stage = Setup::new(&device, &scene, down, 8, 8, 3);
    let image = |range| stage.render(&AmbientOcclusion::new(&stage.desc(), range).expect("valid"), 8);
    assert_eq!(image(1.9), vec![[1.0; 3]; 64]);
    // Nearly everything is occluded: only rays within 1/5000 of the horizon escape.
    assert!(mean(&image(f32::INFINITY)) < 0.01);
    // The ceiling within a range r covers the cone of cosine 2/r: 1 - (2/r)^2 of the weight.
    let visible = mean(&image(4.0));
    let deviation = (0.25 * 0.75 / 512.0f64).sqrt();
    assert!((visible - 0.25).abs() < 5.0 * deviation, "{visible}");
    assert!(matches!(AmbientOcclusion::new(&stage.desc(), 0.0), Err(IntegratorError::Value(_))));
    assert!(matches!(AmbientOcclusion::new(&stage.desc(), f32::NAN), Err(IntegratorError::Value(_))));
    assert_silent(&device);
}

#[test]
fn a_closed_emitting_box_gives_the_geometric_series() {
    let device = device();
    let albedo = 0.5f64;
    let scene = scene(box_inside(1.0, 0), vec![lambert(albedo as f32, 1.0)], [0.0; 3]);
    let stage = Setup::new(&device, &scene, forward_camera(DVec3::new(0.1, -0.2, 0.3)), 16, 16, 5);
    for bounces in [0, 1, 3] {
        let path = Path::new(&stage.desc(), bounces).expect("valid");
        assert_eq!(path.traces_per_wave(), 2 * bounces + 1);
        let image = stage.render(&path, 16);
        let expected: f64 = (0..=bounces).map(|k| albedo.powi(k as i32)).sum();
        let found = mean(&image);
        assert!((found - expected).abs() < 0.01 * expected, "{bounces}: {found}, expected {expected}");
        if bounces == 0 {
            assert_eq!(image, vec![[1.0; 3]; 256]);
        }
    }
    assert_silent(&device);
}

#[test]
fn a_point_light_falls_off_with_distance_and_cosine_and_casts_shadows() {
    let device = device();
    let floor = square(DVec3::ZERO, DVec3::X * 10.0, -DVec3::Z * 10.0, 0);
    let mut scene = scene(vec![floor], vec![lambert(0.5, 0.0)], [0.0; 3]);
    scene.lights.push(Light::Point {
        position: DVec3::new(0.0, 2.0, 0.0),
        intensity: [std::f32::consts::PI; 3],
        range: f32::INFINITY,
    });
    let projection = Projection::Orthographic { half_height: 1e-3 };
    let above = |x: f64| camera(DVec3::new(x, 1.0, 0.0), DVec3::X, -DVec3::Z, projection);
    for x in [0.0, 1.5] {
        let stage = Setup::new(&device, &scene, above(x), 2, 2, 0);
        let image = stage.render(&Path::new(&stage.desc(), 1).expect("valid"), 1);
        // I cos / r^2 * albedo / pi
        let squared = x * x + 4.0;
        let expected = 0.5 * (2.0 / squared.sqrt()) / squared;
        assert!((mean(&image) - expected).abs() < 1e-3 * expected, "{x}: {} {expected}", mean(&image));
    }
    // A small square stands between light and floor.
    scene.meshes.push(square(DVec3::new(0.0, 1.5, 0.0), DVec3::X * 0.1, -DVec3::Z * 0.1, 0));
    scene.instances.push(rasray_scene::Instance {
        name: "blocker".to_owned(),
        mesh: 1,
        world_from_mesh: glam::DAffine3::IDENTITY,
    });
    let stage = Setup::new(&device, &scene, above(0.0), 2, 2, 0);
    let image = stage.render(&Path::new(&stage.desc(), 1).expect("valid"), 1);
    assert_eq!(image, vec![[0.0; 3]; 4]);
    assert_silent(&device);
}

#[test]
fn a_polished_metal_of_leaning_normals_is_white_in_a_white_furnace() {
    let device = device();
    let mut floor = square(DVec3::ZERO, DVec3::X, DVec3::Y, 0);
    // Normals are interpolated as on a bumpy surface: some corners lean so far that a mirrored ray would go
    // below it.
    floor.normals = Some(vec![[0.0, 0.0, 1.0], [-0.8, 0.0, 0.6], [0.6, 0.6, 0.53], [0.0, -0.95, 0.31]]);
    let polished = Material { metallic: 1.0, roughness: 0.0, ..lambert(1.0, 0.0) };
    let scene = scene(vec![floor], vec![polished], [1.0; 3]);
    let stage = Setup::new(&device, &scene, forward_camera(DVec3::new(0.0, 0.0, 1.5)), 24, 24, 3);
    let image = stage.render(&Path::new(&stage.desc(), 2).expect("valid"), 4);
    let darkest = image.iter().flatten().copied().fold(f32::INFINITY, f32::min);
    assert!(darkest > 0.999, "{darkest}");
    assert_silent(&device);
}

#[test]
fn a_blended_emitter_shines_with_its_opacity() {
    let device = device();
    let mut veil = lambert(0.0, 1.0);
    veil.base_color[3] = 0.5;
    veil.alpha_mode = rasray_scene::AlphaMode::Blend;
    let mut meshes = box_inside(1.0, 0);
    meshes.push(square(DVec3::new(0.0, 0.0, -0.5), DVec3::X * 0.5, DVec3::Y * 0.5, 1));
    let scene = scene(meshes, vec![veil, lambert(0.5, 0.0)], [0.0; 3]);
    let eye = camera(DVec3::ZERO, DVec3::X, DVec3::Y, Projection::Orthographic { half_height: 0.1 });
    let stage = Setup::new(&device, &scene, eye, 16, 16, 8);
    let found = mean(&stage.render(&Path::new(&stage.desc(), 1).expect("valid"), 16));
    // Every direction shows half of the emission; each sample is 0 or the albedo.
    let deviation = 0.25 / 4096.0f64.sqrt();
    assert!((found - 0.25).abs() < 5.0 * deviation, "{found}");
    assert_silent(&device);
}

#[test]
fn ray_casting_lights_from_the_eye() {
    let device = device();
    let wall = square(DVec3::new(0.0, 0.0, -2.0), DVec3::X * 9.0, DVec3::Y * 9.0, 0);
    let scene = scene(vec![wall], vec![lambert(0.5, 0.25)], [0.0; 3]);
    let eye = camera(DVec3::ZERO, DVec3::X, DVec3::Y, Projection::Orthographic { half_height: 1.0 });
    let stage = Setup::new(&device, &scene, eye, 4, 2, 0);
    let image = stage.render(&Raycast::new(&stage.desc()).expect("valid"), 2);
    assert_eq!(image, vec![[0.75; 3]; 8]);
    assert_silent(&device);
}

#[test]
fn pixel_centres_know_distance_normal_and_primitive() {
    let device = device();
    // The left half of the view holds a wall that shows its back, 3 m away; far from the world origin.
    let place = DVec3::new(1e6, -2e6, 3e6);
    let mut wall = square(DVec3::new(-5.0, 0.0, -3.0), DVec3::X * 5.0, -DVec3::Y * 5.0, 0);
    wall.name = "wall".to_owned();
    let mut scene = scene(
        vec![square(DVec3::new(0.0, 0.0, 9.0), DVec3::X, DVec3::Y, 0), wall],
        vec![lambert(0.5, 0.0)],
        [0.0; 3],
    );
    for instance in &mut scene.instances {
        instance.world_from_mesh = glam::DAffine3::from_translation(place);
    }
    let (width, height) = (6, 4);
    let stage = Setup::new(&device, &scene, forward_camera(place), width, height, 9);
    let bands = Bands::new(&device, [width, height]).expect("a small image");
    let aov = AovPass::new(&device, &stage.scene, bands, 10).expect("valid");
    device.submit(|recorder| aov.record_reset(recorder)).expect("the reset runs");
    for wave in bands.waves([0], 10) {
        let submitted = device
            .submit(|recorder| aov.record_wave(recorder, (&stage.structure).into(), wave))
            .expect("the wave runs");
        submitted.value.expect("the wave can be recorded");
    }
    let half_height = 0.5f64.tan();
    for (index, pixel) in aov.read(&device, width * height).expect("readable").iter().enumerate() {
        let (column, row) = (index as u32 % width, index as u32 / width);
        if column >= width / 2 {
            assert_eq!((pixel.distance, pixel.normal, pixel.primitive), (0.0, [0.0; 3], u32::MAX));
            continue;
        }
        let x = (2.0 * (f64::from(column) + 0.5) / f64::from(width) - 1.0) * half_height * 1.5;
        let y = (1.0 - 2.0 * (f64::from(row) + 0.5) / f64::from(height)) * half_height;
        let expected = 3.0 * DVec3::new(x, y, 1.0).length();
        assert!(
            (f64::from(pixel.distance) - expected).abs() < 1e-5 * expected,
            "{index}: {}",
            pixel.distance
        );
        assert_eq!(pixel.normal, [0.0, 0.0, 1.0]);
        assert!(pixel.primitive == 2 || pixel.primitive == 3);
    }
    assert_silent(&device);
}

/// Makes a box with a lamp, glass-like and blended parts, so that every kernel has work.
fn busy_scene() -> Scene {
    let mut glass = lambert(0.9, 0.0);
    glass.transmission = 0.8;
    glass.roughness = 0.0;
    glass.specular = 1.0;
    let mut veil = lambert(0.7, 0.0);
    veil.base_color[3] = 0.4;
    veil.alpha_mode = rasray_scene::AlphaMode::Blend;
    let mut meshes = box_inside(1.0, 0);
    meshes.push(square(DVec3::new(0.0, 0.98, 0.0), DVec3::X * 0.4, DVec3::Z * 0.4, 1));
    meshes.push(square(DVec3::new(-0.4, 0.0, -0.3), DVec3::X * 0.3, DVec3::Y * 0.3, 2));
    meshes.push(square(DVec3::new(0.4, 0.0, -0.3), DVec3::X * 0.3, DVec3::Y * 0.3, 3));
    scene(meshes, vec![lambert(0.6, 0.0), lambert(0.0, 4.0), glass, veil], [0.0; 3])
}

#[test]
fn the_picture_does_not_depend_on_how_the_image_is_cut() {
    let device = device();
    let stage = Setup::new(&device, &busy_scene(), forward_camera(DVec3::new(0.0, 0.0, 0.9)), 12, 9, 17);
    let whole = Path::new(&stage.desc(), 3).expect("valid");
    let reference = stage.render(&whole, 2);
    assert!(mean(&reference) > 0.05);
    let cut = Path::new(&stage.desc_with(17, stage.scene.features()), 3).expect("valid");
    assert_eq!(stage.render(&cut, 2), reference);
    let pieces = AmbientOcclusion::new(&stage.desc_with(5, stage.scene.features()), 0.5).expect("valid");
    let occlusion = AmbientOcclusion::new(&stage.desc(), 0.5).expect("valid");
    assert_eq!(stage.render(&pieces, 2), stage.render(&occlusion, 2));
    assert_silent(&device);
}

#[test]
fn code_that_is_left_out_does_not_change_the_picture() {
    let device = device();
    let mut scene = busy_scene();
    scene.materials[2].transmission = 0.0;
    scene.materials[3].alpha_mode = rasray_scene::AlphaMode::Opaque;
    let stage = Setup::new(&device, &scene, forward_camera(DVec3::new(0.0, 0.0, 0.9)), 12, 9, 2);
    let needed = ShadingFeatures {
        textures: false,
        transmission: false,
        blend: false,
        panes: false,
        texel_runs: false,
        alpha_masks: false,
        lights: false,
        emitters: true,
        environment_map: false,
        colors: false,
        facets: true,
        anisotropy: false,
    };
    assert_eq!(stage.scene.features(), needed);
    let lean = Path::new(&stage.desc_with(108, needed), 2).expect("valid");
    let full = Path::new(&stage.desc_with(108, ShadingFeatures::ALL), 2).expect("valid");
    assert!(lean.traces_per_wave() < full.traces_per_wave());
    let (lean, full) = (stage.render(&lean, 3), stage.render(&full, 3));
    for (a, b) in lean.iter().zip(&full) {
        for channel in 0..3 {
            assert!((a[channel] - b[channel]).abs() <= 1e-5 * b[channel].abs(), "{a:?} {b:?}");
        }
    }
    assert_silent(&device);
}

#[test]
fn facets_that_no_material_has_change_nothing() {
    let device = device();
    let mut scene = busy_scene();
    // The black material has neither a base nor facets; smooth surfaces have no mirror without facets.
    (scene.materials[2], scene.materials[3]) = (lambert(0.0, 0.0), lambert(0.7, 0.0));
    scene.materials[3].roughness = 0.0;
    let stage = Setup::new(&device, &scene, forward_camera(DVec3::new(0.0, 0.0, 0.9)), 24, 18, 5);
    let features = stage.scene.features();
    assert!(!features.facets);
    let with = ShadingFeatures { facets: true, ..features };
    let path = |features| Path::new(&stage.desc_with(108, features), 4).expect("valid");
    let (lean, full) = (path(features), path(with));
    assert_same(&device, &stage.render(&lean, 4), &stage.render(&full, 4), 24, "paths");
    assert!(mean(&stage.render(&lean, 4)) > 0.05);
    let whitted =
        |features| Whitted::new(&stage.desc_with(108, features), WhittedOptions::default()).expect("valid");
    assert_same(
        &device,
        &stage.render(&whitted(features), 2),
        &stage.render(&whitted(with), 2),
        24,
        "whitted",
    );
    assert_silent(&device);
}

#[test]
fn shadow_rays_say_which_light_they_lead_to() {
    let device = device();
    let mut scene = busy_scene();
    scene.materials[2].transmission = 0.0;
    scene.materials[3].alpha_mode = rasray_scene::AlphaMode::Opaque;
    // The last round replaces the shadow rays of paths that continue; facets of rough metal end some in the
    // first.
    (scene.materials[0].metallic, scene.materials[0].roughness) = (1.0, 1.0);
    let places = [DVec3::new(-0.8, 0.5, 0.2), DVec3::new(0.7, -0.6, 0.4)];
    for position in places {
        let intensity = [2.0; 3];
        scene.lights.push(Light::Point { position, intensity, range: f32::INFINITY });
    }
    let stage = Setup::new(&device, &scene, forward_camera(DVec3::new(0.0, 0.0, 0.9)), 48, 36, 2);
    let path = Path::new(&stage.desc(), 1).expect("valid");
    stage.render(&path, 1);
    let queue = path.queues()[1];
    let rays: Vec<Ray> =
        device.download_as(queue.rays(), 0, queue.capacity() as usize).expect("they can be read");
    let emitters: Vec<EmissiveTriangle> = device
        .download_as(&stage.scene.posed_buffers().emissive, 0, stage.scene.emitter_count() as usize)
        .expect("they can be read");
    let (positions, indices) = stage.scene.geometry().download(&device).expect("they can be read");
    let corner = |index: u32| DVec3::from(positions[index as usize].map(f64::from));
    let lamps: Vec<_> = emitters
        .iter()
        .map(|emitter| [0, 1, 2].map(|k| corner(indices[3 * emitter.primitive as usize + k])))
        .collect();
    let mut found = vec![0; places.len() + lamps.len()];
    for ray in rays.iter().filter(|ray| ray.t_max >= 0.0) {
        let end = DVec3::from(ray.origin.map(f64::from))
            + DVec3::from(ray.direction.map(f64::from)) * f64::from(ray.t_max);
        let light = ray.light().expect("nothing shines from afar") as usize;
        if light < places.len() {
            assert!(end.distance(places[light]) < 1e-3, "{light}: {end}");
        } else {
            // The end is on the lamp under the ceiling: no part of the triangle is on the far side of an
            // edge.
            let [a, b, c] = lamps[light - places.len()];
            let normal = (b - a).cross(c - a);
            let areas = [(a, b), (b, c), (c, a)].map(|(p, q)| (q - p).cross(end - p).dot(normal));
            let least = -1e-3 * normal.length_squared();
            assert!(areas.iter().all(|&area| area > least), "{light}: {end}");
            assert!((end.y - 0.98).abs() < 1e-3, "{end}");
        }
        found[light] += 1;
    }
    assert!(found.iter().all(|&count| count > 10), "{found:?}");
    assert_silent(&device);
}

#[test]
fn seeds_and_samples_differ_and_repeat() {
    let device = device();
    let view =
        |seed| Setup::new(&device, &busy_scene(), forward_camera(DVec3::new(0.0, 0.0, 0.9)), 8, 6, seed);
    let image = |stage: &Setup, samples| stage.render(&Path::new(&stage.desc(), 2).expect("valid"), samples);
    let (one, two) = (view(1), view(2));
    assert_eq!(image(&one, 2), image(&one, 2));
    assert_ne!(image(&one, 2), image(&two, 2));
    assert_ne!(image(&one, 1), image(&one, 2));
}

#[test]
fn samples_that_are_not_finite_are_counted_and_left_out() {
    let device = device();
    let mut scene = scene(box_inside(1.0, 0), vec![lambert(0.5, 0.0)], [0.0; 3]);
    scene.materials[0].emission = [f32::INFINITY, 1.0, 1.0];
    let stage = Setup::new(&device, &scene, forward_camera(DVec3::ZERO), 4, 4, 0);
    let image = stage.render(&Path::new(&stage.desc(), 0).expect("valid"), 3);
    assert_eq!(image, vec![[0.0; 3]; 16]);
    assert_eq!(stage.film.read_faults(&device).expect("readable").non_finite, 48);
    assert!(stage.film.read_pixels(&device).expect("readable").iter().all(|pixel| pixel.samples == 0));
    assert_silent(&device);
}

#[test]
fn what_does_not_fit_is_refused_before_anything_is_recorded() {
    let device = device();
    let stage = Setup::new(&device, &Scene::default(), forward_camera(DVec3::ZERO), 4, 4, 0);
    let raycast = Raycast::new(&stage.desc_with(8, ShadingFeatures::ALL)).expect("valid");
    for (first_pixel, pixel_count) in [(0, 9), (0, 0), (12, 8)] {
        let wave = Wave { first_pixel, pixel_count, sample: 0 };
        let recorded =
            device.submit(|recorder| raycast.record_wave(recorder, (&stage.structure).into(), wave));
        assert!(recorded.expect("nothing was recorded").value.is_err());
    }
    let other = Film::new(&device, 5, 4).expect("valid");
    let desc = rasray_integrators::IntegratorDesc::new(&device, &stage.scene, &other);
    assert!(matches!(Raycast::new(&desc), Err(IntegratorError::SizesDiffer { .. })));
    assert!(matches!(Path::new(&stage.desc(), 5000), Err(IntegratorError::Value(_))));
    assert!(matches!(Film::new(&device, 0, 4), Err(IntegratorError::ImageSize { .. })));
    assert_silent(&device);
}

#[test]
fn the_camera_can_move_without_another_upload() {
    let device = device();
    let wall = square(DVec3::new(0.0, 0.0, -2.0), DVec3::X * 9.0, DVec3::Y * 9.0, 0);
    let scene = scene(vec![wall], vec![lambert(0.5, 0.0)], [1.0; 3]);
    let mut stage = Setup::new(&device, &scene, forward_camera(DVec3::ZERO), 4, 4, 0);
    let raycast = Raycast::new(&stage.desc()).expect("valid");
    assert!(stage.render(&raycast, 1).iter().all(|pixel| pixel[0] < 0.6));
    let away =
        camera(DVec3::new(0.0, 0.0, -1.0), -DVec3::X, DVec3::Y, Projection::Perspective { fov_y: 1.0 });
    let view = rasray_gpu_scene::View { camera: away, width: 4, height: 4, seed: 0 };
    stage.scene.update_camera(&view).expect("the frame can be written");
    assert_eq!(stage.render(&raycast, 1), vec![[1.0; 3]; 16]);
    assert_silent(&device);
}
