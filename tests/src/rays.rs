//! Rays for tests.

use rasray_ads::Ray;

use crate::random::Random;

/// Makes a ray from one point to another, which it reaches at t = 1.
pub fn towards(origin: [f32; 3], target: [f32; 3]) -> Ray {
    Ray::new(origin, std::array::from_fn(|axis| target[axis] - origin[axis]))
}

/// Makes a ray from one point to another that ends there.
pub fn segment(origin: [f32; 3], target: [f32; 3]) -> Ray {
    Ray { t_max: 1.0, ..towards(origin, target) }
}

/// Makes rays of all directions from near the eye in the origin.
pub fn around_the_eye() -> Vec<Ray> {
    Random::new(3).rays(500, -0.5, 0.5)
}

/// Returns the direction of an axis: x, y, z, then their opposites, again and again.
pub fn along_axis(number: usize) -> [f32; 3] {
    let mut direction = [0.0; 3];
    direction[number % 3] = if (number / 3).is_multiple_of(2) { 1.0 } else { -1.0 };
    direction
}
