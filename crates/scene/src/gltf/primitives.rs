//! A mesh primitive to an indexed triangle mesh.

use ::gltf::json::accessor::{ComponentType, GenericComponentType};
use ::gltf::json::mesh::Semantic::{Joints, Weights};
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use glam::DAffine3;

use super::accessor::{components, read_floats, read_integers};
use super::document::Document;
use super::hierarchy::Hierarchy;
use super::{deformation, skins};
use crate::animation::{DeformedMesh, Skin};
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

    /// How the triangles of a primitive are made, and its positions; counts it if it has none.
    fn triangles_of(&mut self, primitive: &Primitive) -> Option<(Mode, usize)> {
        let count = match primitive.mode {
            Checked::Valid(Mode::Points) => &mut self.points,
            Checked::Valid(Mode::Lines | Mode::LineLoop | Mode::LineStrip) => &mut self.lines,
            Checked::Valid(mode) => match attribute(primitive, Semantic::Positions) {
                Some(positions) => return Some((mode, positions)),
                None => &mut self.without_positions,
            },
            // Refused when the file was opened.
            Checked::Invalid => &mut self.empty,
        };
        *count += 1;
        None
    }
}

/// A primitive of the file and the node that shows it.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    pub node: usize,
    pub mesh: usize,
    pub primitive: usize,
}

/// What became of a primitive. `Mesh::material` is the index in the file, or the number of
/// materials for the default one; `DeformedMesh::mesh` is not known here.
pub(super) struct Read {
    pub mesh: Mesh,
    /// What it was before morph targets and joints moved it, if any do.
    pub deformed: Option<DeformedMesh>,
    /// Where a skinned mesh is; other meshes are where their node is.
    pub world_from_mesh: Option<DAffine3>,
}

/// Reads a primitive in its pose at rest. `None` if it has no triangles.
pub(super) fn read(
    document: &Document<'_>,
    hierarchy: &Hierarchy,
    skins: &[Skin],
    shown: Shown,
    skipped: &mut Skipped,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Read>, SceneError> {
    let source = &document.root.meshes[shown.mesh];
    let primitive = &source.primitives[shown.primitive];
    let place = format!("meshes[{}].primitives[{}]", shown.mesh, shown.primitive);
    let Some((mode, positions)) = skipped.triangles_of(primitive) else { return Ok(None) };
    let name = mesh_name(source.name.as_deref(), shown.mesh, shown.primitive, source.primitives.len());
    let mut mesh = undeformed(document, primitive, name, positions)?;
    let corners = match primitive.indices {
        Some(indices) => read_integers::<1>(document, indices.value())?.into_iter().flatten().collect(),
        None => (0..mesh.positions.len() as u32).collect(),
    };
    mesh.indices = triangles(document, &place, mode, corners)?;
    let found = mesh.triangle_count() as u64;
    Limits::check(document.path, "the number of triangles", found, document.limits.triangles, "triangles")?;

    let node = &document.root.nodes[shown.node];
    let binding = match (node.skin, attribute(primitive, Joints(0)), attribute(primitive, Weights(0))) {
        (Some(skin), Some(joints), Some(weights)) => {
            if attribute(primitive, Joints(1)).is_some() {
                warnings.push(Warning {
                    kind: "many-joints",
                    message: format!("mesh {}: only the first four joints of a vertex are used", mesh.name),
                });
            }
            let vertices = mesh.positions.len();
            Some(skins::read_binding(document, &place, skin.value(), (joints, weights), vertices)?)
        }
        (Some(_), ..) => {
            warnings.push(Warning {
                kind: "skin-without-joints",
                message: format!("mesh {}: its node has a skin, but it has no joints or weights", mesh.name),
            });
            None
        }
        (None, ..) => None,
    };
    let morphed = primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty());
    let mut deformed = None;
    let mut world_from_mesh = None;
    if morphed || binding.is_some() {
        let weights = node.weights.as_deref().or(source.weights.as_deref()).unwrap_or_default();
        let mut kept = deformation::read(document, &place, primitive, weights, &mesh)?;
        deformation::morph(&kept, &mut mesh);
        world_from_mesh =
            binding.as_ref().map(|found| skins::pose(&skins[found.skin], found, hierarchy, &mut mesh));
        kept.skin = binding;
        deformed = Some(kept);
    }
    clean_mesh(document.path, &mut mesh, warnings)?;
    if mesh.indices.is_empty() {
        skipped.empty += 1;
        return Ok(None);
    }
    Ok(Some(Read { mesh, deformed, world_from_mesh }))
}

/// The vertices of a primitive, as the file has them; no triangles yet.
fn undeformed(
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

fn mesh_name(name: Option<&str>, mesh: usize, primitive: usize, primitives: usize) -> String {
    let name = name.map_or_else(|| format!("mesh{mesh}"), str::to_owned);
    if primitives > 1 { format!("{name}.{primitive}") } else { name }
}

fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<usize> {
    primitive.attributes.get(&Checked::Valid(semantic)).map(|index| index.value())
}

/// Positions, normals, tangents and their morph displacements: floats, unless the file says that its
/// meshes are quantised.
pub(super) fn read_directions<const N: usize>(
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
