//! Surface that light samples use in place of a smooth triangle.

use glam::Vec3;

use super::{
    Surface,
    posed::PosedScene,
    triangle::{barycentric_weights, barycentrics},
};

impl PosedScene<'_> {
    /// Returns the surface on the smooth shape that the normals of its triangle's vertices suggest, as `o`
    /// sees it; the same surface if there is no such shape.
    pub(crate) fn terminator_surface(&self, surface: &Surface, o: Vec3) -> Surface {
        let Some(primitive) = surface.primitive.filter(|_| !(surface.transmission > 0.0)) else {
            return *surface;
        };
        let draw = self.draw_of(primitive);
        let Some(normals) = &draw.normals else { return *surface };
        let corners = self.vertices(primitive);
        let weights = barycentric_weights(barycentrics(surface.position, corners)).to_array();
        let facing = if surface.front { 1.0 } else { -1.0 };
        let (mut smoothed, mut offset) = (Vec3::ZERO, Vec3::ZERO);
        for ((vertex, corner), weight) in
            self.mesh_vertices(draw, primitive).into_iter().zip(corners).zip(weights)
        {
            let normal = facing * normals[vertex];
            smoothed += weight * normal;
            offset -= weight * (surface.position - corner).dot(normal).min(0.0) * normal;
        }
        let size = smoothed.length();
        if !(size > 0.0) || !(smoothed.dot(surface.geometric_normal) > 0.0) || !(smoothed.dot(o) > 0.0) {
            return *surface;
        }
        let geometric_normal = smoothed / size;
        let normal =
            if surface.normal.dot(geometric_normal) < 0.0 { geometric_normal } else { surface.normal };
        let (position, position_error) = (surface.position + offset, 2.0 * surface.position_error);
        self.with_anisotropy(Surface { position, position_error, geometric_normal, normal, ..*surface })
    }
}
