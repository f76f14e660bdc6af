//! Scene, rays and comparison with which options and motions are tested.

use rasray_ads::Ray;

use super::{Answers, first_difference};
use crate::random::Random;
use crate::rays::along_axis;
use crate::shapes::{Triangle, layers_and_sphere, with_twins};
use crate::tier::is_full;

/// Centre of views.
pub const EYE: [f32; 3] = [0.125, -0.25, 0.375];

/// Returns the number of rays per comparison, by tier.
pub fn ray_count() -> usize {
    if is_full() { 2000 } else { 400 }
}

/// Makes scattered layers, a sphere, and a room around them. `twins` adds triangles that coincide with
/// others.
pub fn scene(twins: bool) -> Vec<Triangle> {
    let triangles = layers_and_sphere(6);
    if twins { with_twins(triangles) } else { triangles }
}

/// Makes rays of every kind.
pub fn rays(count: usize) -> Vec<Ray> {
    let mut random = Random::new(11);
    (0..count)
        .map(|index| {
            let origin = random.point(-6.0, 6.0);
            match index % 8 {
                // This ray goes along an axis, with a limited range, from the views' centre.
                0 => Ray::new(origin, along_axis(index / 8)),
                1 => Ray { t_max: 2.0, t_min: 0.5, ..Ray::new(origin, random.direction()) },
                2 => Ray::new(EYE, random.direction()),
                _ => Ray::new(origin, random.direction()),
            }
        })
        .collect()
}

/// Makes rays in general position, for scenes that are moved about.
pub fn general_rays(count: usize) -> Vec<Ray> {
    Random::new(23).rays(count, -6.0, 6.0)
}

/// Asserts that two answers to the same rays are equal to the bit.
///
/// # Panics
/// They differ: the first ray that differs is named.
pub fn assert_same(what: &str, rays: &[Ray], expected: &Answers, found: &Answers) {
    if let Some(ray) = first_difference(expected, found) {
        panic!(
            "{what}: ray {ray} ({:?}) hits {:x?} (occluded: {}), and {:x?} (occluded: {}) without the change",
            rays[ray], found.closest[ray], found.occluded[ray], expected.closest[ray], expected.occluded[ray]
        );
    }
}
