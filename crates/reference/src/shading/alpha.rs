//! Alpha tests, which decide if a point of a triangle exists.

use glam::Vec2;
use rasray_scene::AlphaMode;

use super::{
    attributes,
    posed::{Draw, PosedScene},
    texture::Use,
    triangle::barycentric_weights,
};

impl PosedScene<'_> {
    /// Returns the alpha of the base colour at level 0.
    pub(super) fn alpha_at(&self, draw: &Draw, primitive: u32, barycentrics: Vec2) -> f32 {
        let (material, mesh) = (self.material(draw), self.mesh(draw));
        let triangle = self.mesh_vertices(draw, primitive);
        let weights = barycentric_weights(barycentrics);
        let reference = material.base_color_texture.as_ref();
        let uv = attributes::uv(mesh, reference.map_or(0, |reference| reference.uv_set), triangle, weights);
        let texel = self.textures.sample(reference, Use::Color, uv, 0.0);
        material.base_color[3] * texel.w * attributes::color(mesh, triangle, weights).w
    }

    /// Applies the alpha test: `barycentrics` are the weights of vertices 1 and 2. True for every point of a
    /// draw that is not masked.
    pub fn alpha_accepts(&self, primitive: u32, barycentrics: [f64; 2]) -> bool {
        let draw = self.draw_of(primitive);
        let AlphaMode::Mask { cutoff } = self.material(draw).alpha_mode else { return true };
        self.alpha_at(draw, primitive, Vec2::from(barycentrics.map(|weight| weight as f32))) >= cutoff
    }
}
