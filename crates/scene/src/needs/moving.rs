//! Instances that change with time.

use crate::Scene;
use crate::animation::{ChannelValues, Rig};

/// Returns for each instance, in scene order, true if it changes with time. A clip can move or deform it: by
/// animating its node or one above it, a joint of its skin or one above that, or the weights of its morph
/// targets. A deformer can change its mesh.
pub fn moving_instances(scene: &Scene) -> Vec<bool> {
    let mut moving = moved_by_clips(scene);
    if let Some(deformer) = &scene.animation.deformer {
        let changed = deformer.meshes();
        for (moves, instance) in moving.iter_mut().zip(&scene.instances) {
            *moves |= changed.contains(&instance.mesh);
        }
    }
    moving
}

fn moved_by_clips(scene: &Scene) -> Vec<bool> {
    let rig = &scene.animation.rig;
    if rig.clips.is_empty() {
        return vec![false; scene.instances.len()];
    }
    let moving = moving_nodes(rig);
    let moves = |node: usize| moving.get(node).copied().unwrap_or(false);
    let mut weighted = vec![false; rig.nodes.len()];
    for channel in rig.clips.iter().flat_map(|clip| &clip.channels) {
        if let (ChannelValues::Weights { .. }, Some(node)) = (&channel.values, weighted.get_mut(channel.node))
        {
            *node = true;
        }
    }
    let mut deformed = vec![None; scene.meshes.len()];
    for entry in &rig.deformed {
        if let Some(slot) = deformed.get_mut(entry.mesh) {
            *slot = Some(entry);
        }
    }
    let of_instance = |(index, instance): (usize, &crate::Instance)| {
        let node = rig.placements.get(index).map(|placement| placement.node);
        let entry = deformed.get(instance.mesh).copied().flatten();
        let skin = entry.and_then(|entry| rig.skins.get(entry.skin.as_ref()?.skin));
        let skinned = skin.is_some_and(|skin| skin.joints.iter().any(|joint| moves(*joint)));
        let morphed = entry.is_some_and(|entry| !entry.targets.is_empty())
            && node.is_some_and(|node| weighted.get(node).copied().unwrap_or(false));
        skinned || morphed || node.is_some_and(moves)
    };
    scene.instances.iter().enumerate().map(of_instance).collect()
}

/// Marks the nodes that a clip animates, and all nodes below them.
fn moving_nodes(rig: &Rig) -> Vec<bool> {
    let mut animated = vec![false; rig.nodes.len()];
    for channel in rig.clips.iter().flat_map(|clip| &clip.channels) {
        if let (false, Some(node)) =
            (matches!(channel.values, ChannelValues::Weights { .. }), animated.get_mut(channel.node))
        {
            *node = true;
        }
    }
    // Parents may come after children, so each unknown chain is traversed upwards once and filled in.
    let mut known: Vec<Option<bool>> = vec![None; rig.nodes.len()];
    for start in 0..rig.nodes.len() {
        let mut chain = Vec::new();
        let mut next = Some(start);
        let mut verdict = false;
        while let Some(node) = next.filter(|node| *node < rig.nodes.len()) {
            if let Some(found) = known[node] {
                verdict = found;
                break;
            }
            // A valid graph has no cycle; a longer chain than there are nodes would be one.
            if chain.len() > rig.nodes.len() {
                break;
            }
            chain.push(node);
            next = rig.nodes[node].parent;
        }
        for node in chain.into_iter().rev() {
            verdict |= animated[node];
            known[node] = Some(verdict);
        }
    }
    known.into_iter().map(|verdict| verdict.unwrap_or(false)).collect()
}
