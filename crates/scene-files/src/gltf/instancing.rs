//! `EXT_mesh_gpu_instancing`: many copies of a mesh at one node.

use ::gltf::json::Value;
use glam::{DAffine3, DVec3};

use super::accessor::{count, read_floats};
use super::document::Document;
use super::transforms::unit_rotation;
use crate::Limits;
use rasray_scene::SceneError;

/// Returns the copies of a node's mesh relative to the node; `None` if the mesh is not instanced.
pub(super) fn transforms(document: &Document<'_>, node: usize) -> Result<Option<Vec<DAffine3>>, SceneError> {
    let extensions = document.root.nodes[node].extensions.as_ref();
    let Some(extension) = extensions.and_then(|found| found.others.get("EXT_mesh_gpu_instancing")) else {
        return Ok(None);
    };
    let place = format!("nodes[{node}].extensions.EXT_mesh_gpu_instancing");
    let attributes = extension
        .get("attributes")
        .and_then(Value::as_object)
        .ok_or_else(|| document.invalid(place.clone(), "has no attributes"))?;
    let mut copies = None;
    for (name, index) in attributes {
        let accessor = index
            .as_u64()
            .and_then(|index| usize::try_from(index).ok())
            .filter(|&index| index < document.root.accessors.len())
            .ok_or_else(|| {
                document.invalid(place.clone(), format!("{name} refers to no accessor: {index}"))
            })?;
        let found = count(document, accessor)?;
        if copies.is_some_and(|copies| copies != found) {
            return Err(document.invalid(place, "its attributes differ in length"));
        }
        copies = Some(found);
    }
    let copies = copies.ok_or_else(|| document.invalid(place, "has no attributes"))?;
    Limits::check(
        document.path,
        "the number of instances",
        copies as u64,
        document.limits.instances,
        "instances",
    )?;
    let accessor = |name: &str| attributes.get(name).and_then(Value::as_u64).map(|index| index as usize);
    let translations = accessor("TRANSLATION").map(|index| read_floats::<3>(document, index)).transpose()?;
    let rotations = accessor("ROTATION").map(|index| read_floats::<4>(document, index)).transpose()?;
    let scales = accessor("SCALE").map(|index| read_floats::<3>(document, index)).transpose()?;
    let vector = |list: &Option<Vec<[f32; 3]>>, i: usize, absent: DVec3| {
        list.as_ref().map_or(absent, |list| DVec3::from(list[i].map(f64::from)))
    };
    let mut turned_nowhere = 0;
    let transforms: Vec<DAffine3> = (0..copies)
        .map(|i| {
            let rotation = rotations.as_ref().map(|list| unit_rotation(list[i].map(f64::from)));
            turned_nowhere += usize::from(rotation == Some(None));
            DAffine3::from_scale_rotation_translation(
                vector(&scales, i, DVec3::ONE),
                rotation.flatten().unwrap_or_default(),
                vector(&translations, i, DVec3::ZERO),
            )
        })
        .collect();
    let flat = transforms.iter().filter(|copy| copy.matrix3.determinant() == 0.0).count();
    let mut remarks = document.remarks.borrow_mut();
    let text = "rotations of its copies have no direction; none is applied to them";
    remarks.count("bad-rotation", format!("nodes[{node}]"), turned_nowhere, text);
    let text = "copies have a scale of 0; they are flat or a point";
    remarks.count("zero-scale", format!("nodes[{node}]"), flat, text);
    Ok(Some(transforms))
}
