//! Ward's lobe in place of GGX, in a frame whose z axis is the normal of the facets.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

/// Returns the distribution of half vectors, 1/sr.
pub fn ward_distribution(h: Vec3, alpha: Vec2) -> f32 {
    // At larger angles the Gaussian is 0.
    if !(h.z > 1.0e-4) {
        return 0.0;
    }
    let slope = h.truncate() / (alpha * h.z);
    (-slope.length_squared()).exp() / (PI * alpha.x * alpha.y * h.z.powi(4))
}

/// Returns a half vector, with the density D(h) h.z.
pub fn ward_half(alpha: Vec2, random: Vec2) -> Vec3 {
    let radius = (-(1.0 - random.y).ln()).sqrt();
    let (sine, cosine) = (2.0 * PI * random.x).sin_cos();
    (alpha * radius * Vec2::new(cosine, sine)).extend(1.0).normalize()
}
