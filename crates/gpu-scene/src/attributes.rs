//! Shading attributes: normals and tangents posed once per instance, texture coordinates and colours stored
//! once per mesh.

use std::collections::HashMap;

use glam::{DMat3, DVec3};
use rasray_scene::{AlphaMode, Mesh, Scene};
use rasray_shaders_glsl::constants::{
    contract::{DRAW_ALPHA_MASKED, DRAW_MIRRORED},
    scene::{ATTRIBUTE_NONE, EMISSIVE_NONE},
};

use crate::{GpuSceneError, Parts, Posed, layout::DrawShading, words::Words};

/// Packed tables of attributes.
#[derive(Clone, Debug)]
pub struct Attributes {
    /// Shading records, one per draw.
    pub draw_shadings: Vec<DrawShading>,
    /// Normals and tangents in world space.
    pub posed: Words,
    /// Texture coordinates and colours.
    pub vertex: Words,
}

/// Packs the attributes of all draws into tables that continue `words`. `first_emissive` of every draw is
/// left at `EMISSIVE_NONE`.
///
/// # Errors
/// `TooManyVertices` where 32-bit word offsets do not reach; `Malformed` where an attribute has
/// another length than the positions or a mesh names a material that does not exist.
pub fn pack_attributes(
    scene: &Scene,
    posed: &Posed,
    parts: &Parts,
    words: Words,
) -> Result<Attributes, GpuSceneError> {
    let mut packed = Attributes { draw_shadings: Vec::new(), posed: words.clone(), vertex: words };
    let mut of_mesh: HashMap<usize, VertexOffsets> = HashMap::new();
    for draw in &posed.draws {
        let instance = &scene.instances[draw.instance as usize];
        let mesh = &scene.meshes[instance.mesh];
        if mesh.material >= scene.materials.len() {
            return Err(GpuSceneError::Malformed {
                what: format!("mesh {} names material {}", mesh.name, mesh.material),
                limit: scene.materials.len(),
            });
        }
        let offsets = match of_mesh.get(&instance.mesh) {
            Some(&offsets) => offsets,
            None => {
                let offsets = append_vertex_attributes(&mut packed.vertex, scene, mesh, parts)?;
                of_mesh.insert(instance.mesh, offsets);
                offsets
            }
        };
        let linear = instance.world_from_mesh.matrix3;
        let mirrored = draw.flags & DRAW_MIRRORED != 0;
        packed.draw_shadings.push(DrawShading {
            first_triangle: draw.first_triangle,
            first_vertex: posed.first_vertex[draw.instance as usize],
            material: mesh.material as u32,
            flags: draw.flags & (DRAW_ALPHA_MASKED | DRAW_MIRRORED),
            normals: append_normals(&mut packed.posed, mesh, linear, parts)?,
            tangents: append_tangents(&mut packed.posed, mesh, linear, mirrored, parts)?,
            uv0: offsets.uv0,
            uv1: offsets.uv1,
            colors: offsets.colors,
            first_emissive: EMISSIVE_NONE,
            instance: draw.instance,
        });
    }
    Ok(packed)
}

#[derive(Clone, Copy)]
struct VertexOffsets {
    uv0: u32,
    uv1: u32,
    colors: u32,
}

/// Appends the attributes that a texture or colour of the mesh's material can read.
fn append_vertex_attributes(
    table: &mut Words,
    scene: &Scene,
    mesh: &Mesh,
    parts: &Parts,
) -> Result<VertexOffsets, GpuSceneError> {
    // Where only masks are read, coordinates and colours of opaque meshes are unused.
    let masked = matches!(scene.materials[mesh.material].alpha_mode, AlphaMode::Mask { .. }) && parts.alpha;
    let shaded = parts.base_color_textures
        || parts.metallic_roughness_textures
        || parts.anisotropy_textures
        || scene.materials[mesh.material].anisotropy > 0.0
        || parts.normal_textures
        || parts.emission_textures
        || parts.transmission_textures;
    let mut uv = |set: usize| {
        let wanted = parts.uvs[set] && (shaded || masked);
        let uvs = mesh.uvs[set].as_ref().filter(|_| wanted);
        append(table, mesh, uvs.map(|uvs| uvs.iter().copied()), "texture coordinates")
    };
    let (uv0, uv1) = (uv(0)?, uv(1)?);
    let colors = mesh.colors.as_ref().filter(|_| parts.colors);
    let colors = append(table, mesh, colors.map(|colors| colors.iter().copied()), "colours")?;
    Ok(VertexOffsets { uv0, uv1, colors })
}

fn append<const N: usize>(
    table: &mut Words,
    mesh: &Mesh,
    values: Option<impl ExactSizeIterator<Item = [f32; N]>>,
    what: &str,
) -> Result<u32, GpuSceneError> {
    let Some(values) = values else { return Ok(ATTRIBUTE_NONE) };
    if values.len() != mesh.positions.len() {
        return Err(GpuSceneError::Malformed {
            what: format!("mesh {} has {} {what}", mesh.name, values.len()),
            limit: mesh.positions.len(),
        });
    }
    table.append(values.len() * N, || values.flatten())
}

fn append_normals(
    table: &mut Words,
    mesh: &Mesh,
    linear: DMat3,
    parts: &Parts,
) -> Result<u32, GpuSceneError> {
    let Some(normals) = mesh.normals.as_ref().filter(|_| parts.normals) else { return Ok(ATTRIBUTE_NONE) };
    let world_from_mesh = normal_matrix(linear);
    let posed = normals.iter().map(|&normal| unit(world_from_mesh * DVec3::from(normal.map(f64::from))));
    append(table, mesh, Some(posed), "normals")
}

fn append_tangents(
    table: &mut Words,
    mesh: &Mesh,
    linear: DMat3,
    mirrored: bool,
    parts: &Parts,
) -> Result<u32, GpuSceneError> {
    let Some(tangents) = mesh.tangents.as_ref().filter(|_| parts.tangents) else { return Ok(ATTRIBUTE_NONE) };
    let posed = tangents.iter().map(|&[x, y, z, w]| {
        let [x, y, z] = unit(linear * DVec3::new(x.into(), y.into(), z.into()));
        let sign = if (w < 0.0) != mirrored { -1.0 } else { 1.0 };
        [x, y, z, sign]
    });
    append(table, mesh, Some(posed), "tangents")
}

/// Returns the inverse transpose up to a positive factor, which normalising removes. It is made from
/// cofactors, so that a transform which flattens the mesh still gives the normal of the resulting plane.
pub fn normal_matrix(linear: DMat3) -> DMat3 {
    let scale = linear.to_cols_array().iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
    if !scale.is_finite() || scale == 0.0 {
        return DMat3::ZERO;
    }
    let linear = linear * scale.recip();
    let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if linear.determinant() < 0.0 { -cofactors } else { cofactors }
}

/// Returns the unit vector rounded to f32; zero where there is no direction.
fn unit(vector: DVec3) -> [f32; 3] {
    // The vector is scaled first: the squares of very large and very small vectors leave the range of f64.
    let scale = vector.abs().max_element();
    if !scale.is_finite() || scale == 0.0 {
        return [0.0; 3];
    }
    (vector / scale).normalize_or_zero().as_vec3().to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_stay_perpendicular_under_any_transform() {
        let linear = DMat3::from_cols(
            DVec3::new(2.0, 0.5, 0.0),
            DVec3::new(-0.3, 0.1, 0.2),
            DVec3::new(0.0, 1.0, -4.0),
        );
        for linear in [linear, -linear, linear * 1e-200, linear * 1e150] {
            let normal = DVec3::from(unit(normal_matrix(linear) * DVec3::Z).map(f64::from));
            for tangent in [DVec3::X, DVec3::Y] {
                let tangent = DVec3::from(unit(linear * tangent).map(f64::from));
                assert!(normal.dot(tangent).abs() < 1e-6);
            }
            // The outside stays outside, with and without mirroring.
            assert!(normal.dot(linear * DVec3::Z) > 0.0);
        }
    }

    #[test]
    fn a_flattening_transform_gives_the_plane_s_normal() {
        let flat = DMat3::from_cols(DVec3::X, DVec3::ZERO, DVec3::Z);
        assert_eq!(unit(normal_matrix(flat) * DVec3::new(0.3, 0.9, 0.1)).map(f32::abs), [0.0, 1.0, 0.0]);
    }
}
