//! Node graph: a forest, traversed without recursion, multiplied out in f64.

use glam::DAffine3;

use super::document::Document;
use crate::{Limits, SceneChoice};
use rasray_scene::SceneError;

/// Transforms of all nodes.
pub(super) struct Hierarchy {
    /// Map from each node's space to the world.
    pub world: Vec<DAffine3>,
    /// Parent of each node.
    pub parent: Vec<Option<usize>>,
}

impl Hierarchy {
    /// Checks that the graph is a forest of bounded depth, and multiplies the transforms along it.
    pub fn of(document: &Document<'_>) -> Result<Self, SceneError> {
        let nodes = &document.root.nodes;
        let mut parent = vec![None; nodes.len()];
        for (i, node) in nodes.iter().enumerate() {
            for child in node.children.iter().flatten().map(|child| child.value()) {
                if let Some(other) = parent[child].replace(i) {
                    let reason =
                        format!("is a child of nodes[{other}] and of nodes[{i}]; a node has one parent");
                    return Err(document.invalid(format!("nodes[{child}]"), reason));
                }
            }
        }
        let mut world = vec![DAffine3::IDENTITY; nodes.len()];
        let mut reached = vec![false; nodes.len()];
        let mut stack: Vec<(usize, u64)> =
            (0..nodes.len()).filter(|&node| parent[node].is_none()).map(|node| (node, 1)).collect();
        while let Some((node, depth)) = stack.pop() {
            Limits::check(
                document.path,
                "the depth of the node graph",
                depth,
                document.limits.depth,
                "depth",
            )?;
            reached[node] = true;
            let above = parent[node].map_or(DAffine3::IDENTITY, |parent| world[parent]);
            world[node] = above * document.locals[node].to_affine();
            stack.extend(nodes[node].children.iter().flatten().map(|child| (child.value(), depth + 1)));
        }
        // As each node has at most one parent, a node that no root reaches is on a cycle or hangs below one.
        match reached.iter().position(|&reached| !reached) {
            Some(node) => {
                Err(document
                    .invalid(format!("nodes[{node}]"), "is its own ancestor, or below a node that is"))
            }
            None => Ok(Self { world, parent }),
        }
    }

    /// Returns the nodes of the chosen scene, depth-first, children in order.
    pub fn scene_order(
        &self,
        document: &Document<'_>,
        choice: &SceneChoice,
    ) -> Result<Vec<usize>, SceneError> {
        let mut stack = roots(document, self, choice)?;
        let mut listed = vec![false; self.world.len()];
        for &root in &stack {
            let place = format!("nodes[{root}]");
            if self.parent[root].is_some() {
                return Err(document.invalid(place, "is listed in a scene but has a parent"));
            }
            if std::mem::replace(&mut listed[root], true) {
                return Err(document.invalid(place, "is listed twice in a scene"));
            }
        }
        stack.reverse();
        let mut order = Vec::new();
        while let Some(node) = stack.pop() {
            order.push(node);
            stack
                .extend(document.root.nodes[node].children.iter().flatten().rev().map(|child| child.value()));
        }
        Ok(order)
    }
}

/// Returns the reason why the scene of the nodes in `order` shows no mesh; `None` if a node has one.
pub(super) fn without_meshes(document: &Document<'_>, order: &[usize]) -> Option<String> {
    let root = &document.root;
    let shown = |nodes: &[usize]| nodes.iter().any(|&node| root.nodes[node].mesh.is_some());
    if shown(order) {
        return None;
    }
    let meshes = root.meshes.len();
    let (count, are) =
        if meshes == 1 { ("1 mesh".to_owned(), "is") } else { (format!("{meshes} meshes"), "are") };
    if meshes == 0 {
        return Some("the file has no meshes".to_owned());
    }
    let mut placed = Vec::new();
    let mut stack: Vec<usize> =
        root.scenes.iter().flat_map(|scene| &scene.nodes).map(|node| node.value()).collect();
    // The graph is a forest, but a root may be in many scenes.
    let mut seen = vec![false; root.nodes.len()];
    while let Some(node) = stack.pop() {
        if !std::mem::replace(&mut seen[node], true) {
            placed.push(node);
            stack.extend(root.nodes[node].children.iter().flatten().map(|child| child.value()));
        }
    }
    Some(if shown(&placed) {
        format!("the scene has no mesh; {count} {are} in other scenes of the file")
    } else {
        format!("{count} {are} in no scene")
    })
}

/// Returns the root nodes of the chosen scene.
fn roots(
    document: &Document<'_>,
    hierarchy: &Hierarchy,
    choice: &SceneChoice,
) -> Result<Vec<usize>, SceneError> {
    let scenes = &document.root.scenes;
    let chosen = match choice {
        SceneChoice::Default => {
            let default = document.root.scene.map_or(0, |scene| scene.value());
            if scenes.is_empty() {
                let parentless = (0..hierarchy.parent.len()).filter(|&node| hierarchy.parent[node].is_none());
                return Ok(parentless.collect());
            }
            scenes.get(default)
        }
        SceneChoice::Index(index) => scenes.get(*index),
        SceneChoice::Name(name) => scenes.iter().find(|scene| scene.name.as_ref() == Some(name)),
    };
    match chosen {
        Some(scene) => Ok(scene.nodes.iter().map(|node| node.value()).collect()),
        None => Err(no_such_scene(document, choice)),
    }
}

fn no_such_scene(document: &Document<'_>, choice: &SceneChoice) -> SceneError {
    let names: Vec<String> = document
        .root
        .scenes
        .iter()
        .enumerate()
        .map(|(i, scene)| match &scene.name {
            Some(name) => format!("{i} ({name})"),
            None => i.to_string(),
        })
        .collect();
    SceneError::NoSuchScene {
        path: document.path.to_owned(),
        wanted: match choice {
            SceneChoice::Default => "default".to_owned(),
            SceneChoice::Index(index) => index.to_string(),
            SceneChoice::Name(name) => format!("{name:?}"),
        },
        available: if names.is_empty() { "none".to_owned() } else { names.join(", ") },
    }
}
