//! Morph targets, and the data of a mesh that later deformation needs.

use ::gltf::json::Index;
use ::gltf::json::accessor::Accessor;
use ::gltf::json::mesh::Primitive;

use super::attributes::read_directions;
use super::document::Document;
use rasray_scene::animation::{DeformedMesh, MorphTarget};
use rasray_scene::{Mesh, SceneError};

/// Reads the morph targets of a primitive with the undeformed `mesh`. `weights` are those at rest; absent
/// weights are zero.
pub(super) fn read(
    document: &Document<'_>,
    place: &str,
    primitive: &Primitive,
    weights: &[f32],
    mesh: &Mesh,
) -> Result<DeformedMesh, SceneError> {
    let sources = primitive.targets.as_deref().unwrap_or_default();
    let displacements = |accessor: Option<Index<Accessor>>| -> Result<Option<Vec<[f32; 3]>>, SceneError> {
        let Some(accessor) = accessor else { return Ok(None) };
        let mut read = read_directions::<3>(document, accessor.value())?;
        if read.len() != mesh.positions.len() {
            let reason =
                format!("a morph target has {} elements for {} vertices", read.len(), mesh.positions.len());
            return Err(document.invalid(place, reason));
        }
        make_finite(&mut read);
        Ok(Some(read))
    };
    let mut targets = Vec::with_capacity(sources.len());
    for target in sources {
        targets.push(MorphTarget {
            positions: displacements(target.positions)?,
            normals: displacements(target.normals)?,
            tangents: displacements(target.tangents)?,
        });
    }
    let mut deformed = DeformedMesh {
        mesh: 0,
        positions: mesh.positions.clone(),
        normals: mesh.normals.clone().filter(|list| list.len() == mesh.positions.len()),
        tangents: mesh.tangents.clone().filter(|list| list.len() == mesh.positions.len()),
        weights: weights.iter().copied().chain(std::iter::repeat(0.0)).take(targets.len()).collect(),
        targets,
        skin: None,
    };
    make_finite(&mut deformed.positions);
    deformed.normals.iter_mut().for_each(|list| make_finite(list));
    deformed.tangents.iter_mut().for_each(|list| make_finite(list));
    Ok(deformed)
}

fn make_finite<const N: usize>(list: &mut [[f32; N]]) {
    list.iter_mut().flatten().filter(|x| !x.is_finite()).for_each(|x| *x = 0.0);
}
