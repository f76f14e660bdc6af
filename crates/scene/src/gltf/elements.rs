//! Meshes and instances: the primitives of the chosen scene, each read once, placed by its nodes.

use std::collections::HashMap;

use glam::DAffine3;

use super::document::Document;
use super::hierarchy::Hierarchy;
use super::instancing;
use super::primitives::{self, Skipped};
use crate::{Instance, Limits, Mesh, SceneError, Warning};

/// Meshes of the scene, `Mesh::material` still an index into the file (its length: the default
/// material), and where they are.
#[derive(Default)]
pub(super) struct Placed {
    pub meshes: Vec<Mesh>,
    pub instances: Vec<Instance>,
}

/// What identifies the geometry of a primitive: mesh, primitive, and the node if it has morph
/// weights of its own.
type MeshKey = (usize, usize, Option<usize>);

/// Reads and places what the nodes in `order` show.
pub(super) fn place(
    document: &Document<'_>,
    hierarchy: &Hierarchy,
    order: &[usize],
    warnings: &mut Vec<Warning>,
) -> Result<Placed, SceneError> {
    let mut placer = Placer {
        document,
        placed: Placed::default(),
        read: HashMap::new(),
        names: HashMap::new(),
        triangles: 0,
        lost: 0,
    };
    let mut skipped = Skipped::default();
    for &node in order {
        let Some(mesh) = document.root.nodes[node].mesh else { continue };
        let copies = instancing::transforms(document, node)?;
        for primitive in 0..document.root.meshes[mesh.value()].primitives.len() {
            if let Some(mesh) = placer.mesh(node, mesh.value(), primitive, &mut skipped, warnings)? {
                placer.instances(node, mesh, hierarchy.world[node], copies.as_deref())?;
            }
        }
    }
    skipped.report(warnings);
    if placer.lost > 0 {
        warnings.push(Warning {
            kind: "non-finite-instances",
            message: format!("{} instances have a place that is not finite and were dropped", placer.lost),
        });
    }
    Ok(placer.placed)
}

struct Placer<'a> {
    document: &'a Document<'a>,
    placed: Placed,
    read: HashMap<MeshKey, Option<usize>>,
    names: HashMap<String, usize>,
    triangles: u64,
    lost: usize,
}

impl Placer<'_> {
    /// Index of the mesh of a primitive, `None` if it has no triangles.
    fn mesh(
        &mut self,
        node: usize,
        mesh: usize,
        primitive: usize,
        skipped: &mut Skipped,
        warnings: &mut Vec<Warning>,
    ) -> Result<Option<usize>, SceneError> {
        let own_weights = self.document.root.nodes[node].weights.as_deref();
        let key = (mesh, primitive, own_weights.map(|_| node));
        if let Some(&known) = self.read.get(&key) {
            return Ok(known);
        }
        let read = primitives::read(self.document, mesh, primitive, own_weights, skipped, warnings)?;
        let index = read.map(|mesh| {
            self.placed.meshes.push(mesh);
            self.placed.meshes.len() - 1
        });
        self.read.insert(key, index);
        Ok(index)
    }

    /// Adds the instances of a mesh at a node: one, or one a copy.
    fn instances(
        &mut self,
        node: usize,
        mesh: usize,
        world: DAffine3,
        copies: Option<&[DAffine3]>,
    ) -> Result<(), SceneError> {
        let copies = copies.unwrap_or(&[DAffine3::IDENTITY]);
        let Document { path, limits, .. } = *self.document;
        let placed = self.placed.instances.len() as u64 + copies.len() as u64;
        Limits::check(path, "the number of instances", placed, limits.instances, "instances")?;
        self.triangles += self.placed.meshes[mesh].triangle_count() as u64 * copies.len() as u64;
        Limits::check(path, "the number of placed triangles", self.triangles, limits.triangles, "triangles")?;
        for copy in copies {
            let world_from_mesh = world * *copy;
            if world_from_mesh.is_finite() {
                let name = self.instance_name(node);
                self.placed.instances.push(Instance { name, mesh, world_from_mesh });
            } else {
                self.lost += 1;
            }
        }
        Ok(())
    }

    /// The node's name, from its second use on with a running number.
    fn instance_name(&mut self, node: usize) -> String {
        let name = self.document.root.nodes[node].name.clone().unwrap_or_else(|| format!("node{node}"));
        let uses = self.names.entry(name.clone()).or_insert(0);
        *uses += 1;
        if *uses == 1 { name } else { format!("{name}.{uses}") }
    }
}
