//! The bytes behind buffers.

use std::borrow::Cow;
use std::cell::{Cell, OnceCell};

/// The buffers of a file. One that nothing of the scene needs is never read, and may be missing.
pub(super) struct Buffers<'a> {
    pub read: Vec<OnceCell<Cow<'a, [u8]>>>,
    pub binary: Option<&'a [u8]>,
    /// Bytes that may still be read.
    pub left: Cell<u64>,
}

impl<'a> Buffers<'a> {
    /// Buffers of which none is read; at most `limit` bytes will be.
    pub fn new(count: usize, binary: Option<&'a [u8]>, limit: u64) -> Self {
        Self { read: (0..count).map(|_| OnceCell::new()).collect(), binary, left: Cell::new(limit) }
    }
}
