//! Stamps of geometries, by which a structure's status says for which triangles it was built.

use std::sync::atomic::{AtomicU32, Ordering};

use rasray_shaders_glsl::constants::contract::STATUS_FLAGS;

/// Difference between consecutive stamps: the flags of a status lie in the bits below.
pub(crate) const STAMP_STEP: u32 = STATUS_FLAGS + 1;

/// Next stamp that no geometry of this process has yet, in units of [`STAMP_STEP`]; 0 is no stamp.
static NEXT_STAMP: AtomicU32 = AtomicU32::new(1);

/// Returns the first of `count` stamps that fit into one word, if `next` is the next free one. The stamps
/// begin again after 2^28.
fn stamps_from(next: u32, count: u32) -> u32 {
    if next > u32::MAX / STAMP_STEP - count { 1 } else { next }
}

/// Returns the first of `count` consecutive stamps that no other geometry has.
pub(crate) fn new_stamps(count: u32) -> u32 {
    let after = |next| Some(stamps_from(next, count) + count);
    let next =
        NEXT_STAMP.fetch_update(Ordering::Relaxed, Ordering::Relaxed, after).unwrap_or_else(|next| next);
    stamps_from(next, count) * STAMP_STEP
}
