//! Types that a scene is made of.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

pub use crate::mesh::Mesh;
pub use crate::warning::Warning;

/// Scene in one world: meshes and their instances, materials, lights, cameras and animation.
///
/// Instances are in *scene order*, which global triangle ids follow (glTF: depth-first over scene nodes,
/// primitives in order, instances in order; OBJ and PLY: file order).
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// File stem or built-in name with its parameters.
    pub name: String,
    /// Triangle meshes; one per glTF primitive or OBJ material group.
    pub meshes: Vec<Mesh>,
    /// Placed meshes in scene order.
    pub instances: Vec<Instance>,
    /// Materials; `Mesh::material` indexes here. Never empty once loaded: index 0 may be the default.
    pub materials: Vec<Material>,
    /// Textures: an image with a sampler.
    pub textures: Vec<Texture>,
    /// Decoded images.
    pub images: Vec<Image>,
    /// Punctual lights in world space. Emissive triangles are lights too, found through materials.
    pub lights: Vec<Light>,
    /// Radiance of rays that leave the scene.
    pub environment: Environment,
    /// Cameras in world space, in scene order.
    pub cameras: Vec<Camera>,
    /// Changes of the scene with time: clips, skins and morph targets as read, or a deformer.
    pub animation: Animation,
    /// Data that was dropped, replaced or not supported, each with a count and a place.
    pub warnings: Vec<Warning>,
    /// Files that were read because the scene's own file refers to them: buffers, images and material
    /// libraries, in the order in which they were read. A file that is referred to twice may be listed twice.
    pub files: Vec<std::path::PathBuf>,
}

/// A mesh placed in the world.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Node name, with a running number where several share it.
    pub name: String,
    /// Index into `Scene::meshes`.
    pub mesh: usize,
    /// Transform into the world, metres, in f64: rounded to f32 once, after the frame origin is subtracted.
    pub world_from_mesh: DAffine3,
}

/// Interpretation of alpha.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// A point counts if and only if its alpha is at least the cutoff.
    Mask {
        /// Cutoff, at least 0. With a cutoff above 1, which files give as infinity, no point counts.
        cutoff: f32,
    },
    /// Stochastic opacity in integrators.
    Blend,
}

/// Metallic-roughness material with the transmission, volume, ior, specular and emissive-strength
/// extensions of glTF. Colours are linear Rec. 709.
#[derive(Clone, Debug)]
pub struct Material {
    /// Name from the file.
    pub name: String,
    /// Base colour, linear RGBA.
    pub base_color: [f32; 4],
    /// Texture of the base colour: sRGB colour, linear alpha.
    pub base_color_texture: Option<TextureRef>,
    /// Metalness in [0, 1].
    pub metallic: f32,
    /// Perceptual roughness in [0, 1]; alpha of the microfacet distribution is its square.
    pub roughness: f32,
    /// Texture of metalness and roughness: roughness in G, metalness in B, linear.
    pub metallic_roughness_texture: Option<TextureRef>,
    /// Excess roughness of facets along one direction, in [0, 1].
    pub anisotropy: f32,
    /// Angle of that direction, radians from the tangent to the bitangent.
    pub anisotropy_rotation: f32,
    /// Texture of the anisotropy: direction in RG, from -1 to 1, before the rotation, and a factor of the
    /// strength in B, linear.
    pub anisotropy_texture: Option<TextureRef>,
    /// Normal map: tangent-space normals, linear.
    pub normal_texture: Option<TextureRef>,
    /// Scale of the normal texture's x and y.
    pub normal_scale: f32,
    /// Emitted radiance, W/(sr m^2): factor times strength.
    pub emission: [f32; 3],
    /// Texture of the emission, sRGB.
    pub emission_texture: Option<TextureRef>,
    /// Share of the dielectric base that transmits, in [0, 1].
    pub transmission: f32,
    /// Texture of the transmission: factor in R, linear.
    pub transmission_texture: Option<TextureRef>,
    /// Index of refraction, 1.5 unless told.
    pub ior: f32,
    /// Thickness, metres; 0 means a thin wall: refraction does not bend, nothing is absorbed.
    pub thickness: f32,
    /// Colour that white light has after `attenuation_distance` metres inside.
    pub attenuation_color: [f32; 3],
    /// Distance after which light has the attenuation colour, metres; infinite means no absorption.
    pub attenuation_distance: f32,
    /// Strength of the dielectric specular reflection, 1 unless told.
    pub specular: f32,
    /// Colour of the dielectric specular reflection at normal incidence.
    pub specular_color: [f32; 3],
    /// Interpretation of alpha.
    pub alpha_mode: AlphaMode,
    /// True if both sides emit, not the front alone.
    pub double_sided: bool,
    /// True if the back is not drawn: rays that pass backs ([`BackFaces`](crate::BackFaces)) go on behind it.
    /// The front is the counter-clockwise side of the mesh.
    pub culls_back: bool,
    /// True if the surface shows its base colour as emission and scatters nothing.
    pub unlit: bool,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: "default".to_owned(),
            base_color: [1.0; 4],
            base_color_texture: None,
            metallic: 1.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            anisotropy: 0.0,
            anisotropy_rotation: 0.0,
            anisotropy_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            emission: [0.0; 3],
            emission_texture: None,
            transmission: 0.0,
            transmission_texture: None,
            ior: 1.5,
            thickness: 0.0,
            attenuation_color: [1.0; 3],
            attenuation_distance: f32::INFINITY,
            specular: 1.0,
            specular_color: [1.0; 3],
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            culls_back: false,
            unlit: false,
        }
    }
}

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureRef {
    /// Index into `Scene::textures`.
    pub texture: usize,
    /// Set of texture coordinates, 0 or 1.
    pub uv_set: u32,
    /// Transform of the texture coordinates: rows of the 2x3 matrix applied to (u, v, 1).
    pub uv_transform: [[f32; 3]; 2],
}

/// An image with a sampler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// Index into `Scene::images`.
    pub image: usize,
    /// Behaviour outside [0, 1] in u.
    pub wrap_u: Wrap,
    /// Behaviour outside [0, 1] in v.
    pub wrap_v: Wrap,
    /// Filter of magnification: nearest texel or bilinear.
    pub filter: Filter,
    /// True if smaller levels are used for distant surfaces.
    pub mipmapped: bool,
}

/// Texture coordinates outside [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Wrap {
    /// Repeat.
    #[default]
    Repeat,
    /// Repeat, every other copy mirrored.
    Mirror,
    /// Clamp to the edge texel.
    Clamp,
}

/// Ways of combining texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Filter {
    /// The texel that holds the point.
    Nearest,
    /// Four texels, bilinear.
    #[default]
    Linear,
}

/// Decoded texels, rows top first (v = 0 is the first row).
#[derive(Clone, Debug)]
pub struct Image {
    /// Name or file.
    pub name: String,
    /// Texels per row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// RGBA, one byte each; 16-bit sources are rounded with a warning. Whether colour is sRGB
    /// depends on the use: base colour and emission are, all else is linear.
    pub rgba8: Vec<u8>,
}

/// A light without extent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Radiates evenly from a point.
    Point {
        /// Position, metres, world.
        position: DVec3,
        /// Radiant intensity, W/sr, linear RGB.
        intensity: [f32; 3],
        /// Range, metres; infinite unless the file says so.
        range: f32,
    },
    /// Parallel light.
    Directional {
        /// Unit direction in which the light travels.
        direction: DVec3,
        /// Irradiance, W/m^2, linear RGB.
        irradiance: [f32; 3],
    },
    /// A point light within a cone.
    Spot {
        /// Position, metres, world.
        position: DVec3,
        /// Axis of the cone, unit.
        direction: DVec3,
        /// Radiant intensity, W/sr, linear RGB.
        intensity: [f32; 3],
        /// Range, metres.
        range: f32,
        /// Angle between the axis and the start of the falloff, radians.
        inner_cone: f32,
        /// Angle between the axis and the end of the light, radians.
        outer_cone: f32,
    },
}

/// Radiance that arrives from outside the scene.
#[derive(Clone, Debug)]
pub enum Environment {
    /// One radiance in every direction, linear RGB, W/(sr m^2). Black means no environment.
    Constant([f32; 3]),
    /// Latitude-longitude map: u grows with the azimuth from +x over +z, v from +y (top) down.
    LatLong {
        /// Texels per row.
        width: u32,
        /// Rows.
        height: u32,
        /// Radiance of the texels, linear RGB, W/(sr m^2), rows top first.
        radiance: Vec<[f32; 3]>,
    },
}

impl Default for Environment {
    fn default() -> Self {
        Self::Constant([0.0; 3])
    }
}

/// Camera in the world: it looks along -z of its own frame, +y up.
#[derive(Clone, Debug)]
pub struct Camera {
    /// Name from the file.
    pub name: String,
    /// Rigid placement, metres, f64.
    pub world_from_camera: DAffine3,
    /// Projection.
    pub projection: Projection,
    /// Ratio of width to height of the camera's frame, above 0, where the file gives one; see
    /// [`Camera::half_extents`].
    pub aspect_ratio: Option<f32>,
    /// Lens of a perspective camera; absent means a pinhole, which blurs nothing. No supported file format
    /// has one.
    pub lens: Option<Lens>,
}

/// Thin lens: all of its opening sees a pixel, and points outside the plane in focus are blurred. Brightness
/// does not depend on the lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Diameter of the opening, metres; 0 is a pinhole.
    pub aperture: f32,
    /// Distance from the eye to the plane in focus, along the view, metres; above 0.
    pub focus: f32,
}

impl Camera {
    /// Returns half of the extent that an image of that many pixels shows, across and upwards: tangents of
    /// angles of a perspective, metres of a parallel projection. Pixels are square. The height that the
    /// projection gives holds for images that are at least as wide for their height as the camera's frame,
    /// and for cameras without a frame: wider images show more at both sides. A narrower image shows the
    /// frame in its full width, and more above and below.
    pub fn half_extents(&self, width: u32, height: u32) -> [f64; 2] {
        let aspect = f64::from(width.max(1)) / f64::from(height.max(1));
        let half_height = match self.projection {
            Projection::Perspective { fov_y } => (0.5 * f64::from(fov_y)).tan(),
            Projection::Orthographic { half_height } => f64::from(half_height),
        };
        // The comparison is in the precision of files: an image of the frame's own shape is not narrower.
        let narrower = self.aspect_ratio.filter(|own| *own > aspect as f32);
        let half_height = narrower.map_or(half_height, |own| half_height * f64::from(own) / aspect);
        [half_height * aspect, half_height]
    }
}

/// Mapping from directions to pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Pinhole projection.
    Perspective {
        /// Full vertical angle, radians.
        fov_y: f32,
    },
    /// Parallel projection.
    Orthographic {
        /// Half of the visible height, metres.
        half_height: f32,
    },
}

/// Changes of a scene with time, as read from the file.
#[derive(Clone, Debug, Default)]
pub struct Animation {
    /// Names of the clips.
    pub clips: Vec<String>,
    /// Time in seconds from which on nothing changes: the end of the longest clip, or of the deformer's
    /// motion.
    pub duration: f32,
    /// Number of skins.
    pub skins: usize,
    /// Number of meshes with morph targets.
    pub morphed_meshes: usize,
    /// Nodes, keys, skins and morph targets: the data that posing needs.
    pub rig: crate::animation::Rig,
    /// Deformer of meshes without a rig: a simulation, or a file for each frame.
    pub deformer: Option<Arc<dyn crate::deforming::Deformer>>,
    /// Warnings of the deformer at the time that is shown; [`Scene::warnings`] holds them too.
    pub deformer_warnings: Vec<Warning>,
}
