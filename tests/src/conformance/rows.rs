use std::sync::LazyLock;

use super::{DEEP, Row, rows_bricks, rows_bvh, rows_dirt, rows_ldc, rows_mmrt, rows_voxel};
use crate::hard_cases;
use crate::tier::is_pair;

/// All rows, system by system.
pub static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    [rows_bvh::ROWS, rows_bricks::ROWS, rows_dirt::ROWS, rows_mmrt::ROWS, rows_voxel::ROWS, rows_ldc::ROWS]
        .concat()
});

/// Returns the number of comparisons of rows with cases in all runs together. Each law and each end of a
/// deviation is one comparison for rays that the oracle decides, and one for rays that it does not.
pub fn comparisons() -> usize {
    let cases = |row: &Row| hard_cases::ids().iter().filter(|id| row.cases.contain(id)).count();
    ROWS.iter().map(|row| 4 * cases(row)).sum()
}

/// Divisor of the quick tier: it holds one in this many pairs of a row and a case that go together.
pub const SHARE: usize = 4;

/// Cases of a hundred thousand triangles and more, which take software drivers much longer than others.
pub const LARGE: &[&str] = &["E2-400", "E2-400-far", "C3", "C3-random"];

/// Divisor [`SHARE`] for [`LARGE`] cases: at most the number of rows of either kind.
const LARGE_SHARE: usize = 10;

/// True if this run holds a row against a case. The full tier holds every pair. In the quick tier rows and
/// cases take turns, separately for rows that find triangles without loss and for others, and separately for
/// [`DEEP`], [`LARGE`] and other cases: each row gets some of the deep and some of the other cases that it is
/// held against, each case some rows of each kind.
pub fn is_held(row: &Row, case: &str) -> bool {
    let is_alike = |other: &&Row| {
        other.is_exact() == row.is_exact() && other.tier == row.tier && other.cases.contain(case)
    };
    let row_place = ROWS.iter().filter(is_alike).position(|other| other.name == row.name);
    let sort = |id: &str| (DEEP.contains(&id), LARGE.contains(&id));
    let ids = hard_cases::ids();
    let case_place = ids.iter().filter(|id| sort(id) == sort(case)).position(|id| *id == case);
    let share = if LARGE.contains(&case) { LARGE_SHARE } else { SHARE };
    row_place.zip(case_place).is_some_and(|(row, case)| is_pair(row, case, share))
}
