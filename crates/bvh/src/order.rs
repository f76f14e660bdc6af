//! Order of the triangles on the device, as far as the host knows it.

use std::sync::atomic::{AtomicU32, Ordering};

/// Orders are numbered from 1. A build that orders the triangles carries the number of the order in its
/// header; once the host has read that such a build was complete, builds recorded later may keep that order.
/// What is merely recorded does not count: it may never be submitted, or be incomplete.
#[derive(Debug)]
pub(crate) struct Order {
    /// The number that builds carry now: triangles or pools of another number are gone.
    current: AtomicU32,
    /// The last number of which a complete build was seen.
    seen: AtomicU32,
}

impl Default for Order {
    fn default() -> Self {
        Self { current: AtomicU32::new(1), seen: AtomicU32::new(0) }
    }
}

impl Order {
    /// The number for the header of a build.
    pub(crate) fn number(&self) -> u32 {
        self.current.load(Ordering::Relaxed)
    }

    /// True if the next build may keep the order.
    pub(crate) fn is_kept(&self) -> bool {
        self.seen.load(Ordering::Relaxed) == self.number()
    }

    /// A complete build with this number has ended.
    pub(crate) fn see(&self, number: u32) {
        self.seen.store(number, Ordering::Relaxed);
    }

    /// Triangles or pools are others now.
    pub(crate) fn forget(&self) {
        self.current.fetch_add(1, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_complete_build_of_the_same_triangles_is_kept() {
        let order = Order::default();
        assert!(!order.is_kept());
        let first = order.number();
        order.see(first);
        assert!(order.is_kept());
        order.forget();
        assert!(!order.is_kept());
        // A frame in flight that was recorded before ends after.
        order.see(first);
        assert!(!order.is_kept());
        order.see(order.number());
        assert!(order.is_kept());
    }
}
