//! Point of the scene that was picked in a picture, and the hit of each system there.

use glam::DVec3;
use rasray_experiment::{Built, DeviceScene, ExperimentError, Frame, SystemConfig, hit_at};
use rasray_gpu::Device;
use rasray_scene::{Camera, Projection, Scene};

use crate::traced::Traced;

/// Ray through a picture, and the systems through which it is to be traced.
#[derive(Clone, Debug)]
pub struct Pick {
    /// Number of the pick; after a new pick, the answers to an earlier one no longer count.
    pub number: u64,
    /// Camera of the picture.
    pub camera: Camera,
    /// Width and height of the picture, pixels.
    pub size: [u32; 2],
    /// Place in the picture from the left top corner, pixels.
    pub place: [f32; 2],
    /// Number of the scene, as in the settings.
    pub scene: u32,
    /// Time of the scene, seconds; absent at rest.
    pub seconds: Option<f64>,
    /// Systems in the order in which they answer.
    pub systems: Vec<SystemConfig>,
}

impl Pick {
    /// Returns the ray of the pick: its origin in the world, metres, and its direction, a unit vector.
    fn ray(&self) -> (DVec3, DVec3) {
        let [width, height] = self.size;
        let half = self.camera.half_extents(width, height);
        let [x, y] = [
            (2.0 * f64::from(self.place[0]) / f64::from(width) - 1.0) * half[0],
            (1.0 - 2.0 * f64::from(self.place[1]) / f64::from(height)) * half[1],
        ];
        let frame = &self.camera.world_from_camera;
        let axis = |axis: DVec3| axis.normalize_or_zero();
        let (right, up, back) =
            (axis(frame.matrix3.x_axis), axis(frame.matrix3.y_axis), axis(frame.matrix3.z_axis));
        let across = right * x + up * y;
        match self.camera.projection {
            Projection::Perspective { .. } => (frame.translation, (across - back).normalize_or_zero()),
            Projection::Orthographic { .. } => (frame.translation + across, -back),
        }
    }

    /// Finds the hit in the structure of a configuration: in `traced` if that is of this configuration,
    /// otherwise in a structure that is built for the pick. The scene is given as it was read and as it is on
    /// the device.
    pub(crate) fn hit(
        &self,
        device: &Device,
        (scene, stage): (&Scene, &DeviceScene),
        traced: Option<&Traced>,
        config: &SystemConfig,
        frame: &Frame,
    ) -> Result<Option<PickedHit>, ExperimentError> {
        let [width, height] = self.size;
        let frame = Frame { width, height, ..frame.clone() };
        let config = config.clone().serving(frame.workload()).seen_by(&self.camera, &frame);
        let eye = self.camera.world_from_camera.translation;
        let made;
        let built = match traced.filter(|traced| traced.config == config) {
            Some(traced) => &traced.built,
            None => {
                let relative = (eye - stage.scene.frame_origin()).as_vec3().to_array();
                made = Built::new(device, &config.spec()?, &stage.scene, relative)?;
                &made
            }
        };
        let Some(hit) = hit_at(device, stage, built, &self.camera, self.size, self.place)? else {
            return Ok(None);
        };
        let (origin, direction) = self.ray();
        let distance = f64::from(hit.t);
        let point = origin + direction * distance;
        let forward = -self.camera.world_from_camera.matrix3.z_axis.normalize_or_zero();
        let triangle = hit.primitive.and_then(|id| PickedTriangle::of(scene, id));
        Ok(Some(PickedHit { point, depth: (point - eye).dot(forward), distance, triangle }))
    }
}

/// Description of a triangle by names of the scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PickedTriangle {
    /// Id of the triangle over all instances.
    pub id: u32,
    /// Name of the instance, and the index of the triangle in the instance.
    pub instance: (String, u32),
    /// Name of the triangle's material.
    pub material: String,
}

impl PickedTriangle {
    /// Finds the triangle of an id: ids count the triangles of all instances in the order of the scene.
    pub(crate) fn of(scene: &Scene, id: u32) -> Option<Self> {
        let mut left = id as usize;
        for instance in &scene.instances {
            let mesh = scene.meshes.get(instance.mesh)?;
            let Some(beyond) = left.checked_sub(mesh.triangle_count()) else {
                let material = scene.materials.get(mesh.material)?;
                return Some(Self {
                    id,
                    instance: (instance.name.clone(), left as u32),
                    material: material.name.clone(),
                });
            };
            left = beyond;
        }
        None
    }
}

/// Hit of a ray.
#[derive(Clone, Debug, PartialEq)]
pub struct PickedHit {
    /// Position in the world, metres.
    pub point: DVec3,
    /// Depth along the view, metres.
    pub depth: f64,
    /// Distance from the origin of the ray, metres.
    pub distance: f64,
    /// Triangle that was hit; absent where fragments do not keep it.
    pub triangle: Option<PickedTriangle>,
}

/// Answer of one system to a pick.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Name and preset of the system.
    pub system: String,
    /// Hit, or `None` for a miss; or the reason for which there is no answer.
    pub hit: Result<Option<PickedHit>, String>,
}

/// Pick with the answers so far, first the answer of the system that is shown.
#[derive(Clone, Debug)]
pub struct Picked {
    /// Pick that the answers belong to.
    pub pick: Pick,
    /// Answers in the order of the systems.
    pub answers: Vec<Answer>,
    /// Number of answers still to come.
    pub awaited: usize,
}

impl Picked {
    /// Returns the hit of the system that is shown.
    pub fn hit(&self) -> Option<&PickedHit> {
        self.answers.first()?.hit.as_ref().ok()?.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_scene_source::load;

    #[test]
    fn ids_count_the_triangles_of_all_instances() {
        let loaded = load("cornell".as_ref()).expect("a scene");
        let scene = &loaded.scene;
        let mut id = 0;
        for instance in &scene.instances {
            let mesh = &scene.meshes[instance.mesh];
            for number in 0..mesh.triangle_count() as u32 {
                let triangle = PickedTriangle::of(scene, id).expect("a triangle");
                assert_eq!(triangle.instance, (instance.name.clone(), number));
                assert_eq!(triangle.material, scene.materials[mesh.material].name);
                id += 1;
            }
        }
        assert_eq!(PickedTriangle::of(scene, id), None);
    }
}
