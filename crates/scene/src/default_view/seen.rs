//! First hits of a camera's pixels.

use glam::DVec3;

use super::bounds;
use super::sight::Sight;
use crate::{Camera, Projection, Scene};

/// Returns the instance at the middle of each pixel, rows from the top; `None` where a ray leaves the scene.
/// The camera is a perspective one and stands within the bounds of the scene, which has few enough triangles
/// for [`Sight`].
pub(crate) fn seen_instances(scene: &Scene, camera: &Camera, [width, height]: [u32; 2]) -> Vec<Option<u32>> {
    debug_assert!(matches!(camera.projection, Projection::Perspective { .. }));
    let Some((low, high)) = bounds(scene) else { return Vec::new() };
    let Some(sight) = Sight::new(scene, low, high) else { return Vec::new() };
    let [half_width, half_height] = camera.half_extents(width, height);
    let place = |index: u32, count: u32| (2.0 * f64::from(index) + 1.0) / f64::from(count) - 1.0;
    let eye = camera.world_from_camera.translation;
    let pixels = (0..height).flat_map(|row| (0..width).map(move |column| (row, column)));
    pixels
        .map(|(row, column)| {
            let toward =
                DVec3::new(half_width * place(column, width), -half_height * place(row, height), -1.0);
            sight.first(eye, camera.world_from_camera.matrix3 * toward).map(|hit| hit.instance)
        })
        .collect()
}
