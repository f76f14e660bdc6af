//! Store of the set layouts of a device and the sets made with them, divided into parts.
//!
//! A pipeline is made with a part of a layout: the bindings that its modules use. Every set of the layout has
//! one Vulkan set for each part.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;

/// Maximum number of bindings of one set: each is one bit of a [`Mask`].
pub(crate) const MOST_BINDINGS: u32 = u64::BITS;

/// Subset of a set's bindings, one bit each.
pub(crate) type Mask = u64;

/// Returns the bindings of a mask, in order.
pub(crate) fn bindings(mask: Mask) -> impl Iterator<Item = u32> {
    (0..MOST_BINDINGS).filter(move |binding| mask >> binding & 1 != 0)
}

/// Returns the mask of the first `count` bindings.
pub(crate) fn all(count: u32) -> Mask {
    Mask::MAX.checked_shr(MOST_BINDINGS - count).unwrap_or(0)
}

/// Parts of the layouts of a device, by the layouts' number of buffers. The parts live as long as the device,
/// because pipelines that are kept without a handle are made of them.
#[derive(Default)]
pub(crate) struct SetLayouts(Mutex<BTreeMap<u32, LayoutParts>>);

/// Parts of a layout that pipelines or sets were made of.
#[derive(Default)]
pub(crate) struct LayoutParts {
    /// Vulkan layouts: that of all bindings, and those of the bindings that pipelines use.
    pub(crate) layouts: BTreeMap<Mask, vk::DescriptorSetLayout>,
    /// Sets of the layout; each is taken out before its buffers are dropped.
    pub(crate) sets: Vec<Arc<SetParts>>,
}

/// Vulkan sets of one set: one per part of its layout.
pub(crate) struct SetParts {
    pub(crate) name: String,
    /// Ranges of the bound buffers, in the order of the bindings.
    pub(crate) buffers: Vec<vk::DescriptorBufferInfo>,
    parts: Mutex<BTreeMap<Mask, SetPart>>,
}

/// Vulkan set of one part.
#[derive(Clone, Copy)]
pub(crate) struct SetPart {
    /// Pool of this set alone: sets are few, and each can be dropped separately.
    pub(crate) pool: vk::DescriptorPool,
    pub(crate) raw: vk::DescriptorSet,
}

impl SetLayouts {
    pub(crate) fn lock(&self) -> MutexGuard<'_, BTreeMap<u32, LayoutParts>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Destroys all layouts.
    ///
    /// # Safety
    /// Nothing uses a layout any more: sets and pipelines are destroyed.
    pub(crate) unsafe fn clear(&self, device: &ash::Device) {
        for parts in std::mem::take(&mut *self.lock()).into_values() {
            for layout in parts.layouts.into_values() {
                // SAFETY: the caller guarantees the conditions.
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
