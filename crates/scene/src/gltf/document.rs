//! A file whose every claim has been checked: what all other modules read from.

use std::borrow::Cow;
use std::cell::Cell;
use std::path::Path;

use ::gltf::json::Root;

use super::{accessor, buffers, container, extensions, indices, json};
use crate::animation::NodeTransform;
use crate::{Limits, LoadOptions, SceneError, Warning};

/// A parsed file with its bytes. Every index in `root` is in range, every enumeration known, every
/// accessor lies within its buffer.
pub(super) struct Document<'a> {
    pub path: &'a Path,
    pub limits: &'a Limits,
    pub root: Root,
    /// Transform of every node relative to its parent.
    pub locals: Vec<NodeTransform>,
    /// Bytes of every buffer, at least as long as it claims.
    pub buffers: Vec<Cow<'a, [u8]>>,
    /// Elements read so far, against [`Limits::elements`].
    elements: Cell<u64>,
}

impl<'a> Document<'a> {
    /// Parses and checks `bytes`, and reads the buffers they refer to.
    pub fn open(
        path: &'a Path,
        bytes: &'a [u8],
        options: &'a LoadOptions,
        warnings: &mut Vec<Warning>,
    ) -> Result<Self, SceneError> {
        let limits = &options.limits;
        let container = container::split(path, bytes)?;
        let json::Parsed { root, locals } = json::parse(path, container.json, warnings)?;
        extensions::check(path, &root, warnings)?;
        Limits::check(path, "the number of nodes", root.nodes.len() as u64, limits.nodes, "nodes")?;
        indices::check(path, &root)?;
        let buffers = buffers::read(path, limits, &root, container.binary)?;
        let document = Self { path, limits, root, locals, buffers, elements: Cell::new(0) };
        accessor::check_all(&document)?;
        Ok(document)
    }

    /// Counts elements that are about to be read.
    pub fn spend(&self, elements: usize) -> Result<(), SceneError> {
        let total = self.elements.get().saturating_add(elements as u64);
        self.elements.set(total);
        let what = "the number of elements of all arrays";
        Limits::check(self.path, what, total, self.limits.elements, "elements")
    }

    /// An error about an element of this file.
    pub fn invalid(&self, place: impl Into<String>, reason: impl Into<String>) -> SceneError {
        SceneError::invalid(self.path, place, reason)
    }
}
