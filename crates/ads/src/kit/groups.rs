//! Dispatch sizes, in workgroups.

use rasray_shaders_glsl::constants::ads::BUILD_GROUP_SIZE;

/// Maximum number of workgroups along the first dimension; further workgroups go to the second, and shaders
/// compute one index from both.
const MOST_GROUPS: u64 = 32_768;

/// Returns the number of workgroups of a build pass with an invocation per item.
pub fn workgroups(items: u64) -> u64 {
    items.div_ceil(BUILD_GROUP_SIZE.into())
}

/// Arranges at least `groups` workgroups in two dimensions; shaders ignore indices that are too large. Absent
/// for 0.
pub fn folded(groups: u64) -> Option<[u32; 3]> {
    let rows = groups.div_ceil(MOST_GROUPS);
    (groups > 0).then(|| [groups.div_ceil(rows) as u32, rows as u32, 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_has_an_invocation_and_few_workgroups_have_none() {
        let group = u64::from(BUILD_GROUP_SIZE);
        assert_eq!([0, 1, group, group + 1].map(workgroups), [0, 1, 1, 2]);
        assert_eq!(folded(0), None);
        for groups in
            [1, MOST_GROUPS, MOST_GROUPS + 1, 3 * MOST_GROUPS - 1, u64::from(u32::MAX).div_ceil(group)]
        {
            let [columns, rows, layers] = folded(groups).expect("there are workgroups").map(u64::from);
            assert!(columns <= MOST_GROUPS && rows <= 65_535 && layers == 1, "{groups}");
            assert!((groups..groups + rows).contains(&(columns * rows)), "{groups}");
        }
    }
}
