//! The records of the scene tables, byte for byte as `scene/types.glsl` declares them.
//!
//! All fields are words of four bytes, so scalar block layout and `repr(C)` agree.

use bytemuck::{Pod, Zeroable};
use rasray_ads::{CameraView, Viewpoint};
use rasray_shaders_glsl::constants::scene::PROJECTION_PERSPECTIVE;

pub use rasray_ads::Draw;

/// Camera, image size, seed, sizes of the tables and the constant environment.
/// Lengths are metres relative to the frame origin.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Frame {
    /// Where perspective rays start; the centre of an orthographic image.
    pub camera_position: [f32; 3],
    /// `PROJECTION_*`.
    pub projection: u32,
    /// Unit, to the right in the image.
    pub camera_right: [f32; 3],
    /// Perspective: tangent of the half angle; orthographic: metres.
    pub half_width: f32,
    /// Unit, up in the image.
    pub camera_up: [f32; 3],
    /// As `half_width`.
    pub half_height: f32,
    /// Unit, into the image.
    pub camera_forward: [f32; 3],
    /// Radians that a pixel subtends at the image centre; 0 if orthographic.
    pub cone_spread: f32,
    /// Metres that a pixel covers at the ray's origin; 0 if perspective.
    pub cone_width: f32,
    /// Pixels a row of the whole image.
    pub width: u32,
    /// Rows of the whole image.
    pub height: u32,
    /// Seed of all random numbers.
    pub seed: u32,
    /// Triangles of the geometry.
    pub triangle_count: u32,
    /// Point, directional and spot lights.
    pub light_count: u32,
    /// Entries of the emissive triangles; 0 if their power is 0.
    pub emissive_count: u32,
    /// `ENVIRONMENT_*`.
    pub environment_kind: u32,
    /// Texels per row; 0 unless latitude-longitude.
    pub environment_width: u32,
    /// Rows; 0 unless latitude-longitude.
    pub environment_height: u32,
    /// 1 if the environment emits and is worth a light sample.
    pub environment_sampled: u32,
    /// W/(sr m^2), the constant environment.
    pub environment_radiance: [f32; 3],
    /// `SAMPLER_*`.
    pub sampling: u32,
    /// Of a camera ray's cone: 1 over the root of the samples per pixel.
    pub footprint_scale: f32,
    /// Probability of the kinds of light: punctual, emissive triangles, environment.
    pub kind_shares: [f32; 3],
    /// A run of texels has 2^`texel_shift` of them; at most 30.
    pub texel_shift: u32,
}

impl Frame {
    /// The eye and what the camera sees there; without the latter where it has no perspective.
    pub fn viewpoint(&self) -> Viewpoint {
        let camera = CameraView {
            right: self.camera_right,
            up: self.camera_up,
            forward: self.camera_forward,
            half_width: self.half_width,
            half_height: self.half_height,
        };
        let perspective = self.projection == PROJECTION_PERSPECTIVE && camera.is_valid();
        Viewpoint { eye: self.camera_position, camera: perspective.then_some(camera) }
    }
}

/// How a draw is shaded; same order as the draws. Offsets count words from the start of their
/// table; `ATTRIBUTE_NONE` means absent.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct DrawShading {
    /// Global triangle id of its first triangle.
    pub first_triangle: u32,
    /// Global vertex index of its first vertex.
    pub first_vertex: u32,
    /// Index into the materials.
    pub material: u32,
    /// `DRAW_ALPHA_MASKED`, `DRAW_MIRRORED`.
    pub flags: u32,
    /// Posed attributes, 3 words a vertex.
    pub normals: u32,
    /// Posed attributes, 4 words a vertex.
    pub tangents: u32,
    /// Vertex attributes, 2 words a vertex.
    pub uv0: u32,
    /// Vertex attributes, 2 words a vertex.
    pub uv1: u32,
    /// Vertex attributes, 4 words a vertex.
    pub colors: u32,
    /// Entry of its first triangle among the emissive triangles, or `EMISSIVE_NONE`.
    pub first_emissive: u32,
    /// Index into the scene's instances.
    pub instance: u32,
}

/// A texture as a material uses it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TextureUse {
    /// Index into the textures, or `TEXTURE_NONE`.
    pub texture: u32,
    /// 0 or 1.
    pub uv_set: u32,
    /// u' = dot(row_u, (u, v, 1)).
    pub row_u: [f32; 3],
    /// v' = dot(row_v, (u, v, 1)).
    pub row_v: [f32; 3],
}

/// A material; fields as in `rasray_scene::Material`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Material {
    /// Linear RGBA.
    pub base_color: [f32; 4],
    /// W/(sr m^2).
    pub emission: [f32; 3],
    /// In [0, 1].
    pub metallic: f32,
    /// Perceptual, in [0, 1].
    pub roughness: f32,
    /// In [0, 1].
    pub transmission: f32,
    /// Index of refraction.
    pub ior: f32,
    /// Metres; 0 is a thin wall.
    pub thickness: f32,
    /// In [0, 1] each.
    pub attenuation_color: [f32; 3],
    /// Metres, may be infinite.
    pub attenuation_distance: f32,
    /// Linear RGB.
    pub specular_color: [f32; 3],
    /// In [0, 1].
    pub specular: f32,
    /// Scale of the normal map's x and y.
    pub normal_scale: f32,
    /// Used with `MATERIAL_ALPHA_MASK` only.
    pub alpha_cutoff: f32,
    /// `MATERIAL_*`.
    pub flags: u32,
    /// Vertex attributes: word of the table of what rough glass loses, or `ATTRIBUTE_NONE`.
    pub albedo: u32,
    /// With `TEXTURE_SRGB`.
    pub base_color_texture: TextureUse,
    /// Linear.
    pub metallic_roughness_texture: TextureUse,
    /// Linear.
    pub normal_texture: TextureUse,
    /// With `TEXTURE_SRGB`.
    pub emission_texture: TextureUse,
    /// Linear.
    pub transmission_texture: TextureUse,
}

/// Where the texels of a texture lie and how they are sampled.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Texture {
    /// Number of the first texel of level 0, over all runs.
    pub first_texel: u32,
    /// Of level 0.
    pub width: u32,
    /// Of level 0.
    pub height: u32,
    /// 1 if smaller levels are not used.
    pub level_count: u32,
    /// Wrap modes and `TEXTURE_*` flags.
    pub sampling: u32,
}

/// A light without extent.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Light {
    /// Metres relative to the frame origin.
    pub position: [f32; 3],
    /// `LIGHT_*`.
    pub kind: u32,
    /// Unit, the way light travels.
    pub direction: [f32; 3],
    /// Metres, may be infinite.
    pub range: f32,
    /// W/sr; directional: W/m^2.
    pub intensity: [f32; 3],
    /// Spot: factor of the cosine.
    pub cone_scale: f32,
    /// Spot: added after the factor.
    pub cone_offset: f32,
    /// Share of the power of all punctual lights up to and including this one; the last is 1.
    pub cumulative: f32,
}

/// One triangle of an emissive draw.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct EmissiveTriangle {
    /// Global triangle id.
    pub primitive: u32,
    /// Share of all power up to and including this entry; the last is 1.
    pub cumulative: f32,
}
