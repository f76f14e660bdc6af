//! Building blocks of scattering, in a frame whose z axis is the shading normal.

use std::f32::consts::PI;

use glam::{Mat3, Vec2, Vec3};

/// Returns a basis with the columns tangent, bitangent, normal. After Duff et al. 2017.
pub fn basis_around(normal: Vec3) -> Mat3 {
    let turn = if normal.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (turn + normal.z);
    let b = normal.x * normal.y * a;
    Mat3::from_cols(
        Vec3::new(1.0 + turn * normal.x * normal.x * a, turn * b, -turn * normal.x),
        Vec3::new(b, turn + normal.y * normal.y * a, -normal.y),
        normal,
    )
}

/// Returns a direction with the density cosine / pi over the upper hemisphere.
pub fn cosine_hemisphere(random: Vec2) -> Vec3 {
    let radius = random.x.sqrt();
    let azimuth = 2.0 * PI * random.y;
    Vec3::new(radius * azimuth.cos(), radius * azimuth.sin(), (1.0 - random.x).max(0.0).sqrt())
}

/// Returns the GGX distribution of facet normals, 1/sr.
pub fn ggx_distribution(h: Vec3, alpha: f32) -> f32 {
    let slope = (h.x * h.x + h.y * h.y) / (alpha * alpha) + h.z * h.z;
    1.0 / (PI * alpha * alpha * slope * slope)
}

fn ggx_root(cosine: f32, alpha: f32) -> f32 {
    (alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine).sqrt()
}

/// Returns G(o, i) / (4 cos o cos i) for positive cosines.
pub fn ggx_visibility(cosine_o: f32, cosine_i: f32, alpha: f32) -> f32 {
    0.5 / (cosine_o * ggx_root(cosine_i, alpha) + cosine_i * ggx_root(cosine_o, alpha))
}

/// Returns G1(o) / (4 cos o).
pub fn ggx_visibility_one(cosine_o: f32, alpha: f32) -> f32 {
    0.5 / (cosine_o + ggx_root(cosine_o, alpha))
}

/// Returns the [`ggx_distribution`] of facets with different alphas along x and y.
pub fn ggx_distribution_along(h: Vec3, alpha: Vec2) -> f32 {
    let slope = (h.truncate() / alpha).extend(h.z).length_squared();
    1.0 / (PI * alpha.x * alpha.y * slope * slope)
}

fn ggx_root_along(direction: Vec3, alpha: Vec2) -> f32 {
    (alpha * direction.truncate()).extend(direction.z).length()
}

pub fn ggx_visibility_along(o: Vec3, i: Vec3, alpha: Vec2) -> f32 {
    0.5 / (o.z.abs() * ggx_root_along(i, alpha) + i.z.abs() * ggx_root_along(o, alpha))
}

pub fn ggx_visibility_one_along(o: Vec3, alpha: Vec2) -> f32 {
    0.5 / (o.z.abs() + ggx_root_along(o, alpha))
}

/// Returns a facet normal visible from o, with the density G1(o) D(h) max(0, o.h) / cos o. There is one alpha
/// for each of x and y.
pub fn ggx_visible_normal(o: Vec3, alpha: Vec2, random: Vec2) -> Vec3 {
    let stretched = Vec3::new(alpha.x * o.x, alpha.y * o.y, o.z).normalize();
    let azimuth = 2.0 * PI * random.x;
    let z = (1.0 - random.y) * (1.0 + stretched.z) - stretched.z;
    let sine = (1.0 - z * z).clamp(0.0, 1.0).sqrt();
    let h = Vec3::new(sine * azimuth.cos(), sine * azimuth.sin(), z) + stretched;
    Vec3::new(alpha.x * h.x, alpha.y * h.y, h.z.max(1.0e-7)).normalize()
}

/// Returns (1 - cosine)^5.
pub fn fresnel_power(cosine: f32) -> f32 {
    let rest = (1.0 - cosine).clamp(0.0, 1.0);
    let squared = rest * rest;
    squared * squared * rest
}

/// Returns the Rec. 709 luminance of a linear colour.
pub fn luminance(color: Vec3) -> f32 {
    color.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}
