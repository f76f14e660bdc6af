//! Ray casting through one surface after the other, front to back.

use glam::Vec3;
use rasray_options::Value;

use super::{Image, NaiveIntegrator, Tracer};
use crate::shading::{PosedScene, Ray, ReferenceError, View, random::Numbers, spawn_ray};

pub(super) const ROW: NaiveIntegrator = NaiveIntegrator {
    name: "layers",
    render: |posed, view, values| {
        let limit = values.get("layer-limit").and_then(Value::whole).unwrap_or(u32::MAX);
        let opacity = values.get("layer-opacity").and_then(Value::number).unwrap_or(1.0);
        posed.render_layers(view, limit, opacity)
    },
};

/// Largest number of surfaces that one ray passes; the surface behind them is not seen.
const LAYER_LIMIT: u32 = 4096;

impl Tracer<'_> {
    fn layers(&self, view: &View, limit: u32, opacity: f32, random: Numbers) -> Vec3 {
        let mut ray = self.camera_ray(view, random);
        let (mut radiance, mut left) = (Vec3::ZERO, 1.0);
        for _ in 0..limit.min(LAYER_LIMIT) {
            let Some(surface) = self.closest(&ray) else { break };
            let opacity = surface.opacity * opacity;
            radiance += surface.raycast(ray.direction) * (left * opacity);
            left *= 1.0 - opacity;
            if !(left > 0.0) {
                return radiance;
            }
            ray = Ray {
                culls_back_faces: ray.culls_back_faces,
                cone_width: ray.cone_width + ray.cone_spread * surface.t,
                cone_spread: ray.cone_spread,
                ..spawn_ray(&surface, ray.direction, f32::INFINITY)
            };
        }
        let is_cut = limit > LAYER_LIMIT && self.closest(&ray).is_some();
        if is_cut { radiance } else { radiance + self.posed.environment_radiance(ray.direction) * left }
    }
}

impl PosedScene<'_> {
    /// Renders the first `limit` surfaces along camera rays, lit from the eye, each with `opacity` times the
    /// opacity of its material; W/(sr m^2), with a light of 1 at the eye.
    ///
    /// # Errors
    /// An error if the image is empty or the scene has more triangles than ids.
    pub fn render_layers(&self, view: &View, limit: u32, opacity: f32) -> Result<Image, ReferenceError> {
        self.render(view, false, |tracer, random| tracer.layers(view, limit, opacity, random))
    }
}
