//! A mesh primitive to an indexed triangle mesh.

use ::gltf::json::Index;
use ::gltf::json::accessor::{Accessor, ComponentType, GenericComponentType};
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use glam::Vec3;

use super::accessor::{components, count, read_floats, read_integers};
use super::document::Document;
use crate::check::clean_mesh;
use crate::{Limits, Mesh, SceneError, Warning};

/// Primitives without triangles, counted for one warning a kind.
#[derive(Default)]
pub(super) struct Skipped {
    points: usize,
    lines: usize,
    without_positions: usize,
    empty: usize,
}

impl Skipped {
    /// One warning for each kind that occurred.
    pub fn report(&self, warnings: &mut Vec<Warning>) {
        let mut warn = |kind, count: usize, what: &str| {
            if count > 0 {
                warnings.push(Warning { kind, message: format!("{count} {what}") });
            }
        };
        warn("points", self.points, "point primitives were dropped: only triangles are rendered");
        warn("lines", self.lines, "line primitives were dropped: only triangles are rendered");
        warn("no-positions", self.without_positions, "primitives without positions were dropped");
        warn("empty-mesh", self.empty, "primitives without triangles were dropped");
    }
}

/// Reads a primitive, morphed by `weights` (or those of the mesh). `None` if it has no triangles.
/// `Mesh::material` is the index in the file, or the number of materials for the default one.
pub(super) fn read(
    document: &Document<'_>,
    mesh_index: usize,
    primitive_index: usize,
    weights: Option<&[f32]>,
    skipped: &mut Skipped,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Mesh>, SceneError> {
    let source = &document.root.meshes[mesh_index];
    let primitive = &source.primitives[primitive_index];
    let place = format!("meshes[{mesh_index}].primitives[{primitive_index}]");
    let mode = match primitive.mode {
        Checked::Valid(Mode::Points) => {
            skipped.points += 1;
            return Ok(None);
        }
        Checked::Valid(Mode::Lines | Mode::LineLoop | Mode::LineStrip) => {
            skipped.lines += 1;
            return Ok(None);
        }
        Checked::Valid(mode) => mode,
        Checked::Invalid => return Err(document.invalid(place, "has an unknown mode")),
    };
    let Some(positions) = attribute(primitive, Semantic::Positions) else {
        skipped.without_positions += 1;
        return Ok(None);
    };
    let mut mesh = Mesh {
        name: mesh_name(source.name.as_deref(), mesh_index, primitive_index, source.primitives.len()),
        positions: read_directions(document, positions)?,
        normals: attribute(primitive, Semantic::Normals)
            .map(|index| read_directions(document, index))
            .transpose()?,
        tangents: attribute(primitive, Semantic::Tangents)
            .map(|index| read_directions(document, index))
            .transpose()?,
        uvs: [read_uvs(document, primitive, 0)?, read_uvs(document, primitive, 1)?],
        colors: attribute(primitive, Semantic::Colors(0))
            .map(|index| read_colors(document, index))
            .transpose()?,
        indices: Vec::new(),
        material: primitive.material.map_or(document.root.materials.len(), |material| material.value()),
    };
    let corners = match primitive.indices {
        Some(indices) => read_integers::<1>(document, indices.value())?.into_iter().flatten().collect(),
        None => (0..mesh.positions.len() as u32).collect(),
    };
    mesh.indices = triangles(document, &place, mode, corners)?;
    morph(document, &place, primitive, weights.or(source.weights.as_deref()), &mut mesh)?;
    let found = mesh.triangle_count() as u64;
    Limits::check(document.path, "the number of triangles", found, document.limits.triangles, "triangles")?;
    clean_mesh(document.path, &mut mesh, warnings)?;
    if mesh.indices.is_empty() {
        skipped.empty += 1;
        return Ok(None);
    }
    Ok(Some(mesh))
}

fn mesh_name(name: Option<&str>, mesh: usize, primitive: usize, primitives: usize) -> String {
    let name = name.map_or_else(|| format!("mesh{mesh}"), str::to_owned);
    if primitives > 1 { format!("{name}.{primitive}") } else { name }
}

fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<usize> {
    primitive.attributes.get(&Checked::Valid(semantic)).map(|index| index.value())
}

/// Positions, normals, tangents and their morph displacements: floats, unless the file says that its
/// meshes are quantised.
fn read_directions<const N: usize>(
    document: &Document<'_>,
    accessor: usize,
) -> Result<Vec<[f32; N]>, SceneError> {
    let quantized = document.root.extensions_used.iter().any(|name| name == "KHR_mesh_quantization");
    let component = document.root.accessors[accessor].component_type;
    let floats = matches!(component, Checked::Valid(GenericComponentType(ComponentType::F32)));
    let wide = matches!(component, Checked::Valid(GenericComponentType(ComponentType::U32)));
    if !floats && (!quantized || wide) {
        let reason =
            "positions, normals and tangents must be floats (or small integers with KHR_mesh_quantization)";
        return Err(document.invalid(format!("accessors[{accessor}]"), reason));
    }
    read_floats(document, accessor)
}

fn read_uvs(
    document: &Document<'_>,
    primitive: &Primitive,
    set: u32,
) -> Result<Option<Vec<[f32; 2]>>, SceneError> {
    attribute(primitive, Semantic::TexCoords(set)).map(|index| read_floats(document, index)).transpose()
}

fn read_colors(document: &Document<'_>, accessor: usize) -> Result<Vec<[f32; 4]>, SceneError> {
    if components(document, accessor)? == 3 {
        let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
        return Ok(read_floats(document, accessor)?.into_iter().map(opaque).collect());
    }
    read_floats(document, accessor)
}

/// Three corners a triangle, in the order and winding of the format.
fn triangles(
    document: &Document<'_>,
    place: &str,
    mode: Mode,
    corners: Vec<u32>,
) -> Result<Vec<u32>, SceneError> {
    match mode {
        Mode::TriangleStrip => Ok(corners
            .windows(3)
            .enumerate()
            .flat_map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] })
            .collect()),
        Mode::TriangleFan => {
            let Some((&centre, rim)) = corners.split_first() else { return Ok(corners) };
            Ok(rim.windows(2).flat_map(|edge| [edge[0], edge[1], centre]).collect())
        }
        _ if !corners.len().is_multiple_of(3) => {
            let reason = format!("{} vertices do not make whole triangles", corners.len());
            Err(document.invalid(place, reason))
        }
        _ => Ok(corners),
    }
}

/// Adds the weighted morph targets.
fn morph(
    document: &Document<'_>,
    place: &str,
    primitive: &Primitive,
    weights: Option<&[f32]>,
    mesh: &mut Mesh,
) -> Result<(), SceneError> {
    let targets = primitive.targets.as_deref().unwrap_or_default();
    let weights = weights.unwrap_or_default().iter().copied().chain(std::iter::repeat(0.0));
    let mut turned = false;
    for (target, weight) in targets.iter().zip(weights) {
        for index in [target.positions, target.normals, target.tangents].into_iter().flatten() {
            same_count(document, place, index, mesh.positions.len())?;
        }
        if weight == 0.0 {
            continue;
        }
        add(document, target.positions, weight, mesh.positions.iter_mut().map(|position| &mut position[..]))?;
        if let Some(normals) = &mut mesh.normals {
            turned |= target.normals.is_some();
            add(document, target.normals, weight, normals.iter_mut().map(|normal| &mut normal[..]))?;
        }
        if let Some(tangents) = &mut mesh.tangents {
            add(document, target.tangents, weight, tangents.iter_mut().map(|tangent| &mut tangent[..3]))?;
        }
    }
    if turned {
        for normal in mesh.normals.iter_mut().flatten() {
            *normal = Vec3::from(*normal).normalize_or_zero().to_array();
        }
    }
    Ok(())
}

fn same_count(
    document: &Document<'_>,
    place: &str,
    accessor: Index<Accessor>,
    vertices: usize,
) -> Result<(), SceneError> {
    let found = count(document, accessor.value())?;
    if found != vertices {
        let reason = format!("a morph target has {found} elements for {vertices} vertices");
        return Err(document.invalid(place, reason));
    }
    Ok(())
}

fn add<'v>(
    document: &Document<'_>,
    displacement: Option<Index<Accessor>>,
    weight: f32,
    vectors: impl Iterator<Item = &'v mut [f32]>,
) -> Result<(), SceneError> {
    let Some(displacement) = displacement else { return Ok(()) };
    for (vector, displacement) in vectors.zip(read_directions::<3>(document, displacement.value())?) {
        for (x, d) in vector.iter_mut().zip(displacement) {
            *x += weight * d;
        }
    }
    Ok(())
}
