//! Dispatch sizes, in workgroups.

/// Maximum number of workgroups along the first dimension; further workgroups go to the second, and shaders
/// compute one index from both.
const MOST_GROUPS: u64 = 32_768;

/// Arranges at least `groups` workgroups in two dimensions; shaders ignore indices that are too large. Absent
/// for 0.
pub fn folded(groups: u64) -> Option<[u32; 3]> {
    let rows = groups.div_ceil(MOST_GROUPS);
    (groups > 0).then(|| [groups.div_ceil(rows) as u32, rows as u32, 1])
}
