//! Attributes of the vertices of a primitive.

use ::gltf::json::accessor::{ComponentType, GenericComponentType};
use ::gltf::json::mesh::{Primitive, Semantic};
use ::gltf::json::validation::Checked;

use super::accessor::{component_name, components, read_floats};
use super::document::Document;
use rasray_scene::{Mesh, SceneError};

/// Reads the vertices of a primitive as the file has them, without triangles.
pub(super) fn undeformed(
    document: &Document<'_>,
    primitive: &Primitive,
    name: String,
    positions: usize,
) -> Result<Mesh, SceneError> {
    let normals = attribute(primitive, Semantic::Normals);
    let tangents = attribute(primitive, Semantic::Tangents);
    let colors = attribute(primitive, Semantic::Colors(0));
    Ok(Mesh {
        name,
        positions: read_directions(document, positions)?,
        normals: normals.map(|index| read_directions(document, index)).transpose()?,
        tangents: tangents.map(|index| read_directions(document, index)).transpose()?,
        uvs: [read_uvs(document, primitive, 0)?, read_uvs(document, primitive, 1)?],
        colors: colors.map(|index| read_colors(document, index)).transpose()?,
        indices: Vec::new(),
        material: primitive.material.map_or(document.root.materials.len(), |material| material.value()),
    })
}

/// Returns the accessor of an attribute.
pub(super) fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<usize> {
    primitive.attributes.get(&Checked::Valid(semantic)).map(|index| index.value())
}

/// Reads positions, normals, tangents or their morph displacements: floats, or quantised numbers if the file
/// says that its meshes are quantised.
pub(super) fn read_directions<const N: usize>(
    document: &Document<'_>,
    accessor: usize,
) -> Result<Vec<[f32; N]>, SceneError> {
    if let Checked::Valid(GenericComponentType(found)) = document.root.accessors[accessor].component_type
        && found != ComponentType::F32
        && (!is_quantized(document) || found == ComponentType::U32)
    {
        let reason = format!(
            "positions, normals and tangents must be floats (or small integers with KHR_mesh_quantization), \
             these are {}",
            component_name(found)
        );
        return Err(document.invalid(format!("accessors[{accessor}]"), reason));
    }
    read_floats(document, accessor)
}

fn is_quantized(document: &Document<'_>) -> bool {
    document.root.extensions_used.iter().any(|name| name == "KHR_mesh_quantization")
}

fn read_uvs(
    document: &Document<'_>,
    primitive: &Primitive,
    set: u32,
) -> Result<Option<Vec<[f32; 2]>>, SceneError> {
    attribute(primitive, Semantic::TexCoords(set)).map(|index| read_floats(document, index)).transpose()
}

fn read_colors(document: &Document<'_>, accessor: usize) -> Result<Vec<[f32; 4]>, SceneError> {
    if components(document, accessor)? == Some(3) {
        let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
        return Ok(read_floats(document, accessor)?.into_iter().map(opaque).collect());
    }
    read_floats(document, accessor)
}

/// Notes remarks on attributes whose numbers are of a type that the format does not allow for them. They are
/// read anyway.
pub(super) fn remark(document: &Document<'_>, place: &str, primitive: &Primitive) {
    for (semantic, index) in &primitive.attributes {
        let Checked::Valid(semantic) = semantic else { continue };
        let accessor = &document.root.accessors[index.value()];
        let Checked::Valid(GenericComponentType(component)) = accessor.component_type else { continue };
        let float = component == ComponentType::F32;
        let unsigned = matches!(component, ComponentType::U8 | ComponentType::U16);
        let share = unsigned && accessor.normalized;
        let allowed = match semantic {
            Semantic::TexCoords(0 | 1) => {
                float || share || (is_quantized(document) && component != ComponentType::U32)
            }
            Semantic::Colors(0) | Semantic::Weights(_) => float || share,
            Semantic::Joints(_) => unsigned && !accessor.normalized,
            // Other attributes are not read, or are refused where they are read.
            _ => true,
        };
        if !allowed {
            let normalized = if accessor.normalized { "normalized " } else { "" };
            let text = format!(
                "{} is of {normalized}{}, which the format does not allow there; it is read as it is",
                semantic.to_string(),
                component_name(component)
            );
            document.note("attribute-type", place, text);
        }
    }
}
