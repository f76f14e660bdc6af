//! Sizes of the pools, by plain arithmetic without a device.

use rasray_ads::kit::Scan;
use rasray_ads::{AdsError, GeometryExtent, Sizes};
use rasray_shaders_glsl::constants::bricks as numbers;

use crate::grid::BRICK_SIDE;
use crate::{Config, Pool, Views};

/// Words of a record, which is a triangle in some cells of a brick.
const RECORD_WORDS: u64 = 4;

/// Demand of a build: the number of elements that it needs in each pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Demand {
    /// Number of entries of all lists.
    pub entries: u64,
    /// Number of triangles in the near region, around the centre of a cube's faces.
    pub near: u64,
    /// Number of records: triangles in columns of cells of a brick, and in the bricks of divided cells.
    pub records: u64,
    /// Number of bricks, of the views and of divided cells.
    pub bricks: u64,
    /// Number of cells that list something, or are divided.
    pub cells: u64,
    /// Number of triangles of the geometry.
    pub triangles: u64,
    /// Columns, rows and slices of a view, as [`Config::cells`] gives them for the geometry.
    pub grid: [u32; 3],
}

/// Returns the bricks along each side of a view, and those of all views; `cells` are the columns, rows and
/// slices of a view.
pub(crate) fn bricks_of(views: Views, cells: [u32; 3]) -> ([u64; 3], u64) {
    let along = cells.map(|cells| u64::from(cells / BRICK_SIDE));
    (along, u64::from(views.count()) * along.iter().product::<u64>())
}

/// Returns the words per triangle in the pool of triangles: its corners, or the large-triangle queue, one
/// word per view, which binning needs during the build.
fn triangle_words(config: &Config) -> u64 {
    if config.corners { 9 } else { numbers::BRICKS_LARGE_LIMIT.into() }
}

/// Returns the sizes of the pools of bricks of this configuration that hold `demand`.
///
/// # Errors
/// An option is out of range, or a pool has more elements than 32-bit indices can address.
pub fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
    config.validate()?;
    // There is at least one brick, so that a build can count its demand.
    let (_, of_views) = bricks_of(config.views, demand.grid.map(|along| along.max(BRICK_SIDE)));
    // The distances of the views' bricks replace the sums of the scan.
    let distances = if config.skip { of_views } else { 0 };
    let pool = |pool, elements, words: u64| (pool, elements, 4 * words);
    let pools = [
        pool(Pool::Bricks, demand.bricks.max(of_views), config.brick_words().into()),
        pool(Pool::Lists, demand.cells, if config.divides() { 2 } else { 1 }),
        pool(Pool::Entries, demand.entries, 1),
        pool(Pool::Sums, Scan::sums(demand.cells).max(distances), 1),
        pool(Pool::Near, demand.near, 1),
        pool(Pool::Records, demand.records, RECORD_WORDS),
        pool(Pool::Triangles, demand.triangles, triangle_words(config)),
    ];
    Sizes::of("bricks", pools)
}

/// Returns the demand of the first build, before anything has been counted: eight columns per triangle with
/// two cells each, two entries per cell, and, if cells are divided, a brick for every eight triangles.
pub(crate) fn first_demand(config: &Config, extent: &GeometryExtent) -> Demand {
    let (triangles, grid) = (u64::from(extent.triangle_count), config.cells(extent));
    let entries = config.entries.unwrap_or(16 * triangles);
    let near = if config.views == Views::Axes { 0 } else { 64 };
    let (records, cells) = (entries / 2, entries / 2);
    let divided = if config.divides() { triangles / 8 + 16 } else { 0 };
    let bricks = bricks_of(config.views, grid).1 + divided;
    Demand { entries, near, records, bricks, cells, triangles, grid }
}

/// Returns the sizes of the pools for the first build.
pub(crate) fn first_plan(config: &Config, extent: &GeometryExtent) -> Result<Sizes, AdsError> {
    config.validate()?;
    plan(config, &first_demand(config, extent))
}

/// Bytes of bricks, for counted bricks, cells and entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Bytes of cells: 12 per brick and 4 per cell that lists something; if cells are divided, 32 per brick
    /// and 8 per cell, including divided cells.
    pub cells: u64,
    /// Bytes of entries: 4 each.
    pub entries: u64,
    /// Bytes of the scan and of distances: the larger of 4 per 1024 lists and, with [`Config::skip`], 4 per
    /// brick of the views.
    pub scan: u64,
    /// Bytes of all else: the header, 4 per triangle of the near-region list, 16 per record, and per triangle
    /// 36 for a copy of its corners, or 24 for the large-triangle queue.
    pub rest: u64,
}

impl FormulaBytes {
    /// Returns the sum of all parts.
    pub fn total(&self) -> u64 {
        self.cells + self.entries + self.scan + self.rest
    }
}

/// Computes the bytes by the formula of `docs/systems/bricks.md`. It shares no code with [`plan`], so that
/// the two check each other.
pub fn formula_bytes(config: &Config, demand: &Demand) -> FormulaBytes {
    let of_view = demand.grid.map(|along| u64::from(along).max(4)).iter().product::<u64>() / 64;
    let of_views = if config.views == Views::Cube { 6 * of_view } else { of_view };
    let (brick, list) = if config.divides() { (32, 8) } else { (12, 4) };
    let sums = demand.cells.div_ceil(1024);
    FormulaBytes {
        cells: brick * demand.bricks.max(of_views) + list * demand.cells,
        entries: 4 * demand.entries,
        scan: 4 * if config.skip { of_views.max(sums) } else { sums },
        rest: 504
            + 4 * demand.near
            + 16 * demand.records
            + demand.triangles * if config.corners { 36 } else { 24 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_equals_formula() {
        // A brick has at most 64 cells.
        let demand = Demand {
            entries: 12_345,
            near: 7,
            records: 2_345,
            bricks: 1,
            cells: 60,
            triangles: 99,
            grid: [0; 3],
        };
        for views in Views::ALL {
            for (skip, corners) in [(true, true), (false, true), (true, false)] {
                let config = Config { skip, corners, ..Config::new(views) };
                let bytes = [[0, 0, 0], [4, 4, 8], [64, 12, 128]].map(|grid| {
                    let demand = Demand { grid, ..demand };
                    let sizes = plan(&config, &demand).expect("options are in range");
                    assert_eq!(sizes.bytes(), formula_bytes(&config, &demand).total(), "{config:?}");
                    let more = Demand { entries: demand.entries + 1, ..demand };
                    assert_ne!(sizes.bytes(), formula_bytes(&config, &more).total());
                    sizes.bytes()
                });
                assert!(bytes[0] < bytes[1] && bytes[1] < bytes[2]);
            }
        }
    }

    #[test]
    fn out_of_range_options_are_named() {
        let message =
            |config: Config| plan(&config, &Demand::default()).expect_err("it is refused").to_string();
        let cube = Config::new(Views::Cube);
        assert!(message(Config { grid: Some(1025), ..cube }).contains("grid is 1025"));
        assert!(message(Config { grid: Some(0), ..cube }).contains("grid is 0"));
        assert!(message(Config { slices: Some(1025), ..cube }).contains("slices is 1025"));
        assert!(message(Config { work_budget: Some(0), ..cube }).contains("work budget is 0"));
        let axes = Config::new(Views::Axes);
        assert!(message(Config { slices: Some(8), ..axes }).contains("use `grid`"));
        let demand = Demand { entries: 1 << 32, ..Demand::default() };
        assert!(plan(&cube, &demand).expect_err("it is refused").to_string().contains("entries"));
    }
}
