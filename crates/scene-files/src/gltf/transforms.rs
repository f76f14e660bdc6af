//! Node transforms in f64, read from the plain JSON tree.

use std::path::Path;

use ::gltf::json::Value;
use glam::{DAffine3, DMat3, DQuat, DVec3};

use rasray_scene::SceneError;
use rasray_scene::animation::NodeTransform;
use rasray_scene::remarks::Remarks;

/// Largest deviation of the last row of a matrix from (0, 0, 0, 1).
const PROJECTIVE_TOLERANCE: f64 = 1e-6;

/// Reads the transform of every node.
pub(super) fn read_all(
    path: &Path,
    tree: &Value,
    remarks: &mut Remarks,
) -> Result<Vec<NodeTransform>, SceneError> {
    let nodes = tree.get("nodes").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    nodes.iter().enumerate().map(|(i, node)| read(path, i, node, remarks)).collect()
}

fn read(path: &Path, index: usize, node: &Value, remarks: &mut Remarks) -> Result<NodeTransform, SceneError> {
    let place = format!("nodes[{index}]");
    if let Some(elements) = numbers::<16>(path, index, node, "matrix")? {
        let column = |k: usize| DVec3::new(elements[4 * k], elements[4 * k + 1], elements[4 * k + 2]);
        let bottom = [elements[3], elements[7], elements[11], elements[15] - 1.0];
        if bottom.iter().any(|x| x.abs() > PROJECTIVE_TOLERANCE) {
            let [x, y, z, _] = bottom;
            let reason = format!("is projective: its last row is {x} {y} {z} {}, not 0 0 0 1", elements[15]);
            return Err(SceneError::invalid(path, format!("nodes[{index}].matrix"), reason));
        }
        if ["translation", "rotation", "scale"].iter().any(|part| node.get(part).is_some()) {
            let text = "has a matrix next to a translation, rotation or scale; only the matrix is used";
            remarks.note("matrix-and-parts", &place, text);
        }
        let matrix3 = DMat3::from_cols(column(0), column(1), column(2));
        return Ok(NodeTransform::Matrix(DAffine3 { matrix3, translation: column(3) }));
    }
    let translation = numbers::<3>(path, index, node, "translation")?.map_or(DVec3::ZERO, DVec3::from);
    let scale = numbers::<3>(path, index, node, "scale")?.map_or(DVec3::ONE, DVec3::from);
    let rotation = match numbers::<4>(path, index, node, "rotation")? {
        Some(elements) => unit_rotation(elements).unwrap_or_else(|| {
            remarks.note(
                "bad-rotation",
                &place,
                format!("the rotation {elements:?} has no direction; none is applied"),
            );
            DQuat::IDENTITY
        }),
        None => DQuat::IDENTITY,
    };
    Ok(NodeTransform::Parts { translation, rotation, scale })
}

/// Returns the unit rotation along x, y, z, w of any length but zero.
pub(super) fn unit_rotation(elements: [f64; 4]) -> Option<DQuat> {
    let rotation = DQuat::from_array(elements);
    let length = rotation.length();
    (length.is_normal()).then(|| DQuat::from_array(elements.map(|x| x / length)))
}

/// Returns the member `name` of a node as exactly `N` finite numbers.
fn numbers<const N: usize>(
    path: &Path,
    index: usize,
    node: &Value,
    name: &str,
) -> Result<Option<[f64; N]>, SceneError> {
    let Some(member) = node.get(name).filter(|member| !member.is_null()) else { return Ok(None) };
    let numbers: Option<Vec<f64>> = member
        .as_array()
        .and_then(|items| items.iter().map(|item| item.as_f64().filter(|x| x.is_finite())).collect());
    match numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok()) {
        Some(numbers) => Ok(Some(numbers)),
        None => {
            let place = format!("nodes[{index}].{name}");
            Err(SceneError::invalid(path, place, format!("must be {N} numbers")))
        }
    }
}
