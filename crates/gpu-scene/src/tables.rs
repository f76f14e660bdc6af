//! Scene packed into the tables that shaders read. No Vulkan.

use glam::DVec3;
use rasray_scene::{AlphaMode, Scene};
use rasray_shaders_glsl::constants::contract::{DRAW_ALPHA_MASKED, DRAW_MIRRORED, DRAW_SINGLE_SIDED};

use crate::{
    GpuSceneError, Parts, Posed, Sampling, TexelRuns, View,
    attributes::pack_attributes,
    emissive::EmissiveSources,
    environment::{EnvironmentTables, pack_environment},
    glass_albedo::append_glass_albedos,
    kinds::{disk_of, kind_shares},
    layout::{DrawShading, EmissiveTriangle, Frame, Light, Material, Texture},
    lights::pack_lights,
    materials::pack_materials,
    origin::{frame_origin_spacing, snap_frame_origin},
    words::Words,
};

/// All tables of a scene. Positions are metres relative to `frame_origin`.
#[derive(Clone, Debug, Default)]
pub struct SceneTables {
    /// Frame origin, world, metres.
    pub frame_origin: DVec3,
    /// Posed geometry.
    pub posed: Posed,
    /// Shading records, one per draw.
    pub draw_shadings: Vec<DrawShading>,
    /// Normals and tangents in world space, words.
    pub posed_attributes: Vec<f32>,
    /// Texture coordinates and colours, then the tables of rough glass, words.
    pub vertex_attributes: Vec<f32>,
    /// Materials in the order of the scene.
    pub materials: Vec<Material>,
    /// Texture records, one for every pair of scene texture and use.
    pub textures: Vec<Texture>,
    /// Texels of all levels, red in the lowest byte.
    pub texels: Vec<u32>,
    /// Point, directional and spot lights.
    pub lights: Vec<Light>,
    /// Triangles that are sampled as lights, where `emissive_power` is not 0.
    pub emissive_triangles: Vec<EmissiveTriangle>,
    /// Power per area of these triangles, W/m^2, by luminance.
    pub emissive_radiosities: Vec<f64>,
    /// Total power of these triangles, W, by luminance.
    pub emissive_power: f64,
    /// Environment seen by rays that leave the scene.
    pub environment: EnvironmentTables,
    /// Probability of the kinds of light: punctual, emissive triangles, environment.
    pub kind_shares: [f32; 3],
}

impl SceneTables {
    /// Packs the given parts of `scene`, with positions relative to `frame_origin` (world, metres). Static
    /// geometry is posed here, once, in f64.
    ///
    /// # Errors
    /// An error if the scene refers to an element that it does not have, or needs more vertices, words or
    /// texels than 32 bits can number.
    pub fn new(scene: &Scene, frame_origin: DVec3, parts: &Parts) -> Result<Self, GpuSceneError> {
        let posed = Posed::new(scene, frame_origin, |instance| draw_flags(scene, instance, parts))?;
        if posed.dropped_triangles > 0 {
            tracing::warn!(
                "{} triangles have a vertex that is not finite or farther than {} m once placed, and are not drawn",
                posed.dropped_triangles,
                crate::LARGEST_COORDINATE
            );
        }
        let mut attributes = pack_attributes(scene, &posed, parts, Words::stored())?;
        let (mut materials, textures) = pack_materials(scene, parts)?;
        if parts.glass_albedos {
            append_glass_albedos(scene, &mut materials, &mut attributes.vertex)?;
        }
        let emissive = if parts.emissive_triangles {
            EmissiveSources::new(scene, &posed, &mut attributes.draw_shadings)
        } else {
            EmissiveSources::default()
        };
        let (emissive_power, emissive_triangles) = emissive.pack(&emissive.areas(&posed));
        let disk = disk_of(posed.lower, posed.upper);
        let lights = if parts.lights { &scene.lights[..] } else { &[] };
        let (punctual_power, lights) = pack_lights(lights, frame_origin, disk);
        let environment = if parts.environment {
            pack_environment(&scene.environment)?
        } else {
            EnvironmentTables::default()
        };
        let kind_shares = kind_shares([
            (!lights.is_empty()).then_some(punctual_power),
            (emissive_power > 0.0).then_some(emissive_power),
            environment.emits.then_some(environment.irradiance * disk),
        ]);
        Ok(Self {
            frame_origin,
            posed,
            draw_shadings: attributes.draw_shadings,
            posed_attributes: attributes.posed.into_vec(),
            vertex_attributes: attributes.vertex.into_vec(),
            materials,
            textures: textures.textures,
            texels: textures.texels,
            lights,
            emissive_triangles,
            emissive_radiosities: emissive.radiosities,
            emissive_power,
            environment,
            kind_shares,
        })
    }

    /// Returns the default frame origin for an eye (world, metres): see [`snap_frame_origin`].
    pub fn default_frame_origin(scene: &Scene, eye: DVec3) -> DVec3 {
        snap_frame_origin(eye, frame_origin_spacing(world_diagonal(scene)))
    }

    /// Returns the frame record for a view: all data but the tables themselves.
    pub fn frame(&self, view: &View) -> Frame {
        let mut frame = Frame {
            triangle_count: self.posed.triangle_count() as u32,
            light_count: self.lights.len() as u32,
            emissive_count: if self.emissive_power > 0.0 { self.emissive_triangles.len() as u32 } else { 0 },
            environment_kind: self.environment.kind,
            environment_width: self.environment.width,
            environment_height: self.environment.height,
            environment_sampled: u32::from(self.environment.emits),
            environment_radiance: self.environment.constant,
            kind_shares: self.kind_shares,
            texel_shift: TexelRuns::LONGEST.shift(),
            ..Frame::default()
        };
        view.write(&mut frame, self.frame_origin);
        Sampling::default().write(&mut frame, self.has_single_sided());
        frame
    }

    /// True if any draw has a back that rays may pass.
    pub fn has_single_sided(&self) -> bool {
        self.posed.draws.iter().any(|draw| draw.flags & DRAW_SINGLE_SIDED != 0)
    }
}

fn draw_flags(scene: &Scene, instance: usize, parts: &Parts) -> u32 {
    let instance = scene.instances.get(instance);
    let mesh = instance.and_then(|instance| scene.meshes.get(instance.mesh));
    let material = mesh.and_then(|mesh| scene.materials.get(mesh.material));
    let masked = material.is_some_and(|material| matches!(material.alpha_mode, AlphaMode::Mask { .. }));
    let single_sided = material.is_some_and(|material| material.culls_back);
    let mirrored = instance.is_some_and(|instance| instance.world_from_mesh.matrix3.determinant() < 0.0);
    let flag = |bit: u32, is_set: bool| if is_set { bit } else { 0 };
    flag(DRAW_ALPHA_MASKED, masked && parts.alpha)
        | flag(DRAW_SINGLE_SIDED, single_sided)
        | flag(DRAW_MIRRORED, mirrored)
}

/// Returns the diagonal of the box around all placed meshes, metres; 0 for an empty scene. Vertices that are
/// unusable once placed do not count.
fn world_diagonal(scene: &Scene) -> f64 {
    let (mut lower, mut upper) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for instance in &scene.instances {
        let Some(mesh) = scene.meshes.get(instance.mesh) else { continue };
        for position in &mesh.positions {
            let world = instance.world_from_mesh.transform_point3(DVec3::from(position.map(f64::from)));
            if world.abs().max_element() <= f64::from(crate::LARGEST_COORDINATE) {
                lower = lower.min(world);
                upper = upper.max(world);
            }
        }
    }
    if lower.x <= upper.x { (upper - lower).length() } else { 0.0 }
}
