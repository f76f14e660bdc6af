//! Sizes of the pools, by plain arithmetic without a device.

use rasray_ads::kit::{Pyramid, Scan, ViewDraw};
use rasray_ads::{AdsError, Sizes};
use rasray_shaders_glsl::constants::ads::BIN_BLOCK;
use rasray_shaders_glsl::constants::primitive as numbers;

use crate::{Builder, Config, Pool, Storage, Views};

/// Demand of a build: the number of elements that it needs in each pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Demand {
    /// Number of entries of all lists.
    pub entries: u64,
    /// Number of triangles in the near region, around the eye.
    pub near: u64,
    /// Number of triangles of the geometry, if a compute pass puts them into tiles.
    pub triangles: u64,
}

/// Returns the number of cells of all views, each view with a border of one cell.
pub fn cell_count(config: &Config) -> u64 {
    let side = u64::from(config.tiles()) + 2;
    u64::from(config.view_count()) * side * side
}

/// Returns the words of a cell's bounds: both ends, and the scale if there are several buckets.
pub(crate) fn bounds_words(config: &Config) -> u64 {
    if config.buckets > 1 { 3 } else { 2 }
}

/// Returns the words of an entry of a list.
pub(crate) fn entry_words(storage: Storage) -> u64 {
    match storage {
        Storage::Linked => 2,
        Storage::Contiguous => 1,
    }
}

/// Returns the words per triangle of the large-triangle queue, one per face, which binning needs during the
/// build. Lists that are drawn need none.
pub(crate) fn large_words(config: &Config) -> u64 {
    match config.builder {
        Builder::Binning => numbers::PRIMITIVE_LARGE_LIMIT.into(),
        Builder::Raster => 0,
    }
}

/// Returns the number of workgroups per triangle with many columns of a face. It is large enough that the
/// loops of an invocation stay within BIN_TURNS iterations.
pub(crate) fn bin_groups(config: &Config) -> u32 {
    let block = BIN_BLOCK as u64;
    let blocks = u64::from(config.tiles() + 2).div_ceil(block).pow(2);
    // Iterations over each block, its rows and columns, and the buckets of each column.
    let turns = blocks * (1 + block + block * block * u64::from(1 + config.buckets));
    rasray_ads::kit::bin_groups(turns)
}

/// Returns the draw of the faces, whose cells and blocks are built together.
pub(crate) fn faces(config: &Config) -> ViewDraw {
    ViewDraw { side: config.tiles() + 2, views: config.view_count(), first: 0 }
}

/// Returns the words of the bounds of all blocks.
fn pyramid_words(config: &Config) -> u64 {
    if config.has_pyramid() { Pyramid::words(&[faces(config)]) } else { 0 }
}

/// Returns the sizes of the pools of primitive lists of this configuration for `demand`.
///
/// # Errors
/// An option is out of range, or a pool has more elements than 32-bit indices can address.
pub fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
    config.validate()?;
    let cells = cell_count(config);
    let lists = cells * u64::from(config.buckets);
    let sums = if config.storage == Storage::Contiguous { Scan::sums(lists) } else { 0 };
    let pool = |pool, elements, words: u64| (pool, elements, 4 * words);
    let pools = [
        pool(Pool::Bounds, cells * bounds_words(config) + pyramid_words(config), 1),
        pool(Pool::Lists, lists, 1),
        pool(Pool::Entries, demand.entries, entry_words(config.storage)),
        pool(Pool::Sums, sums, 1),
        pool(Pool::Near, demand.near, 1),
        pool(Pool::Large, large_words(config) * demand.triangles, 1),
    ];
    Sizes::of("primitive", pools)
}

/// Returns the sizes for the first build, before anything has been counted: four entries per cell, if the
/// options do not say.
pub(crate) fn first_plan(config: &Config, triangles: u32) -> Result<Sizes, AdsError> {
    let entries = config.entries.unwrap_or_else(|| 4 * cell_count(config));
    plan(config, &Demand { entries, near: 64, triangles: triangles.into() })
}

/// Bytes of primitive lists, for counted cells, buckets and entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Bytes of cells: 8 per tile, 4 per list of each bucket, and a scale of 4 if there are several buckets;
    /// and 8 per block of the pyramid.
    pub cells: u64,
    /// Bytes of entries: 4 each, or 8 in a linked list.
    pub entries: u64,
    /// Bytes of the scan: a sum of 4 per 1024 numbers that are scanned.
    pub scan: u64,
    /// Bytes of all else: the header, 4 per triangle of the near-region list, and 24 per triangle if a
    /// compute pass puts triangles into tiles.
    pub rest: u64,
}

impl FormulaBytes {
    /// Returns the sum of all parts.
    pub fn total(&self) -> u64 {
        self.cells + self.entries + self.scan + self.rest
    }
}

/// Computes the bytes by the formula of `docs/systems/dirt.md`. It shares no code with [`plan`], so that the
/// two check each other.
pub fn formula_bytes(config: &Config, demand: &Demand) -> FormulaBytes {
    let tiles = u64::from(config.resolution).div_ceil(u64::from(config.tile));
    let views = if config.views == Views::Camera { 1 } else { 6 };
    let cells = (tiles + 2) * (tiles + 2) * views;
    let buckets = u64::from(config.buckets);
    let contiguous = config.storage == Storage::Contiguous;
    let (mut side, mut blocks) = (tiles + 2, 0);
    while config.pyramid && config.skip && side > 1 {
        side = side.div_ceil(2);
        blocks += views * side * side;
    }
    let large = if config.builder == Builder::Binning { 24 * demand.triangles } else { 0 };
    FormulaBytes {
        cells: cells * (8 + 4 * buckets + if buckets > 1 { 4 } else { 0 }) + 8 * blocks,
        entries: demand.entries * if contiguous { 4 } else { 8 },
        scan: if contiguous { (cells * buckets).div_ceil(1024) * 4 } else { 0 },
        rest: 196 + 4 * demand.near + large,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_equals_formula() {
        let demand = Demand { entries: 12_345, near: 7, triangles: 99 };
        for (resolution, tile, buckets, storage) in [
            (64, 1, 1, Storage::Linked),
            (256, 2, 16, Storage::Contiguous),
            (100, 8, 64, Storage::Contiguous),
            (33, 4, 4, Storage::Linked),
        ] {
            for (skip, builder, pyramid) in [
                (true, Builder::Raster, true),
                (false, Builder::Binning, true),
                (true, Builder::Raster, false),
            ] {
                let views = if pyramid { Views::Cube } else { Views::Camera };
                let own = Config { views, ..Config::robust(resolution) };
                let config = Config { tile, buckets, storage, skip, builder, pyramid, ..own };
                let sizes = plan(&config, &demand).expect("options are in range");
                assert_eq!(sizes.bytes(), formula_bytes(&config, &demand).total(), "{config:?}");
                let more = Demand { entries: demand.entries + 1, ..demand };
                assert_ne!(sizes.bytes(), formula_bytes(&config, &more).total());
            }
        }
    }

    /// Checks the bytes of table 3 of the paper: 8 for a node of a list, 4 for a head, and 8 per tile for
    /// depth bounds.
    #[test]
    fn published_lists_have_the_papers_bytes() {
        // Terms of the paper's table 3: 8 bytes for depths and a third of that for their pyramid, 4 for the
        // head of each bucket, and 8 for a node.
        let published = Config { tile: 1, buckets: 4, ..Config::published(512) };
        let demand = Demand { entries: 3_100_000, ..Demand::default() };
        let (formula, cells) = (formula_bytes(&published, &demand), cell_count(&published));
        assert_eq!(formula.entries, 8 * 3_100_000);
        // A cell has one word more than in the paper: the scale of its buckets.
        let pyramid = formula.cells - cells * (8 + 4 * 4 + 4);
        let third = 8.0 * cells as f64 / 3.0;
        assert!(
            (pyramid as f64 / third - 1.0).abs() < 0.02,
            "{pyramid} bytes of a pyramid, a third is {third}"
        );
        let flat = Config { pyramid: false, ..published };
        assert_eq!(formula_bytes(&flat, &demand).cells, cells * (8 + 4 * 4 + 4));
        let contiguous = Config { storage: Storage::Contiguous, ..published };
        assert_eq!(formula_bytes(&contiguous, &demand).entries, 4 * 3_100_000);
    }

    /// Checks that an invocation's share of a triangle that covers all columns stays bounded for any number
    /// of tiles and buckets.
    #[test]
    fn binning_gives_each_invocation_a_bounded_share() {
        for (resolution, buckets, groups) in [(16, 1, 1), (256, 16, 1), (1024, 64, 36), (8192, 64, 2286)] {
            let lists = Config { tile: 1, buckets, storage: Storage::Linked, ..Config::robust(resolution) };
            assert_eq!(bin_groups(&lists), groups, "{resolution} tiles, {buckets} buckets");
        }
    }

    #[test]
    fn out_of_range_options_are_named() {
        let message =
            |config: Config| plan(&config, &Demand::default()).expect_err("it is refused").to_string();
        assert!(message(Config { buckets: 65, ..Config::robust(64) }).contains("buckets is 65"));
        assert!(message(Config { tile: 0, ..Config::robust(64) }).contains("tile is 0"));
        assert!(message(Config { resolution: 0, ..Config::robust(64) }).contains("resolution is 0"));
        let budget = Config { work_budget: Some(0), ..Config::robust(64) };
        assert!(message(budget).contains("work budget is 0"));
        let demand = Demand { entries: 1 << 32, ..Demand::default() };
        assert!(
            plan(&Config::robust(64), &demand).expect_err("it is refused").to_string().contains("entries")
        );
    }
}
