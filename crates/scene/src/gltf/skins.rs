//! Skins: joints, bindings, and the pose at rest.

use glam::{DAffine3, DMat3, DVec3};

use super::accessor::{read_floats, read_integers};
use super::document::Document;
use super::hierarchy::Hierarchy;
use crate::animation::{Skin, SkinBinding};
use crate::{Mesh, SceneError};

/// Reads all skins of a file.
pub(super) fn read_all(document: &Document<'_>) -> Result<Vec<Skin>, SceneError> {
    document
        .root
        .skins
        .iter()
        .enumerate()
        .map(|(i, skin)| {
            let joints: Vec<usize> = skin.joints.iter().map(|joint| joint.value()).collect();
            let joint_from_mesh = match skin.inverse_bind_matrices {
                Some(accessor) => read_floats::<16>(document, accessor.value())?.iter().map(affine).collect(),
                None => vec![DAffine3::IDENTITY; joints.len()],
            };
            if joint_from_mesh.len() < joints.len() {
                let reason =
                    format!("{} inverse bind matrices for {} joints", joint_from_mesh.len(), joints.len());
                return Err(document.invalid(format!("skins[{i}]"), reason));
            }
            let name = skin.name.clone().unwrap_or_else(|| format!("skin{i}"));
            Ok(Skin { name, joints, joint_from_mesh })
        })
        .collect()
}

/// The affine part of a column-major matrix.
fn affine(elements: &[f32; 16]) -> DAffine3 {
    let column = |k: usize| DVec3::new(elements[k].into(), elements[k + 1].into(), elements[k + 2].into());
    DAffine3 { matrix3: DMat3::from_cols(column(0), column(4), column(8)), translation: column(12) }
}

/// Reads which joints move the vertices of a primitive. `accessors` are those of joints and weights.
pub(super) fn read_binding(
    document: &Document<'_>,
    place: &str,
    skin: usize,
    accessors: (usize, usize),
    vertices: usize,
) -> Result<SkinBinding, SceneError> {
    let available = document.root.skins[skin].joints.len();
    let joints = read_integers::<4>(document, accessors.0)?;
    let mut weights = read_floats::<4>(document, accessors.1)?;
    if joints.len() != vertices || weights.len() != vertices {
        let reason = format!("{} joints and {} weights for {vertices} vertices", joints.len(), weights.len());
        return Err(document.invalid(place, reason));
    }
    for (joints, weights) in joints.iter().zip(&mut weights) {
        for (&joint, weight) in joints.iter().zip(weights.iter_mut()) {
            if !(weight.is_finite() && *weight > 0.0) {
                *weight = 0.0;
            } else if joint as usize >= available {
                let reason = format!("joint {joint}, but skins[{skin}] has only {available}");
                return Err(document.invalid(place, reason));
            }
        }
        let sum: f32 = weights.iter().sum();
        // A vertex that no joint moves follows the first.
        *weights = if sum.is_normal() { weights.map(|weight| weight / sum) } else { [1.0, 0.0, 0.0, 0.0] };
    }
    if available == 0 && vertices > 0 {
        return Err(document.invalid(format!("skins[{skin}]"), "has no joints"));
    }
    let joints =
        joints.into_iter().map(|joints| joints.map(|joint| joint.min(available.max(1) as u32 - 1))).collect();
    Ok(SkinBinding { skin, joints, weights })
}

/// Moves the vertices of `mesh` to where the joints have them at rest, relative to the returned
/// place in the world (the first joint's), so that f32 suffices far from the origin. As the format
/// asks, the transform of the node that holds the mesh plays no part.
pub(super) fn pose(skin: &Skin, binding: &SkinBinding, hierarchy: &Hierarchy, mesh: &mut Mesh) -> DAffine3 {
    let origin = skin.joints.first().map_or(DVec3::ZERO, |&joint| hierarchy.world[joint].translation);
    let to_origin = DAffine3::from_translation(-origin);
    let moves: Vec<DAffine3> = (skin.joints.iter().zip(&skin.joint_from_mesh))
        .map(|(&joint, &joint_from_mesh)| to_origin * hierarchy.world[joint] * joint_from_mesh)
        .collect();
    for (vertex, (joints, weights)) in binding.joints.iter().zip(&binding.weights).enumerate() {
        let blended = joints.iter().zip(weights).filter(|(_, weight)| **weight > 0.0).fold(
            DAffine3 { matrix3: DMat3::ZERO, translation: DVec3::ZERO },
            |sum, (&joint, &weight)| {
                let (step, weight) = (moves[joint as usize], f64::from(weight));
                DAffine3 {
                    matrix3: sum.matrix3 + step.matrix3 * weight,
                    translation: sum.translation + step.translation * weight,
                }
            },
        );
        let position = &mut mesh.positions[vertex];
        *position = blended.transform_point3(DVec3::from(position.map(f64::from))).as_vec3().to_array();
        if let Some(normal) = mesh.normals.as_mut().and_then(|normals| normals.get_mut(vertex)) {
            let turned = cofactors(blended.matrix3) * DVec3::from(normal.map(f64::from));
            *normal = turned.normalize_or_zero().as_vec3().to_array();
        }
        if let Some([x, y, z, _]) = mesh.tangents.as_mut().and_then(|tangents| tangents.get_mut(vertex)) {
            let turned = blended.matrix3 * DVec3::new((*x).into(), (*y).into(), (*z).into());
            [*x, *y, *z] = turned.normalize_or_zero().as_vec3().to_array();
        }
    }
    DAffine3::from_translation(origin)
}

/// The matrix that turns normals, whatever the determinant; for a mirrored map it also flips them
/// back to the side that the winding has.
fn cofactors(matrix: DMat3) -> DMat3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let side = if matrix.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * side
}
