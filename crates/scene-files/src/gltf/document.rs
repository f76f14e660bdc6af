//! File whose references have been checked: the source of all other modules.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::path::Path;

use ::gltf::json::Root;

use super::buffers::Buffers;
use super::draco::Streams;
use super::unread::Unread;
use super::{container, indices, json};
use crate::{Limits, LoadOptions};
use rasray_scene::SceneError;
use rasray_scene::animation::NodeTransform;
use rasray_scene::remarks::Remarks;

/// Parsed file with its bytes. Every index in `root` is in range. Buffers are read, and accessors checked
/// against them, when an element of the scene needs them.
pub(super) struct Document<'a> {
    pub path: &'a Path,
    pub limits: &'a Limits,
    pub root: Root,
    /// Transform of every node relative to its parent.
    pub locals: Vec<NodeTransform>,
    pub buffers: Buffers<'a>,
    pub draco: Streams,
    /// Remarks made while the file is read.
    pub remarks: RefCell<Remarks>,
    /// Values of enumerations that the format does not know, by their place.
    unknown: HashMap<String, String>,
    /// Attributes of primitives that are not read, by mesh and primitive.
    pub unread: HashMap<(usize, usize), Unread>,
    /// Number of elements read so far, checked against [`Limits::elements`].
    elements: Cell<u64>,
}

impl<'a> Document<'a> {
    /// Parses and checks `bytes`.
    pub fn open(path: &'a Path, bytes: &'a [u8], options: &'a LoadOptions) -> Result<Self, SceneError> {
        let limits = &options.limits;
        let mut remarks = Remarks::default();
        let container = container::split(path, bytes, &mut remarks)?;
        let json::Parsed { root, locals, unknown, unread } = json::parse(path, container.json, &mut remarks)?;
        Limits::check(path, "the number of nodes", root.nodes.len() as u64, limits.nodes, "nodes")?;
        indices::check(path, &root)?;
        let buffers = Buffers::new(&root, container.binary);
        let draco = Streams::of(path, &root)?;
        let remarks = RefCell::new(remarks);
        Ok(Self {
            path,
            limits,
            root,
            locals,
            buffers,
            draco,
            remarks,
            unknown,
            unread,
            elements: Cell::new(0),
        })
    }

    /// Counts elements before they are read.
    pub fn spend(&self, elements: usize) -> Result<(), SceneError> {
        let total = self.elements.get().saturating_add(elements as u64);
        self.elements.set(total);
        let what = "the number of elements of all arrays";
        Limits::check(self.path, what, total, self.limits.elements, "elements")
    }

    /// Counts bytes before they are held beside the file.
    pub fn spend_bytes(&self, bytes: u64) -> Result<(), SceneError> {
        let total = self.buffers.held.get().saturating_add(bytes);
        self.buffers.held.set(total);
        let what = "the size of all buffers in bytes";
        Limits::check(self.path, what, total, self.limits.file_bytes, "file_bytes")
    }

    /// Makes an error about an element of this file.
    pub fn invalid(&self, place: impl Into<String>, reason: impl Into<String>) -> SceneError {
        SceneError::invalid(self.path, place, reason)
    }

    /// Describes the fault of an enumeration whose value the format does not know.
    pub fn unknown(&self, place: &str) -> String {
        let value = self.unknown.get(place).map_or("of a kind", String::as_str);
        format!("is {value}, which the format does not know")
    }

    /// Notes a remark as [`Remarks::note`] does.
    pub fn note(&self, kind: &'static str, place: impl Into<String>, text: impl Into<String>) {
        self.remarks.borrow_mut().note(kind, place, text);
    }
}
