use glam::Vec3;

use super::{Image, NaiveIntegrator, Tracer};
use crate::shading::{PosedScene, ReferenceError, Surface, View, random::Numbers};

pub(super) const ROW: NaiveIntegrator =
    NaiveIntegrator { name: "raycast", render: |posed, view, _| posed.render_raycast(view) };

impl Surface {
    /// Returns emission plus base colour times the cosine between shading normal and the unit `direction` of
    /// the ray.
    pub(super) fn raycast(&self, direction: Vec3) -> Vec3 {
        self.emission + self.base_color * self.normal.dot(direction).abs()
    }
}

impl Tracer<'_> {
    /// Returns one sample: emission plus base colour times the cosine between shading normal and ray, or the
    /// environment.
    pub(super) fn raycast(&self, view: &View, random: Numbers) -> Vec3 {
        let ray = self.camera_ray(view, random);
        match self.closest(&ray) {
            Some(surface) => surface.raycast(ray.direction),
            None => self.posed.environment_radiance(ray.direction),
        }
    }
}

impl PosedScene<'_> {
    /// Renders the surfaces that camera rays hit, lit from the eye; W/(sr m^2), with a light of 1 there.
    ///
    /// # Errors
    /// An error if the image is empty or the scene has more triangles than ids.
    pub fn render_raycast(&self, view: &View) -> Result<Image, ReferenceError> {
        self.render(view, false, |tracer, random| tracer.raycast(view, random))
    }
}
