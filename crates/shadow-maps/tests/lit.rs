//! Scenes on a device for the other tests. Maps or traces answer their shadow rays, and functions make rays
//! between surfaces and lights.

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use glam::{DAffine3, DVec3};
use rasray_ads::{BruteForce, Domain, Hit, Occluder, Ray, RayQueue, Structure, Trace};
use rasray_gpu::{Device, DeviceDesc};
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
use rasray_scene::{Camera, Instance, Light, Material, Mesh, Projection, Scene};
use rasray_shadow_maps::{Config, Emitters, Lights, ShadowMaps};

/// Returns a device with validation. Tests take turns, so that a message belongs to one of them.
pub fn device() -> (Device, MutexGuard<'static, ()>) {
    static TURN: Mutex<()> = Mutex::new(());
    static DEVICE: OnceLock<Device> = OnceLock::new();
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let device = DEVICE.get_or_init(|| {
        let requirements = ShadowMaps::requirements();
        let desc = DeviceDesc { validation: true, requirements, ..DeviceDesc::default() };
        let device =
            Device::create(&desc).expect("these tests need a Vulkan device and the validation layer");
        device.keep_pipelines(64);
        device
    });
    (device.clone(), turn)
}

/// Panics if the validation layer has reported a message.
pub fn expect_silence(device: &Device) {
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}

/// Generator of numbers in [0, 1) that are equal in every run.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / (1u64 << 24) as f64
    }

    /// Returns a random point in the cube between -1 and 1.
    pub fn point(&mut self) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| 2.0 * self.next() - 1.0))
    }
}

/// Returns a scene with these triangles as one mesh of one material.
pub fn scene_of(triangles: &[[DVec3; 3]], lights: Vec<Light>) -> Scene {
    let mesh = Mesh {
        name: "triangles".to_owned(),
        positions: triangles.iter().flatten().map(|corner| corner.as_vec3().to_array()).collect(),
        indices: (0..3 * triangles.len() as u32).collect(),
        ..Mesh::default()
    };
    Scene {
        name: "test".to_owned(),
        meshes: vec![mesh],
        instances: vec![Instance { name: "0".to_owned(), mesh: 0, world_from_mesh: DAffine3::IDENTITY }],
        materials: vec![Material { double_sided: true, ..Material::default() }],
        lights,
        ..Scene::default()
    }
}

/// Returns the inside of a room from -1 to 1, with `count` triangles of every size in it.
pub fn cluttered_room(count: usize) -> Vec<[DVec3; 3]> {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let corner = |u: f64, v: f64| {
                let mut p = [0.0; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, u, v);
                DVec3::from(p)
            };
            triangles.push([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0)]);
            triangles.push([corner(-1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]);
        }
    }
    let mut random = Random::new(7);
    for k in 0..count {
        let size = 0.04 + 0.4 * (k % 7) as f64 / 7.0;
        let centre = 0.75 * random.point();
        triangles.push(std::array::from_fn(|_| {
            (centre + size * random.point()).clamp(DVec3::NEG_ONE, DVec3::ONE)
        }));
    }
    triangles
}

/// Returns one light of each kind, and a spot so wide that it has a cube of views.
pub fn lights() -> Vec<Light> {
    let spot = |position, direction: DVec3, outer_cone| Light::Spot {
        position,
        direction: direction.normalize(),
        intensity: [1.0; 3],
        range: f32::INFINITY,
        inner_cone: 0.5 * outer_cone,
        outer_cone,
    };
    vec![
        Light::Point { position: DVec3::new(0.31, 0.72, -0.23), intensity: [1.0; 3], range: f32::INFINITY },
        spot(DVec3::new(-0.83, 0.91, 0.67), DVec3::new(1.0, -1.3, -0.8), 0.6),
        Light::Directional { direction: DVec3::new(0.4, -0.8, 0.3).normalize(), irradiance: [1.0; 3] },
        spot(DVec3::new(0.2, -0.6, 0.85), DVec3::new(-0.3, 0.6, -1.0), 1.4),
        // This light is a centimetre from a wall.
        Light::Point { position: DVec3::new(-0.99, 0.1, 0.05), intensity: [1.0; 3], range: f32::INFINITY },
    ]
}

/// Returns the lights of a scene, with the triangles that emit.
pub fn lights_of(scene: &GpuScene) -> Lights<'_> {
    let posed = scene.posed_buffers();
    let emitters = Emitters { records: &posed.emissive, count: scene.emitter_count() };
    Lights { records: &posed.lights, known: scene.lights(), emitters: Some(emitters) }
}

/// Scene with its lights on a device.
pub struct Lit {
    pub device: Device,
    pub scene: GpuScene,
    pub structure: BruteForce,
    pub maps: ShadowMaps,
    pub positions: Vec<[f32; 3]>,
    pub indices: Vec<u32>,
}

impl Lit {
    pub fn new(device: &Device, scene: &Scene, config: Config) -> Self {
        let camera = Camera {
            name: "test".to_owned(),
            world_from_camera: DAffine3::IDENTITY,
            projection: Projection::Perspective { fov_y: 1.0 },
            aspect_ratio: None,
            lens: None,
        };
        let view = View { camera, width: 4, height: 4, seed: 1 };
        let tables = SceneTables::new(scene, DVec3::ZERO, &Parts::ALL).expect("the scene is well formed");
        let scene = GpuScene::upload(device, &tables, &view).expect("the scene fits");
        let (geometry, binding) = (scene.geometry(), scene.binding());
        let structure = BruteForce::new(device, geometry, Some(binding), false).expect("it can be made");
        let lights = lights_of(&scene);
        let maps =
            ShadowMaps::new(device, config, geometry, Some(binding), lights).expect("the device draws");
        let (positions, indices) = geometry.download(device).expect("readable");
        Self { device: device.clone(), scene, structure, maps, positions, indices }
    }

    /// Replaces the maps by maps with these options.
    pub fn with(self, config: Config) -> Self {
        let lights = lights_of(&self.scene);
        let (geometry, binding) = (self.scene.geometry(), self.scene.binding());
        let maps = ShadowMaps::new(&self.device, config, geometry, Some(binding), lights);
        Self { maps: maps.expect("the device draws"), ..self }
    }

    pub fn build(&self) {
        self.device.submit(|recorder| self.maps.record_build(recorder)).expect("the build runs");
    }

    /// Returns true for each ray that is occluded, by the maps or by a trace.
    pub fn occluded(&self, rays: &[Ray], by_maps: bool) -> Vec<bool> {
        let hits = self.hits(rays, by_maps, Domain::First(rays.len() as u32));
        hits.iter().map(Hit::is_hit).collect()
    }

    pub fn hits(&self, rays: &[Ray], by_maps: bool, domain: Domain) -> Vec<Hit> {
        let queue = RayQueue::new(&self.device, "rays", rays.len() as u32, false).expect("it fits");
        self.device.upload_slice(queue.rays(), 0, rays).expect("it fits");
        self.ask(&queue, by_maps, domain);
        self.device.download_as(queue.hits(), 0, rays.len()).expect("readable")
    }

    pub fn ask(&self, queue: &RayQueue, by_maps: bool, domain: Domain) {
        let submitted = self.device.submit(|recorder| {
            if by_maps {
                self.maps.record_occluded(recorder, queue, domain, &self.structure);
            } else {
                self.structure.record_trace(recorder, queue, Trace::occluded(domain));
            }
        });
        submitted.expect("the rays are answered");
    }

    /// Returns the corners of the triangles as the device has them.
    pub fn triangles(&self) -> Vec<[DVec3; 3]> {
        let corner = |index: &u32| glam::Vec3::from(self.positions[*index as usize]).as_dvec3();
        self.indices.as_chunks::<3>().0.iter().map(|triangle| triangle.each_ref().map(corner)).collect()
    }

    /// Returns rays from points spread evenly over all surfaces to a light without extent, as integrators
    /// ask. Leaves out points that the light does not shine on.
    pub fn shadow_rays(&self, light: u32, count: usize) -> Vec<Ray> {
        let record = self.scene.lights()[light as usize];
        self.rays_to(light, count, |_, p| {
            let towards = towards(&record, p)?;
            let is_far = record.kind == rasray_shaders_glsl::constants::scene::LIGHT_DIRECTIONAL;
            Some((towards, (!is_far).then(|| record.position.into())))
        })
    }

    /// Returns rays from points spread evenly over all surfaces to random places on the emitting triangle
    /// with this number and these corners.
    pub fn rays_to_emitter(&self, emitter: u32, corners: [DVec3; 3], count: usize) -> Vec<Ray> {
        self.rays_to(self.scene.lights().len() as u32 + emitter, count, |random, p| {
            let (root, along) = (random.next().sqrt(), random.next());
            let [a, b, c] = corners;
            let place = a * (1.0 - root) + b * (root * (1.0 - along)) + c * (root * along);
            ((place - p).length() > 1.0e-3).then(|| (place - p, Some(place.as_vec3())))
        })
    }

    /// Returns rays from points on all surfaces, on the side of a light. `target` gives the direction of the
    /// light, and the end of the ray.
    fn rays_to(
        &self,
        light: u32,
        count: usize,
        mut target: impl FnMut(&mut Random, DVec3) -> Option<(DVec3, Option<glam::Vec3>)>,
    ) -> Vec<Ray> {
        let triangles = self.triangles();
        let twice_area = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]);
        let total: f64 = triangles.iter().map(|t| twice_area(t).length()).sum();
        let mut random = Random::new(u64::from(light) + 1);
        let mut rays = Vec::new();
        let (mut triangle, mut sum) = (0, twice_area(&triangles[0]).length());
        for k in 0..count {
            let wanted = total * (k as f64 + 0.5) / count as f64;
            while sum < wanted && triangle + 1 < triangles.len() {
                triangle += 1;
                sum += twice_area(&triangles[triangle]).length();
            }
            let [a, b, c] = triangles[triangle];
            let (root, along) = (random.next().sqrt(), random.next());
            let p = a * (1.0 - root) + b * (root * (1.0 - along)) + c * (root * along);
            let Some((towards, end)) = target(&mut random, p) else { continue };
            let normal = twice_area(&triangles[triangle]).normalize();
            let side = normal.dot(towards).signum();
            let origin = (p + normal * side * 2.0e-6 * (1.0 + p.abs().max_element())).as_vec3();
            let direction = end.map_or(towards.as_vec3(), |end| end - origin);
            rays.push(Ray {
                t_max: if end.is_some() { 1.0 - 1.0 / 1_048_576.0 } else { f32::INFINITY },
                exclude_primitive: triangle as u32,
                ..Ray::new(origin.to_array(), direction.to_array()).with_light(light)
            });
        }
        rays
    }
}

/// Returns the vector from a point towards a light, or `None` if the light does not shine there.
fn towards(light: &rasray_shadow_maps::Light, from: DVec3) -> Option<DVec3> {
    use rasray_shaders_glsl::constants::scene::{LIGHT_DIRECTIONAL, LIGHT_SPOT};
    let direction = glam::Vec3::from(light.direction).as_dvec3();
    if light.kind == LIGHT_DIRECTIONAL {
        return Some(-direction);
    }
    let towards = glam::Vec3::from(light.position).as_dvec3() - from;
    let cosine = -direction.dot(towards.normalize());
    let is_lit =
        light.kind != LIGHT_SPOT || cosine * f64::from(light.cone_scale) + f64::from(light.cone_offset) > 0.0;
    is_lit.then_some(towards)
}
