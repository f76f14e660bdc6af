//! Bytes of buffers.

use std::borrow::Cow;
use std::cell::{Cell, OnceCell};

use ::gltf::json::Root;

/// Buffers of a file. A buffer that the scene does not need is never read, and may be missing.
pub(super) struct Buffers<'a> {
    pub read: Vec<OnceCell<Cow<'a, [u8]>>>,
    pub binary: Option<&'a [u8]>,
    /// Number of bytes read and decoded so far.
    pub held: Cell<u64>,
    /// Decoded bytes of the buffer views that are stored compressed.
    #[cfg(feature = "meshopt")]
    pub decoded: Vec<OnceCell<Option<super::compression::Decoded>>>,
}

impl<'a> Buffers<'a> {
    /// Makes the buffers of `root`, none of which is read yet.
    pub fn new(root: &Root, binary: Option<&'a [u8]>) -> Self {
        Self {
            read: root.buffers.iter().map(|_| OnceCell::new()).collect(),
            binary,
            held: Cell::new(0),
            #[cfg(feature = "meshopt")]
            decoded: root.buffer_views.iter().map(|_| OnceCell::new()).collect(),
        }
    }
}
