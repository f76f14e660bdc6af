//! Numbering of the orders in which the device sorts triangles.

use std::sync::atomic::{AtomicU32, Ordering};

/// Numbers of orders, from 1. A build that orders the triangles carries the number of the order in its
/// header. Once the host has read that such a build was complete, builds recorded later may keep that order.
/// A build that is merely recorded does not count: it may never be submitted, or be incomplete.
#[derive(Debug)]
pub(crate) struct Order {
    /// Number that builds carry now. Triangles or pools that had another number no longer exist.
    current: AtomicU32,
    /// Last number with which the host saw a complete build.
    seen: AtomicU32,
}

impl Default for Order {
    fn default() -> Self {
        Self { current: AtomicU32::new(1), seen: AtomicU32::new(0) }
    }
}

impl Order {
    /// Returns the number for the header of a build.
    pub(crate) fn number(&self) -> u32 {
        self.current.load(Ordering::Relaxed)
    }

    /// Returns true if the next build may keep the order.
    pub(crate) fn is_kept(&self) -> bool {
        self.seen.load(Ordering::Relaxed) == self.number()
    }

    /// Notes that a complete build with this number has ended.
    pub(crate) fn see(&self, number: u32) {
        self.seen.store(number, Ordering::Relaxed);
    }

    /// Starts a new order, since triangles or pools have changed.
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
        // A frame in flight that was recorded before the change ends after it.
        order.see(first);
        assert!(!order.is_kept());
        order.see(order.number());
        assert!(order.is_kept());
    }
}
