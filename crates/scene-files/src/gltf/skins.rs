//! Skins: joints and bindings.

use ::gltf::json::mesh::{Primitive, Semantic};
use ::gltf::json::validation::Checked;
use glam::{DAffine3, DMat3, DVec3};

use super::accessor::{read_floats, read_integers};
use super::document::Document;
use rasray_scene::SceneError;
use rasray_scene::animation::{Skin, SkinBinding};

/// Largest deviation of the last row of a matrix from (0, 0, 0, 1).
const PROJECTIVE_TOLERANCE: f32 = 1e-4;

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
                Some(accessor) => {
                    let matrices = read_floats::<16>(document, accessor.value())?;
                    remark_matrices(document, i, &matrices[..joints.len().min(matrices.len())]);
                    matrices.iter().map(affine).collect()
                }
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

/// Notes remarks on inverse bind matrices that are not taken as they are.
fn remark_matrices(document: &Document<'_>, skin: usize, matrices: &[[f32; 16]]) {
    let count = |is_bad: &dyn Fn(&[f32; 16]) -> bool| matrices.iter().filter(|matrix| is_bad(matrix)).count();
    let (place, mut remarks) = (format!("skins[{skin}].inverseBindMatrices"), document.remarks.borrow_mut());
    let bad = count(&|matrix| !is_finite(matrix));
    remarks.count("skin-matrices", &place, bad, "matrices are not finite; none is applied");
    let bottom = |matrix: &[f32; 16]| [matrix[3], matrix[7], matrix[11], matrix[15] - 1.0];
    let bad =
        count(&|matrix| is_finite(matrix) && bottom(matrix).iter().any(|x| x.abs() > PROJECTIVE_TOLERANCE));
    remarks.count(
        "skin-matrices",
        &place,
        bad,
        "matrices are projective; their last row is taken as 0 0 0 1",
    );
}

fn is_finite(matrix: &[f32; 16]) -> bool {
    matrix.iter().all(|x| x.is_finite())
}

/// Returns the affine part of a column-major matrix; the identity where it is not finite.
fn affine(elements: &[f32; 16]) -> DAffine3 {
    if !is_finite(elements) {
        return DAffine3::IDENTITY;
    }
    let column = |k: usize| DVec3::new(elements[k].into(), elements[k + 1].into(), elements[k + 2].into());
    DAffine3 { matrix3: DMat3::from_cols(column(0), column(4), column(8)), translation: column(12) }
}

/// Notes remarks on joints without weights and weights without joints. Sets from `read` on are not read.
pub(super) fn remark(document: &Document<'_>, place: &str, primitive: &Primitive, read: u32) {
    for semantic in primitive.attributes.keys() {
        let Checked::Valid(semantic @ (Semantic::Joints(set) | Semantic::Weights(set))) = semantic else {
            continue;
        };
        if *set >= read {
            let text = format!(
                "{} was dropped: JOINTS_{read} and WEIGHTS_{read} are not both there",
                semantic.to_string()
            );
            document.note("unread-attributes", place, text);
        }
    }
}

/// Reads the joints and weights of the vertices of a primitive. `sets` are the accessors of joints and
/// weights, four joints per vertex each.
pub(super) fn read_binding(
    document: &Document<'_>,
    place: &str,
    skin: usize,
    sets: &[(usize, usize)],
    vertices: usize,
) -> Result<SkinBinding, SceneError> {
    let available = document.root.skins[skin].joints.len();
    let per_vertex = 4 * sets.len();
    let mut joints = vec![0; vertices * per_vertex];
    let mut weights = vec![0.0; vertices * per_vertex];
    let mut bad = 0;
    for (set, accessors) in sets.iter().enumerate() {
        let joints_of = read_integers::<4>(document, accessors.0)?;
        let weights_of = read_floats::<4>(document, accessors.1)?;
        if joints_of.len() != vertices || weights_of.len() != vertices {
            let (joints, weights) = (joints_of.len(), weights_of.len());
            let reason = format!("{joints} joints and {weights} weights for {vertices} vertices");
            return Err(document.invalid(place, reason));
        }
        for (vertex, (joints_of, weights_of)) in joints_of.into_iter().zip(weights_of).enumerate() {
            let first = vertex * per_vertex + 4 * set;
            for (place_of, (joint, weight)) in joints_of.into_iter().zip(weights_of).enumerate() {
                if !(weight.is_finite() && weight > 0.0) {
                    bad += usize::from(weight != 0.0);
                    continue;
                }
                if joint as usize >= available {
                    let reason = format!("joint {joint}, but skins[{skin}] has only {available}");
                    return Err(document.invalid(place, reason));
                }
                joints[first + place_of] = joint;
                weights[first + place_of] = weight;
            }
        }
    }
    if available == 0 && vertices > 0 {
        return Err(document.invalid(format!("skins[{skin}]"), "has no joints"));
    }
    let mut unmoved = 0;
    for weights in weights.chunks_exact_mut(per_vertex.max(1)) {
        let sum: f64 = weights.iter().copied().map(f64::from).sum();
        if sum >= f64::from(f32::MIN_POSITIVE) {
            weights.iter_mut().for_each(|weight| *weight = (f64::from(*weight) / sum) as f32);
        } else {
            weights.fill(0.0);
            weights[0] = 1.0;
            unmoved += 1;
        }
    }
    let mut remarks = document.remarks.borrow_mut();
    remarks.count("bad-weights", place, bad, "weights of joints are negative or not finite, and taken as 0");
    remarks.count(
        "bad-weights",
        place,
        unmoved,
        "vertices have no joint with weight; they follow the first of the skin",
    );
    Ok(SkinBinding { skin, per_vertex, joints, weights })
}
