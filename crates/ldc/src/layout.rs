//! Sizes of the pools: plain arithmetic, no device.

use rasray_ads::{AdsError, PoolSize, Scan, Sizes};

use crate::{Config, Coverage, Depth, Header};

/// Names of the pools in the order of [`Sizes::pools`].
pub(crate) const POOLS: [&str; 8] =
    ["header", "lists", "depths", "primitives", "blocks", "heads", "fringe", "sums"];

/// Cells of all three views.
pub fn cell_count(resolution: u32) -> u64 {
    3 * u64::from(resolution) * u64::from(resolution)
}

/// Blocks of all three views; the last of a row may reach beyond the view.
pub fn block_count(config: &Config) -> u64 {
    cell_count(config.resolution.div_ceil(config.block))
}

/// What a layered depth cube of this configuration allocates to hold `fragments` places of fragments and `fringe`
/// triangles beside centres. With 16-bit depths every list begins at an even place, so a list of odd length takes
/// one place more than it has fragments.
///
/// # Errors
/// An option is out of range, or a pool has more elements than 32-bit numbers can name.
pub fn plan(config: &Config, fragments: u64, fringe: u64) -> Result<Sizes, AdsError> {
    config.validate()?;
    let cells = cell_count(config.resolution);
    let depth_words = match config.depth {
        Depth::Bits16 => fragments.div_ceil(2),
        Depth::Bits32 => fragments,
    };
    let (heads, fringe) = match config.coverage {
        Coverage::Conservative => (cells, fringe),
        Coverage::Exact | Coverage::Hardware => (0, 0),
    };
    let sizes = [
        (1, size_of::<Header>() as u64),
        (cells, 4),
        (depth_words, 4),
        (fragments, 4),
        (block_count(config), 8),
        (heads, 4),
        (fringe, 8),
        (Scan::sums(cells), 4),
    ];
    let pools: Vec<PoolSize> = POOLS
        .iter()
        .zip(sizes)
        .map(|(&name, (elements, element_bytes))| PoolSize { name, elements, element_bytes })
        .collect();
    // Words of a pool are counted in 32 bits by the shaders, and the largest number means "more".
    if let Some(pool) =
        pools.iter().find(|pool| pool.elements * pool.element_bytes.div_ceil(4) >= u64::from(u32::MAX))
    {
        return Err(AdsError::PoolTooLarge { structure: "ldc", pool: pool.name, elements: pool.elements });
    }
    Ok(Sizes { pools })
}

/// The first guess where nothing has been counted: two fragments a cell, and a triangle beside the centre of
/// every fourth.
pub(crate) fn first_plan(config: &Config) -> Result<Sizes, AdsError> {
    let cells = cell_count(config.resolution);
    plan(config, config.fragments.unwrap_or(2 * cells), cells / 4)
}

/// Bytes for counted cells, places of fragments and triangles beside centres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Per cell: the end of its list 4, and with conservative coverage the head of its fringe 4.
    pub cells: u64,
    /// Per block: smallest and largest depth 8.
    pub blocks: u64,
    /// Per place: triangle 4 and depth 2 or 4.
    pub fragments: u64,
    /// Per triangle beside a centre: triangle and link 8.
    pub fringe: u64,
    /// Header, and a sum of 4 per 1024 cells for the scan.
    pub rest: u64,
}

impl FormulaBytes {
    /// Sum of all parts.
    pub fn total(&self) -> u64 {
        self.cells + self.blocks + self.fragments + self.fringe + self.rest
    }
}

/// The page's formula. It does not look at [`plan`], so that the two check each other.
pub fn formula_bytes(config: &Config, fragments: u64, fringe: u64) -> FormulaBytes {
    let side = u64::from(config.resolution);
    let blocks = side.div_ceil(u64::from(config.block));
    let cells = side * side * 3;
    let kept = config.coverage == Coverage::Conservative;
    // Depths of 16 bits fill whole words.
    let depths = if config.depth == Depth::Bits16 { 4 * fragments.div_ceil(2) } else { 4 * fragments };
    FormulaBytes {
        cells: cells * if kept { 8 } else { 4 },
        blocks: 3 * blocks * blocks * 8,
        fragments: 4 * fragments + depths,
        fringe: if kept { 8 * fringe } else { 0 },
        rest: 152 + 4 * cells.div_ceil(1024),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_equals_formula() {
        for (resolution, block, depth, coverage) in [
            (64, 8, Depth::Bits32, Coverage::Conservative),
            (100, 64, Depth::Bits16, Coverage::Hardware),
            (33, 1, Depth::Bits16, Coverage::Exact),
            (1, 2, Depth::Bits32, Coverage::Exact),
        ] {
            let config = Config { block, depth, coverage, ..Config::robust(resolution) };
            for fragments in [0, 12_344, 12_345] {
                let sizes = plan(&config, fragments, 77).expect("options are in range");
                assert_eq!(sizes.bytes(), formula_bytes(&config, fragments, 77).total(), "{config:?}");
            }
        }
    }

    #[test]
    fn out_of_range_options_are_named() {
        let refused = |config: Config| plan(&config, 0, 0).expect_err("refused").to_string();
        assert!(refused(Config { resolution: 0, ..Config::robust(64) }).contains("resolution is 0"));
        assert!(refused(Config { block: 3, ..Config::robust(64) }).contains("block is 3"));
        assert!(refused(Config { block: 128, ..Config::robust(64) }).contains("block is 128"));
        assert!(refused(Config { tolerance: f32::NAN, ..Config::robust(64) }).contains("tolerance"));
        assert!(refused(Config { work_budget: Some(1), ..Config::robust(64) }).contains("work budget"));
        assert!(plan(&Config::robust(64), 1 << 32, 0).unwrap_err().to_string().contains("depths"));
        assert!(plan(&Config::robust(64), 0, 1 << 31).unwrap_err().to_string().contains("fringe"));
    }
}
