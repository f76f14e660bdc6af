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
    /// The words are valid SPIR-V for the Vulkan version and the enabled features of each device that makes a
    /// pipeline of them, with all constants that it is specialised with. The shader reaches memory only
    /// - within the buffers bound to its sets, and
    /// - through device addresses that it finds in push constants or in these buffers.
    ///
    /// It may trust counts and addresses that its buffers hold, such as those of headers, where the
    /// documentation of these buffers says so. Whoever writes such a word then guarantees that it is right.
    pub const unsafe fn new(words: Cow<'static, [u32]>) -> Self {
        Self { words }
    }

    /// Returns the words.
    pub fn words(&self) -> &[u32] {
        &self.words
    }
}
