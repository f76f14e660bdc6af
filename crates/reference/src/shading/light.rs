//! Directions chosen by the lights, and the density with which they would choose a given one.

use glam::{DVec3, Vec2, Vec3};
use rasray_scene::{AlphaMode, Light};

use super::{
    Ray, Surface,
    environment::{cumulative_shares, search, share},
    luminance,
    posed::PosedScene,
    ray::{spawn_position, spawn_ray, spawn_segment},
    texture::Use,
    triangle::{barycentric_weights, triangle_normal, triangle_point},
};

/// The emissive triangles by power.
#[derive(Clone, Debug, Default)]
pub struct LightTable {
    primitives: Vec<u32>,
    cumulative: Vec<f32>,
    /// For each draw, the entry of its first triangle.
    first_of_draw: Vec<Option<u32>>,
}

/// A direction chosen by the lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit, from the surface to the light.
    pub direction: Vec3,
    /// End of the shadow segment; `None` for lights that are infinitely far away.
    pub target: Option<Vec3>,
    /// Arriving, W/(sr m^2); delta: irradiance across the direction, W/m^2.
    pub radiance: Vec3,
    /// 1/sr including the choice of the light; delta: probability of the choice.
    pub pdf: f32,
    /// The light has no extent.
    pub delta: bool,
}

impl LightSample {
    /// The ray that asks whether the sample is seen from the surface; `None` if nothing can lie between.
    pub fn shadow_ray(&self, surface: &Surface) -> Option<Ray> {
        match self.target {
            Some(target) => spawn_segment(surface, target),
            None => Some(spawn_ray(surface, self.direction, f32::INFINITY)),
        }
    }
}

impl LightTable {
    pub(super) fn new(posed: &PosedScene<'_>) -> Self {
        let (mut primitives, mut powers, mut first_of_draw) = (Vec::new(), Vec::new(), Vec::new());
        for draw in &posed.draws {
            let material = posed.material(draw);
            let texture = material.emission_texture.as_ref();
            let bound = Vec3::from(material.emission) * posed.textures.bound(texture, Use::Color);
            let bound = f64::from(luminance(bound)) * if material.double_sided { 2.0 } else { 1.0 };
            // Scattered rays alone meet what blends, as often as its opacity says.
            if material.unlit || material.alpha_mode == AlphaMode::Blend || !(bound > 0.0) {
                first_of_draw.push(None);
                continue;
            }
            first_of_draw.push(Some(primitives.len() as u32));
            let count = posed.mesh(draw).triangle_count() as u32;
            for primitive in draw.first_triangle..draw.first_triangle + count {
                let [a, b, c] =
                    posed.vertices(primitive).map(|corner| DVec3::from(corner.to_array().map(f64::from)));
                let area = 0.5 * (b - a).cross(c - a).length();
                primitives.push(primitive);
                powers.push(if area.is_finite() { area * bound } else { 0.0 });
            }
        }
        let (total, cumulative) = cumulative_shares(&powers);
        if total > 0.0 { Self { primitives, cumulative, first_of_draw } } else { Self::default() }
    }

    fn is_empty(&self) -> bool {
        self.primitives.is_empty()
    }
}

/// 1/sr of a point uniform on a triangle, as seen along the unit `direction` from `distance` away.
fn area_pdf(normal: Vec3, twice_area: f32, direction: Vec3, distance: f32) -> f32 {
    let projected = 0.5 * twice_area * normal.dot(direction).abs();
    if projected > 0.0 { distance * distance / projected } else { 0.0 }
}

impl PosedScene<'_> {
    /// Kinds of light the scene has: punctual, emissive triangles, environment.
    fn light_kind_count(&self) -> u32 {
        u32::from(!self.scene.lights.is_empty())
            + u32::from(!self.lights.is_empty())
            + u32::from(self.environment.is_sampled())
    }

    /// A direction from the surface to a light, one random number for each of: kind, light or row,
    /// place. `None` where nothing can arrive.
    pub fn light_sample(&self, surface: &Surface, [kind, pick, u, v]: [f32; 4]) -> Option<LightSample> {
        let kinds = self.light_kind_count();
        if kinds == 0 {
            return None;
        }
        let kind = ((kind * kinds as f32) as u32).min(kinds - 1);
        let punctual = u32::from(!self.scene.lights.is_empty());
        let emissive = u32::from(!self.lights.is_empty());
        let mut chosen = if kind < punctual {
            self.sample_punctual(surface.position, pick)?
        } else if kind < punctual + emissive {
            self.sample_emissive(surface.position, pick, Vec2::new(u, v))?
        } else {
            let (direction, radiance, pdf) = self.environment.sample(pick, Vec2::new(u, v));
            LightSample { direction, target: None, radiance, pdf, delta: false }
        };
        chosen.pdf /= kinds as f32;
        (chosen.pdf > 0.0).then_some(chosen)
    }

    fn sample_punctual(&self, from: Vec3, pick: f32) -> Option<LightSample> {
        let lights = &self.scene.lights;
        let index = ((pick * lights.len() as f32) as usize).min(lights.len() - 1);
        let pdf = 1.0 / lights.len() as f32;
        let (position, intensity, range, cone) = match lights[index] {
            Light::Directional { direction, irradiance } => {
                let direction = -direction.normalize_or(DVec3::NEG_Z).as_vec3();
                let radiance = Vec3::from(irradiance);
                return Some(LightSample { direction, target: None, radiance, pdf, delta: true });
            }
            Light::Point { position, intensity, range } => (position, intensity, range, None),
            Light::Spot { position, direction, intensity, range, inner_cone, outer_cone } => {
                let (inner, outer) = (f64::from(inner_cone).cos(), f64::from(outer_cone).cos());
                let scale = 1.0 / (inner - outer).max(0.001);
                let axis = direction.normalize_or(DVec3::NEG_Z).as_vec3();
                (position, intensity, range, Some((axis, scale as f32, (-outer * scale) as f32)))
            }
        };
        let position = (position - self.frame_origin()).as_vec3();
        let towards = position - from;
        let squared = towards.length_squared();
        if !(squared > 0.0) {
            return None;
        }
        let distance = squared.sqrt();
        let direction = towards / distance;
        let ratio = distance / range;
        let mut window = (1.0 - ratio * ratio * ratio * ratio).clamp(0.0, 1.0);
        if let Some((axis, scale, offset)) = cone {
            let inside = (axis.dot(-direction) * scale + offset).clamp(0.0, 1.0);
            window *= inside * inside;
        }
        let radiance = Vec3::from(intensity) * (window / squared);
        Some(LightSample { direction, target: Some(position), radiance, pdf, delta: true })
    }

    fn sample_emissive(&self, from: Vec3, pick: f32, place: Vec2) -> Option<LightSample> {
        let entry = search(&self.lights.cumulative, pick);
        let primitive = self.lights.primitives[entry];
        let root = place.x.sqrt();
        let barycentrics = Vec2::new(root * (1.0 - place.y), root * place.y);
        let corners = self.vertices(primitive);
        let (position, error) = triangle_point(barycentric_weights(barycentrics), corners);
        let towards = position - from;
        let squared = towards.length_squared();
        if !(squared > 0.0) {
            return None;
        }
        let distance = squared.sqrt();
        let direction = towards / distance;
        let (normal, twice_area) = triangle_normal(corners[1] - corners[0], corners[2] - corners[0]);
        let pdf = share(&self.lights.cumulative, entry) * area_pdf(normal, twice_area, direction, distance);
        if !(pdf > 0.0) {
            return None;
        }
        let counter_clockwise = normal.dot(direction) < 0.0;
        let front = counter_clockwise != self.draw_of(primitive).mirrored;
        let radiance = self.emission_at(primitive, barycentrics, front);
        let target = Some(spawn_position(position, error, normal, -direction));
        Some(LightSample { direction, target, radiance, pdf, delta: false })
    }

    /// 1/sr with which [`PosedScene::light_sample`] chooses `position` on `primitive` from `origin`.
    pub fn light_pdf_emitter(&self, primitive: u32, origin: Vec3, position: Vec3) -> f32 {
        let draw = self.draw_of_index(primitive);
        let Some(Some(first)) = self.lights.first_of_draw.get(draw) else { return 0.0 };
        let entry = (first + primitive - self.draws[draw].first_triangle) as usize;
        let corners = self.vertices(primitive);
        let towards = position - origin;
        let distance = towards.length();
        if !(distance > 0.0) {
            return 0.0;
        }
        let (normal, twice_area) = triangle_normal(corners[1] - corners[0], corners[2] - corners[0]);
        let density = area_pdf(normal, twice_area, towards / distance, distance);
        share(&self.lights.cumulative, entry) * density / self.light_kind_count() as f32
    }

    /// 1/sr with which [`PosedScene::light_sample`] chooses the environment in `direction`.
    pub fn environment_pdf(&self, direction: Vec3) -> f32 {
        if !self.environment.is_sampled() {
            return 0.0;
        }
        self.environment.pdf(direction) / self.light_kind_count() as f32
    }

    /// W/(sr m^2) from outside against the unit `direction`.
    pub fn environment_radiance(&self, direction: Vec3) -> Vec3 {
        self.environment.radiance(direction)
    }
}
