//! Meshes and instances: the primitives of the chosen scene, each read once, placed by its nodes.

use std::collections::HashMap;

use glam::DAffine3;

use super::document::Document;
use super::hierarchy::Hierarchy;
use super::instancing;
use super::primitives::{self, Shown, Skipped};
use crate::Limits;
use rasray_scene::animation::{DeformedMesh, Placement, Skin};
use rasray_scene::{Instance, Mesh, SceneError};

/// Meshes of the scene, with their placements and their undeformed shapes. `Mesh::material` is still an index
/// into the file (the number of materials stands for the default material).
#[derive(Default)]
pub(super) struct Placed {
    pub meshes: Vec<Mesh>,
    pub instances: Vec<Instance>,
    /// Placements, one per instance.
    pub placements: Vec<Placement>,
    pub deformed: Vec<DeformedMesh>,
}

/// Identity of the geometry of a primitive: mesh, primitive, and the node if that has a skin or
/// morph weights of its own.
type MeshKey = (usize, usize, Option<usize>);

/// Mesh that was read, and its transform if it is not at its node.
type Known = Option<(usize, Option<DAffine3>)>;

/// Reads and places the meshes that the nodes in `order` show.
pub(super) fn place(
    document: &Document<'_>,
    hierarchy: &Hierarchy,
    skins: &[Skin],
    order: &[usize],
) -> Result<Placed, SceneError> {
    let mut placer = Placer {
        document,
        hierarchy,
        skins,
        placed: Placed::default(),
        read: HashMap::new(),
        names: HashMap::new(),
        skipped: Skipped::default(),
        triangles: 0,
        lost: 0,
    };
    for &node in order {
        let Some(mesh) = document.root.nodes[node].mesh.map(|mesh| mesh.value()) else { continue };
        let copies = instancing::transforms(document, node)?;
        let copies = copies.as_deref().unwrap_or(&[DAffine3::IDENTITY]);
        for primitive in 0..document.root.meshes[mesh].primitives.len() {
            let shown = Shown { node, mesh, primitive };
            match placer.mesh(shown)? {
                // Joints place a skinned mesh, and its node does not: copies would coincide.
                Some((mesh, Some(world))) => {
                    if copies.len() > 1 {
                        let text = "has copies of a mesh with a skin, which joints place: they would coincide, and one is shown";
                        document.note("skinned-copies", format!("nodes[{node}]"), text);
                    }
                    placer.instances(node, mesh, world, &[DAffine3::IDENTITY])?;
                }
                Some((mesh, None)) => placer.instances(node, mesh, hierarchy.world[node], copies)?,
                None => {}
            }
        }
    }
    let mut remarks = document.remarks.borrow_mut();
    placer.skipped.report(&mut remarks);
    let text = "instances have a place that is not finite and were dropped";
    remarks.count("non-finite-instances", "", placer.lost, text);
    Ok(placer.placed)
}

struct Placer<'a, 'd> {
    document: &'a Document<'d>,
    hierarchy: &'a Hierarchy,
    skins: &'a [Skin],
    placed: Placed,
    read: HashMap<MeshKey, Known>,
    names: HashMap<String, usize>,
    skipped: Skipped,
    triangles: u64,
    lost: usize,
}

impl Placer<'_, '_> {
    /// Returns the mesh of a primitive, `None` if it has no triangles.
    fn mesh(&mut self, shown: Shown) -> Result<Known, SceneError> {
        let node = &self.document.root.nodes[shown.node];
        let own = node.weights.is_some() || node.skin.is_some();
        let key = (shown.mesh, shown.primitive, own.then_some(shown.node));
        if let Some(&known) = self.read.get(&key) {
            return Ok(known);
        }
        let read = primitives::read(self.document, self.hierarchy, self.skins, shown, &mut self.skipped)?;
        let known = read.map(|read| {
            let mesh = self.placed.meshes.len();
            self.placed.meshes.push(read.mesh);
            self.placed.deformed.extend(read.deformed.map(|deformed| DeformedMesh { mesh, ..deformed }));
            (mesh, read.world_from_mesh)
        });
        self.read.insert(key, known);
        Ok(known)
    }

    /// Adds the instances of a mesh at a node, one per copy.
    fn instances(
        &mut self,
        node: usize,
        mesh: usize,
        world: DAffine3,
        copies: &[DAffine3],
    ) -> Result<(), SceneError> {
        let Document { path, limits, .. } = *self.document;
        let placed = self.placed.instances.len() as u64 + copies.len() as u64;
        Limits::check(path, "the number of instances", placed, limits.instances, "instances")?;
        self.triangles += self.placed.meshes[mesh].triangle_count() as u64 * copies.len() as u64;
        Limits::check(path, "the number of placed triangles", self.triangles, limits.triangles, "triangles")?;
        for &node_from_mesh in copies {
            let world_from_mesh = world * node_from_mesh;
            if world_from_mesh.is_finite() {
                let name = self.instance_name(node);
                self.placed.instances.push(Instance { name, mesh, world_from_mesh });
                self.placed.placements.push(Placement { node, node_from_mesh });
            } else {
                self.lost += 1;
            }
        }
        Ok(())
    }

    /// Returns the node's name, from its second use on with a running number.
    fn instance_name(&mut self, node: usize) -> String {
        let name = self.document.root.nodes[node].name.clone().unwrap_or_else(|| format!("node{node}"));
        let uses = self.names.entry(name.clone()).or_insert(0);
        *uses += 1;
        if *uses == 1 { name } else { format!("{name}.{uses}") }
    }
}
