//! Direction in which the facets of a surface are rougher, and the strength of this anisotropy.

use glam::{Vec2, Vec4Swizzles};

use super::{
    Surface,
    posed::PosedScene,
    surface::Textured,
    texture::Use,
    triangle::{barycentric_weights, barycentrics},
};

impl PosedScene<'_> {
    /// Returns the surface with its anisotropy: none if the triangle is not known, or its tangents have no
    /// source.
    pub(super) fn with_anisotropy(&self, surface: Surface) -> Surface {
        let isotropic = Surface { anisotropy: 0.0, ..surface };
        let Some(primitive) = surface.primitive else { return isotropic };
        let draw = self.draw_of(primitive);
        let material = self.material(draw);
        if !(material.anisotropy > 0.0) {
            return isotropic;
        }
        let corners = self.vertices(primitive);
        let textured = Textured {
            posed: self,
            draw,
            triangle: self.mesh_vertices(draw, primitive),
            weights: barycentric_weights(barycentrics(surface.position, corners)),
            twice_area: 0.0,
            footprint: 0.0,
        };
        let reference = material.anisotropy_texture.as_ref();
        let uv_set = material.normal_texture.as_ref().or(reference).map_or(0, |reference| reference.uv_set);
        let tangent = textured.tangent(uv_set, corners[1] - corners[0], corners[2] - corners[0]);
        // Tangents refer to the front.
        let normal = if surface.front { surface.normal } else { -surface.normal };
        let along = tangent.xyz() - normal * normal.dot(tangent.xyz());
        if !(along.length_squared() > 0.0) {
            return isotropic;
        }
        let along = along / along.length();
        let across = normal.cross(along) * tangent.w;
        let (mut direction, mut strength) = (Vec2::X, material.anisotropy);
        if reference.is_some() {
            let texel = textured.texel(reference, Use::Linear);
            direction = texel.xy() * 2.0 - 1.0;
            strength *= texel.z;
        }
        let (sine, cosine) = material.anisotropy_rotation.sin_cos();
        let rougher = along * (cosine * direction.x - sine * direction.y)
            + across * (sine * direction.x + cosine * direction.y);
        Surface { anisotropy: strength.clamp(0.0, 1.0), rougher, ..surface }
    }
}
