use glam::{Vec2, Vec3};

use rasray_options::Value;
use rasray_scene::{Camera, Sampler, Scene};

use super::{Image, NaiveIntegrator, Tracer, eye};
use crate::shading::{
    PosedScene, ReferenceError, View, basis_around, cosine_hemisphere,
    random::{Numbers, RANDOM_BSDF_U, RANDOM_BSDF_V, random_dimension},
    spawn_ray,
};

pub(super) const ROW: NaiveIntegrator = NaiveIntegrator {
    name: "ao",
    render: |posed, view, values| {
        let distance = values.get("ao-distance").and_then(Value::number).unwrap_or(f32::INFINITY);
        posed.render_ambient_occlusion(view, distance)
    },
};

impl Tracer<'_> {
    /// Returns one sample: 1 if nothing is hit within `distance` metres, else 0.
    pub(super) fn ambient_occlusion(&self, view: &View, distance: f32, random: Numbers) -> Vec3 {
        let ray = self.camera_ray(view, random);
        let Some(surface) = self.closest(&ray) else { return Vec3::ONE };
        let place = Vec2::new(
            random.float(random_dimension(0, RANDOM_BSDF_U)),
            random.float(random_dimension(0, RANDOM_BSDF_V)),
        );
        let direction = (basis_around(surface.geometric_normal) * cosine_hemisphere(place)).normalize();
        if self.occluded(&spawn_ray(&surface, direction, distance)) { Vec3::ZERO } else { Vec3::ONE }
    }
}

impl PosedScene<'_> {
    /// Renders the cosine-weighted visibility of a white environment within `distance` metres; the background
    /// is 1.
    ///
    /// # Errors
    /// An error if the image is empty or the scene has more triangles than ids.
    pub fn render_ambient_occlusion(&self, view: &View, distance: f32) -> Result<Image, ReferenceError> {
        self.render(view, false, |tracer, random| tracer.ambient_occlusion(view, distance, random))
    }
}

/// Renders like [`PosedScene::render_ambient_occlusion`], with the frame origin at the eye.
///
/// # Errors
/// An error if the scene refers to an element that it does not have, or the image is empty.
pub fn render_ambient_occlusion(
    scene: &Scene,
    camera: &Camera,
    width: u32,
    height: u32,
    samples: u32,
    seed: u32,
    distance: f32,
) -> Result<Image, ReferenceError> {
    let view = View { camera: camera.clone(), width, height, samples, seed, sampler: Sampler::default() };
    PosedScene::new(scene, eye(camera))?.render_ambient_occlusion(&view, distance)
}
