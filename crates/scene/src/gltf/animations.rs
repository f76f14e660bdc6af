//! Clips and the rig they move.

use ::gltf::json::animation::{Animation as JsonAnimation, Interpolation as JsonInterpolation, Property};
use ::gltf::json::validation::Checked;

use super::accessor::read_floats;
use super::document::Document;
use super::hierarchy::Hierarchy;
use crate::animation::{
    Channel, ChannelValues, Clip, DeformedMesh, Interpolation, Placement, Rig, RigNode, Skin,
};
use crate::{Animation, SceneError};

/// Reads all clips and what they move.
pub(super) fn read(
    document: &Document<'_>,
    hierarchy: &Hierarchy,
    skins: Vec<Skin>,
    deformed: Vec<DeformedMesh>,
    placements: Vec<Placement>,
) -> Result<Animation, SceneError> {
    let mut clips = Vec::with_capacity(document.root.animations.len());
    for (i, animation) in document.root.animations.iter().enumerate() {
        clips.push(read_clip(document, i, animation)?);
    }
    let morphed = deformed.iter().filter(|mesh| !mesh.targets.is_empty()).count();
    if clips.is_empty() && deformed.is_empty() {
        return Ok(Animation::default());
    }
    let nodes = document.root.nodes.iter().enumerate().map(|(i, node)| RigNode {
        name: node.name.clone().unwrap_or_else(|| format!("node{i}")),
        parent: hierarchy.parent[i],
        transform: document.locals[i],
    });
    Ok(Animation {
        clips: clips.iter().map(|clip| clip.name.clone()).collect(),
        duration: clips.iter().map(|clip| clip.duration).fold(0.0, f32::max),
        skins: skins.len(),
        morphed_meshes: morphed,
        rig: Rig { nodes: nodes.collect(), placements, clips, skins, deformed, ..Rig::default() },
        ..Animation::default()
    })
}

fn read_clip(document: &Document<'_>, index: usize, animation: &JsonAnimation) -> Result<Clip, SceneError> {
    let name = animation.name.clone().unwrap_or_else(|| format!("animation{index}"));
    let mut channels = Vec::with_capacity(animation.channels.len());
    for (i, channel) in animation.channels.iter().enumerate() {
        let place = format!("animation {name}, channel {i}");
        let sampler = &animation.samplers[channel.sampler.value()];
        let times: Vec<f32> =
            read_floats::<1>(document, sampler.input.value())?.into_iter().flatten().collect();
        let interpolation = match sampler.interpolation {
            Checked::Valid(JsonInterpolation::Step) => Interpolation::Step,
            Checked::Valid(JsonInterpolation::CubicSpline) => Interpolation::CubicSpline,
            _ => Interpolation::Linear,
        };
        let output = sampler.output.value();
        let (values, elements) = match channel.target.path {
            Checked::Valid(Property::Translation) => {
                of_length(read_floats(document, output)?, ChannelValues::Translation)
            }
            Checked::Valid(Property::Rotation) => {
                of_length(read_floats(document, output)?, ChannelValues::Rotation)
            }
            Checked::Valid(Property::Scale) => {
                of_length(read_floats(document, output)?, ChannelValues::Scale)
            }
            Checked::Valid(Property::MorphTargetWeights) => {
                let values: Vec<f32> = read_floats::<1>(document, output)?.into_iter().flatten().collect();
                let targets = target_count(document, channel.target.node.value());
                let elements = values.len().checked_div(targets).unwrap_or(0);
                (ChannelValues::Weights { values, targets }, elements)
            }
            Checked::Invalid => {
                let path = format!("animations[{index}].channels[{i}].target.path");
                let text = format!("the path of a channel {}; it was dropped", document.unknown(&path));
                document.note("bad-channel", place, text);
                continue;
            }
        };
        let per_key = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let ascending =
            times.iter().all(|time| time.is_finite()) && times.windows(2).all(|pair| pair[0] <= pair[1]);
        if times.is_empty() || !ascending || elements != times.len() * per_key {
            let text = "keys do not ascend or do not match their values; the channel was dropped";
            document.note("bad-channel", place, text);
            continue;
        }
        channels.push(Channel { node: channel.target.node.value(), interpolation, times, values });
    }
    let duration = channels.iter().filter_map(|channel| channel.times.last()).copied().fold(0.0, f32::max);
    Ok(Clip { name, duration, channels })
}

fn of_length<T>(values: Vec<T>, wrap: impl FnOnce(Vec<T>) -> ChannelValues) -> (ChannelValues, usize) {
    let elements = values.len();
    (wrap(values), elements)
}

/// Number of morph targets of the mesh at a node.
fn target_count(document: &Document<'_>, node: usize) -> usize {
    let mesh = document.root.nodes[node].mesh.map(|mesh| &document.root.meshes[mesh.value()]);
    let targets =
        mesh.and_then(|mesh| mesh.primitives.first()).and_then(|primitive| primitive.targets.as_ref());
    targets.map_or(0, Vec::len)
}
