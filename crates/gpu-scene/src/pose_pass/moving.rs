//! Nodes and weights that the clips of a scene can move.

use rasray_scene::animation::{ChannelValues, DeformedMesh, NodeTransform, Rig};

/// Nodes that any clip can move, and nodes whose morph targets it can change.
pub struct Moving {
    /// Carrier of each node: the node itself or the nearest node above it that a clip changes; absent if the
    /// node is static.
    nodes: Vec<Option<usize>>,
    weights: Vec<bool>,
}

impl Moving {
    /// Finds the nodes. Linear in nodes and channels.
    pub fn of(rig: &Rig) -> Self {
        let count = rig.nodes.len();
        let (mut nodes, mut weights) = (vec![None::<Option<usize>>; count], vec![false; count]);
        for channel in rig.clips.iter().flat_map(|clip| &clip.channels) {
            let Some(node) = rig.nodes.get(channel.node) else { continue };
            match channel.values {
                ChannelValues::Weights { .. } => weights[channel.node] = true,
                // The format forbids animated matrices.
                _ if matches!(node.transform, NodeTransform::Parts { .. }) => {
                    nodes[channel.node] = Some(Some(channel.node));
                }
                _ => {}
            }
        }
        for start in 0..count {
            let mut chain = Vec::new();
            let mut next = Some(start);
            // A forest has no cycle; a chain longer than the number of nodes would be one.
            while let Some(node) = next.filter(|&node| nodes[node].is_none() && chain.len() < count) {
                chain.push(node);
                next = rig.nodes[node].parent;
            }
            let above = next.and_then(|node| nodes[node]).flatten();
            chain.into_iter().for_each(|node| nodes[node] = Some(above));
        }
        Self { nodes: nodes.into_iter().map(Option::flatten).collect(), weights }
    }

    /// True if a node moves, by itself or with one above it.
    pub fn node(&self, node: usize) -> bool {
        self.carrier(node).is_some()
    }

    /// Returns the carrier of a node: the node itself or the nearest above it that a clip changes. Nodes with
    /// one carrier keep their places relative to it. `None` if the node is static.
    pub fn carrier(&self, node: usize) -> Option<usize> {
        self.nodes.get(node).copied().flatten()
    }

    /// True if the vertices of an instance at a node move, with this deformation.
    pub fn instance(&self, rig: &Rig, node: usize, deformed: Option<&DeformedMesh>) -> bool {
        let Some(deformed) = deformed else { return self.node(node) };
        let morphs = !deformed.targets.is_empty() && self.weights.get(node).copied().unwrap_or(false);
        let skin = deformed.skin.as_ref().and_then(|binding| rig.skins.get(binding.skin));
        // Joints place a skinned mesh, and its node does not.
        let is_carried =
            skin.map_or_else(|| self.node(node), |skin| skin.joints.iter().any(|&joint| self.node(joint)));
        morphs || is_carried
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DAffine3, DQuat, DVec3};
    use rasray_scene::animation::{Channel, Clip, Interpolation, RigNode};

    #[test]
    fn what_hangs_on_a_moving_node_moves() {
        let parts =
            NodeTransform::Parts { translation: DVec3::ZERO, rotation: DQuat::IDENTITY, scale: DVec3::ONE };
        let node = |parent, transform| RigNode { name: String::new(), parent, transform };
        let channel =
            |node, values| Channel { node, interpolation: Interpolation::Step, times: vec![0.0], values };
        // Node 0 hangs on 2, which hangs on 3, which is animated; 1 and 4 are static: a matrix cannot be
        // animated, and weights move no node.
        let rig = Rig {
            nodes: vec![
                node(Some(2), parts),
                node(None, parts),
                node(Some(3), parts),
                node(None, parts),
                node(None, NodeTransform::Matrix(DAffine3::IDENTITY)),
            ],
            clips: vec![Clip {
                name: String::new(),
                duration: 0.0,
                channels: vec![
                    channel(3, ChannelValues::Translation(vec![[0.0; 3]])),
                    channel(4, ChannelValues::Translation(vec![[0.0; 3]])),
                    channel(1, ChannelValues::Weights { values: vec![0.0], targets: 1 }),
                ],
            }],
            ..Rig::default()
        };
        let moving = Moving::of(&rig);
        assert_eq!([0, 1, 2, 3, 4, 9].map(|node| moving.node(node)), [true, false, true, true, false, false]);
        assert_eq!([0, 1, 2, 3].map(|node| moving.carrier(node)), [Some(3), None, Some(3), Some(3)]);
        let morphed = DeformedMesh { targets: vec![Default::default()], ..DeformedMesh::default() };
        assert!(moving.instance(&rig, 1, Some(&morphed)) && !moving.instance(&rig, 1, None));
        assert!(!moving.instance(&rig, 1, Some(&DeformedMesh::default())), "there is no target to show");
    }
}
