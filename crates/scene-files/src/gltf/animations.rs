//! Clips and the rig that they move.

use std::collections::HashMap;

use ::gltf::json::animation::{
    Animation as JsonAnimation, Interpolation as JsonInterpolation, Property, Sampler,
};
use ::gltf::json::validation::Checked;

use super::accessor::read_floats;
use super::document::Document;
use super::hierarchy::Hierarchy;
use rasray_scene::animation::{
    Channel, ChannelValues, Clip, DeformedMesh, Interpolation, NodeTransform, Placement, Rig, RigNode, Skin,
};
use rasray_scene::{Animation, SceneError};

/// Reads all clips and the rig that they move.
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
    let place = |number: usize| format!("animation {name}, channel {number}");
    let mut read: Vec<(usize, Channel)> = Vec::with_capacity(animation.channels.len());
    // Channels by the property that they animate, so that the later one of two is found to count.
    let mut known: HashMap<_, usize> = HashMap::new();
    for (number, source) in animation.channels.iter().enumerate() {
        let sampler = &animation.samplers[source.sampler.value()];
        let place = place(number);
        let channel = match source.target.path {
            Checked::Valid(path) => {
                read_channel(document, &place, source.target.node.value(), path, sampler)?
            }
            Checked::Invalid => {
                let path = format!("animations[{index}].channels[{number}].target.path");
                Err(format!("the path of a channel {}", document.unknown(&path)))
            }
        };
        match channel {
            Ok(channel) => {
                known.insert((channel.node, std::mem::discriminant(&channel.values)), number);
                read.push((number, channel));
            }
            Err(fault) => document.note("bad-channel", place, format!("{fault}; the channel was dropped")),
        }
    }
    let mut channels = Vec::with_capacity(read.len());
    for (number, channel) in read {
        let last = known[&(channel.node, std::mem::discriminant(&channel.values))];
        if last == number {
            channels.push(channel);
        } else {
            let text = format!("channel {last} animates the same; the channel was dropped");
            document.note("bad-channel", place(number), text);
        }
    }
    let duration = channels.iter().filter_map(|channel| channel.times.last()).copied().fold(0.0, f32::max);
    Ok(Clip { name, duration, channels })
}

/// Reads a channel, or returns its fault.
///
/// # Errors
/// Errors of accessors that cannot be read.
fn read_channel(
    document: &Document<'_>,
    place: &str,
    node: usize,
    path: Property,
    sampler: &Sampler,
) -> Result<Result<Channel, String>, SceneError> {
    if path != Property::MorphTargetWeights && matches!(document.locals[node], NodeTransform::Matrix(_)) {
        let path = path_name(path);
        return Ok(Err(format!("it animates the {path} of nodes[{node}], which has a matrix instead")));
    }
    // An accessor may be valid for another use: the message names the channel that needs another form.
    let asked = |error: SceneError| match error {
        SceneError::Invalid { path: file, place: at, reason } => SceneError::Invalid {
            path: file,
            place: at,
            reason: format!("{reason} ({place}, {})", path_name(path)),
        },
        other => other,
    };
    let scalars = |accessor: usize| -> Result<Vec<f32>, SceneError> {
        Ok(read_floats::<1>(document, accessor).map_err(asked)?.into_iter().flatten().collect())
    };
    let times = scalars(sampler.input.value())?;
    let interpolation = match sampler.interpolation {
        Checked::Valid(JsonInterpolation::Step) => Interpolation::Step,
        Checked::Valid(JsonInterpolation::CubicSpline) => Interpolation::CubicSpline,
        _ => Interpolation::Linear,
    };
    let output = sampler.output.value();
    let values = match path {
        Property::Translation => ChannelValues::Translation(read_floats(document, output).map_err(asked)?),
        Property::Rotation => ChannelValues::Rotation(read_floats(document, output).map_err(asked)?),
        Property::Scale => ChannelValues::Scale(read_floats(document, output).map_err(asked)?),
        Property::MorphTargetWeights => {
            let targets = match target_count(document, node) {
                Ok(targets) => targets,
                Err(fault) => return Ok(Err(fault)),
            };
            ChannelValues::Weights { values: scalars(output)?, targets }
        }
    };
    let channel = Channel { node, interpolation, times, values };
    if let Some(fault) = fault(&channel) {
        return Ok(Err(fault));
    }
    if let ChannelValues::Rotation(values) = &channel.values {
        let is_value = |at: usize| interpolation != Interpolation::CubicSpline || at % 3 == 1;
        let nowhere = |(at, value): &(usize, &[f32; 4])| is_value(*at) && value.iter().all(|x| *x == 0.0);
        let count = values.iter().enumerate().filter(nowhere).count();
        let text = "rotations of its keys have no direction; none is applied at them";
        document.remarks.borrow_mut().count("bad-rotation", place, count, text);
    }
    Ok(Ok(channel))
}

/// Returns the fault of the keys of a channel.
fn fault(channel: &Channel) -> Option<String> {
    let Channel { interpolation, times, values, .. } = channel;
    if times.is_empty() {
        return Some("it has no keys".to_owned());
    }
    if let Some(key) = times.iter().position(|time| !time.is_finite()) {
        return Some(format!("the time of key {key} is {}", times[key]));
    }
    if let Some(key) = times.windows(2).position(|pair| pair[0] > pair[1]) {
        let (before, after) = (times[key], times[key + 1]);
        return Some(format!(
            "its keys do not ascend: key {} is at {after} s, the one before at {before} s",
            key + 1
        ));
    }
    let (numbers, width) = match values {
        ChannelValues::Translation(list) | ChannelValues::Scale(list) => (list.as_flattened(), 3),
        ChannelValues::Rotation(list) => (list.as_flattened(), 4),
        ChannelValues::Weights { values, targets } => (&values[..], *targets),
    };
    let per_key = if *interpolation == Interpolation::CubicSpline { 3 } else { 1 };
    if numbers.len() != times.len() * per_key * width {
        let (keys, each) = (times.len(), if per_key == 3 { ", three of them a key" } else { "" });
        return Some(match values {
            ChannelValues::Weights { values, targets } => {
                format!("it has {} weights for {keys} keys of {targets} morph targets{each}", values.len())
            }
            _ => format!("it has {} values for {keys} keys{each}", numbers.len() / width),
        });
    }
    let bad = numbers.iter().position(|number| !number.is_finite())?;
    Some(format!("a value of key {} is {}", bad / (width * per_key), numbers[bad]))
}

fn path_name(path: Property) -> &'static str {
    match path {
        Property::Translation => "translation",
        Property::Rotation => "rotation",
        Property::Scale => "scale",
        Property::MorphTargetWeights => "weights",
    }
}

/// Returns the number of morph targets of the mesh at a node: that of the primitive with most targets, since
/// primitives are not displaced by targets that they lack. The error says why there is none.
fn target_count(document: &Document<'_>, node: usize) -> Result<usize, String> {
    let Some(mesh) = document.root.nodes[node].mesh.map(|mesh| mesh.value()) else {
        return Err(format!("it animates the weights of nodes[{node}], which has no mesh"));
    };
    let counts = document.root.meshes[mesh]
        .primitives
        .iter()
        .map(|primitive| primitive.targets.as_ref().map_or(0, Vec::len));
    match counts.max() {
        None | Some(0) => Err(format!(
            "it animates the weights of nodes[{node}], and no primitive of meshes[{mesh}] has morph targets"
        )),
        Some(targets) => Ok(targets),
    }
}
