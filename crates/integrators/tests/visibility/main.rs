//! First hits of camera rays found by drawing, against brute force: they must be equal in every bit.

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use crate::pictures::common::{
    assert_silent, box_inside, camera, device, forward_camera, lambert, mean, scene, scenes::textured_room,
    square,
};
use glam::{DAffine3, DVec3};
use rasray_ads::{BruteForce, Counters, Hit, Surface};
use rasray_gpu::{Device, DeviceDesc};
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
use rasray_integrators::{
    AmbientOcclusion, AovPass, Bands, Film, Integrator, IntegratorDesc, IntegratorError, Path, Raycast,
    Traced, Visibility, Wave, Whitted, WhittedOptions,
};
use rasray_scene::{AlphaMode, Camera, Mesh, Projection, Scene, builtin};

/// Makes a device with validation on that can draw. Tests take turns, so that a message belongs to one of
/// them.
pub(crate) fn drawing_device() -> (Device, MutexGuard<'static, ()>) {
    static TURN: Mutex<()> = Mutex::new(());
    static DEVICE: OnceLock<Device> = OnceLock::new();
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let device = DEVICE.get_or_init(|| {
        let requirements = Visibility::requirements();
        let desc = DeviceDesc { validation: true, requirements, ..DeviceDesc::default() };
        let device =
            Device::create(&desc).expect("these tests need a Vulkan device and the validation layer");
        device.keep_pipelines(64);
        device
    });
    (device.clone(), turn)
}

/// Scene as one camera sees it, with both methods to find its first hits.
struct Both {
    device: Device,
    scene: GpuScene,
    structure: BruteForce,
    visibility: Visibility,
}

/// Results on which both methods agreed.
#[derive(Default)]
struct Agreed {
    rays: usize,
    hits: usize,
    /// Number of triangles drawn over all pixels of a wave.
    covering: u32,
    /// Number of triangles tested at pixels.
    tests: u64,
}

impl Both {
    fn new(device: &Device, scene: &Scene, camera: Camera, [width, height]: [u32; 2]) -> Self {
        let view = View { camera, width, height, seed: 3 };
        let origin = SceneTables::default_frame_origin(scene, view.eye());
        let tables = SceneTables::new(scene, origin, &Parts::ALL).expect("the scene is well formed");
        let scene = GpuScene::upload(device, &tables, &view).expect("the scene fits");
        let structure = BruteForce::new(device, scene.geometry(), Some(scene.binding()), false)
            .expect("the structure can be made");
        let visibility = Visibility::new(device, &scene, Counters::Sums).expect("the device draws");
        Self { device: device.clone(), scene, structure, visibility }
    }

    fn traced(&self, draws: bool) -> Traced<'_> {
        Traced::from(&self.structure).with_primary(draws.then_some(&self.visibility))
    }

    /// Returns the hits and surfaces of the camera rays of a wave.
    fn seen(&self, raycast: &Raycast, wave: Wave, draws: bool) -> (Vec<Hit>, Vec<Surface>) {
        let traced = self.traced(draws);
        let submitted = self.device.submit(|recorder| raycast.record_wave(recorder, traced, wave));
        submitted.expect("the wave runs").value.expect("the wave can be recorded");
        let [queue] = raycast.queues()[..] else { panic!("ray casting has one queue") };
        let count = wave.pixel_count as usize;
        let hits = self.device.download_as(queue.hits(), 0, count).expect("readable");
        (hits, self.device.download_as(queue.surfaces(), 0, count).expect("readable"))
    }

    /// Compares hits and surfaces of these samples of all pixels, in waves of at most `capacity`.
    fn compare(&self, name: &str, samples: u32, capacity: u32) -> Agreed {
        let [width, height] = self.scene.image_size();
        let film = Film::new(&self.device, width, height).expect("the film fits");
        let desc = IntegratorDesc {
            wave_capacity: capacity,
            ..IntegratorDesc::new(&self.device, &self.scene, &film)
        };
        let raycast = Raycast::new(&desc).expect("valid");
        self.device
            .submit(|recorder| {
                raycast.record_reset(recorder);
                self.visibility.record_reset(recorder);
            })
            .expect("the reset runs");
        let mut agreed = Agreed::default();
        for wave in film.bands().waves(0..samples, capacity) {
            let (expected, expected_surfaces) = self.seen(&raycast, wave, false);
            let (found, surfaces) = self.seen(&raycast, wave, true);
            for slot in 0..found.len() {
                let (hit, other) = (&found[slot], &expected[slot]);
                let pixel = wave.first_pixel + slot as u32;
                assert_eq!(bits(hit), bits(other), "{name}: pixel {pixel}, {hit:?} and {other:?} traced");
                let (surface, other) = (&surfaces[slot], &expected_surfaces[slot]);
                assert_eq!(
                    (surface.valid, surface.primitive),
                    (other.valid, other.primitive),
                    "{name}: {pixel}"
                );
                assert!(
                    surface.valid == 0 || surface == other,
                    "{name}: pixel {pixel}, {surface:?} {other:?}"
                );
            }
            agreed.rays += found.len();
            agreed.hits += found.iter().filter(|hit| hit.is_hit()).count();
        }
        let counters = raycast.queues()[0].download_counters(&self.device).expect("readable");
        assert_eq!((counters.unfinished, counters.not_ready), (0, 0), "{name}");
        agreed.covering = self.visibility.read_counts(&self.device).expect("readable").covering;
        agreed.tests = counters.tests;
        let Agreed { rays, hits, covering, tests } = agreed;
        println!("{name}: {hits} of {rays} rays hit, {tests} tests, {covering} triangles over all pixels");
        assert_silent(&self.device);
        agreed
    }
}

/// Returns all bits of a hit.
pub(crate) fn bits(hit: &Hit) -> [u32; 4] {
    [hit.t.to_bits(), hit.primitive, hit.a.to_bits(), hit.b.to_bits()]
}

/// Generator of random numbers that are the same on every machine.
pub(crate) struct Random(pub u64);

impl Random {
    /// Returns the next number in [-1, 1).
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / f64::from(1 << 26) / f64::from(1 << 26) - 1.0
    }

    pub fn point(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

/// Makes triangles of one mesh.
pub(crate) fn soup(triangles: &[[DVec3; 3]]) -> Scene {
    let positions: Vec<[f32; 3]> = triangles.iter().flatten().map(|p| p.as_vec3().to_array()).collect();
    let indices = (0..positions.len() as u32).collect();
    let mesh = Mesh { name: "soup".to_owned(), positions, indices, ..Mesh::default() };
    scene(vec![mesh], vec![lambert(0.5, 0.0)], [0.3; 3])
}

pub(crate) fn perspective(eye: DVec3, fov_y: f32) -> Camera {
    camera(eye, DVec3::X, DVec3::Y, Projection::Perspective { fov_y })
}

/// Makes a camera at the origin with a general rotation.
pub(crate) fn turned(projection: Projection) -> Camera {
    let forward = DVec3::new(0.3, -0.2, -0.9).normalize();
    let right = forward.cross(DVec3::new(0.1, 1.0, 0.05)).normalize();
    camera(DVec3::new(0.01, -0.02, 0.03), right, right.cross(forward), projection)
}

#[test]
fn a_room_is_seen_alike_from_every_kind_of_camera() {
    let (device, _turn) = drawing_device();
    let cornell = builtin::builtin("cornell").expect("a built-in scene").expect("no parameters");
    let own = cornell.cameras[0].clone();
    let agreed = Both::new(&device, &cornell, own.clone(), [40, 30]).compare("cornell", 2, 1200);
    assert!(agreed.hits > agreed.rays / 2 && agreed.tests >= agreed.hits as u64);
    let parallel = Camera { projection: Projection::Orthographic { half_height: 0.8 }, ..own.clone() };
    let agreed = Both::new(&device, &cornell, parallel, [30, 40]).compare("cornell, parallel", 2, 1200);
    assert!(agreed.hits > agreed.rays / 8);
    for (size, samples) in [([1, 1], 4), ([1, 33], 1), ([33, 1], 1)] {
        let agreed =
            Both::new(&device, &cornell, own.clone(), size).compare(&format!("{size:?}"), samples, 64);
        assert!(agreed.hits > 0);
    }
}

#[test]
fn waves_smaller_than_the_image_see_the_same() {
    let (device, _turn) = drawing_device();
    let mut random = Random(5);
    let triangles: Vec<[DVec3; 3]> = (0..60)
        .map(|_| {
            let middle = random.point() * 3.0;
            [middle + random.point(), middle + random.point(), middle + random.point()]
        })
        .collect();
    let both =
        Both::new(&device, &soup(&triangles), turned(Projection::Perspective { fov_y: 1.2 }), [24, 17]);
    let whole = both.compare("one wave", 2, 24 * 17);
    for capacity in [1, 23, 24, 37, 100] {
        let cut = both.compare(&format!("waves of {capacity}"), 2, capacity);
        assert_eq!((cut.rays, cut.hits), (whole.rays, whole.hits));
    }
    assert!(whole.hits > whole.rays / 4);
}

#[test]
fn triangles_that_cross_the_plane_of_the_eye_are_seen() {
    let (device, _turn) = drawing_device();
    // A floor whose triangles reach behind the eye, walls beside it, and triangles with one corner or two
    // behind it.
    let floor = |height: f64, half: f64| {
        let corner = |x: f64, z: f64| DVec3::new(x * half, height, z * half);
        [
            [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0)],
            [corner(-1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        ]
    };
    let mut triangles: Vec<[DVec3; 3]> = [floor(-0.5, 3.0), floor(0.7, 100.0)].concat();
    triangles.push([DVec3::new(-0.2, -0.1, 0.5), DVec3::new(-0.3, 0.2, -2.0), DVec3::new(-0.1, -0.4, -2.0)]);
    triangles.push([DVec3::new(0.2, -0.1, -1.5), DVec3::new(0.1, 0.2, 2.0), DVec3::new(0.6, -0.4, 1.0)]);
    // Edges pass the eye closely, between corners far away.
    triangles.push([
        DVec3::new(-9e3, 1e-3, -8e3),
        DVec3::new(9e3, -1e-3, 7.9e3),
        DVec3::new(0.0, -9e3, -10.0),
    ]);
    let scene = soup(&triangles);
    for (name, projection) in [
        ("perspective", Projection::Perspective { fov_y: 1.0 }),
        ("wide", Projection::Perspective { fov_y: 2.8 }),
        ("parallel", Projection::Orthographic { half_height: 2.0 }),
    ] {
        let agreed = Both::new(&device, &scene, turned(projection), [48, 36]).compare(name, 2, 1728);
        assert!(agreed.hits > agreed.rays / 2, "{name}: {} hits", agreed.hits);
        let behind_the_eye = !matches!(projection, Projection::Orthographic { .. });
        assert_eq!(agreed.covering > 0, behind_the_eye, "{name}: {} over all pixels", agreed.covering);
    }
}

#[test]
fn triangles_of_every_size_around_the_camera_are_seen() {
    let (device, _turn) = drawing_device();
    let mut random = Random(11);
    // A closed sphere is around the camera, with triangles from far larger than the view to far smaller than
    // a pixel.
    let mut triangles: Vec<[DVec3; 3]> = Vec::new();
    for _ in 0..250 {
        let middle = random.point().normalize() * 10.0_f64.powf(1.5 * random.next());
        let size = 10.0_f64.powf(2.0 * random.next() - 1.0) * middle.length();
        triangles.push([0, 1, 2].map(|_| middle + random.point() * size));
    }
    let scene = soup(&triangles);
    for (name, projection) in [
        ("perspective", Projection::Perspective { fov_y: 1.0 }),
        ("wide", Projection::Perspective { fov_y: 2.5 }),
        ("telephoto", Projection::Perspective { fov_y: 2e-4 }),
        ("parallel", Projection::Orthographic { half_height: 3.0 }),
        ("parallel, near", Projection::Orthographic { half_height: 1e-3 }),
    ] {
        let agreed = Both::new(&device, &scene, turned(projection), [40, 32]).compare(name, 2, 1280);
        assert!(agreed.hits > 0, "{name}");
    }
}

#[test]
fn a_camera_within_a_mesh_sees_it_from_inside() {
    let (device, _turn) = drawing_device();
    let furnace = builtin::builtin("furnace").expect("a built-in scene").expect("no parameters");
    for eye in [DVec3::ZERO, DVec3::new(0.4, -0.3, 0.2)] {
        let both = Both::new(&device, &furnace, perspective(eye, 1.7), [32, 24]);
        let agreed = both.compare("inside of a sphere", 2, 768);
        assert_eq!(agreed.hits, agreed.rays);
    }
}

#[test]
fn slivers_and_specks_below_a_pixel_are_seen() {
    let (device, _turn) = drawing_device();
    let mut random = Random(23);
    let mut triangles: Vec<[DVec3; 3]> = Vec::new();
    for _ in 0..300 {
        let (from, to) = (random.point(), random.point());
        let across = random.point() * 10.0_f64.powf(random.next() - 2.0);
        let away = DVec3::NEG_Z * 3.0;
        triangles.push([away + from, away + to, away + to + across]);
        let speck = away + random.point();
        triangles.push([0, 1, 2].map(|_| speck + random.point() * 0.03));
    }
    let both = Both::new(&device, &soup(&triangles), perspective(DVec3::ZERO, 0.7), [32, 32]);
    let agreed = both.compare("slivers", 4, 1024);
    assert!(agreed.hits > 300, "{} hits", agreed.hits);
}

#[test]
fn holes_of_masks_are_seen_through() {
    let (device, _turn) = drawing_device();
    let masked = textured_room();
    let mut opaque = masked.clone();
    for material in &mut opaque.materials {
        material.alpha_mode = AlphaMode::Opaque;
    }
    let primitives = |scene: &Scene| {
        let both = Both::new(&device, scene, forward_camera(DVec3::ZERO), [48, 40]);
        both.compare("masks", 2, 1920);
        let bands = Bands::new(&device, [48, 40]).expect("a small image");
        let aov = AovPass::new(&device, &both.scene, bands, 1920).expect("valid");
        let wave = Wave { first_pixel: 0, pixel_count: 1920, sample: 0 };
        device.submit(|recorder| aov.record_reset(recorder)).expect("the reset runs");
        let submitted = device.submit(|recorder| aov.record_wave(recorder, both.traced(true), wave));
        submitted.expect("the wave runs").value.expect("the wave can be recorded");
        let pixels = aov.read(&device, 1920).expect("readable");
        pixels.iter().map(|pixel| pixel.primitive).collect::<Vec<u32>>()
    };
    let (seen, without) = (primitives(&masked), primitives(&opaque));
    let through = seen.iter().zip(&without).filter(|(a, b)| a != b).count();
    assert!(through > 40, "{through} pixels show what is behind a hole");
}

/// The scene has walls without an outside, slivers, and every other triangle of an instance that mirrors its
/// mesh.
#[test]
fn backs_are_passed_alike() {
    let (device, _turn) = drawing_device();
    let mut random = Random(41);
    let triangles: Vec<[DVec3; 3]> = (0..150)
        .map(|number| {
            let middle = DVec3::NEG_Z * 4.0 + random.point() * 1.5;
            let thin = if number % 3 == 0 { 1e-3 } else { 1.0 };
            [middle + random.point(), middle + random.point() * thin, middle + random.point()]
        })
        .collect();
    let (half, other) = triangles.split_at(75);
    let mut culling = soup(half);
    let mirrored = soup(other);
    culling.meshes.extend(mirrored.meshes);
    let mut instance = mirrored.instances[0].clone();
    (instance.mesh, instance.world_from_mesh) = (1, DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0)));
    culling.instances.push(instance);
    let mut two_sided = culling.clone();
    culling.materials[0].culls_back = true;
    let seen = |scene: &Scene, name: &str| {
        let both = Both::new(&device, scene, perspective(DVec3::ZERO, 0.9), [40, 32]);
        both.compare(name, 2, 1280).hits
    };
    let (fewer, all) = (seen(&culling, "single-sided"), seen(&two_sided, "two-sided"));
    assert!(fewer > 200 && fewer < all, "{fewer} of {all} hits are left");
    // The eye is below a floor that reaches behind it, and sees no part of it.
    two_sided.materials[0].culls_back = true;
    two_sided.meshes.truncate(1);
    two_sided.instances.truncate(1);
    let up = DVec3::Y * 0.5;
    let corners = [up - DVec3::X * 9.0, up + DVec3::Z * 9.0, up + DVec3::X * 9.0 - DVec3::Z * 50.0];
    two_sided.meshes[0].positions = corners.map(|corner| corner.as_vec3().to_array()).to_vec();
    two_sided.meshes[0].indices = vec![0, 1, 2];
    assert_eq!(seen(&two_sided, "a floor from below"), 0);
    two_sided.meshes[0].indices = vec![0, 2, 1];
    assert!(seen(&two_sided, "a ceiling") > 0);
}

#[test]
fn pictures_are_the_same_as_with_traced_camera_rays() {
    let (device, _turn) = drawing_device();
    let mut glass = lambert(0.9, 0.0);
    (glass.transmission, glass.roughness) = (0.8, 0.5);
    let mut veil = lambert(0.7, 0.0);
    veil.base_color[3] = 0.4;
    veil.alpha_mode = AlphaMode::Blend;
    let mut meshes = box_inside(1.0, 0);
    meshes.push(square(DVec3::new(0.0, 0.98, 0.0), DVec3::X * 0.4, DVec3::Z * 0.4, 1));
    meshes.push(square(DVec3::new(-0.4, 0.0, -0.3), DVec3::X * 0.3, DVec3::Y * 0.3, 2));
    meshes.push(square(DVec3::new(0.4, 0.0, -0.3), DVec3::X * 0.3, DVec3::Y * 0.3, 3));
    let mut scene = scene(meshes, vec![lambert(0.6, 0.0), lambert(0.0, 4.0), glass, veil], [0.0; 3]);
    // The place is far from the world's origin.
    let place = DVec3::new(1e6, -2e6, 3e6);
    for instance in &mut scene.instances {
        instance.world_from_mesh = DAffine3::from_translation(place);
    }
    let both = Both::new(&device, &scene, forward_camera(place + DVec3::Z * 0.9), [20, 14]);
    let film = Film::new(&device, 20, 14).expect("the film fits");
    let desc = IntegratorDesc { wave_capacity: 111, ..IntegratorDesc::new(&device, &both.scene, &film) };
    let path = Path::new(&desc, 4).expect("valid");
    let occlusion = AmbientOcclusion::new(&desc, 0.5).expect("valid");
    let whitted = Whitted::new(&desc, WhittedOptions { mirror_roughness: 1.0, ..WhittedOptions::default() });
    let whitted = whitted.expect("valid");
    for integrator in [&path as &dyn Integrator, &whitted, &occlusion] {
        let image = |draws: bool| {
            device.submit(|recorder| integrator.record_reset(recorder)).expect("the reset runs");
            for wave in film.bands().waves(0..3, integrator.wave_capacity()) {
                let traced = both.traced(draws);
                let submitted = device.submit(|recorder| integrator.record_wave(recorder, traced, wave));
                submitted.expect("the wave runs").value.expect("the wave can be recorded");
            }
            film.read(&device).expect("readable")
        };
        let (drawn, traced) = (image(true), image(false));
        assert!(mean(&traced) > 0.05);
        assert_eq!(drawn, traced, "{}", integrator.name());
    }
    assert_silent(&device);
}

#[test]
fn a_scene_without_triangles_is_a_miss_everywhere() {
    let (device, _turn) = drawing_device();
    let both = Both::new(&device, &Scene::default(), forward_camera(DVec3::ZERO), [9, 7]);
    assert_eq!(both.compare("empty", 1, 63).hits, 0);
}

#[test]
fn devices_that_cannot_draw_are_refused() {
    let (draws, _turn) = drawing_device();
    let device = device();
    let view = View { camera: forward_camera(DVec3::ZERO), width: 4, height: 4, seed: 1 };
    let tables = SceneTables::new(&Scene::default(), DVec3::ZERO, &Parts::ALL).expect("well formed");
    let scene = GpuScene::upload(&device, &tables, &view).expect("it fits");
    // The device was made without the feature.
    let refused = Visibility::new(&device, &scene, false).expect_err("stores of fragments are missing");
    assert!(matches!(refused, IntegratorError::CannotDraw { .. }), "{refused:?}");
    assert!(refused.to_string().contains("fragmentStoresAndAtomics"), "{refused}");
    let wide = View { width: draws.limits().max_framebuffer_size[0] + 1, height: 1, ..view };
    let scene = GpuScene::upload(&draws, &tables, &wide).expect("it fits");
    let refused = Visibility::new(&draws, &scene, false).expect_err("the image is too wide");
    assert!(matches!(refused, IntegratorError::CannotDraw { .. }), "{refused:?}");
    assert_silent(&device);
    assert_silent(&draws);
}
