//! From JSON text to the typed tree, around what the typed tree cannot hold.
//!
//! The typed tree keeps indices as u32 by cutting off high bits, node transforms as f32, and
//! insists on members that the format makes optional. So the text is read as a plain tree first.

use std::path::Path;

use ::gltf::json::deserialize::{from_slice, from_value};
use ::gltf::json::{Root, Value};

use super::transforms;
use crate::animation::NodeTransform;
use crate::{SceneError, Warning};

/// Members that hold an index, a stride or an enumeration of the format.
const INDEX_MEMBERS: [&str; 30] = [
    "attributes",
    "buffer",
    "bufferView",
    "byteStride",
    "camera",
    "children",
    "componentType",
    "index",
    "indices",
    "input",
    "inverseBindMatrices",
    "joints",
    "light",
    "magFilter",
    "material",
    "mesh",
    "minFilter",
    "mode",
    "node",
    "nodes",
    "output",
    "sampler",
    "scene",
    "skeleton",
    "skin",
    "source",
    "targets",
    "texCoord",
    "wrapS",
    "wrapT",
];

/// A parsed file: the typed tree, and the transform of every node in f64.
pub(super) struct Parsed {
    pub root: Root,
    pub locals: Vec<NodeTransform>,
}

/// Parses JSON text.
pub(super) fn parse(path: &Path, text: &[u8], warnings: &mut Vec<Warning>) -> Result<Parsed, SceneError> {
    let malformed =
        |error: ::gltf::json::Error| SceneError::syntax(path, format!("malformed glTF JSON: {error}"));
    let mut tree: Value = from_slice(text).map_err(malformed)?;
    if !tree.is_object() {
        return Err(SceneError::syntax(path, "malformed glTF JSON: the file is not an object"));
    }
    check_version(path, &tree)?;
    check_integers(path, "", &tree, false)?;
    supply_optional_members(&mut tree);
    drop_untargeted_channels(&mut tree, warnings);
    let locals = transforms::read_all(path, &tree, warnings)?;
    let root = from_value(tree).map_err(|error| misplaced(path, text, &error))?;
    Ok(Parsed { root, locals })
}

/// The error of a tree that is JSON but not glTF, with the element at fault: the typed parser does
/// not say where it stopped, so the elements are tried one by one.
fn misplaced(path: &Path, text: &[u8], error: &::gltf::json::Error) -> SceneError {
    let parses = |list: &str, element: Value| {
        let mut file = Value::Object(Default::default());
        file["asset"]["version"] = "2.0".into();
        file[list] = element;
        supply_optional_members(&mut file);
        from_value::<Root>(file)
    };
    let tree: Value = from_slice(text).unwrap_or_default();
    for (name, member) in tree.as_object().into_iter().flatten() {
        for (i, element) in member.as_array().into_iter().flatten().enumerate() {
            if let Err(error) = parses(name, Value::Array(vec![element.clone()])) {
                return SceneError::invalid(path, format!("{name}[{i}]"), error.to_string());
            }
        }
        if let Err(error) = parses(name, member.clone()) {
            return SceneError::invalid(path, name.clone(), error.to_string());
        }
    }
    SceneError::syntax(path, format!("malformed glTF JSON: {error}"))
}

/// Refuses files that are not of version 2.
fn check_version(path: &Path, tree: &Value) -> Result<(), SceneError> {
    let asset = &tree["asset"];
    for member in ["version", "minVersion"] {
        let Some(version) = asset.get(member) else {
            if member == "version" {
                return Err(SceneError::invalid(path, "asset.version", "is missing; is this a glTF file?"));
            }
            continue;
        };
        let major = version.as_str().and_then(|text| text.split('.').next());
        let supported = if member == "version" { major == Some("2") } else { version == "2.0" };
        if !supported {
            let reason = format!("is {version}; only glTF 2.0 is supported");
            return Err(SceneError::invalid(path, format!("asset.{member}"), reason));
        }
    }
    Ok(())
}

/// Refuses integers above u32 where the format has indices or enumerations. The depth of the
/// recursion is bounded by that of the JSON parser.
fn check_integers(path: &Path, place: &str, value: &Value, index: bool) -> Result<(), SceneError> {
    match value {
        Value::Number(number) if index => {
            if number.as_u64().is_some_and(|number| number > u64::from(u32::MAX)) {
                return Err(SceneError::invalid(path, place, format!("{number} is too large")));
            }
            Ok(())
        }
        Value::Array(items) => items
            .iter()
            .enumerate()
            .filter(|(_, item)| index || item.is_object() || item.is_array())
            .try_for_each(|(i, item)| check_integers(path, &format!("{place}[{i}]"), item, index)),
        Value::Object(members) => members
            .iter()
            // The application's own, whatever its members are called.
            .filter(|(name, _)| *name != "extras")
            .filter(|(_, member)| index || member.is_object() || member.is_array() || member.is_u64())
            .try_for_each(|(name, member)| {
                let inside = if place.is_empty() { name.clone() } else { format!("{place}.{name}") };
                let semantic = index && (place.ends_with("attributes") || place.contains(".targets["));
                let index = INDEX_MEMBERS.contains(&name.as_str()) || semantic;
                check_integers(path, &inside, member, index)
            }),
        _ => Ok(()),
    }
}

/// Adds empty arrays where the format lets them be absent and the typed tree does not.
fn supply_optional_members(tree: &mut Value) {
    let optional =
        [("scenes", "nodes"), ("animations", "channels"), ("animations", "samplers"), ("skins", "joints")];
    for (list, member) in optional {
        for element in tree.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten() {
            if let Some(element) = element.as_object_mut() {
                element.entry(member).or_insert_with(|| Value::Array(Vec::new()));
            }
        }
    }
}

/// Removes animation channels without a target node, which the format says to ignore.
fn drop_untargeted_channels(tree: &mut Value, warnings: &mut Vec<Warning>) {
    let mut dropped = 0;
    for animation in tree.get_mut("animations").and_then(Value::as_array_mut).into_iter().flatten() {
        if let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) {
            let before = channels.len();
            channels
                .retain(|channel| channel["target"].get("node").is_some() || !channel["target"].is_object());
            dropped += before - channels.len();
        }
    }
    if dropped > 0 {
        warnings.push(Warning {
            kind: "untargeted-channels",
            message: format!("{dropped} animation channels have no target node and were dropped"),
        });
    }
}
