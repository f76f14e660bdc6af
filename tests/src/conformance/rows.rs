use std::sync::LazyLock;

use super::{Row, rows_bricks, rows_bvh, rows_dirt, rows_ldc, rows_mmrt, rows_voxel};
use crate::hard_cases;

/// All rows, system by system.
pub static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    [rows_bvh::ROWS, rows_bricks::ROWS, rows_dirt::ROWS, rows_mmrt::ROWS, rows_voxel::ROWS, rows_ldc::ROWS]
        .concat()
});

/// How often a row is evaluated in all runs together: each law and each end of a deviation is one comparison,
/// for rays that the oracle decides and for those that it does not.
pub fn comparisons() -> usize {
    let cases = |row: &Row| hard_cases::ids().iter().filter(|id| row.cases.contain(id)).count();
    ROWS.iter().map(|row| 4 * cases(row)).sum()
}
