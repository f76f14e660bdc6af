//! Sizes of tables on the device, computed without making them.

use glam::DVec3;
use rasray_scene::Scene;

use crate::{
    GpuSceneError, Parts, Posed,
    attributes::pack_attributes,
    emissive::EmissiveSources,
    environment::environment_words,
    glass_albedo::append_glass_albedos,
    layout::{DrawShading, EmissiveTriangle, Light, Material, Texture},
    materials::collect_materials,
    words::Words,
};

/// Returns the bytes that a [`crate::GpuScene`] with all parts of a scene would need in addition to one with
/// these parts alone; `frame_origin` (world, metres) is that of the tables.
///
/// # Errors
/// Errors of [`crate::SceneTables::new`] with all parts: a scene may have faults in parts that are not
/// packed.
pub fn left_out_bytes(scene: &Scene, frame_origin: DVec3, parts: &Parts) -> Result<u64, GpuSceneError> {
    let posed = Posed::new(scene, frame_origin, |_| 0)?;
    Ok(shading_bytes(scene, &posed, &Parts::ALL)? - shading_bytes(scene, &posed, parts)?)
}

/// Returns the bytes of the tables that depend on parts. Geometry is always needed, and the frame has one
/// size.
fn shading_bytes(scene: &Scene, posed: &Posed, parts: &Parts) -> Result<u64, GpuSceneError> {
    let mut attributes = pack_attributes(scene, posed, parts, Words::counted())?;
    let (mut materials, textures) = collect_materials(scene, parts)?;
    if parts.glass_albedos {
        append_glass_albedos(scene, &mut materials, &mut attributes.vertex)?;
    }
    let emissive = if parts.emissive_triangles {
        EmissiveSources::new(scene, posed, &mut attributes.draw_shadings).primitives.len() as u64
    } else {
        0
    };
    let lights = if parts.lights { scene.lights.len() as u64 } else { 0 };
    let [radiance, distribution] =
        if parts.environment { environment_words(&scene.environment) } else { [0; 2] };
    let tables = [
        bytes::<DrawShading>(attributes.draw_shadings.len() as u64),
        bytes::<f32>(attributes.posed.count()),
        bytes::<f32>(attributes.vertex.count()),
        bytes::<Material>(materials.len() as u64),
        bytes::<Texture>(textures.texture_count()),
        bytes::<u32>(textures.texel_count()),
        bytes::<Light>(lights),
        bytes::<EmissiveTriangle>(emissive),
        bytes::<f32>(radiance),
        bytes::<f32>(distribution),
    ];
    Ok(tables.iter().sum())
}

/// Returns the bytes of a table on the device, where one record replaces an empty table.
fn bytes<T>(records: u64) -> u64 {
    records.max(1) * size_of::<T>() as u64
}
