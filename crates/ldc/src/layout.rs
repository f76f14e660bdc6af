//! Sizes of the pools, by plain arithmetic without a device.

use rasray_ads::kit::{Scan, Scratch};
use rasray_ads::{AdsError, Sizes};

use rasray_shaders_glsl::constants::ldc::LDC_LEVEL_BLOCKS;

use crate::{Builder, Config, Depth, Making, Occupancy, Payload, Pool};

/// Returns the number of cells of all three views.
pub fn cell_count(resolution: u32) -> u64 {
    3 * u64::from(resolution) * u64::from(resolution)
}

/// Returns the number of blocks of all three views and all levels. The last block of a row may reach beyond
/// the view.
pub fn block_count(config: &Config) -> u64 {
    let blocks = config.block.map(|side| config.resolution.div_ceil(side));
    let upper = blocks.map(|side| side.div_ceil(LDC_LEVEL_BLOCKS));
    let in_views = |[columns, rows]: [u32; 2]| 3 * u64::from(columns) * u64::from(rows);
    in_views(blocks) + if config.levels == 2 { in_views(upper) } else { 0 }
}

/// Demand of a build: the number of elements that it needs in each pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Demand {
    /// Number of places of fragments. With 16-bit depths every list begins at an even place, so a list of odd
    /// length takes one place more than it has fragments.
    pub fragments: u64,
    /// Number of triangles that conservative lists keep.
    pub conservative: u64,
    /// Number of lists that are too long for one dispatch to sort.
    pub long_lists: u64,
    /// Number of fragments in the deepest cell, which is the number of layers that peeling needs.
    pub layers: u64,
    /// Number of triangles with many cells of their view, which the binning builder queues.
    pub large: u64,
}

/// Returns the sizes of the pools of a layered depth cube of this configuration for a demand.
///
/// # Errors
/// An option is out of range, or a pool has more elements than 32-bit indices can address.
pub fn plan(config: &Config, demand: Demand) -> Result<Sizes, AdsError> {
    config.validate()?;
    let cells = cell_count(config.resolution);
    let depth_words = match config.depth {
        Depth::Bits16 => demand.fragments.div_ceil(2),
        Depth::Bits32 => demand.fragments,
    };
    let block_bytes = match config.occupancy {
        Occupancy::Bounds => 8,
        Occupancy::Slices => 16,
    };
    let (heads, conservative) =
        if config.has_conservative_lists() { (cells, demand.conservative) } else { (0, 0) };
    let sizes = [
        (Pool::Lists, cells, 4),
        (Pool::Depths, depth_words, 4),
        (Pool::Payload, demand.fragments, config.payload_bytes()),
        (Pool::Blocks, block_count(config), block_bytes),
        (Pool::Heads, heads, 4),
        (Pool::Conservative, conservative, 12),
        (Pool::Scratch, scratch_words(config, demand), 4),
    ];
    Sizes::of("ldc", sizes)
}

/// Returns the contents of the scratch pool: the sums of the scan, and the words that binning and sorting
/// use.
pub(crate) fn scratch(config: &Config) -> Scratch<Pool> {
    let sums = Scan::sums(cell_count(config.resolution));
    let sorts = config.making == Making::Single;
    Scratch { pool: Pool::Scratch, sums, builder: config.builder, sorts }
}

/// Returns the words of the scratch pool. Peeling adds one word per layer behind the sums.
pub(crate) fn scratch_words(config: &Config, demand: Demand) -> u64 {
    let layers = if config.making == Making::Peel { demand.layers } else { 0 };
    scratch(config).words(demand.large, demand.long_lists) + layers
}

/// Returns the number of layers that can be peeled into pools of these sizes.
pub(crate) fn layer_capacity(config: &Config, sizes: &Sizes) -> u64 {
    if config.making == Making::Peel { scratch(config).words_behind_sums(sizes) } else { 0 }
}

/// Returns the sizes for the first build, before anything has been counted: two fragments per cell, one
/// triangle of a conservative list per four cells, and up to eight layers.
pub(crate) fn first_plan(config: &Config) -> Result<Sizes, AdsError> {
    let cells = cell_count(config.resolution);
    let fragments = config.fragments.unwrap_or(2 * cells);
    let layers = config.layers.min(8).into();
    plan(config, Demand { fragments, conservative: cells / 4, long_lists: 0, layers, large: 1024 })
}

/// Bytes of a layered depth cube, for counted cells, places of fragments, triangles outside of centres and
/// long lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Bytes of cells: 4 for the end of the cell's list and, with conservative lists, 4 for the head of the
    /// cell's conservative list.
    pub cells: u64,
    /// Bytes of blocks: 8 for the smallest and largest depth and, with [`Occupancy::Slices`], 8 for the
    /// slices.
    pub blocks: u64,
    /// Bytes of fragments: per place a triangle of 4, or colour and normal of 8; and a depth of 2 or 4.
    pub fragments: u64,
    /// Bytes of conservative lists: 12 per triangle outside of a centre, for the triangle, the link and the
    /// depths.
    pub conservative: u64,
    /// Bytes of triangles that are kept for diagnostics ([`Config::ids`]): 4 per fragment.
    pub ids: u64,
    /// Bytes of all else: the header; a sum of 4 per 1024 cells for the scan; with peeling 4 per layer,
    /// otherwise the larger of 8 per long list and, with the binning builder, 4 per triangle with many cells.
    pub rest: u64,
}

impl FormulaBytes {
    /// Returns the sum of all parts.
    pub fn total(&self) -> u64 {
        self.cells + self.blocks + self.fragments + self.conservative + self.ids + self.rest
    }
}

/// Computes the bytes by the formula of `docs/systems/ldc.md`. It shares no code with [`plan`], so that the
/// two check each other.
pub fn formula_bytes(config: &Config, demand: Demand) -> FormulaBytes {
    let Demand { fragments, conservative, long_lists, layers, large } = demand;
    let side = u64::from(config.resolution);
    let [across, along] = config.block.map(|cells| side.div_ceil(u64::from(cells)));
    let upper = if config.levels == 2 { across.div_ceil(8) * along.div_ceil(8) } else { 0 };
    let block_bytes = if config.occupancy == Occupancy::Slices { 16 } else { 8 };
    let cells = side * side * 3;
    let kept = config.has_conservative_lists();
    // Depths of 16 bits fill whole words, two each.
    let depths = if config.depth == Depth::Bits16 { 4 * fragments.div_ceil(2) } else { 4 * fragments };
    let payload = if config.payload == Payload::Attributes { 8 } else { 4 };
    FormulaBytes {
        cells: cells * if kept { 8 } else { 4 },
        blocks: 3 * (across * along + upper) * block_bytes,
        fragments: payload * fragments + depths,
        ids: if config.ids { 4 * fragments } else { 0 },
        conservative: if kept { 12 * conservative } else { 0 },
        rest: 224
            + 4 * cells.div_ceil(1024)
            + match (config.making, config.builder) {
                (Making::Peel, _) => 4 * layers,
                (Making::Single, Builder::Raster) => 8 * long_lists,
                (Making::Single, Builder::Binning) => (8 * long_lists).max(4 * large),
            },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Accept, Coverage};

    #[test]
    fn plan_equals_formula() {
        for (resolution, block, depth, coverage, accept) in [
            (64, [8, 8], Depth::Bits32, Coverage::Conservative, Accept::Plane),
            (64, [8, 8], Depth::Bits16, Coverage::Conservative, Accept::Triangle),
            (100, [64, 2], Depth::Bits16, Coverage::Hardware, Accept::Plane),
            (33, [1, 4], Depth::Bits16, Coverage::Exact, Accept::Plane),
            (1, [2, 2], Depth::Bits32, Coverage::Exact, Accept::Slope),
        ] {
            for (occupancy, levels, making) in
                [(Occupancy::Slices, 2, Making::Single), (Occupancy::Bounds, 1, Making::Peel)]
            {
                let robust = Config::robust(resolution);
                let binned = making == Making::Single && coverage != Coverage::Hardware;
                let builder = if binned { Builder::Binning } else { Builder::Raster };
                let config =
                    Config { block, depth, coverage, accept, builder, occupancy, levels, making, ..robust };
                let stored = Config { payload: Payload::Attributes, accept: Accept::Tolerance, ..config };
                let named = Config { ids: true, ..stored };
                for (config, fragments) in [config, stored, named]
                    .into_iter()
                    .flat_map(|config| [0, 12_344, 12_345].map(|fragments| (config, fragments)))
                {
                    let demand = Demand { fragments, conservative: 77, long_lists: 3, layers: 5, large: 9 };
                    let sizes = plan(&config, demand).expect("options are in range");
                    assert_eq!(sizes.bytes(), formula_bytes(&config, demand).total(), "{config:?}");
                }
            }
        }
    }

    #[test]
    fn out_of_range_options_are_named() {
        let refused = |config: Config| plan(&config, Demand::default()).expect_err("refused").to_string();
        assert!(refused(Config { resolution: 0, ..Config::robust(64) }).contains("resolution is 0"));
        assert!(refused(Config { block: [3; 2], ..Config::robust(64) }).contains("block is 3"));
        assert!(refused(Config { block: [8, 128], ..Config::robust(64) }).contains("block is 8x128"));
        assert!(refused(Config { levels: 3, ..Config::robust(64) }).contains("levels is 3"));
        assert!(refused(Config { layers: 1025, ..Config::robust(64) }).contains("layers is 1025"));
        assert!(refused(Config { tolerance: f32::NAN, ..Config::robust(64) }).contains("tolerance"));
        assert!(refused(Config { work_budget: Some(1), ..Config::robust(64) }).contains("work budget"));
        let nameless = refused(Config { payload: Payload::Attributes, ..Config::robust(64) });
        assert!(nameless.contains("accept") && nameless.contains("payload"), "{nameless}");
        let planes = Config { accept: Accept::Plane, ..Config::robust(64) };
        let asked = |demand| plan(&planes, demand).expect_err("refused").to_string();
        assert!(asked(Demand { fragments: 1 << 32, ..Demand::default() }).contains("depths"));
        assert!(asked(Demand { conservative: 1 << 31, ..Demand::default() }).contains("conservative"));
    }
}
