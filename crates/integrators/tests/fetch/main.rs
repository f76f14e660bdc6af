//! Surfaces fetched by drawing, against those of the structure: they must be equal in every bit, in every
//! round of a path.

use crate::kept_pictures::Compared;
use crate::pictures::common::{
    assert_same, assert_silent, box_inside, device, forward_camera, lambert, scene,
    scenes::{glass_room, textured_room, veiled_room},
};
use crate::visibility::{Random, bits, drawing_device, perspective, soup, turned};
use glam::DVec3;
use rasray_ads::{BruteForce, Hit, Surface};
use rasray_gpu::Device;
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
use rasray_integrators::{
    FetchCounts, Fetching, Film, Integrator, IntegratorDesc, IntegratorError, Path, PathOptions, Traced,
};
use rasray_scene::{Camera, Projection, Scene, builtin};
use rasray_shaders_glsl::constants::integrators::FETCH_PART;

/// Scene as one camera sees it.
struct Stage {
    device: Device,
    scene: GpuScene,
    structure: BruteForce,
}

/// Results of a render.
struct Rendered {
    /// Hits and surfaces of each wave after its last round.
    waves: Vec<(Vec<Hit>, Vec<Surface>)>,
    image: Vec<[f32; 3]>,
    counts: Option<FetchCounts>,
    bytes: u64,
}

impl Stage {
    fn new(device: &Device, scene: &Scene, camera: Camera, [width, height]: [u32; 2]) -> Self {
        let view = View { camera, width, height, seed: 5 };
        let origin = SceneTables::default_frame_origin(scene, view.eye());
        let tables = SceneTables::new(scene, origin, &Parts::ALL).expect("the scene is well formed");
        let scene = GpuScene::upload(device, &tables, &view).expect("the scene fits");
        let structure = BruteForce::new(device, scene.geometry(), Some(scene.binding()), false)
            .expect("the structure can be made");
        Self { device: device.clone(), scene, structure }
    }

    fn render(&self, bounces: u32, capacity: u32, fetch: Fetching, surfaces_of_hits: bool) -> Rendered {
        let [width, height] = self.scene.image_size();
        let film = Film::new(&self.device, width, height).expect("the film fits");
        let desc = IntegratorDesc {
            wave_capacity: capacity,
            surfaces_of_hits,
            ..IntegratorDesc::new(&self.device, &self.scene, &film)
        };
        let path = Path::new(&desc, PathOptions { fetch, ..PathOptions::from(bounces) }).expect("valid");
        self.device.submit(|recorder| path.record_reset(recorder)).expect("the reset runs");
        let queue = path.queues()[0];
        let mut seen = Vec::new();
        for wave in film.bands().waves([0], capacity) {
            let traced = Traced::from(&self.structure);
            path.render_wave(&self.device, rasray_gpu::Timing::None, traced, wave).expect("the wave runs");
            let count = wave.pixel_count as usize;
            let hits = self.device.download_as(queue.hits(), 0, count).expect("readable");
            seen.push((hits, self.device.download_as(queue.surfaces(), 0, count).expect("readable")));
        }
        for queue in path.queues() {
            let counters = queue.download_counters(&self.device).expect("readable");
            assert_eq!((counters.unfinished, counters.not_ready), (0, 0), "surfaces are missing");
        }
        let counts = path.fetch().map(|fetch| fetch.read_counts(&self.device).expect("readable"));
        let bytes = path.fetch().map_or(0, |fetch| fetch.bytes());
        Rendered { waves: seen, image: film.read(&self.device).expect("readable"), counts, bytes }
    }

    /// Compares the hits and surfaces that both methods leave after each number of bounces, and the images.
    fn compare(&self, name: &str, capacity: u32) -> FetchCounts {
        let mut all = FetchCounts::default();
        let triangles = self.scene.geometry().triangle_count();
        for bounces in [0, 1, 3] {
            let direct = self.render(bounces, capacity, Fetching::Direct, false);
            let drawn = self.render(bounces, capacity, Fetching::Raster, false);
            // Surfaces that the shading kernel looks up are not stored.
            let of_hits = self.render(bounces, capacity, Fetching::Direct, true);
            assert!(
                of_hits.waves.iter().all(|(_, surfaces)| surfaces.iter().all(|surface| surface.valid == 0))
            );
            let [width, _] = self.scene.image_size();
            let why = format!("{name}, {bounces} bounces: surfaces of hits");
            assert_same(&self.device, &of_hits.image, &direct.image, width, why);
            assert_eq!((direct.counts, direct.bytes), (None, 0));
            assert_eq!(drawn.bytes, formula_bytes(capacity, triangles), "{name}");
            for ((hits, surfaces), (other_hits, others)) in drawn.waves.iter().zip(&direct.waves) {
                for slot in 0..hits.len() {
                    let (hit, other) = (&hits[slot], &other_hits[slot]);
                    assert_eq!(bits(hit), bits(other), "{name}, {bounces} bounces: slot {slot}");
                    let (surface, other) = (&surfaces[slot], &others[slot]);
                    assert_eq!(surface.valid, other.valid, "{name}, {bounces} bounces: slot {slot}");
                    assert!(
                        surface.valid == 0 || bytemuck::bytes_of(surface) == bytemuck::bytes_of(other),
                        "{name}, {bounces} bounces: slot {slot}, {surface:?} {other:?}"
                    );
                }
            }
            let compared = Compared { picture: &drawn.image, reference: &direct.image, width };
            compared.assert_bits(format_args!("{name}, {bounces} bounces"));
            all = drawn.counts.expect("it was drawn");
            let FetchCounts { hits, triangles: fetched, pixels, longest } = all;
            println!(
                "{name}, {triangles} triangles, {bounces} bounces: {hits} hits on {fetched} triangles in {pixels} pixels, \
                 lists of up to {longest}; {} bytes for {capacity} rays",
                drawn.bytes
            );
        }
        assert!(all.hits >= all.pixels && all.hits >= all.triangles, "{name}: {all:?}");
        assert_silent(&self.device);
        all
    }
}

/// Formula of the page: docs/systems/dirt.md, "Fetch by drawing".
fn formula_bytes(rays: u32, triangles: u32) -> u64 {
    let side = (f64::from(rays) / 6.0).sqrt().ceil() as u64;
    36 + 12 * u64::from(rays) + 8 * 6 * side * side + 4 * u64::from(triangles).div_ceil(32)
}

#[test]
fn surfaces_of_rooms_are_those_of_ids() {
    let (device, _turn) = drawing_device();
    let cornell = builtin::builtin("cornell").expect("a built-in scene").expect("no parameters");
    let own = cornell.cameras[0].clone();
    let counts = Stage::new(&device, &cornell, own.clone(), [40, 30]).compare("cornell", 1200);
    assert!(counts.hits > 1200 && counts.pixels > 100, "{counts:?}");
    let spheres =
        builtin::builtin("spheres:10000").expect("a built-in scene").expect("a number of triangles");
    let counts = Stage::new(&device, &spheres, spheres.cameras[0].clone(), [40, 30]).compare("spheres", 1200);
    assert!(counts.hits > 200 && counts.triangles < 400, "most triangles are not drawn: {counts:?}");
    let parallel = Camera { projection: Projection::Orthographic { half_height: 0.8 }, ..own };
    Stage::new(&device, &cornell, parallel, [17, 23]).compare("cornell, parallel, small waves", 100);
    for (name, scene) in
        [("textures and masks", textured_room()), ("glass", glass_room()), ("veils", veiled_room())]
    {
        let stage = Stage::new(&device, &scene, forward_camera(DVec3::new(0.1, 0.0, 0.8)), [32, 24]);
        assert!(stage.compare(name, 500).hits > 400, "{name}");
    }
}

#[test]
fn surfaces_of_triangles_of_every_size_and_place_are_fetched() {
    let (device, _turn) = drawing_device();
    let mut random = Random(29);
    let mut triangles: Vec<[DVec3; 3]> = Vec::new();
    for _ in 0..250 {
        let middle = random.point().normalize() * 10.0_f64.powf(1.5 * random.next());
        let size = 10.0_f64.powf(2.0 * random.next() - 1.0) * middle.length();
        triangles.push([0, 1, 2].map(|_| middle + random.point() * size));
    }
    // One triangle goes through the camera, one lies just before it, and one is seen edge-on.
    let (eye, forward) = (DVec3::new(0.01, -0.02, 0.03), DVec3::new(0.3, -0.2, -0.9).normalize());
    triangles.push([eye - DVec3::X, eye + DVec3::X + DVec3::Y * 0.1, eye + DVec3::X - DVec3::Y * 0.1]);
    let across = forward.cross(DVec3::Y).normalize() * 1e-7;
    triangles.push([0.0, 1.0, 2.0].map(|turn: f64| {
        let (sin, cos) = (turn * std::f64::consts::TAU / 3.0).sin_cos();
        eye + forward * 1e-7 + across * cos + forward.cross(across) * sin
    }));
    triangles.push([eye + forward, eye + forward * 3.0, eye + forward * 2.0 + DVec3::Y]);
    let scene = soup(&triangles);
    for (name, projection) in [
        ("perspective", Projection::Perspective { fov_y: 1.0 }),
        ("wide", Projection::Perspective { fov_y: 2.5 }),
        ("parallel", Projection::Orthographic { half_height: 3.0 }),
    ] {
        let counts = Stage::new(&device, &scene, turned(projection), [40, 32]).compare(name, 1280);
        assert!(counts.triangles > 50, "{name}: {counts:?}");
    }
}

/// From far away all hits are in a few pixels of the cube, so lists are read in parts.
#[test]
fn lists_longer_than_a_part_are_fetched() {
    let (device, _turn) = drawing_device();
    let mut meshes = box_inside(1.0, 0);
    meshes.remove(5);
    let scene = scene(meshes, vec![lambert(0.6, 0.0)], [0.4; 3]);
    let camera = perspective(DVec3::new(0.1, 0.05, 400.0), 4e-3);
    let counts = Stage::new(&device, &scene, camera, [40, 40]).compare("far away", 1600);
    assert!(counts.longest > 2 * FETCH_PART, "{counts:?}");
}

#[test]
fn devices_that_cannot_draw_are_refused() {
    let (_, _turn) = drawing_device();
    let device = device();
    let cornell = builtin::builtin("cornell").expect("a built-in scene").expect("no parameters");
    let stage = Stage::new(&device, &cornell, cornell.cameras[0].clone(), [4, 4]);
    let film = Film::new(&device, 4, 4).expect("the film fits");
    let desc = IntegratorDesc::new(&device, &stage.scene, &film);
    // The device was made without the feature.
    let options = PathOptions { fetch: Fetching::Raster, ..PathOptions::from(1) };
    let refused = Path::new(&desc, options).expect_err("stores of fragments are missing");
    assert!(matches!(refused, IntegratorError::CannotFetch { .. }), "{refused:?}");
    assert!(refused.to_string().contains("fragmentStoresAndAtomics"), "{refused}");
    assert_silent(&device);
}

/// Without a scene a structure has no surfaces, for any kernel that looks them up.
#[test]
fn surfaces_of_hits_are_refused_where_a_structure_has_none() {
    let device = device();
    let cornell = builtin::builtin("cornell").expect("a built-in scene").expect("no parameters");
    let stage = Stage::new(&device, &cornell, cornell.cameras[0].clone(), [8, 8]);
    let without = BruteForce::new(&device, stage.scene.geometry(), None, false).expect("it can be made");
    let film = Film::new(&device, 8, 8).expect("the film fits");
    let desc = IntegratorDesc { surfaces_of_hits: true, ..IntegratorDesc::new(&device, &stage.scene, &film) };
    let path = Path::new(&desc, 1).expect("valid");
    let render = |structure| {
        let wave = film.bands().waves([0], 64).next().expect("one wave");
        path.render_wave(&device, rasray_gpu::Timing::None, Traced::from(structure), wave).map(drop)
    };
    assert!(matches!(render(&without), Err(IntegratorError::SurfacesOfHits { structure: "brute-force" })));
    assert!(render(&stage.structure).is_ok());
    assert_silent(&device);
}
