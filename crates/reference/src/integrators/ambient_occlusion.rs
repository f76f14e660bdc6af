use glam::{Vec2, Vec3};

use super::Tracer;
use crate::shading::{
    View, basis_around, cosine_hemisphere,
    random::{Numbers, RANDOM_BSDF_U, RANDOM_BSDF_V, random_dimension},
    spawn_ray,
};

impl Tracer<'_> {
    /// One sample: 1 if nothing is hit within `distance` metres, else 0.
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
