//! Sizes of the pools, by plain arithmetic without a device.

use rasray_ads::kit::Scan;
use rasray_ads::{AdsError, GeometryExtent, Sizes};

use crate::{Config, Pool};

/// Demand of a build: the number of elements that it needs in each pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Demand {
    /// Number of entries of all lists, as a build counts them.
    pub entries: u64,
    /// Number of triangles of the geometry.
    pub triangles: u64,
    /// Number of cells along each axis, as [`Config::cells_over`] gives them for the geometry.
    pub cells: [u32; 3],
}

/// Returns the number of cells of the whole grid.
pub(crate) fn cell_count(cells: [u32; 3]) -> u64 {
    cells.into_iter().map(u64::from).product()
}

/// Returns the sizes of the pools of a grid of this configuration that holds `demand`.
///
/// # Errors
/// An option is out of range, or a pool has more elements than 32-bit indices can address.
pub fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
    config.validate()?;
    // There is at least one cell, so that a build can count its demand.
    let cells = cell_count(demand.cells).max(1);
    let pool = |pool, elements| (pool, elements, 4);
    let pools = [
        pool(Pool::Lists, cells),
        pool(Pool::Entries, demand.entries),
        pool(Pool::Scratch, Scan::sums(cells) + demand.triangles),
    ];
    Sizes::of("grid", pools)
}

/// Returns the sizes for the first build, before anything has been counted: eight entries per triangle, if
/// the options do not say.
pub(crate) fn first_plan(config: &Config, extent: &GeometryExtent) -> Result<Sizes, AdsError> {
    config.validate()?;
    let triangles = u64::from(extent.triangle_count);
    let entries = config.entries.unwrap_or(8 * triangles);
    plan(config, &Demand { entries, triangles, cells: config.cells_over(extent) })
}

/// Bytes of a grid, for counted cells and entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Bytes of cells: 4 each.
    pub cells: u64,
    /// Bytes of entries: 4 each.
    pub entries: u64,
    /// Bytes of all else: the header, 4 per 1024 cells for the scan, and 4 per triangle.
    pub rest: u64,
}

impl FormulaBytes {
    /// Returns the sum of all parts.
    pub fn total(&self) -> u64 {
        self.cells + self.entries + self.rest
    }
}

/// Computes the bytes by the formula of `docs/systems/grid.md`. It shares no code with [`plan`], so that the
/// two check each other.
pub fn formula_bytes(demand: &Demand) -> FormulaBytes {
    let [x, y, z] = demand.cells.map(u64::from);
    let cells = (x * y * z).max(1);
    FormulaBytes {
        cells: 4 * cells,
        entries: 4 * demand.entries,
        rest: 152 + cells.div_ceil(1024) * 4 + 4 * demand.triangles,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_equals_formula() {
        let config = Config::new();
        let bytes = [[0, 0, 0], [3, 5, 8], [64, 12, 128]].map(|cells| {
            let demand = Demand { entries: 12_345, triangles: 99, cells };
            let sizes = plan(&config, &demand).expect("options are in range");
            assert_eq!(sizes.bytes(), formula_bytes(&demand).total(), "{cells:?}");
            let more = Demand { entries: demand.entries + 1, ..demand };
            assert_ne!(sizes.bytes(), formula_bytes(&more).total());
            sizes.bytes()
        });
        assert!(bytes[0] < bytes[1] && bytes[1] < bytes[2]);
    }

    #[test]
    fn out_of_range_options_are_named() {
        let message =
            |config: Config| plan(&config, &Demand::default()).expect_err("it is refused").to_string();
        let plain = Config::new();
        assert!(message(Config { cells: Some(1025), ..plain }).contains("grid is 1025"));
        assert!(message(Config { cells: Some(0), ..plain }).contains("grid is 0"));
        assert!(message(Config { work_budget: Some(0), ..plain }).contains("work budget is 0"));
        let demand = Demand { entries: 1 << 32, ..Demand::default() };
        assert!(plan(&plain, &demand).expect_err("it is refused").to_string().contains("entries"));
    }
}
