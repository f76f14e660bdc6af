//! Surfaces: the data of a hit that shading reads.

use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};
use rasray_scene::{AlphaMode, TextureRef};

use super::{
    Ray, attributes,
    posed::{Draw, PosedScene},
    texture::Use,
    triangle::{barycentric_weights, triangle_normal, triangle_point},
};

/// Point of a surface that is shaded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Position, metres relative to the frame origin.
    pub position: Vec3,
    /// Bound of the error of `position` along each axis, metres.
    pub position_error: f32,
    /// Unit geometric normal, which faces the ray.
    pub geometric_normal: Vec3,
    /// Global triangle id; `None` for a synthetic surface without geometry.
    pub primitive: Option<u32>,
    /// Unit shading normal, on the side of the geometric normal.
    pub normal: Vec3,
    /// Base colour, linear.
    pub base_color: Vec3,
    /// Metalness in [0, 1].
    pub metallic: f32,
    /// Emitted radiance, W/(sr m^2).
    pub emission: Vec3,
    /// Perceptual roughness in [0, 1].
    pub roughness: f32,
    /// Strength of the additional roughness of facets along `rougher`, in [0, 1].
    pub anisotropy: f32,
    /// Direction in which facets are rougher, not normalised; read if there is anisotropy.
    pub rougher: Vec3,
    /// Transmission in [0, 1].
    pub transmission: f32,
    /// Index of refraction.
    pub ior: f32,
    /// Opacity; 1 unless the material blends.
    pub opacity: f32,
    /// Thickness, metres; 0 is a thin wall.
    pub thickness: f32,
    /// True if light that goes straight through the surface, a smooth thin wall, is followed separately:
    /// scattering leaves it out.
    pub is_pane: bool,
    /// True if the surface reflects by Ward's lobe where it lets no light through.
    pub is_ward: bool,
    /// Strength of the dielectric reflection.
    pub specular: f32,
    /// Colour of the dielectric reflection.
    pub specular_color: Vec3,
    /// True if the ray came from the counter-clockwise side.
    pub front: bool,
    /// Distance along the ray, metres.
    pub t: f32,
    /// Index into the scene's materials.
    pub material: Option<usize>,
}

impl Default for Surface {
    /// Makes a white diffuse surface at the frame origin that faces +z.
    fn default() -> Self {
        Self {
            position: Vec3::ZERO,
            position_error: 0.0,
            geometric_normal: Vec3::Z,
            primitive: None,
            normal: Vec3::Z,
            base_color: Vec3::ONE,
            metallic: 0.0,
            emission: Vec3::ZERO,
            roughness: 1.0,
            anisotropy: 0.0,
            rougher: Vec3::ZERO,
            transmission: 0.0,
            ior: 1.5,
            opacity: 1.0,
            thickness: 0.0,
            is_pane: false,
            is_ward: false,
            specular: 0.0,
            specular_color: Vec3::ONE,
            front: true,
            t: 0.0,
            material: None,
        }
    }
}

/// Triangle as seen by its textures.
pub(super) struct Textured<'a> {
    pub posed: &'a PosedScene<'a>,
    pub draw: &'a Draw,
    pub triangle: [usize; 3],
    pub weights: Vec3,
    pub twice_area: f32,
    pub footprint: f32,
}

impl Textured<'_> {
    pub fn texel(&self, reference: Option<&TextureRef>, usage: Use) -> Vec4 {
        let Some(reference) = reference else { return Vec4::ONE };
        let mesh = self.posed.mesh(self.draw);
        let uv = attributes::uv(mesh, reference.uv_set, self.triangle, self.weights);
        let area = if self.footprint > 0.0 { self.uv_area(reference.uv_set) } else { 0.0 };
        let level = self.posed.textures.level(Some(reference), area, self.footprint);
        self.posed.textures.sample(Some(reference), usage, uv, level)
    }

    fn uv_edges(&self, uv_set: u32) -> [Vec2; 2] {
        let mesh = self.posed.mesh(self.draw);
        let [a, b, c] = self.triangle.map(|vertex| attributes::uv_at(mesh, uv_set, vertex));
        [b - a, c - a]
    }

    fn uv_area(&self, uv_set: u32) -> f32 {
        let [ab, ac] = self.uv_edges(uv_set);
        if self.twice_area > 0.0 { (ab.x * ac.y - ab.y * ac.x).abs() / self.twice_area } else { 0.0 }
    }

    /// Returns the tangent along growing u, from the vertices or else from the texture coordinates.
    pub fn tangent(&self, uv_set: u32, ab: Vec3, ac: Vec3) -> Vec4 {
        let tangent = attributes::tangent(self.draw, self.triangle, self.weights);
        if tangent.xyz().length_squared() > 0.0 {
            return tangent;
        }
        let [u, v] = self.uv_edges(uv_set);
        let determinant = u.x * v.y - u.y * v.x;
        if determinant == 0.0 {
            return Vec4::ZERO;
        }
        // v grows downwards in images, so the bitangent points against it.
        let turn = if determinant < 0.0 { -1.0 } else { 1.0 };
        let mirrored = if self.draw.mirrored { 1.0 } else { -1.0 };
        ((ab * v.y - ac * u.y) * turn).extend(turn * mirrored)
    }
}

fn mapped_normal(normal: Vec3, tangent: Vec4, texel: Vec3, scale: f32) -> Vec3 {
    let along = tangent.xyz() - normal * normal.dot(tangent.xyz());
    if !(along.length_squared() > 0.0) {
        return normal;
    }
    let along = along / along.length();
    let across = normal.cross(along) * tangent.w;
    let local = (texel * 2.0 - 1.0) * Vec3::new(scale, scale, 1.0);
    let mapped = along * local.x + across * local.y + normal * local.z;
    if mapped.length_squared() > 0.0 { mapped / mapped.length() } else { normal }
}

/// Returns the shading normal on the side of the geometric normal. It may face away from the ray; facets then
/// lie around a bent normal that does not.
fn shading_normal(interpolated: Vec3, geometric_normal: Vec3) -> Vec3 {
    let squared = interpolated.length_squared();
    if !(squared > 0.0) {
        return geometric_normal;
    }
    let normal = interpolated / squared.sqrt();
    let aside = normal.dot(geometric_normal);
    if aside < 0.0 { normal - 2.0 * aside * geometric_normal } else { normal }
}

impl PosedScene<'_> {
    /// Returns the surface that `ray` hits at `t` metres on a triangle; `barycentrics` are the weights of
    /// vertices 1 and 2.
    pub fn surface(&self, ray: &Ray, t: f32, primitive: u32, barycentrics: Vec2) -> Surface {
        let draw = self.draw_of(primitive);
        let material = self.material(draw);
        let triangle = self.mesh_vertices(draw, primitive);
        let weights = barycentric_weights(barycentrics);
        let corners = self.vertices(primitive);
        let (position, position_error) = triangle_point(weights, corners);
        let (ab, ac) = (corners[1] - corners[0], corners[2] - corners[0]);
        let o = -ray.direction;
        let (mut normal, twice_area) = triangle_normal(ab, ac);
        if normal == Vec3::ZERO {
            normal = o;
        }
        let counter_clockwise = normal.dot(o) >= 0.0;
        let geometric_normal = if counter_clockwise { normal } else { -normal };
        let front = counter_clockwise != draw.mirrored;

        // The footprint is the smaller axis of the cone's ellipse.
        let footprint = ray.cone_width + ray.cone_spread * t;
        let textured = Textured { posed: self, draw, triangle, weights, twice_area, footprint };

        let mut interpolated = attributes::normal(draw, triangle, weights);
        // Attributes describe the front; for a ray from behind they are flipped.
        let facing = if front { 1.0 } else { -1.0 };
        if let Some(reference) = &material.normal_texture {
            let whole = interpolated.length_squared() > 0.0;
            let outside = if whole { interpolated.normalize() } else { geometric_normal * facing };
            let tangent = textured.tangent(reference.uv_set, ab, ac);
            let texel = textured.texel(Some(reference), Use::Linear).xyz();
            interpolated = mapped_normal(outside, tangent, texel, material.normal_scale);
        }

        let texel = textured.texel(material.base_color_texture.as_ref(), Use::Color);
        let base_color =
            Vec4::from(material.base_color) * texel * attributes::color(self.mesh(draw), triangle, weights);
        let blends = material.alpha_mode == AlphaMode::Blend;
        let mut surface = Surface {
            position,
            position_error,
            geometric_normal,
            primitive: Some(primitive),
            normal: shading_normal(interpolated * facing, geometric_normal),
            base_color: Vec3::ZERO,
            opacity: if blends { base_color.w.clamp(0.0, 1.0) } else { 1.0 },
            front,
            t,
            material: Some(draw.material),
            ..Surface::default()
        };
        if material.unlit {
            surface.emission = base_color.xyz();
            return surface;
        }
        surface.base_color = base_color.xyz().clamp(Vec3::ZERO, Vec3::ONE);
        let metal = textured.texel(material.metallic_roughness_texture.as_ref(), Use::Linear);
        surface.metallic = (material.metallic * metal.z).clamp(0.0, 1.0);
        surface.roughness = (material.roughness * metal.y).clamp(0.0, 1.0);
        if front || material.double_sided {
            let glow = textured.texel(material.emission_texture.as_ref(), Use::Color);
            surface.emission = Vec3::from(material.emission) * glow.xyz();
        }
        let clear = textured.texel(material.transmission_texture.as_ref(), Use::Linear);
        surface.transmission = (material.transmission * clear.x).clamp(0.0, 1.0);
        surface.ior = material.ior;
        surface.thickness = material.thickness;
        surface.specular = material.specular;
        surface.specular_color = Vec3::from(material.specular_color);
        self.with_anisotropy(surface)
    }

    /// Returns the radiance that leaves a point of a triangle towards a light sample, from texture level 0.
    /// Points that a mask cuts out emit nothing, blended ones emit in proportion to their opacity.
    pub(super) fn emission_at(&self, primitive: u32, barycentrics: Vec2, front: bool) -> Vec3 {
        let draw = self.draw_of(primitive);
        let material = self.material(draw);
        if !front && !material.double_sided {
            return Vec3::ZERO;
        }
        let reference = material.emission_texture.as_ref();
        let uv_set = reference.map_or(0, |reference| reference.uv_set);
        let triangle = self.mesh_vertices(draw, primitive);
        let uv = attributes::uv(self.mesh(draw), uv_set, triangle, barycentric_weights(barycentrics));
        let glow = self.textures.sample(reference, Use::Color, uv, 0.0);
        let emission = Vec3::from(material.emission) * glow.xyz();
        match material.alpha_mode {
            AlphaMode::Opaque => emission,
            AlphaMode::Mask { cutoff } => {
                let kept = self.alpha_at(draw, primitive, barycentrics) >= cutoff;
                if kept { emission } else { Vec3::ZERO }
            }
            AlphaMode::Blend => emission * self.alpha_at(draw, primitive, barycentrics).clamp(0.0, 1.0),
        }
    }
}
