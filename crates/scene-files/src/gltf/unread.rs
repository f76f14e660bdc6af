//! Attributes of primitives and of their morph targets that have no place in a mesh.

use std::collections::HashMap;

use ::gltf::json::Value;

use super::document::Document;

/// Names of the attributes of a primitive that are not read, in their order in the file.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Unread {
    /// Attributes of the primitive's vertices.
    attributes: Vec<String>,
    /// Attributes of the primitive's morph targets.
    displacements: Vec<String>,
}

/// Finds the attributes of primitives that are not read, by mesh and primitive, for primitives that have any.
/// The typed tree has no place for them.
pub(super) fn find(tree: &Value) -> HashMap<(usize, usize), Unread> {
    let mut found = HashMap::new();
    for (mesh, source) in tree.get("meshes").and_then(Value::as_array).into_iter().flatten().enumerate() {
        for (number, primitive) in source["primitives"].as_array().into_iter().flatten().enumerate() {
            let mut unread = Unread::default();
            add(&mut unread.attributes, &primitive["attributes"], is_read);
            for target in primitive["targets"].as_array().into_iter().flatten() {
                add(&mut unread.displacements, target, |name| {
                    ["POSITION", "NORMAL", "TANGENT"].contains(&name)
                });
            }
            if unread != Unread::default() {
                found.insert((mesh, number), unread);
            }
        }
    }
    found
}

fn add(names: &mut Vec<String>, attributes: &Value, is_read: impl Fn(&str) -> bool) {
    for name in attributes.as_object().into_iter().flat_map(|object| object.keys()) {
        // Names that begin with an underscore are specific to an application.
        if !name.starts_with('_') && !is_read(name) && !names.contains(name) {
            names.push(name.clone());
        }
    }
}

/// True if an attribute is read, or if another remark names it where needed: the textures that use further
/// texture coordinates do, and the skin does for joints and weights.
fn is_read(name: &str) -> bool {
    let is_numbered =
        |prefix: &str| name.strip_prefix(prefix).is_some_and(|number| number.parse::<u32>().is_ok());
    ["POSITION", "NORMAL", "TANGENT", "COLOR_0"].contains(&name)
        || ["TEXCOORD_", "JOINTS_", "WEIGHTS_"].into_iter().any(is_numbered)
}

impl Unread {
    /// Names all of these attributes in remarks.
    pub(super) fn remark(&self, document: &Document<'_>, place: &str) {
        for name in &self.attributes {
            let text = match name.starts_with("COLOR_") {
                true => format!("{name} is not shown: COLOR_0 alone is the colour of vertices"),
                false => format!("{name} is no attribute that is known; the mesh is shown without it"),
            };
            document.note("unread-attributes", place, text);
        }
        for name in &self.displacements {
            let text =
                format!("its morph targets displace {name}, which is not supported; it stays as it is");
            document.note("unread-attributes", place, text);
        }
    }
}
