//! Hard case on a device: the triangles that the device keeps, and the ids by which device and case count
//! them.

use glam::{DAffine3, DVec3};
use rasray_ads::{Hit, PRIMITIVE_NONE, PRIMITIVE_UNKNOWN, RAY_CULL_BACK_FACES, Ray};
use rasray_hard_cases::{CAMERA_TOWARDS, HardCase, Triangle};
use rasray_reference::oracle::{self, COORDINATE_LIMIT};
use rasray_scene::default_view::camera_looking_at;
use rasray_scene::{Camera, Instance, Material, Mesh, Scene};

/// Triangles of a case that loaders keep: those whose coordinates are finite and have finite squares. Ids of
/// the device count these triangles, ids of the case count all.
#[derive(Clone, Debug)]
pub struct Placed {
    /// Ids in the case of the triangles on the device, ascending.
    kept: Vec<u32>,
}

impl Placed {
    /// Selects the triangles of a list that are kept.
    pub fn new(triangles: &[Triangle]) -> Self {
        let good = |triangle: &Triangle| triangle.iter().flatten().all(|x| x.abs() <= COORDINATE_LIMIT);
        Self { kept: (0..triangles.len() as u32).filter(|&id| good(&triangles[id as usize])).collect() }
    }

    /// Returns the triangles on the device, in its order; `triangles` is the list that this was made from.
    pub fn triangles(&self, triangles: &[Triangle]) -> Vec<Triangle> {
        self.kept.iter().filter_map(|&id| triangles.get(id as usize).copied()).collect()
    }

    /// Makes a scene of these triangles of a case and nothing else.
    pub fn scene(&self, case: &HardCase) -> Scene {
        let positions = self.triangles(&case.triangles).into_flattened();
        let mut scene = Scene { name: format!("hard:{}", case.id), ..Scene::default() };
        if !positions.is_empty() {
            scene.materials.push(Material::default());
            scene.meshes.push(Mesh {
                name: case.id.to_owned(),
                indices: (0..positions.len() as u32).collect(),
                positions,
                normals: None,
                tangents: None,
                uvs: [None, None],
                colors: None,
                material: 0,
            });
            scene.instances.push(Instance {
                name: case.id.to_owned(),
                mesh: 0,
                world_from_mesh: DAffine3::IDENTITY,
            });
        }
        scene
    }

    /// Converts a ray to ids of the device.
    pub fn device_ray(&self, ray: &oracle::Ray) -> Ray {
        // A dropped triangle cannot be hit, so its exclusion is left out.
        let exclude = ray.exclude_primitive.and_then(|id| self.kept.binary_search(&id).ok());
        Ray {
            t_min: ray.t_min,
            t_max: ray.t_max,
            flags: if ray.culls_back_faces { RAY_CULL_BACK_FACES } else { 0 },
            exclude_primitive: exclude.map_or(PRIMITIVE_NONE, |index| index as u32),
            ..Ray::new(ray.origin, ray.direction)
        }
    }

    /// Converts a hit to ids of the case.
    pub fn named(&self, hit: Hit) -> Hit {
        Hit { primitive: self.id(hit.primitive), ..hit }
    }

    /// Returns the case's id of a triangle on the device. An id without a triangle on the device maps to an
    /// id without a triangle in the case.
    pub fn id(&self, on_device: u32) -> u32 {
        if matches!(on_device, PRIMITIVE_NONE | PRIMITIVE_UNKNOWN) {
            return on_device;
        }
        // An id without a triangle must not become the id of one.
        self.kept.get(on_device as usize).copied().unwrap_or(PRIMITIVE_UNKNOWN - 1)
    }
}

/// Returns the camera of every hard case, at its eye (metres).
pub fn case_camera(eye: [f32; 3]) -> Camera {
    let eye = DVec3::from_array(eye.map(f64::from));
    let target = eye + DVec3::from_array(CAMERA_TOWARDS);
    camera_looking_at("hard case", eye, target, std::f32::consts::FRAC_PI_2)
}
