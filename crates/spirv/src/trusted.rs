//! Modules that may run on a device.

use std::borrow::Cow;

/// Module that its maker vouches for. A driver runs it without a check of its own, so code that makes
/// pipelines takes modules in this form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TrustedModule {
    words: Cow<'static, [u32]>,
}

impl TrustedModule {
    /// Vouches for the words of a module.
    ///
    /// # Safety
    /// The words are valid SPIR-V for the device's Vulkan version and enabled features, with all constants
    /// that a pipeline is specialised with. The shader ends, and reaches memory only
    /// - within the buffers bound to its sets, whatever these contain, and
    /// - through device addresses that it finds in push constants or in these buffers. Whoever writes such an
    ///   address guarantees that it leads to memory that is alive and large enough.
    pub const unsafe fn new(words: Cow<'static, [u32]>) -> Self {
        Self { words }
    }

    /// Returns the words.
    pub fn words(&self) -> &[u32] {
        &self.words
    }
}
