//! Keeps the set layouts of a device and the sets made with them, part by part.
//!
//! A pipeline is made with a part of a layout: the bindings that its modules use. Every set of the layout has
//! a Vulkan set for each part.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;

/// Bindings of one set at most: a bit of a [`Mask`] each.
pub(crate) const MOST_BINDINGS: u32 = u64::BITS;

/// Some of a set's bindings, one bit each.
pub(crate) type Mask = u64;

/// The bindings of a mask, in order.
pub(crate) fn bindings(mask: Mask) -> impl Iterator<Item = u32> {
    (0..MOST_BINDINGS).filter(move |binding| mask >> binding & 1 != 0)
}

/// The mask of the first `count` bindings.
pub(crate) fn all(count: u32) -> Mask {
    Mask::MAX.checked_shr(MOST_BINDINGS - count).unwrap_or(0)
}

/// The parts of the layouts of a device, by their number of buffers. They live as long as the device:
/// pipelines that are kept without a handle to them are made of them.
#[derive(Default)]
pub(crate) struct SetLayouts(Mutex<BTreeMap<u32, LayoutParts>>);

/// The parts of a layout that something was made of.
#[derive(Default)]
pub(crate) struct LayoutParts {
    /// Layouts of all bindings, and of those that pipelines use.
    pub(crate) layouts: BTreeMap<Mask, vk::DescriptorSetLayout>,
    /// Sets of the layout; each is taken out before its buffers go.
    pub(crate) sets: Vec<Arc<SetParts>>,
}

/// The Vulkan sets of a set, one a part of its layout.
pub(crate) struct SetParts {
    pub(crate) name: String,
    /// Buffers bound, in the order of the bindings.
    pub(crate) buffers: Vec<vk::DescriptorBufferInfo>,
    parts: Mutex<BTreeMap<Mask, SetPart>>,
}

/// The Vulkan set of a part.
#[derive(Clone, Copy)]
pub(crate) struct SetPart {
    /// One pool a set: sets are few, and each can be dropped by itself.
    pub(crate) pool: vk::DescriptorPool,
    pub(crate) raw: vk::DescriptorSet,
}

impl SetLayouts {
    pub(crate) fn lock(&self) -> MutexGuard<'_, BTreeMap<u32, LayoutParts>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Destroys all.
    ///
    /// # Safety
    /// Nothing uses a layout any more: sets and pipelines are gone.
    pub(crate) unsafe fn clear(&self, device: &ash::Device) {
        for parts in std::mem::take(&mut *self.lock()).into_values() {
            for layout in parts.layouts.into_values() {
                // SAFETY: the caller vouches for it.
                unsafe { device.destroy_descriptor_set_layout(layout, None) };
            }
        }
    }
}

impl SetParts {
    pub(crate) fn new(name: &str, buffers: Vec<vk::DescriptorBufferInfo>) -> Self {
        Self { name: name.to_owned(), buffers, parts: Mutex::default() }
    }

    pub(crate) fn lock(&self) -> MutexGuard<'_, BTreeMap<Mask, SetPart>> {
        self.parts.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
