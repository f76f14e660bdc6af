//! Numbers of workgroups as they are dispatched.

/// Maximum number of workgroups along the first dimension; more go to the second, and shaders compute one
/// index from both.
const MOST_GROUPS: u64 = 32_768;

/// That number of workgroups in two dimensions, at least: shaders leave out indices that are too large. 0
/// gives none.
pub fn folded(groups: u64) -> Option<[u32; 3]> {
    let rows = groups.div_ceil(MOST_GROUPS);
    (groups > 0).then(|| [groups.div_ceil(rows) as u32, rows as u32, 1])
}
