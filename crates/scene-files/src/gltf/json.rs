//! Parser from JSON text to the typed tree, and the data that the typed tree cannot hold.
//!
//! The typed tree keeps indices as u32 by cutting off high bits, keeps node transforms as f32, insists on
//! members that the format makes optional, and does not say where parsing stopped. So the text is read as a
//! plain tree first.

use std::collections::HashMap;
use std::path::Path;

use ::gltf::json::deserialize::{from_slice, from_value};
use ::gltf::json::{Root, Value};

use super::conform::{Found, conform};
use super::unread::{self, Unread};
use super::{extensions, transforms};
use crate::recognise::{binary, recognise};
use rasray_scene::SceneError;
use rasray_scene::animation::NodeTransform;
use rasray_scene::remarks::Remarks;
use rasray_scene::text::shown;

/// Number of bytes around an error that a message repeats.
const AROUND: usize = 24;

/// Parsed file: the typed tree, and the data that it cannot hold.
pub(super) struct Parsed {
    pub root: Root,
    /// Transform of every node in f64.
    pub locals: Vec<NodeTransform>,
    /// Values of enumerations that the format does not know, by their place.
    pub unknown: HashMap<String, String>,
    /// Attributes that are not read, as [`unread::find`] returns them.
    pub unread: HashMap<(usize, usize), Unread>,
}

/// Parses JSON text.
pub(super) fn parse(path: &Path, text: &[u8], remarks: &mut Remarks) -> Result<Parsed, SceneError> {
    let mut tree: Value = from_slice(text).map_err(|error| malformed(path, text, &error))?;
    if !tree.is_object() {
        return Err(SceneError::syntax(path, "malformed glTF JSON: the file is not an object"));
    }
    check_version(path, &tree)?;
    // This check comes before that of the shape: a required extension may change the shape.
    extensions::check_required(path, &tree)?;
    let Found { unknown, extensions } = conform(path, &mut tree)?;
    supply_optional_members(&mut tree);
    drop_untargeted_channels(&mut tree, remarks);
    let locals = transforms::read_all(path, &tree, remarks)?;
    let unread = unread::find(&tree);
    let root: Root = from_value(tree).map_err(|_| {
        // As far as is known, the schema refuses all that the typed tree refuses.
        SceneError::syntax(path, "malformed glTF JSON: a member has a value of the wrong kind")
    })?;
    extensions::report(extensions.iter().chain(&root.extensions_used), remarks);
    Ok(Parsed { root, locals, unknown, unread })
}

/// Makes the error of text that is no JSON: it names the actual kind of file, or the place where the JSON
/// ends.
fn malformed(path: &Path, text: &[u8], error: &::gltf::json::Error) -> SceneError {
    let begins = text.trim_ascii_start().first();
    if !matches!(begins, Some(b'{' | b'[')) {
        if let Some(foreign) = recognise(text).or_else(|| binary(text)) {
            return foreign.refuse(path, "glTF");
        }
        let head: Vec<String> = text.iter().take(4).map(|byte| format!("{byte:02x}")).collect();
        let reason = format!("begins with bytes {}, neither `glTF` nor the `{{` of JSON", head.join(" "));
        return SceneError::syntax(path, reason);
    }
    let (line, column) = (error.line(), error.column());
    let reason = if error.is_eof() {
        format!("the text ends in line {line} before the JSON does; is the file cut short?")
    } else {
        let start = text.split(|&byte| byte == b'\n').take(line.saturating_sub(1)).map(|line| line.len() + 1);
        let at = (start.sum::<usize>() + column.saturating_sub(1)).min(text.len());
        let around = &text[at.saturating_sub(AROUND)..(at + AROUND).min(text.len())];
        let near = shown(String::from_utf8_lossy(around).split_whitespace().collect::<Vec<_>>().join(" "));
        format!("line {line}, column {column} is no JSON, or a number out of range, near `{near}`")
    };
    SceneError::syntax(path, format!("malformed glTF JSON: {reason}"))
}

/// Refuses files that are not of version 2.
fn check_version(path: &Path, tree: &Value) -> Result<(), SceneError> {
    let asset = &tree["asset"];
    let refused = |found: String| SceneError::NotThisFormat {
        path: path.to_owned(),
        found,
        fix: "export it as glTF 2.0",
    };
    let Some(version) = asset.get("version") else {
        let reason = "is missing; is this a glTF file?";
        return Err(SceneError::invalid(path, "asset.version", reason));
    };
    if version.as_str().is_some_and(|text| text.split('.').next() != Some("2")) {
        return Err(refused(format!("is glTF of version {}, and only glTF 2.0 is read", shown(version))));
    }
    match asset.get("minVersion") {
        Some(version) if version != "2.0" && !version.is_null() => {
            Err(refused(format!("needs glTF of version {}, and only glTF 2.0 is read", shown(version))))
        }
        _ => Ok(()),
    }
}

/// Adds empty arrays that the format makes optional and the typed tree requires.
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
fn drop_untargeted_channels(tree: &mut Value, remarks: &mut Remarks) {
    let mut dropped = 0;
    for animation in tree.get_mut("animations").and_then(Value::as_array_mut).into_iter().flatten() {
        if let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) {
            let before = channels.len();
            channels.retain(|channel| channel["target"].get("node").is_some());
            dropped += before - channels.len();
        }
    }
    let text = "animation channels have no target node and were dropped";
    remarks.count("untargeted-channels", "", dropped, text);
}
