//! Tests of images in addition to the colours, against the scene itself and against other pictures.

use std::ffi::OsStr;
use std::ops::ControlFlow;

use glam::{DVec2, DVec3};
use rasray_denoise::{Denoiser, NoisyPicture};
use rasray_experiment::{
    Aov, AovImage, AovSelection, Backend, DeviceChoice, Frame, FrameBefore, IntegratorRow, KeptScene,
    OptionValues, Refresh, RenderJob, RenderOutput, Sampler, open,
};
use rasray_scene::{Camera, Moment, Scene};
use rasray_scene_source::{LoadedScene, default_view, load};

use super::{job as comparison, systems};

const SIZE: [u32; 2] = [40, 30];

fn scene(name: &str) -> LoadedScene {
    let mut loaded = load(OsStr::new(name)).expect("a built-in scene");
    loaded.light(None);
    loaded
}

fn frame(loaded: &LoadedScene, bounces: u32) -> Frame {
    let row = IntegratorRow::named("path").expect("registered");
    let options = OptionValues::default().with("bounces", bounces);
    let integrator = rasray_experiment::IntegratorSpec::new(row, &options).expect("values that are taken");
    let [width, height] = SIZE;
    Frame { integrator, width, height, spp: 4, ..comparison(loaded, &["bvh"], &[]).frame }
}

fn job<'a>(loaded: &'a LoadedScene, system: &str, frame: &Frame, aovs: AovSelection) -> RenderJob<'a> {
    RenderJob {
        scene: &loaded.scene,
        moment: loaded.moment.as_ref(),
        camera: default_view(&loaded.scene).camera,
        system: systems(&[system]).remove(0),
        refresh: Refresh::All,
        needs: aovs.needs(&loaded.scene, frame.workload()),
        frame: frame.clone(),
        shard: None,
        aovs,
        before: None,
        repetitions: 0,
    }
}

fn device() -> Box<dyn Backend> {
    open(&DeviceChoice { validation: true, ..DeviceChoice::default() }).expect("a device")
}

fn render(backend: &mut dyn Backend, job: &RenderJob<'_>) -> RenderOutput {
    let output = backend.render(job, &mut KeptScene::default(), &mut |_| ControlFlow::Continue(()));
    let output = output.expect("the device works");
    output.check_images(job.aovs).expect("whole");
    output
}

fn floats(output: &RenderOutput, aov: Aov) -> &[Vec<f32>] {
    match &output.aovs[&aov] {
        AovImage::Floats(channels) => channels,
        AovImage::Whole(_) => panic!("{aov:?} has whole numbers"),
    }
}

fn whole(output: &RenderOutput, aov: Aov) -> &[u32] {
    match &output.aovs[&aov] {
        AovImage::Whole(values) => values,
        AovImage::Floats(_) => panic!("{aov:?} has no whole numbers"),
    }
}

fn point(output: &RenderOutput, aov: Aov, pixel: usize) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| floats(output, aov)[axis][pixel].into()))
}

/// Returns a triangle of a scene by its global id: its instance, its corners in the world and their texture
/// coordinates.
fn triangle(scene: &Scene, id: u32) -> (usize, [DVec3; 3], Option<[DVec2; 3]>) {
    let mut local = id as usize;
    for (place, instance) in scene.instances.iter().enumerate() {
        let mesh = &scene.meshes[instance.mesh];
        if local >= mesh.triangle_count() {
            local -= mesh.triangle_count();
            continue;
        }
        let vertices = [0, 1, 2].map(|corner| mesh.indices[3 * local + corner] as usize);
        let in_world = |vertex: usize| DVec3::from_array(mesh.positions[vertex].map(f64::from));
        let corners = vertices.map(|vertex| instance.world_from_mesh.transform_point3(in_world(vertex)));
        let uvs = mesh.uvs[0].as_ref();
        let uvs = uvs.map(|uvs| vertices.map(|vertex| DVec2::from_array(uvs[vertex].map(f64::from))));
        return (place, corners, uvs);
    }
    panic!("the scene has no triangle {id}")
}

/// Returns the weights of the corners of a triangle at a point of it.
fn weights([a, b, c]: [DVec3; 3], point: DVec3) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let part = |from: DVec3, to: DVec3| (from - point).cross(to - point).dot(normal) / normal.dot(normal);
    [part(b, c), part(c, a), part(a, b)]
}

/// Projects a point by a perspective, pixels from the lower left.
fn projected(camera: &Camera, point: DVec3) -> DVec2 {
    let local = camera.world_from_camera.inverse().transform_point3(point);
    let half = DVec2::from_array(camera.half_extents(SIZE[0], SIZE[1]));
    let across = local.truncate() / (-local.z * half);
    0.5 * (across + 1.0) * DVec2::new(SIZE[0].into(), SIZE[1].into())
}

/// Compares images with the triangles of the scene itself, through trees and through fragments alike.
#[test]
fn what_a_pixel_shows_is_what_the_scene_has_there() {
    let loaded = scene("atrium");
    let aovs = AovSelection::from_iter(Aov::ALL.into_iter().filter(|aov| *aov != Aov::Motion));
    let mut backend = device();
    for system in ["bvh", "hu"] {
        let job = job(&loaded, system, &frame(&loaded, 2), aovs);
        let output = render(&mut *backend, &job);
        let eye = job.camera.world_from_camera.translation;
        let (mut coloured, mut mapped) = (0, 0);
        for pixel in 0..(SIZE[0] * SIZE[1]) as usize {
            let id = whole(&output, Aov::Primitive)[pixel];
            let [material, instance] = [Aov::Material, Aov::Instance].map(|aov| whole(&output, aov)[pixel]);
            let at = point(&output, Aov::Position, pixel);
            if id == u32::MAX {
                assert_eq!((material, instance, at), (u32::MAX, u32::MAX, DVec3::ZERO), "{system}");
                continue;
            }
            let (expected, corners, uvs) = triangle(&loaded.scene, id);
            let own = loaded.scene.meshes[loaded.scene.instances[expected].mesh].material;
            assert_eq!((instance, material), (expected as u32, own as u32), "{system} {id}");
            let distance = f64::from(floats(&output, Aov::Depth)[0][pixel]);
            assert!(((at - eye).length() - distance).abs() < 1.0e-3 * distance, "{system} {id}");
            let weights = weights(corners, at);
            let tolerance = if system == "bvh" { 1.0e-3 } else { 0.1 };
            assert!(weights.iter().all(|weight| *weight > -tolerance), "{system} {id}: {weights:?}");
            let uv = DVec2::from_array([0, 1].map(|axis| floats(&output, Aov::Uv)[axis][pixel].into()));
            let expected = uvs.map_or(DVec2::ZERO, |uvs| (0..3).map(|at| uvs[at] * weights[at]).sum());
            assert!(uv.distance(expected) < 2.0e-3, "{system} {id}: {uv} and {expected}");
            mapped += usize::from(uvs.is_some());
            let material = &loaded.scene.materials[own];
            let albedo = point(&output, Aov::Albedo, pixel);
            assert!(albedo.cmpge(DVec3::ZERO).all() && albedo.cmple(DVec3::ONE).all(), "{albedo}");
            if material.base_color_texture.is_none() && !material.unlit {
                let [red, green, blue, _] = material.base_color.map(f64::from);
                assert!(albedo.distance(DVec3::new(red, green, blue)) < 1.0e-6, "{system} {id}: {albedo}");
                coloured += 1;
            }
        }
        println!("{system}: {mapped} pixels with texture coordinates, {coloured} without a texture");
        assert!(mapped > 500 && coloured > 20, "{system}: {mapped} {coloured}");
    }
}

/// Checks bit for bit that direct light is the picture with one bounce, and indirect light the difference to
/// the picture.
#[test]
fn direct_and_indirect_light_are_the_picture() {
    let mut backend = device();
    let aovs = AovSelection::from_iter([Aov::Direct, Aov::Indirect]);
    for (name, sampler) in [("cornell", Sampler::Sobol), ("still-life", Sampler::Pcg)] {
        let loaded = scene(name);
        let with = |bounces, aovs| {
            let frame = Frame { sampler, ..frame(&loaded, bounces) };
            job(&loaded, "bvh", &frame, aovs)
        };
        let all = render(&mut *backend, &with(5, aovs));
        let plain = render(&mut *backend, &with(5, AovSelection::default()));
        let direct = render(&mut *backend, &with(1, AovSelection::default()));
        let bits =
            |pixels: &[[f32; 3]]| pixels.iter().map(|pixel| pixel.map(f32::to_bits)).collect::<Vec<_>>();
        assert_eq!(bits(&all.beauty), bits(&plain.beauty), "{name}: the picture stays");
        let parts = [Aov::Direct, Aov::Indirect].map(|aov| all.aovs[&aov].triples().expect("three channels"));
        assert_eq!(bits(&parts[0]), bits(&direct.beauty), "{name}");
        let mut scattered = 0.0;
        for (pixel, all) in all.beauty.iter().enumerate() {
            for channel in 0..3 {
                let (direct, indirect) = (parts[0][pixel][channel], parts[1][pixel][channel]);
                let largest = all[channel].abs().max(direct.abs()).max(indirect.abs());
                assert!((direct + indirect - all[channel]).abs() <= f32::EPSILON * largest, "{name} {pixel}");
                assert!(indirect >= -1.0e-5 * largest, "{name} {pixel}: {indirect}");
                scattered += indirect;
            }
        }
        assert!(scattered > 10.0, "{name}: {scattered}");
        let one = render(&mut *backend, &with(1, aovs));
        let none = one.aovs[&Aov::Indirect].triples().expect("three channels");
        assert!(none.iter().flatten().all(|value| *value == 0.0), "{name}: nothing is scattered twice");
    }
}

/// Checks that pictures of other seeds differ as much as the variance says, where samples are independent.
#[test]
fn the_variance_is_that_of_pictures_with_other_random_numbers() {
    let (loaded, mut backend) = (scene("cornell"), device());
    let pictures: Vec<_> = (1..=4)
        .map(|seed| {
            let frame = Frame { sampler: Sampler::Pcg, spp: 16, seed, ..frame(&loaded, 1) };
            render(&mut *backend, &job(&loaded, "bvh", &frame, Aov::Variance.into()))
        })
        .collect();
    // Edges of the lamp are left out: places within a pixel are spread evenly over its samples, and not
    // independent.
    let is_dim = |pixel: usize| pictures.iter().all(|picture| picture.beauty[pixel].iter().all(|x| *x < 1.0));
    let dim: Vec<_> = (0..(SIZE[0] * SIZE[1]) as usize).filter(|pixel| is_dim(*pixel)).collect();
    assert!(dim.len() > 800, "{}", dim.len());
    let (mut measured, mut said) = (0.0, 0.0);
    for (pixel, channel) in dim.iter().flat_map(|pixel| [0, 1, 2].map(|channel| (*pixel, channel))) {
        for (one, other) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            // Half of a squared difference has the variance of one picture.
            let [one, other] = [one, other].map(|number: usize| pictures[number].beauty[pixel][channel]);
            measured += 0.5 * f64::from(one - other).powi(2) / 6.0;
        }
        let all = pictures.iter().map(|picture| f64::from(floats(picture, Aov::Variance)[channel][pixel]));
        said += all.sum::<f64>() / pictures.len() as f64;
    }
    println!("variance of {} pixels: {said} was said, {measured} was measured", dim.len());
    assert!((said / measured - 1.0).abs() < 0.15, "{said} {measured}");
    let frame = Frame { spp: 1, ..frame(&loaded, 1) };
    let single = render(&mut *backend, &job(&loaded, "bvh", &frame, Aov::Variance.into()));
    assert!(floats(&single, Aov::Variance).iter().flatten().all(|value| *value == 0.0));
}

/// Checks that every point's motion leads to the place where the processor poses the point one frame earlier,
/// whatever moves it.
#[test]
fn motion_leads_to_where_points_were_one_frame_before() {
    let mut backend = device();
    let aovs = AovSelection::from_iter([Aov::Motion, Aov::Primitive, Aov::Position]);
    for (name, seconds, step) in [("walker:8k", 0.5, 0.05), ("cloth-ball", 0.6, 0.04)] {
        let mut loaded = load(OsStr::new(name)).expect("a built-in scene");
        loaded.show(seconds, None).expect("it moves");
        loaded.light(None);
        let now = loaded.moment.clone().expect("the device poses it");
        let before = Moment { seconds: seconds - step, ..now.clone() };
        let mut job = job(&loaded, "bvh", &frame(&loaded, 1), aovs);
        let mut camera = job.camera.clone();
        camera.world_from_camera.translation += DVec3::new(0.01, 0.02, 0.0);
        job.before = Some(FrameBefore { moment: before.clone(), camera: camera.clone() });
        let output = render(&mut *backend, &job);
        let [now, before] = [now, before].map(|moment| loaded.scene.at(&moment).expect("posed"));
        let (mut far, mut moved) = (0.0_f64, 0);
        for pixel in 0..(SIZE[0] * SIZE[1]) as usize {
            let id = whole(&output, Aov::Primitive)[pixel];
            if id == u32::MAX {
                continue;
            }
            let weights = weights(triangle(&now, id).1, point(&output, Aov::Position, pixel));
            let corners = triangle(&before, id).1;
            let was = projected(&camera, (0..3).map(|at| corners[at] * weights[at]).sum());
            let (column, row) = (pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]);
            let centre = DVec2::new(f64::from(column) + 0.5, f64::from(SIZE[1] - row) - 0.5);
            let motion =
                DVec2::from_array([0, 1].map(|axis| floats(&output, Aov::Motion)[axis][pixel].into()));
            far = far.max(motion.distance(was - centre));
            let still = projected(&camera, point(&output, Aov::Position, pixel)) - centre;
            moved += usize::from(motion.distance(still) > 0.1);
        }
        println!("{name}: {far} pixels from the processor's at most, {moved} pixels moved by themselves");
        assert!(far < 0.02 && moved > 20, "{name}: {far} {moved}");
    }
}

/// Checks, if the library is installed, that noise is removed and light is kept.
#[test]
fn a_denoised_picture_is_nearer_to_the_converged_one() {
    let denoiser = match Denoiser::find() {
        Ok(denoiser) => denoiser,
        Err(error) => return eprintln!("skipped: {error}"),
    };
    let (loaded, mut backend) = (scene("cornell"), device());
    let aovs = AovSelection::from_iter([Aov::Albedo, Aov::Normal]);
    let mut picture = |spp, seed| {
        let frame = Frame { width: 64, height: 64, spp, seed, ..frame(&loaded, 5) };
        render(&mut *backend, &job(&loaded, "bvh", &frame, aovs))
    };
    let (noisy, converged) = (picture(8, 1), picture(512, 2));
    let [albedo, normal] =
        [Aov::Albedo, Aov::Normal].map(|aov| noisy.aovs[&aov].triples().expect("three channels"));
    let images = NoisyPicture { size: [64, 64], colour: &noisy.beauty, albedo: &albedo, normal: &normal };
    let clean = denoiser.denoise(&images).expect("it works");
    let error = |pixels: &[[f32; 3]]| {
        // The error is relative, so that the lamp does not dominate.
        let pairs = pixels.as_flattened().iter().zip(converged.beauty.as_flattened());
        let squared = pairs.map(|(one, other)| ((one - other) / (other + 0.01)).powi(2)).sum::<f32>();
        (squared / (3 * pixels.len()) as f32).sqrt()
    };
    let (before, after) = (error(&noisy.beauty), error(&clean));
    println!("relative error against 512 samples: {before} of 8 samples, {after} denoised");
    assert!(after < 0.6 * before, "{after} of {before}");
}
