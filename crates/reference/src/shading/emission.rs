//! Emission of photons from the lights.

use std::f32::consts::PI;

use glam::{DVec3, Vec2, Vec3};
use rasray_scene::Light;

use super::{
    Ray, basis_around, cosine_hemisphere,
    environment::{search, share},
    light::{bounds, cone},
    posed::PosedScene,
    spawn::spawn_position,
    triangle::{barycentric_weights, triangle_normal, triangle_point},
};

/// Ratio by which the disk of light from afar is enlarged, so that rounding leaves no triangle uncovered.
const DISK_MARGIN: f32 = 1.001;

/// Photon as it leaves a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Ray of the photon.
    pub ray: Ray,
    /// Flux over the probability of its choice, W.
    pub flux: Vec3,
    /// Distance at which a light without extent ends, metres; infinite for all others.
    pub range: f32,
}

impl Emission {
    fn new(origin: Vec3, direction: Vec3, exclude_primitive: Option<u32>, flux: Vec3) -> Self {
        let ray = Ray {
            origin,
            direction,
            t_max: f32::INFINITY,
            exclude_primitive,
            culls_back_faces: false,
            cone_width: 0.0,
            cone_spread: 0.0,
        };
        Self { ray, flux, range: f32::INFINITY }
    }
}

impl PosedScene<'_> {
    /// Returns the diagonal of the box of all triangles, metres.
    pub fn diagonal(&self) -> f32 {
        let [lower, upper] = bounds(self).map(DVec3::as_vec3);
        (upper - lower).length()
    }

    /// Emits a photon. The numbers of `place` choose kind, light or row, and position; those of `towards`
    /// choose side and direction, one being unused. `None` if nothing is emitted.
    pub fn emit_photon(&self, place: [f32; 4], towards: [f32; 4]) -> Option<Emission> {
        let [kind, pick, u, v] = place;
        let [side, _, x, y] = towards;
        let [punctual, emissive, environment] = self.lights.kinds;
        let (share, mut emission) = if kind < punctual {
            (punctual, self.emit_punctual(pick, [x, y])?)
        } else if kind < punctual + emissive {
            (emissive, self.emit_emissive(pick, Vec2::new(u, v), side, Vec2::new(x, y))?)
        } else if environment > 0.0 {
            let (direction, radiance, pdf) = self.environment.sample(pick, Vec2::new(u, v));
            if !(pdf > 0.0) {
                return None;
            }
            (environment, self.emit_from_afar(-direction, radiance / pdf, [x, y]))
        } else {
            return None;
        };
        emission.flux /= share;
        Some(emission)
    }

    /// Emits a photon from a disk across the direction that covers all triangles, before all of them.
    fn emit_from_afar(&self, direction: Vec3, irradiance: Vec3, [x, y]: [f32; 2]) -> Emission {
        let [lower, upper] = bounds(self).map(DVec3::as_vec3);
        let radius = 0.5 * (upper - lower).length() * DISK_MARGIN;
        let (away, turn) = (radius * x.sqrt(), 2.0 * PI * y);
        let offset = Vec3::new(away * turn.cos(), away * turn.sin(), -radius);
        let origin = 0.5 * (lower + upper) + basis_around(direction) * offset;
        Emission::new(origin, direction, None, irradiance * (PI * radius * radius))
    }

    fn emit_punctual(&self, pick: f32, [x, y]: [f32; 2]) -> Option<Emission> {
        let index = search(&self.lights.punctual, pick);
        let share = share(&self.lights.punctual, index);
        if !(share > 0.0) {
            return None;
        }
        let (position, intensity, range, axis, [scale, offset]) = match self.scene.lights[index] {
            Light::Directional { direction, irradiance } => {
                let direction = direction.normalize_or(DVec3::NEG_Z).as_vec3();
                return Some(self.emit_from_afar(direction, Vec3::from(irradiance) / share, [x, y]));
            }
            Light::Point { position, intensity, range } => (position, intensity, range, Vec3::Z, [0.0, 1.0]),
            Light::Spot { position, direction, intensity, range, inner_cone, outer_cone } => {
                let axis = direction.normalize_or(DVec3::NEG_Z).as_vec3();
                (position, intensity, range, axis, cone(inner_cone, outer_cone))
            }
        };
        let least = if scale > 0.0 { (-offset / scale).max(-1.0) } else { -1.0 };
        let cosine = 1.0 - x * (1.0 - least);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let turn = 2.0 * PI * y;
        let direction = basis_around(axis) * Vec3::new(sine * turn.cos(), sine * turn.sin(), cosine);
        let inside = (cosine * scale + offset).clamp(0.0, 1.0);
        let flux = Vec3::from(intensity) * (inside * inside * 2.0 * PI * (1.0 - least)) / share;
        let origin = (position - self.frame_origin()).as_vec3();
        Some(Emission { range, ..Emission::new(origin, direction, None, flux) })
    }

    fn emit_emissive(&self, pick: f32, place: Vec2, side: f32, towards: Vec2) -> Option<Emission> {
        let entry = search(&self.lights.cumulative, pick);
        let share = share(&self.lights.cumulative, entry);
        if !(share > 0.0) {
            return None;
        }
        let primitive = self.lights.primitives[entry];
        let root = place.x.sqrt();
        let barycentrics = Vec2::new(root * (1.0 - place.y), root * place.y);
        let corners = self.vertices(primitive);
        let (position, error) = triangle_point(barycentric_weights(barycentrics), corners);
        let (normal, twice_area) = triangle_normal(corners[1] - corners[0], corners[2] - corners[0]);
        let draw = self.draw_of(primitive);
        let both = self.material(draw).double_sided;
        let front = !both || side < 0.5;
        let normal = if front == draw.mirrored { -normal } else { normal };
        let radiance = self.emission_at(primitive, barycentrics, front);
        let direction = (basis_around(normal) * cosine_hemisphere(towards)).normalize();
        let origin = spawn_position(position, error, normal, direction);
        let area = if both { 2.0 } else { 1.0 } * 0.5 * twice_area;
        Some(Emission::new(origin, direction, Some(primitive), radiance * (PI * area / share)))
    }
}
