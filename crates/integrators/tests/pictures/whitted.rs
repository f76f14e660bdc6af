//! Whitted's integrator against closed forms, and the rays that it traces.

use glam::{DMat3, DVec3};
use rasray_ads::BruteForce;
use rasray_gpu::Timing;
use rasray_integrators::{
    Integrator, IntegratorRow, IntegratorSpec, RAY_DEPTH_LIMIT, Select, Wave, Whitted, WhittedOptions,
};
use rasray_scene::{Camera, Environment, Light, Material, Mesh, Projection, Scene};

use crate::pictures::common::{difference::difference, *};

fn whitted() -> IntegratorSpec {
    IntegratorRow::named("whitted").expect("it is registered").into()
}

pub(super) fn mirror(tint: f32) -> Material {
    Material { metallic: 1.0, roughness: 0.0, specular: 1.0, ..lambert(tint, 0.0) }
}

/// Makes glass that is clear and thick, with an index of 1.5: perpendicular light is reflected with a share
/// of 0.04.
pub(super) fn glass() -> Material {
    Material {
        transmission: 1.0,
        roughness: 0.0,
        specular: 1.0,
        thickness: 1.0,
        ior: 1.5,
        ..lambert(1.0, 0.0)
    }
}

/// Makes a plate between two planes across z, its front towards +z.
fn plate(front: f64, back: f64, half: f64, material: usize) -> [Mesh; 2] {
    [
        square(DVec3::Z * front, DVec3::X * half, DVec3::Y * half, material),
        square(DVec3::Z * back, -DVec3::X * half, DVec3::Y * half, material),
    ]
}

/// Returns the share of light that is reflected by Schlick's curve, which the device uses: at the boundary of
/// an index of 1.5, by the cosine in air.
pub(super) fn reflected(cosine: f64) -> f64 {
    0.04 + 0.96 * (1.0 - cosine).powi(5)
}

fn render(stage: &Setup, options: WhittedOptions) -> Vec<[f32; 3]> {
    let image = stage.render(&Whitted::new(&stage.desc(), options).expect("valid"), 1);
    let faults = stage.film.read_faults(&stage.device).expect("readable");
    assert_eq!((faults.non_finite, faults.unended, faults.cut), (0, 0, 0));
    image
}

fn depth(ray_depth: u32) -> WhittedOptions {
    WhittedOptions { ray_depth, ..WhittedOptions::default() }
}

fn all() -> WhittedOptions {
    WhittedOptions { select: Select::All, ..WhittedOptions::default() }
}

#[test]
fn a_plane_mirror_shows_the_mirror_image() {
    let device = device();
    let (tint, glow, sky) = (0.75_f32, 3.0_f32, [0.25_f32, 0.5, 1.0]);
    // The lamp is behind the eye: its image is as far behind the mirror as the lamp is in front.
    let (mirror_z, lamp) = (-2.0, square(DVec3::new(0.3, -0.2, 1.0), DVec3::X * 0.9, DVec3::Y * 0.6, 1));
    let image_of_lamp = DVec3::new(0.3, -0.2, 2.0 * mirror_z - 1.0);
    let wall = square(DVec3::Z * mirror_z, DVec3::X * 4.0, DVec3::Y * 4.0, 0);
    let scene = scene(vec![wall, lamp], vec![mirror(tint), lambert(0.0, glow)], sky);
    let (width, height) = (48, 36);
    let stage = Setup::new(&device, &scene, forward_camera(DVec3::ZERO), width, height, 7);
    let image = render(&stage, depth(1));
    // The reflectance of the metal grows towards grazing angles.
    let schlick = |cosine: f64| f64::from(tint) + (1.0 - f64::from(tint)) * (1.0 - cosine).powi(5);
    let half_height = 0.5f64.tan();
    let mut seen = [0; 2];
    for (index, pixel) in image.iter().enumerate() {
        let (column, row) = (index as u32 % width, index as u32 / width);
        let towards = |x: f64, y: f64| {
            DVec3::new(
                (2.0 * (f64::from(column) + x) / f64::from(width) - 1.0) * half_height * 4.0 / 3.0,
                (1.0 - 2.0 * (f64::from(row) + y) / f64::from(height)) * half_height,
                -1.0,
            )
        };
        let is_lamp = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(x, y)| {
            let off = towards(x, y) * -image_of_lamp.z - image_of_lamp;
            off.x.abs() < 0.9 && off.y.abs() < 0.6
        });
        if is_lamp.iter().any(|&corner| corner != is_lamp[0]) {
            continue;
        }
        let share = schlick(1.0 / towards(0.5, 0.5).length());
        for channel in 0..3 {
            let light = if is_lamp[0] { glow } else { sky[channel] };
            let expected = share * f64::from(light);
            let off = (f64::from(pixel[channel]) - expected).abs();
            assert!(off < 2e-3 * expected, "{column}, {row}: {pixel:?}, expected {expected}");
        }
        seen[usize::from(is_lamp[0])] += 1;
    }
    assert!(seen.iter().all(|&count| count > 50), "{seen:?}");
    assert_silent(&device);
}

#[test]
fn a_plate_of_glass_moves_what_is_behind_it_and_reflects_at_both_faces() {
    let device = device();
    let (thickness, glow, size) = (0.8, 2.0_f32, 64);
    let mut meshes = Vec::from(plate(0.0, -thickness, 20.0, 0));
    // A glowing wall stands behind the plate, to the right of x = 0.
    meshes.push(square(DVec3::new(30.0, 0.0, -3.0), DVec3::X * 30.0, DVec3::Y * 30.0, 1));
    let scene = scene(meshes, vec![glass(), lambert(0.0, glow)], [0.0; 3]);
    for angle in [0.0_f64, 0.5, 0.9] {
        // The eye looks along the angle at the edge of the wall.
        let along = DVec3::new(angle.sin(), 0.0, -angle.cos());
        let right = DVec3::new(angle.cos(), 0.0, angle.sin());
        let eye = DVec3::new(0.0, 0.0, -3.0) - 8.0 * along;
        let projection = Projection::Orthographic { half_height: 1.0 };
        let stage = Setup::new(&device, &scene, camera(eye, right, DVec3::Y, projection), size, size, 1);
        let image = render(&stage, depth(2));
        let inside = (angle.sin() / 1.5).asin();
        // A ray leaves the plate shifted across itself, to the left of its place without the plate.
        let shift = thickness * (angle - inside).sin() / inside.cos();
        let passed = (1.0 - reflected(angle.cos())).powi(2) * f64::from(glow);
        for (index, pixel) in image.iter().enumerate() {
            let left = 2.0 * f64::from(index as u32 % size) / f64::from(size) - 1.0;
            let pixel_width = 2.0 / f64::from(size);
            if left < shift && shift < left + pixel_width {
                continue;
            }
            let expected = if left >= shift { passed } else { 0.0 };
            let off = (f64::from(pixel[0]) - expected).abs();
            assert!(off < 1e-4 * passed, "{angle}, {left}: {pixel:?}, expected {expected}");
        }
    }
    assert_silent(&device);
}

/// Under an even sky a plate shows its reflection, and the light that comes through after none, two, four...
/// reflections inside.
#[test]
fn a_plate_of_glass_in_a_white_furnace_gives_the_geometric_series() {
    let device = device();
    let scene = scene(Vec::from(plate(0.0, -0.5, 50.0, 0)), vec![glass()], [1.0; 3]);
    let projection = Projection::Orthographic { half_height: 0.5 };
    let eye = camera(DVec3::Z * 2.0, DVec3::X, DVec3::Y, projection);
    let stage = Setup::new(&device, &scene, eye, 4, 4, 1);
    let share = reflected(1.0);
    for ray_depth in 0..=8 {
        let series: f64 = (0..i32::try_from(ray_depth).expect("few") - 1).map(|k| share.powi(k)).sum();
        let expected = if ray_depth == 0 { 0.0 } else { share + (1.0 - share).powi(2) * series };
        for pixel in render(&stage, depth(ray_depth)) {
            assert!((f64::from(pixel[0]) - expected).abs() < 1e-5, "{ray_depth}: {pixel:?}, {expected}");
        }
    }
    assert_silent(&device);
}

pub(super) fn ball(centre: DVec3, radius: f64, material: usize) -> Mesh {
    let (columns, rows) = (24_u32, 12_u32);
    let mut mesh = Mesh { name: "ball".to_owned(), material, ..Mesh::default() };
    let mut normals = Vec::new();
    for row in 0..=rows {
        for column in 0..columns {
            let polar = std::f64::consts::PI * f64::from(row) / f64::from(rows);
            let azimuth = std::f64::consts::TAU * f64::from(column) / f64::from(columns);
            let out = DVec3::new(polar.sin() * azimuth.cos(), polar.cos(), -polar.sin() * azimuth.sin());
            mesh.positions.push((centre + radius * out).as_vec3().to_array());
            normals.push(out.as_vec3().to_array());
        }
    }
    mesh.normals = Some(normals);
    for row in 0..rows {
        for column in 0..columns {
            let at = |row: u32, column: u32| row * columns + column % columns;
            let [a, b] = [at(row, column), at(row, column + 1)];
            let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
            mesh.indices.extend([a, c, d, a, d, b]);
        }
    }
    mesh
}

/// Makes a ball of tinted glass before a wall, a mirror at the side, a lamp, and an even sky.
fn glass_ball() -> (Scene, Camera) {
    let tinted = Material { attenuation_color: [0.6, 0.9, 0.7], attenuation_distance: 0.5, ..glass() };
    let mut meshes = vec![
        ball(DVec3::new(-0.1, 0.0, -0.4), 0.5, 0),
        square(DVec3::Z * -1.2, DVec3::X * 1.5, DVec3::Y * 1.5, 1),
        square(DVec3::new(1.0, 0.0, 0.0), DVec3::Z, DVec3::Y, 2),
        square(DVec3::new(0.0, -0.7, 0.0), DVec3::X * 1.5, -DVec3::Z * 1.5, 1),
    ];
    meshes.push(square(DVec3::new(0.0, 1.2, 0.0), DVec3::X * 0.3, DVec3::Z * 0.3, 3));
    let materials = vec![tinted, lambert(0.6, 0.0), mirror(0.9), lambert(0.0, 5.0)];
    let mut scene = scene(meshes, materials, [0.3, 0.4, 0.5]);
    scene.name = "a ball of glass".to_owned();
    scene.lights.push(Light::Point {
        position: DVec3::new(-0.9, 0.9, 0.8),
        intensity: [0.8; 3],
        range: f32::INFINITY,
    });
    (scene, forward_camera(DVec3::new(0.0, 0.0, 1.4)))
}

#[test]
fn a_ball_of_glass_is_that_of_the_naive_integrator() {
    let (scene, camera) = glass_ball();
    for ray_depth in [1, 3, 8] {
        let spec = whitted().with("ray-depth", ray_depth).expect("valid");
        let found = difference(&scene, &scene, &camera, 4, &spec);
        eprintln!("{ray_depth}: {found:?}");
        // Where the ball's facets meet, a ray may be refracted by one or by the next.
        found.assert_within(0.02, 0.01, ray_depth);
    }
}

/// Makes, from the left, a mirror, a wall and glass that reflects nothing, all before a wall in the light of
/// a lamp, in a room.
fn three_parts() -> (Scene, Camera) {
    let dull_glass = Material { specular: 0.0, ..glass() };
    let third =
        |place: f64, material| square(DVec3::new(place, 0.0, -1.0), DVec3::X / 3.0, DVec3::Y * 0.9, material);
    let mut meshes = box_inside(2.0, 1);
    meshes.extend([third(-2.0 / 3.0, 0), third(0.0, 1), third(2.0 / 3.0, 2)]);
    meshes.push(square(DVec3::new(0.0, 1.9, 0.5), DVec3::X * 0.5, DVec3::Z * 0.5, 3));
    let materials = vec![mirror(0.9), lambert(0.6, 0.0), dull_glass, lambert(0.0, 6.0)];
    let eye = camera(DVec3::Z, DVec3::X, DVec3::Y, Projection::Orthographic { half_height: 0.9 });
    let mut scene = scene(meshes, materials, [0.0; 3]);
    scene.name = "a mirror, a wall and glass".to_owned();
    (scene, eye)
}

#[test]
fn selections_give_the_picture_of_all_rays_where_they_say_so() {
    let device = device();
    let (scene, eye) = three_parts();
    let (width, height) = (30, 27);
    let stage = Setup::new(&device, &scene, eye, width, height, 5);
    let image = render(&stage, all());
    let bits = |image: &[[f32; 3]]| image.iter().map(|pixel| pixel.map(f32::to_bits)).collect::<Vec<_>>();
    for options in [
        WhittedOptions::default(),
        WhittedOptions { masked: true, ..all() },
        WhittedOptions { masked: true, ..WhittedOptions::default() },
    ] {
        assert!(bits(&render(&stage, options)) == bits(&image), "{options:?}");
    }
    let select = |select| render(&stage, WhittedOptions { select, ..WhittedOptions::default() });
    let reflective = select(Select::Reflective);
    let direct = render(&stage, depth(0));
    let mut left_out = 0;
    for (index, pixel) in reflective.iter().enumerate() {
        // The wall has no rays to lose; the light through the glass is left out.
        let is_glass = index as u32 % width >= 2 * width / 3;
        let expected = if is_glass { &direct } else { &image };
        assert_eq!(pixel.map(f32::to_bits), expected[index].map(f32::to_bits), "{index}");
        left_out += u32::from(image[index] != *pixel);
    }
    assert!(left_out > width, "all rays show what is behind the glass: {left_out}");
    // Specular selects every ray that carries light, and leaves the walls without shadows.
    let specular = select(Select::Specular);
    let unshadowed = WhittedOptions { shadows: rasray_integrators::Shadows::None, ..all() };
    assert!(bits(&specular) == bits(&render(&stage, unshadowed)), "perfect surfaces have no other light");
    assert!(bits(&specular) != bits(&image), "there are shadows");
    assert_silent(&device);
}

/// Replaces the structure by one that counts its tests.
fn counting(stage: Setup) -> Setup {
    let structure = BruteForce::new(&stage.device, stage.scene.geometry(), Some(stage.scene.binding()), true)
        .expect("the structure can be made");
    Setup { structure, ..stage }
}

/// Returns the nearest-hit rays of one sample of a picture, and the picture. Brute force tests every triangle
/// for each ray.
fn rays(stage: &Setup, triangles: u64, options: WhittedOptions) -> (u64, Vec<[f32; 3]>) {
    let integrator = Whitted::new(&stage.desc(), options).expect("valid");
    let image = stage.render(&integrator, 1);
    let queue = integrator.queues()[0];
    let tests = queue.download_counters(&stage.device).expect("the header can be read").tests;
    assert_eq!(tests % triangles, 0);
    (tests / triangles, image)
}

/// A mirror covers some of eight columns of the view, a wall the others. Full tracing sends a ray on from
/// every pixel; a selection only from those of the mirror.
#[test]
fn rays_are_as_many_as_pixels_and_pixels_of_mirrors() {
    let device = device();
    let (columns, size) = (8_u32, 16);
    for covered in [0_u32, 2, 5, 8] {
        let mut meshes = vec![square(DVec3::Z * -2.0, DVec3::X * 2.0, DVec3::Y * 2.0, 0)];
        if covered > 0 {
            let share = f64::from(covered) / f64::from(columns);
            meshes.push(square(DVec3::new(share - 1.0, 0.0, -1.0), DVec3::X * share, DVec3::Y * 1.5, 1));
        }
        let triangles = 2 * meshes.len() as u64;
        let scene = scene(meshes, vec![lambert(0.5, 0.0), mirror(0.9)], [1.0; 3]);
        let eye = camera(DVec3::ZERO, DVec3::X, DVec3::Y, Projection::Orthographic { half_height: 1.0 });
        let stage = counting(Setup::new(&device, &scene, eye, size, size, 2));
        let rays = |options| rays(&stage, triangles, options).0;
        let pixels = u64::from(size * size);
        let reflecting = pixels * u64::from(covered) / u64::from(columns);
        for select in [Select::Expected, Select::Reflective, Select::Specular] {
            let options = WhittedOptions { select, ..WhittedOptions::default() };
            assert_eq!(rays(options), pixels + reflecting, "{covered} {select:?}");
        }
        assert_eq!(rays(all()), 2 * pixels, "{covered}");
        let masked = WhittedOptions { masked: true, ..WhittedOptions::default() };
        assert_eq!(rays(masked), pixels + reflecting, "{covered}: slots without rays");
    }
    assert_silent(&device);
}

/// Makes a room of dull mirrors with a lamp and a post: every object is reflected again and again, ever
/// darker.
fn hall_of_mirrors() -> (Scene, Camera) {
    let mut meshes = box_inside(1.0, 0);
    meshes.push(square(DVec3::new(0.0, 0.95, 0.0), DVec3::X * 0.4, DVec3::Z * 0.4, 1));
    meshes.push(square(DVec3::new(0.3, -0.3, -0.3), DVec3::X * 0.2, DVec3::Y * 0.7, 2));
    let mut scene = scene(meshes, vec![mirror(0.6), lambert(0.0, 4.0), lambert(0.7, 0.0)], [0.0; 3]);
    scene.name = "a hall of mirrors".to_owned();
    (scene, forward_camera(DVec3::new(-0.1, 0.1, 0.9)))
}

/// The test prints the tables of `docs/whitted.md`.
#[test]
fn a_threshold_trades_rays_for_error() {
    let device = device();
    for (scene, eye) in [glass_ball(), hall_of_mirrors()] {
        let triangles = scene.instances.iter().map(|i| scene.meshes[i.mesh].indices.len() as u64 / 3).sum();
        let stage = counting(Setup::new(&device, &scene, eye, 64, 48, 3));
        let deep = WhittedOptions { ray_depth: 8, ..WhittedOptions::default() };
        let (all, expected) = rays(&stage, triangles, WhittedOptions { select: Select::All, ..deep });
        let light = expected.iter().flatten().map(|&light| f64::from(light)).sum::<f64>();
        println!("{}, {all} rays with select=all", scene.name);
        let (mut last_count, mut last_error) = (u64::MAX, 0.0);
        for threshold in [0.0, 0.001, 0.01, 0.03, 0.1, 0.3, 1.0] {
            let (count, image) = rays(&stage, triangles, WhittedOptions { threshold, ..deep });
            let off = |(a, b): (&f32, &f32)| f64::from(a - b).abs();
            let error =
                image.as_flattened().iter().zip(expected.as_flattened()).map(off).sum::<f64>() / light;
            println!("| {threshold} | {:.1} % | {:.3} % |", 100.0 * count as f64 / all as f64, 100.0 * error);
            assert!(count <= last_count && error >= last_error, "{threshold}: {count}, {error}");
            assert!(threshold > 0.0 || error == 0.0, "{error}");
            (last_count, last_error) = (count, error);
        }
        assert!(last_error > 0.1, "the largest threshold leaves out what is seen: {last_error}");
    }
    assert_silent(&device);
}

#[test]
fn the_rest_of_a_tree_is_counted_until_it_is_rendered() {
    let device = device();
    let (scene, eye) = glass_ball();
    let stage = Setup::new(&device, &scene, eye, 12, 9, 4);
    let wave = Wave { first_pixel: 0, pixel_count: 12 * 9, sample: 0 };
    let traced = (&stage.structure).into();
    for masked in [false, true] {
        let options = WhittedOptions { masked, ..depth(8) };
        let parts = Whitted::new(&stage.desc(), options).expect("valid");
        device.submit(|recorder| parts.record_reset(recorder)).expect("the reset runs");
        let submitted = device.submit(|recorder| parts.record_wave(recorder, traced, wave)).expect("it runs");
        submitted.value.expect("the wave can be recorded");
        let unended = stage.film.read_faults(&device).expect("readable").unended;
        assert!(unended > 0 && unended < wave.pixel_count, "{unended}");
        let pixels = stage.film.read_pixels(&device).expect("readable");
        let added: u32 = pixels.iter().map(|pixel| pixel.samples).sum();
        assert_eq!(added + unended, wave.pixel_count, "nothing is added that is not whole");
        while parts.has_rest(&device).expect("readable") {
            let rest = device.submit(|recorder| parts.record_rest(recorder, traced, wave)).expect("it runs");
            rest.value.expect("the rest can be recorded");
        }
        let continued = stage.film.read_pixels(&device).expect("readable");
        assert!(continued.iter().all(|pixel| pixel.samples == 1));

        let whole = Whitted::new(&stage.desc(), options).expect("valid");
        while whole.allow_more_rounds() {}
        assert_eq!(
            whole.traces_per_wave(),
            2 * 511,
            "one closest hit and one occlusion for each ray of a tree"
        );
        device.submit(|recorder| whole.record_reset(recorder)).expect("the reset runs");
        whole.render_wave(&device, Timing::None, traced, wave).expect("it runs");
        assert_eq!(stage.film.read_pixels(&device).expect("readable"), continued);
    }
    assert_silent(&device);
}

/// The scenes are turned and have a sky with texels and more mirrors; the naive integrator is the reference.
#[test]
fn mirrors_of_any_direction_under_a_sky_of_texels() {
    let (mut scene, camera) = glass_ball();
    let turn = DMat3::from_axis_angle(DVec3::new(0.3, 1.0, -0.2).normalize(), 0.4);
    for instance in &mut scene.instances {
        instance.world_from_mesh.matrix3 = turn * instance.world_from_mesh.matrix3;
    }
    scene.materials[1] = Material { roughness: 0.01, specular: 1.0, ..lambert(0.6, 0.0) };
    let radiance = (0..16 * 8).map(|i| [0.1 + (i % 5) as f32 * 0.2, 0.3, 0.2 + (i / 16) as f32 * 0.1]);
    scene.environment = Environment::LatLong { width: 16, height: 8, radiance: radiance.collect() };
    let found = difference(&scene, &scene, &camera, 4, &whitted());
    eprintln!("{found:?}");
    found.assert_within(0.02, 0.01, "a scene with a sky");
}

#[test]
fn point_lights_light_rough_surfaces_as_they_do_in_paths() {
    let device = device();
    let rough = Material { metallic: 0.3, roughness: 0.5, specular: 1.0, ..lambert(0.7, 0.0) };
    let mut scene = scene(box_inside(1.0, 0), vec![rough], [0.0; 3]);
    for position in [DVec3::new(0.2, 0.7, 0.1), DVec3::new(-0.6, -0.3, 0.5)] {
        scene.lights.push(Light::Point { position, intensity: [0.8, 0.6, 0.4], range: f32::INFINITY });
    }
    let stage = Setup::new(&device, &scene, forward_camera(DVec3::new(0.1, 0.0, 0.8)), 16, 12, 9);
    let image = render(&stage, WhittedOptions::default());
    let expected = stage.render(&rasray_integrators::Path::new(&stage.desc(), 1).expect("valid"), 1);
    assert!(mean(&image) > 0.01);
    assert_same(&device, &image, &expected, 16, "direct light");
    assert_silent(&device);
}

#[test]
fn options_out_of_their_ranges_are_refused() {
    let device = device();
    let stage = Setup::new(&device, &Scene::default(), forward_camera(DVec3::ZERO), 2, 2, 0);
    let plain = WhittedOptions::default();
    for (options, named) in [
        (depth(RAY_DEPTH_LIMIT + 1), "ray-depth 9"),
        (WhittedOptions { threshold: -0.5, ..plain }, "threshold -0.5"),
        (WhittedOptions { threshold: 0.5, ..all() }, "select expected alone"),
        (WhittedOptions { mirror_roughness: f32::NAN, ..plain }, "mirror-roughness NaN"),
    ] {
        let error = Whitted::new(&stage.desc(), options).expect_err("refused");
        assert!(error.to_string().contains(named), "{error}");
    }
    assert!(Whitted::new(&stage.desc(), depth(RAY_DEPTH_LIMIT)).is_ok());
    assert_silent(&device);
}
