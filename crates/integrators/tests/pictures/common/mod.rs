//! Small scenes and one way to render them with the brute-force structure, validation on.
#![allow(dead_code, reason = "each test binary uses its own part")]

pub mod difference;
pub mod scenes;

use std::fmt::Display;

use glam::{DAffine3, DMat3, DVec3};
use rasray_ads::BruteForce;
use rasray_gpu::{Device, DeviceDesc, Timing};
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, ShadingFeatures, View};
use rasray_integrators::{Fetch, Film, Integrator, IntegratorDesc};
use rasray_scene::{Camera, Environment, Instance, Material, Mesh, Projection, Scene};

use crate::kept_pictures::Compared;

/// Makes a device with validation on.
pub fn device() -> Device {
    let desc = DeviceDesc { validation: true, ..DeviceDesc::default() };
    Device::create(&desc).expect("these tests need a Vulkan device and the validation layer")
}

/// Makes a device with validation on that can draw, for options that need it.
pub fn drawing_device() -> Device {
    let desc = DeviceDesc { validation: true, requirements: Fetch::requirements(), ..DeviceDesc::default() };
    Device::create(&desc).expect("these tests need a Vulkan device that draws")
}

/// Makes a camera at `eye` with the given axes.
pub fn camera(eye: DVec3, right: DVec3, up: DVec3, projection: Projection) -> Camera {
    let axes = DMat3::from_cols(right, up, right.cross(up));
    Camera {
        name: "test".to_owned(),
        world_from_camera: DAffine3::from_mat3_translation(axes, eye),
        projection,
        aspect_ratio: None,
        lens: None,
    }
}

/// Makes a camera that looks along -z.
pub fn forward_camera(eye: DVec3) -> Camera {
    camera(eye, DVec3::X, DVec3::Y, Projection::Perspective { fov_y: 1.0 })
}

/// Makes a diffuse material without any specular part: it reflects exactly its base colour.
pub fn lambert(albedo: f32, emission: f32) -> Material {
    Material {
        base_color: [albedo, albedo, albedo, 1.0],
        metallic: 0.0,
        specular: 0.0,
        emission: [emission; 3],
        double_sided: true,
        ..Material::default()
    }
}

/// Makes a square of two triangles with corners at `centre` plus and minus `u` and `v`; counter-clockwise
/// seen from the side that u x v points to.
pub fn square(centre: DVec3, u: DVec3, v: DVec3, material: usize) -> Mesh {
    let corners = [centre - u - v, centre + u - v, centre + u + v, centre - u + v];
    Mesh {
        name: "square".to_owned(),
        positions: corners.map(|corner| corner.as_vec3().to_array()).to_vec(),
        indices: vec![0, 1, 2, 0, 2, 3],
        material,
        ..Mesh::default()
    }
}

/// Makes the inside of a cube around the origin, faces turned inwards.
pub fn box_inside(half: f64, material: usize) -> Vec<Mesh> {
    let mut faces = Vec::new();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let mut normal = [0.0; 3];
            normal[axis] = -sign;
            let normal = DVec3::from(normal);
            let u = DVec3::from([normal.y.abs() + normal.z.abs(), normal.x.abs(), 0.0]) * half;
            let v = normal.cross(u);
            faces.push(square(-normal * half, u, v, material));
        }
    }
    faces
}

pub fn scene(meshes: Vec<Mesh>, materials: Vec<Material>, environment: [f32; 3]) -> Scene {
    let instances = (0..meshes.len())
        .map(|mesh| Instance { name: format!("{mesh}"), mesh, world_from_mesh: DAffine3::IDENTITY })
        .collect();
    Scene {
        name: "test".to_owned(),
        meshes,
        instances,
        materials,
        environment: Environment::Constant(environment),
        ..Scene::default()
    }
}

pub struct Setup {
    pub device: Device,
    pub scene: GpuScene,
    pub structure: BruteForce,
    pub film: Film,
}

impl Setup {
    pub fn new(device: &Device, scene: &Scene, camera: Camera, width: u32, height: u32, seed: u32) -> Self {
        Self::with(device, scene, View { camera, width, height, seed }, &Parts::ALL)
    }

    pub fn with(device: &Device, scene: &Scene, view: View, parts: &Parts) -> Self {
        let origin = SceneTables::default_frame_origin(scene, view.eye());
        let tables = SceneTables::new(scene, origin, parts).expect("the scene is well formed");
        let scene = GpuScene::upload(device, &tables, &view).expect("the scene fits");
        let structure = BruteForce::new(device, scene.geometry(), Some(scene.binding()), false)
            .expect("the structure can be made");
        let film = Film::new(device, view.width, view.height).expect("the film fits");
        Self { device: device.clone(), scene, structure, film }
    }

    pub fn desc(&self) -> IntegratorDesc<'_> {
        IntegratorDesc::new(&self.device, &self.scene, &self.film)
    }

    pub fn desc_with(&self, wave_capacity: u32, features: ShadingFeatures) -> IntegratorDesc<'_> {
        IntegratorDesc { wave_capacity, features, ..self.desc() }
    }

    /// Renders all samples and returns the image; every ray must have been finished.
    pub fn render(&self, integrator: &dyn Integrator, samples: u32) -> Vec<[f32; 3]> {
        self.device.submit(|recorder| integrator.record_reset(recorder)).expect("the reset runs");
        for wave in self.film.bands().waves(0..samples, integrator.wave_capacity()) {
            let traced = (&self.structure).into();
            integrator.render_wave(&self.device, Timing::None, traced, wave).expect("the wave runs");
        }
        for queue in integrator.queues() {
            let counters = queue.download_counters(&self.device).expect("the header can be read");
            assert_eq!((counters.unfinished, counters.not_ready), (0, 0));
        }
        self.film.read(&self.device).expect("the film can be read")
    }
}

pub fn mean(image: &[[f32; 3]]) -> f64 {
    image.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / image.len() as f64
}

/// Largest difference of pictures by different kernels on hardware, relative to the value.
const CONTRACTION: f32 = 1.0e-5;

/// True if pictures that different kernels made are equal: bit for bit on a software device. Hardware may
/// contract a product and a sum in one kernel and not in another.
pub fn are_same(device: &Device, picture: &[[f32; 3]], expected: &[[f32; 3]]) -> bool {
    let is_close = |(a, b): (&f32, &f32)| (a - b).abs() <= CONTRACTION * b.abs();
    if device.is_software() {
        return picture == expected;
    }
    picture.len() == expected.len()
        && picture.as_flattened().iter().zip(expected.as_flattened()).all(is_close)
}

/// Fails the running test unless pictures with `width` pixels a row are equal ([`are_same`]); both are kept.
#[track_caller]
pub fn assert_same(
    device: &Device,
    picture: &[[f32; 3]],
    reference: &[[f32; 3]],
    width: u32,
    why: impl Display,
) {
    let is_same = are_same(device, picture, reference);
    Compared { picture, reference, width }.assert(is_same, why);
}

pub fn assert_silent(device: &Device) {
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}
