//! The scene, the rays and the comparison that options and motions are tried with.

use rasray_ads::Ray;

use super::{Answers, first_difference};
use crate::hard_cases::{Scale, case};
use crate::random::Random;
use crate::shapes::{Triangle, closed_box, sphere};
use crate::tier::is_full;

/// Where views are centred.
pub const EYE: [f32; 3] = [0.125, -0.25, 0.375];

/// Rays per comparison: in the full tier, and in every run.
pub fn ray_count() -> usize {
    if is_full() { 2000 } else { 400 }
}

/// Scattered layers, a sphere, and a room around them. `twins` adds triangles that coincide with others.
pub fn scene(twins: bool) -> Vec<Triangle> {
    let mut triangles = case("C4", Scale::QUICK).expect("the case exists").triangles;
    triangles.extend(sphere([-3.0, 0.5, -2.0], 1.5, 6));
    triangles.extend(closed_box([-10.0; 3], [10.0; 3]));
    if twins {
        triangles.extend(triangles.clone().into_iter().step_by(3));
    }
    triangles
}

/// Rays of every sort.
pub fn rays(count: usize) -> Vec<Ray> {
    let mut random = Random::new(11);
    (0..count)
        .map(|index| {
            let origin = random.point(-6.0, 6.0);
            match index % 8 {
                // Along an axis, with a limited range, from the views' centre.
                0 => {
                    let mut direction = [0.0; 3];
                    direction[index / 8 % 3] = if index / 24 % 2 == 0 { 1.0 } else { -1.0 };
                    Ray::new(origin, direction)
                }
                1 => Ray { t_max: 2.0, t_min: 0.5, ..Ray::new(origin, random.direction()) },
                2 => Ray::new(EYE, random.direction()),
                _ => Ray::new(origin, random.direction()),
            }
        })
        .collect()
}

/// Rays in general position, for scenes that are moved about.
pub fn general_rays(count: usize) -> Vec<Ray> {
    let mut random = Random::new(23);
    (0..count).map(|_| Ray::new(random.point(-6.0, 6.0), random.direction())).collect()
}

/// Asserts that two answers to the same rays are the same to the bit.
///
/// # Panics
/// They are not: the first ray that differs is named.
pub fn assert_same(what: &str, rays: &[Ray], expected: &Answers, found: &Answers) {
    if let Some(ray) = first_difference(expected, found) {
        panic!(
            "{what}: ray {ray} ({:?}) hits {:x?} (occluded: {}), and {:x?} (occluded: {}) without the change",
            rays[ray], found.closest[ray], found.occluded[ray], expected.closest[ray], expected.occluded[ray]
        );
    }
}
