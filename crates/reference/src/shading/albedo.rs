//! Share of light that a rough surface of facets reflects in one scattering, as polynomials fitted to the
//! integrals, and the share of the rest that returns after several scatterings. After Kulla and Conty 2017.

use glam::{Vec3, Vec4};

/// Alpha below which the loss is left out.
pub const LOSSLESS_ALPHA: f32 = 0.01;
/// Mean of (1 - x)^5 over the hemisphere, weighted by the cosine x.
pub const SCHLICK_MEAN: f32 = 1.0 / 21.0;

/// Coefficients of the loss in (x, alpha): rows by falling power of x, columns by growing power of alpha.
const LOSS: [[f32; 4]; 6] = [
    [10.4089, -34.9062, -22.5905, 128.757],
    [-25.4505, 85.6628, -36.073, -132.2337],
    [20.1671, -71.3731, 75.614, 33.4621],
    [-6.3211, 25.4213, -34.2336, 1.2643],
    [1.1905, -4.1038, 9.3337, -2.7935],
    [-0.0499, 0.2517, -0.3649, 0.1771],
];

/// Coefficients in (x, roughness): rows by falling power of x; first the constant, then powers 1 to 4 of the
/// roughness.
const SCHLICK: [(f32, [f32; 4]); 5] = [
    (10.3298, [-227.1496, 687.7062, -652.0933, 164.025]),
    (-28.0122, [414.2671, -1340.5924, 1489.9714, -504.7886]),
    (34.8028, [-279.1108, 782.5056, -891.4739, 331.2746]),
    (-0.0889, [54.3496, -155.0691, 175.8718, -67.7776]),
    (-18.15, [60.1864, -86.1476, 58.8347, -15.6502]),
];

/// Returns the share of the light lost by facets that absorb nothing, seen under `cosine`.
pub fn loss(cosine: f32, alpha: f32) -> f32 {
    if alpha < LOSSLESS_ALPHA {
        return 0.0;
    }
    let x = cosine / (cosine + alpha);
    let p = LOSS.into_iter().fold(Vec4::ZERO, |p, row| p * x + Vec4::from(row));
    let squared = alpha * alpha;
    ((1.0 - x) * p.dot(Vec4::new(1.0, alpha, squared, squared * alpha))).clamp(0.0, 1.0)
}

/// Returns the mean of [`loss`] over the hemisphere, weighted by the cosine.
pub fn loss_mean(alpha: f32) -> f32 {
    if alpha < LOSSLESS_ALPHA {
        return 0.0;
    }
    let r = alpha.sqrt();
    (r * (0.0204 + r * (-0.4171 + r * (2.5315 + r * (-1.7591 + 0.2196 * r))))).max(1.0e-4)
}

/// Returns the share of light that facets send back which reflect (1 - x)^5 under their own cosine x; `loss`
/// is the value of [`loss`].
pub fn schlick(cosine: f32, alpha: f32, loss: f32) -> f32 {
    let x = cosine / (cosine + alpha);
    let r = alpha.sqrt();
    let (q, p) = SCHLICK
        .into_iter()
        .fold((0.0, Vec4::ZERO), |(q, p), (constant, row)| (q * x + constant, p * x + Vec4::from(row)));
    let rough = alpha * (q + p.dot(Vec4::new(r, alpha, alpha * r, alpha * alpha)));
    let rest = (1.0 - cosine).clamp(0.0, 1.0);
    let squared = rest * rest;
    (squared * squared * rest * (1.0 - loss) + rough).clamp(0.0, 1.0 - loss)
}

/// Returns the mean of [`schlick`] over the hemisphere, weighted by the cosine.
pub fn schlick_mean(alpha: f32) -> f32 {
    let r = alpha.sqrt();
    SCHLICK_MEAN + r * (0.01992 + r * (-0.26779 + r * (0.31214 - 0.10745 * r)))
}

/// Returns the share of the lost light that comes back where a facet reflects `facet` on average.
pub fn returned(facet: Vec3, loss_mean: f32) -> Vec3 {
    facet * facet * (1.0 - loss_mean) / (Vec3::ONE - facet * loss_mean)
}
