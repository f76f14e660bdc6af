//! Points and normals of posed triangles.

use glam::{Vec2, Vec3};

/// Bound gamma_7 of pbrt: the relative error of a sum of three products and the weights' own error.
const POSITION_ERROR_FACTOR: f32 = 4.172_326_9e-7;

/// Returns the weights of the three vertices from those of vertices 1 and 2.
pub fn barycentric_weights(barycentrics: Vec2) -> Vec3 {
    Vec3::new(1.0 - barycentrics.x - barycentrics.y, barycentrics.x, barycentrics.y)
}

/// Returns a point of the triangle and a bound of its error along each axis, metres.
pub fn triangle_point(weights: Vec3, [a, b, c]: [Vec3; 3]) -> (Vec3, f32) {
    let (from_a, from_b, from_c) = (weights.x * a, weights.y * b, weights.z * c);
    let magnitude = from_a.abs() + from_b.abs() + from_c.abs();
    (from_a + from_b + from_c, POSITION_ERROR_FACTOR * magnitude.max_element())
}

/// Returns the unit normal of the counter-clockwise side and twice the area, from two edges; zero if there is
/// no area.
pub fn triangle_normal(ab: Vec3, ac: Vec3) -> (Vec3, f32) {
    let scale = ab.abs().max(ac.abs()).max_element();
    if !(scale > 0.0) {
        return (Vec3::ZERO, 0.0);
    }
    let normal = (ab / scale).cross(ac / scale);
    let size = normal.length();
    if !(size > 0.0) {
        return (Vec3::ZERO, 0.0);
    }
    (normal / size, size * scale * scale)
}

/// Returns the weights of vertices 1 and 2 of a point of a triangle's plane.
pub fn barycentrics(point: Vec3, [a, b, c]: [Vec3; 3]) -> Vec2 {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let squared = normal.length_squared();
    let weights = Vec2::new((point - a).cross(ac).dot(normal), ab.cross(point - a).dot(normal));
    if squared > 0.0 { weights / squared } else { Vec2::ZERO }
}
