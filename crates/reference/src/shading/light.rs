//! Directions chosen by the lights, and the density with which they would choose a given one.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, Vec2, Vec3};
use rasray_scene::{AlphaMode, Light};

use super::{
    Ray, Surface, attributes,
    environment::{cumulative_shares, search, share},
    light_table::LightTable,
    luminance,
    posed::{Draw, PosedScene},
    spawn::{spawn_position, spawn_ray, spawn_segment},
    texture::Use,
    triangle::{barycentric_weights, triangle_normal, triangle_point},
};

/// Largest number of parts per side into which a triangle is cut to sample its texels.
const MOST_PARTS: f64 = 128.0;
/// Least probability of a kind of light that exists, before the sum is normalised to 1.
const LEAST_KIND: f64 = 0.1;

/// Direction chosen by the lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit direction from the surface to the light.
    pub direction: Vec3,
    /// End of the shadow segment; `None` for lights that are infinitely far away.
    pub target: Option<Vec3>,
    /// Arriving radiance, W/(sr m^2); for delta lights the irradiance across the direction, W/m^2.
    pub radiance: Vec3,
    /// Density including the choice of the light, 1/sr; for delta lights the probability of the choice.
    pub pdf: f32,
    /// True if the light has no extent.
    pub delta: bool,
}

impl LightSample {
    /// Returns the ray that tests if the surface sees the sample; `None` if nothing can lie between.
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
            let sides = if material.double_sided { 2.0 } else { 1.0 };
            let opacity = match material.alpha_mode {
                AlphaMode::Blend => f64::from(material.base_color[3].clamp(0.0, 1.0)),
                AlphaMode::Opaque | AlphaMode::Mask { .. } => 1.0,
            };
            let radiosity =
                PI * f64::from(luminance(Vec3::from(material.emission)).max(0.0)) * sides * opacity;
            if material.unlit || !(radiosity > 0.0) {
                first_of_draw.push(None);
                continue;
            }
            first_of_draw.push(Some(primitives.len() as u32));
            let count = posed.mesh(draw).triangle_count() as u32;
            for primitive in draw.first_triangle..draw.first_triangle + count {
                let [a, b, c] =
                    posed.vertices(primitive).map(|corner| DVec3::from(corner.to_array().map(f64::from)));
                let area = 0.5 * (b - a).cross(c - a).length();
                let power = area * radiosity * glow_share(posed, draw, primitive);
                primitives.push(primitive);
                powers.push(if power.is_finite() { power } else { 0.0 });
            }
        }
        let (total, cumulative) = cumulative_shares(&powers);
        let mut table = if total > 0.0 {
            Self { primitives, cumulative, first_of_draw, ..Self::default() }
        } else {
            Self::default()
        };
        let disk = disk(posed);
        let punctual: Vec<f64> = posed.scene.lights.iter().map(|light| punctual_power(light, disk)).collect();
        let (punctual_power, punctual) = cumulative_shares(&punctual);
        table.kinds = kind_shares([
            (!punctual.is_empty()).then_some(punctual_power),
            (!table.primitives.is_empty()).then_some(total),
            posed.environment.is_sampled().then_some(posed.environment.irradiance() * disk),
        ]);
        table.punctual = punctual;
        table
    }
}

/// Returns the mean over the triangle of the emission texture, by the luminance of the factor times it:
/// texels at the centroids of n by n parts.
fn glow_share(posed: &PosedScene<'_>, draw: &Draw, primitive: u32) -> f64 {
    let material = posed.material(draw);
    let Some(reference) = &material.emission_texture else { return 1.0 };
    let mesh = posed.mesh(draw);
    let [a, b, c] = posed.mesh_vertices(draw, primitive).map(|vertex| {
        let uv = attributes::uv_at(mesh, reference.uv_set, vertex).as_dvec2();
        let [u, v] = reference.uv_transform.map(|row| {
            let [x, y, one] = row.map(f64::from);
            x * uv.x + y * uv.y + one
        });
        DVec2::new(u, v)
    });
    let size = posed.textures.size(reference);
    let parts = (0.5 * (b - a).perp_dot(c - a).abs() * size.x * size.y).sqrt().ceil();
    let parts = if parts.is_finite() { parts.clamp(1.0, MOST_PARTS) as u32 } else { 1 };
    let factor = Vec3::from(material.emission);
    let mut sum = 0.0;
    for row in 0..parts {
        for column in 0..2 * (parts - row) - 1 {
            let third = if column % 2 == 0 { 1.0 } else { 2.0 } / 3.0;
            let across = (f64::from(column / 2) + third) / f64::from(parts);
            let along = (f64::from(row) + third) / f64::from(parts);
            let uv = a + (b - a) * across + (c - a) * along;
            sum += f64::from(luminance(factor * posed.textures.nearest(reference, Use::Color, uv)));
        }
    }
    sum / f64::from(parts * parts) / f64::from(luminance(factor))
}

/// Returns the luminous power, W; `disk` is the largest projected area of all triangles, m^2.
fn punctual_power(light: &Light, disk: f64) -> f64 {
    let bright = |color: [f32; 3]| f64::from(luminance(Vec3::from(color)).max(0.0));
    match *light {
        Light::Point { intensity, .. } => 4.0 * PI * bright(intensity),
        Light::Directional { irradiance, .. } => disk * bright(irradiance),
        Light::Spot { intensity, inner_cone, outer_cone, .. } => {
            let cosine = 0.5 * (f64::from(inner_cone).cos() + f64::from(outer_cone).cos());
            2.0 * PI * (1.0 - cosine) * bright(intensity)
        }
    }
}

/// Returns the corners of the box of all triangles, metres relative to the frame origin; without triangles
/// the upper corner is below the lower one.
pub(super) fn bounds(posed: &PosedScene<'_>) -> [DVec3; 2] {
    let (mut lower, mut upper) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for index in posed.indices() {
        let position = DVec3::from(posed.positions()[*index as usize].map(f64::from));
        if position.is_finite() {
            (lower, upper) = (lower.min(position), upper.max(position));
        }
    }
    [lower, upper]
}

/// Returns the area of the circle around the box of all triangles, m^2.
fn disk(posed: &PosedScene<'_>) -> f64 {
    let [lower, upper] = bounds(posed);
    if lower.x <= upper.x { 0.25 * PI * (upper - lower).length_squared() } else { 0.0 }
}

/// Returns the probabilities of the kinds from their powers; `None` stands for a kind that does not exist.
fn kind_shares(powers: [Option<f64>; 3]) -> [f32; 3] {
    let present = powers.iter().flatten().count();
    let total: f64 = powers.iter().flatten().sum();
    let share = |power: f64| if total > 0.0 { power / total } else { 1.0 / present as f64 };
    let weights = powers.map(|power| power.map_or(0.0, |power| share(power).max(LEAST_KIND)));
    let sum: f64 = weights.iter().sum();
    let mut shares = weights.map(|weight| if present > 0 { (weight / sum) as f32 } else { 0.0 });
    if let Some(last) = powers.iter().rposition(Option::is_some) {
        shares[last] = 1.0 - shares[..last].iter().sum::<f32>();
    }
    shares
}

/// Returns the factor of the cosine to the direction of a spot, and the number to add after it.
pub(super) fn cone(inner: f32, outer: f32) -> [f32; 2] {
    let (inner, outer) = (f64::from(inner).cos(), f64::from(outer).cos());
    let scale = 1.0 / (inner - outer).max(0.001);
    [scale as f32, (-outer * scale) as f32]
}

/// Returns the share of its light that a light without extent sends as far as `distance`, besides the square
/// of the distance.
pub fn window(distance: f32, range: f32) -> f32 {
    let ratio = distance / range;
    (1.0 - ratio * ratio * ratio * ratio).clamp(0.0, 1.0)
}

/// Returns the density, 1/sr, of a point uniform on a triangle, as seen along the unit `direction` from
/// `distance` away.
fn area_pdf(normal: Vec3, twice_area: f32, direction: Vec3, distance: f32) -> f32 {
    let projected = 0.5 * twice_area * normal.dot(direction).abs();
    if projected > 0.0 { distance * distance / projected } else { 0.0 }
}

impl PosedScene<'_> {
    /// Chooses a direction from the surface to a light; the random numbers choose kind, light or row, and
    /// position. `None` if no light can arrive.
    pub fn light_sample(&self, surface: &Surface, [kind, pick, u, v]: [f32; 4]) -> Option<LightSample> {
        let [punctual, emissive, environment] = self.lights.kinds;
        let (share, mut chosen) = if kind < punctual {
            (punctual, self.sample_punctual(surface.position, pick)?)
        } else if kind < punctual + emissive {
            (emissive, self.sample_emissive(surface.position, pick, Vec2::new(u, v))?)
        } else if environment > 0.0 {
            let (direction, radiance, pdf) = self.environment.sample(pick, Vec2::new(u, v));
            (environment, LightSample { direction, target: None, radiance, pdf, delta: false })
        } else {
            return None;
        };
        chosen.pdf *= share;
        (chosen.pdf > 0.0).then_some(chosen)
    }

    fn sample_punctual(&self, from: Vec3, pick: f32) -> Option<LightSample> {
        let index = search(&self.lights.punctual, pick);
        let pdf = share(&self.lights.punctual, index);
        if !(pdf > 0.0) {
            return None;
        }
        let (position, intensity, range, cone) = match self.scene.lights[index] {
            Light::Directional { direction, irradiance } => {
                let direction = -direction.normalize_or(DVec3::NEG_Z).as_vec3();
                let radiance = Vec3::from(irradiance);
                return Some(LightSample { direction, target: None, radiance, pdf, delta: true });
            }
            Light::Point { position, intensity, range } => (position, intensity, range, None),
            Light::Spot { position, direction, intensity, range, inner_cone, outer_cone } => {
                let axis = direction.normalize_or(DVec3::NEG_Z).as_vec3();
                let [scale, offset] = cone(inner_cone, outer_cone);
                (position, intensity, range, Some((axis, scale, offset)))
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
        let mut window = window(distance, range);
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

    /// Returns the density, 1/sr, with which [`PosedScene::light_sample`] chooses `position` on `primitive`
    /// from `origin`.
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
        share(&self.lights.cumulative, entry) * density * self.lights.kinds[1]
    }

    /// Returns the density, 1/sr, with which [`PosedScene::light_sample`] chooses the environment in
    /// `direction`.
    pub fn environment_pdf(&self, direction: Vec3) -> f32 {
        if !self.environment.is_sampled() {
            return 0.0;
        }
        self.environment.pdf(direction) * self.lights.kinds[2]
    }

    /// Returns the radiance from outside against the unit `direction`, W/(sr m^2).
    pub fn environment_radiance(&self, direction: Vec3) -> Vec3 {
        self.environment.radiance(direction)
    }
}
