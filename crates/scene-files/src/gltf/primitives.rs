//! Conversion of a mesh primitive to an indexed triangle mesh.

use ::gltf::json::mesh::Semantic::{Joints as JointsOf, Weights as WeightsOf};
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use glam::DAffine3;

use super::accessor::read_integers;
use super::attributes::{self, attribute};
use super::document::Document;
use super::hierarchy::Hierarchy;
use super::{deformation, draco, skins};
use crate::Limits;
use rasray_scene::animation::{DeformedMesh, Skin};
use rasray_scene::pose::{Joints, deform};
use rasray_scene::remarks::Remarks;
use rasray_scene::{Mesh, SceneError, check};

/// Counts of primitives without triangles, for one warning per kind.
#[derive(Default)]
pub(super) struct Skipped {
    points: usize,
    lines: usize,
    without_positions: usize,
    empty: usize,
}

impl Skipped {
    /// Notes one remark for each kind that occurred.
    pub fn report(&self, remarks: &mut Remarks) {
        let mut count = |kind, count, text| remarks.count(kind, "", count, text);
        count("points", self.points, "point primitives were dropped: only triangles are rendered");
        count("lines", self.lines, "line primitives were dropped: only triangles are rendered");
        count("no-positions", self.without_positions, "primitives without positions were dropped");
        count("empty-mesh", self.empty, "primitives without triangles were dropped");
    }

    /// Returns the mode of a primitive's triangles, and its positions; counts the primitive if it has none.
    fn triangles_of(
        &mut self,
        document: &Document<'_>,
        place: &str,
        primitive: &Primitive,
    ) -> Result<Option<(Mode, usize)>, SceneError> {
        let count = match primitive.mode {
            Checked::Valid(Mode::Points) => &mut self.points,
            Checked::Valid(Mode::Lines | Mode::LineLoop | Mode::LineStrip) => &mut self.lines,
            Checked::Valid(mode) => match attribute(primitive, Semantic::Positions) {
                Some(positions) => return Ok(Some((mode, positions))),
                None => &mut self.without_positions,
            },
            Checked::Invalid => {
                let place = format!("{place}.mode");
                let reason = document.unknown(&place);
                return Err(document.invalid(place, reason));
            }
        };
        *count += 1;
        Ok(None)
    }
}

/// Primitive of the file and the node that shows it.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    pub node: usize,
    pub mesh: usize,
    pub primitive: usize,
}

/// Primitive as read. `Mesh::material` is the index in the file, or the number of materials for the default
/// one; `DeformedMesh::mesh` is not set yet.
pub(super) struct Read {
    pub mesh: Mesh,
    /// Mesh before morph targets and joints move it, if any do.
    pub deformed: Option<DeformedMesh>,
    /// Transform of a skinned mesh; other meshes have the transform of their node.
    pub world_from_mesh: Option<DAffine3>,
}

/// Reads a primitive in its pose at rest. `None` if it has no triangles.
pub(super) fn read(
    document: &Document<'_>,
    hierarchy: &Hierarchy,
    skins: &[Skin],
    shown: Shown,
    skipped: &mut Skipped,
) -> Result<Option<Read>, SceneError> {
    let source = &document.root.meshes[shown.mesh];
    let primitive = &source.primitives[shown.primitive];
    let place = format!("meshes[{}].primitives[{}]", shown.mesh, shown.primitive);
    let Some((mode, positions)) = skipped.triangles_of(document, &place, primitive)? else { return Ok(None) };
    draco::check(document, &place, primitive)?;
    let name = mesh_name(source.name.as_deref(), shown.mesh, shown.primitive, source.primitives.len());
    attributes::remark(document, &place, primitive);
    if let Some(unread) = document.unread.get(&(shown.mesh, shown.primitive)) {
        unread.remark(document, &place);
    }
    let mut mesh = attributes::undeformed(document, primitive, name, positions)?;
    let corners = match primitive.indices {
        Some(indices) => read_integers::<1>(document, indices.value())?.into_iter().flatten().collect(),
        None => (0..mesh.positions.len() as u32).collect(),
    };
    mesh.indices = triangles(document, &place, mode, corners)?;
    let found = mesh.triangle_count() as u64;
    Limits::check(document.path, "the number of triangles", found, document.limits.triangles, "triangles")?;

    let node = &document.root.nodes[shown.node];
    let sets: Vec<(usize, usize)> = (0..)
        .map_while(|set| Some((attribute(primitive, JointsOf(set))?, attribute(primitive, WeightsOf(set))?)))
        .collect();
    let binding = match node.skin {
        Some(_) if sets.is_empty() => {
            let text = "its node has a skin, but it has no joints or weights";
            document.note("skin-without-joints", format!("mesh {}", mesh.name), text);
            None
        }
        Some(skin) => {
            skins::remark(document, &place, primitive, sets.len() as u32);
            Some(skins::read_binding(document, &place, skin.value(), &sets, mesh.positions.len())?)
        }
        None => None,
    };
    let morphed = primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty());
    let mut deformed = None;
    let mut world_from_mesh = None;
    if morphed || binding.is_some() {
        let weights = node.weights.as_deref().or(source.weights.as_deref()).unwrap_or_default();
        let mut kept = deformation::read(document, &place, primitive, weights, &mesh)?;
        let (given, targets) = (weights.len(), kept.targets.len());
        if given > 0 && targets > 0 && given != targets {
            let whose =
                if node.weights.is_some() { format!("nodes[{}]", shown.node) } else { "its mesh".to_owned() };
            let text = format!(
                "{whose} has {given} weights for {targets} morph targets; {}",
                match given < targets {
                    true => "the others are 0",
                    false => "those beyond were dropped",
                }
            );
            document.note("morph-weights", &place, text);
        }
        let joints = binding.as_ref().map(|found| Joints::new(&skins[found.skin], found, &hierarchy.world));
        let weights: Vec<f64> = kept.weights.iter().copied().map(f64::from).collect();
        world_from_mesh = deform(&mut mesh, &kept, &weights, joints.as_ref());
        kept.skin = binding;
        deformed = Some(kept);
    }
    let clips = !document.root.animations.is_empty();
    let before = deformed.as_ref().filter(|_| clips).map(|kept| &kept.positions[..]);
    check::clean_deformed(document.path, &mut mesh, before, &mut document.remarks.borrow_mut())?;
    if mesh.indices.is_empty() {
        skipped.empty += 1;
        return Ok(None);
    }
    Ok(Some(Read { mesh, deformed, world_from_mesh }))
}

fn mesh_name(name: Option<&str>, mesh: usize, primitive: usize, primitives: usize) -> String {
    let name = name.map_or_else(|| format!("mesh{mesh}"), str::to_owned);
    if primitives > 1 { format!("{name}.{primitive}") } else { name }
}

/// Returns three corners per triangle, in the order and winding of the format.
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
