//! Remarks on nodes that flatten the triangles that they place.

use crate::animation::{ChannelValues, NodeTransform, Rig, RigNode};
use crate::remarks::Remarks;
use crate::{Instance, Scene};

/// Ratio of a matrix's volume to the largest that columns of these lengths can span, below which the matrix
/// is singular, but for rounding.
const SINGULAR: f64 = 1e-12;

const ZERO_SCALE: (&str, &str) = ("zero-scale", "has a scale of 0; what it places is flat or a point");
const SINGULAR_MATRIX: (&str, &str) =
    ("singular-transform", "has a singular matrix; what it places is flat or a point");

/// Notes remarks on the nodes of a rig that place triangles and flatten them while these clips play. Nodes
/// that a clip scales are left out: their geometry comes and goes on purpose.
pub fn remark(rig: &Rig, instances: &[Instance], clips: &[usize], remarks: &mut Remarks) {
    let places = placing(rig, instances);
    let mut is_scaled = vec![false; rig.nodes.len()];
    for channel in clips.iter().filter_map(|&clip| rig.clips.get(clip)).flat_map(|clip| &clip.channels) {
        if let (ChannelValues::Scale(_), Some(is_scaled)) = (&channel.values, is_scaled.get_mut(channel.node))
        {
            *is_scaled = true;
        }
    }
    for (number, RigNode { transform, .. }) in rig.nodes.iter().enumerate() {
        if places[number]
            && !is_scaled[number]
            && let Some((kind, text)) = flattens(transform)
        {
            remarks.note(kind, format!("nodes[{number}]"), text);
        }
    }
}

fn flattens(transform: &NodeTransform) -> Option<(&'static str, &'static str)> {
    match transform {
        NodeTransform::Parts { scale, .. } => scale.to_array().contains(&0.0).then_some(ZERO_SCALE),
        NodeTransform::Matrix(matrix) => {
            let volume = [0, 1, 2].map(|k| matrix.matrix3.col(k).length()).into_iter().product::<f64>();
            (matrix.matrix3.determinant().abs() <= SINGULAR * volume).then_some(SINGULAR_MATRIX)
        }
    }
}

/// Marks the nodes at or above a node that places triangles: one that shows a mesh, or a joint that has
/// weight. The node of a mesh with joints does not place the mesh.
fn placing(rig: &Rig, instances: &[Instance]) -> Vec<bool> {
    let mut starts = vec![false; rig.nodes.len()];
    let mut skinned = std::collections::HashSet::new();
    for shape in &rig.deformed {
        let Some(binding) = &shape.skin else { continue };
        skinned.insert(shape.mesh);
        let Some(skin) = rig.skins.get(binding.skin) else { continue };
        for (joint, _) in binding.joints.iter().zip(&binding.weights).filter(|(_, weight)| **weight > 0.0) {
            if let Some(start) = skin.joints.get(*joint as usize).and_then(|&node| starts.get_mut(node)) {
                *start = true;
            }
        }
    }
    for (placement, instance) in rig.placements.iter().zip(instances) {
        if !skinned.contains(&instance.mesh)
            && let Some(start) = starts.get_mut(placement.node)
        {
            *start = true;
        }
    }
    let mut places = vec![false; rig.nodes.len()];
    for start in (0..starts.len()).filter(|&node| starts[node]) {
        let mut next = Some(start);
        while let Some(node) = next.filter(|&node| !places[node]) {
            places[node] = true;
            next = rig.nodes[node].parent;
        }
    }
    places
}

impl Scene {
    /// Updates the warnings of nodes that flatten the triangles they place to the state in which these clips
    /// play: a clip that scales a node, to hide an object for a while, flattens nothing by mistake. Without
    /// clips they are the warnings of the pose at rest.
    pub fn warn_while_playing(&mut self, clips: &[usize]) {
        let ours = [ZERO_SCALE, SINGULAR_MATRIX];
        self.warnings.retain(|warning| {
            !ours.iter().any(|(kind, text)| warning.kind == *kind && warning.message.ends_with(text))
        });
        let mut remarks = Remarks::default();
        remark(&self.animation.rig, &self.instances, clips, &mut remarks);
        self.warnings.extend(remarks.into_warnings());
    }
}
