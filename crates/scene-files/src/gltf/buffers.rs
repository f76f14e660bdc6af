//! The bytes behind buffers.

use std::borrow::Cow;
use std::cell::{Cell, OnceCell};

use ::gltf::json::Root;

/// The buffers of a file. One that nothing of the scene needs is never read, and may be missing.
pub(super) struct Buffers<'a> {
    pub read: Vec<OnceCell<Cow<'a, [u8]>>>,
    pub binary: Option<&'a [u8]>,
    /// Bytes read and decoded so far.
    pub held: Cell<u64>,
    /// Buffer views that are stored compressed.
    #[cfg(feature = "meshopt")]
    pub decoded: Vec<OnceCell<Option<super::compression::Decoded>>>,
}

impl<'a> Buffers<'a> {
    /// The buffers of `root`, of which none is read.
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
