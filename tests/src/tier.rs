//! Tiers of tests.
//!
//! The quick tier is what every change must pass; the full tier (`RASRAY_FULL=1`, `tools/test --full`) has
//! the large counts. A program on the processor traces far fewer rays than a GPU does, so a count of the full
//! tier may be smaller there. Counts follow tier and kind of device alone, never the clock, and each run
//! prints its own.

use std::fmt::Debug;

use rasray_gpu::Device;

/// True if the large counts are requested (`RASRAY_FULL=1`).
pub fn is_full() -> bool {
    std::env::var_os("RASRAY_FULL").is_some_and(|value| value == "1")
}

/// Returns all values in the full tier, and one of them in the quick tier, chosen by `turn`: if one option
/// changes in an outer loop and another in an inner one, every value is tested, but not with every other.
/// Each value is a kernel of its own, which a driver on the processor compiles for seconds.
pub fn in_turn<T>(all: &[T], turn: usize) -> &[T] {
    let place = turn % all.len();
    if is_full() { all } else { &all[place..=place] }
}

/// Returns all values in the full tier, the first ones in the quick tier.
pub fn first<T>(all: &[T], quick: usize) -> &[T] {
    if is_full() { all } else { &all[..quick] }
}

/// True if this run tests a pair of two lists, given by its places in both: every pair in the full tier, one
/// of `share` in the quick tier. Each place of either list then occurs in some pair if the other list has
/// `share` places or more.
pub fn is_pair(one: usize, other: usize, share: usize) -> bool {
    is_full() || (one + other).is_multiple_of(share)
}

/// Counts by tier and kind of device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts<T> {
    /// Count in every run.
    pub quick: T,
    /// Count in the full tier on a software driver.
    pub software: T,
    /// Count in the full tier on other devices.
    pub full: T,
}

impl<T: Copy + Debug> Counts<T> {
    /// Returns the count for this run on this device. The full tier prints it with the name of the counted
    /// things, since the count depends on the device.
    pub fn on(&self, device: &Device, what: &str) -> T {
        let (count, kind) = match (is_full(), device.is_software()) {
            (false, _) => return self.quick,
            (true, true) => (self.software, "a software driver"),
            (true, false) => (self.full, "this device"),
        };
        println!("full tier on {kind}: {what}: {count:?}");
        count
    }
}
