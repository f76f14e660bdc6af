//! Sizes of the pools: plain arithmetic, no device.

use rasray_ads::{AdsError, PoolSize, Scan, Sizes};

use crate::{Config, Header, Storage};

/// Names of the pools in the order of [`Sizes::pools`].
pub(crate) const POOLS: [&str; 6] = ["header", "bounds", "lists", "entries", "sums", "near"];

/// Cells of all six faces of `tiles` tiles a side, each with a border of one.
pub fn cell_count(tiles: u32) -> u64 {
    let side = u64::from(tiles) + 2;
    6 * side * side
}

/// Words of the bounds of a cell: both ends, and the scale where there are several buckets.
pub(crate) fn bounds_words(config: &Config) -> u64 {
    if config.buckets > 1 { 3 } else { 2 }
}

/// Words of an entry of a list.
pub(crate) fn entry_words(storage: Storage) -> u64 {
    match storage {
        Storage::Linked => 2,
        Storage::Contiguous => 1,
    }
}

/// What primitive lists of this configuration allocate to hold `entries` list entries and `near_triangles`
/// triangles around the eye.
///
/// # Errors
/// An option is out of range, or a pool has more elements than 32-bit numbers can name.
pub fn plan(config: &Config, entries: u64, near_triangles: u64) -> Result<Sizes, AdsError> {
    config.validate()?;
    let cells = cell_count(config.tiles());
    let lists = cells * u64::from(config.buckets);
    let blocks = match config.storage {
        Storage::Linked => 0,
        Storage::Contiguous => Scan::sums(lists),
    };
    let sizes = [
        (1, size_of::<Header>() as u64),
        (cells, 4 * bounds_words(config)),
        (lists, 4),
        (entries, 4 * entry_words(config.storage)),
        (blocks, 4),
        (near_triangles, 4),
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
        return Err(AdsError::PoolTooLarge { structure: "dirt", pool: pool.name, elements: pool.elements });
    }
    Ok(Sizes { pools })
}

/// The first guess where nothing has been counted: four entries a cell.
pub(crate) fn first_plan(config: &Config) -> Result<Sizes, AdsError> {
    plan(config, config.entries.unwrap_or_else(|| 4 * cell_count(config.tiles())), 64)
}

/// Bytes for counted cells, buckets and entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Per cell: bounds 8, a list of each bucket 4, and a scale of 4 where there are several buckets.
    pub cells: u64,
    /// Per entry: 4, or 8 in a linked list.
    pub entries: u64,
    /// Per 1024 lists: a sum of 4 for the scan of contiguous lists.
    pub scan: u64,
    /// Header, and 4 per triangle of the near list.
    pub rest: u64,
}

impl FormulaBytes {
    /// Sum of all parts.
    pub fn total(&self) -> u64 {
        self.cells + self.entries + self.scan + self.rest
    }
}

/// The page's formula. It does not look at [`plan`], so that the two check each other.
pub fn formula_bytes(config: &Config, entries: u64, near_triangles: u64) -> FormulaBytes {
    let side = u64::from(config.resolution).div_ceil(u64::from(config.tile)) + 2;
    let cells = side * side * 6;
    let buckets = u64::from(config.buckets);
    let contiguous = config.storage == Storage::Contiguous;
    FormulaBytes {
        cells: cells * (8 + 4 * buckets + if buckets > 1 { 4 } else { 0 }),
        entries: entries * if contiguous { 4 } else { 8 },
        scan: if contiguous { (cells * buckets).div_ceil(1024) * 4 } else { 0 },
        rest: 136 + 4 * near_triangles,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_equals_formula() {
        for (resolution, tile, buckets, storage) in [
            (64, 1, 1, Storage::Linked),
            (256, 2, 16, Storage::Contiguous),
            (100, 8, 64, Storage::Contiguous),
            (33, 4, 4, Storage::Linked),
        ] {
            let config = Config { tile, buckets, storage, ..Config::robust(resolution) };
            let sizes = plan(&config, 12_345, 7).expect("options are in range");
            assert_eq!(sizes.bytes(), formula_bytes(&config, 12_345, 7).total());
            assert_ne!(sizes.bytes(), formula_bytes(&config, 12_346, 7).total());
        }
    }

    /// Table 3 of the paper: a node of a list is 8 bytes, a head 4, and depth bounds 8 a tile.
    #[test]
    fn linked_lists_have_the_papers_bytes() {
        let config = Config { tile: 1, buckets: 4, storage: Storage::Linked, ..Config::robust(512) };
        let (formula, cells) = (formula_bytes(&config, 3_100_000, 0), cell_count(512));
        assert_eq!(formula.entries, 8 * 3_100_000);
        // One word more a cell than the paper: the scale of its buckets.
        assert_eq!(formula.cells, cells * (8 + 4 * 4 + 4));
    }

    #[test]
    fn out_of_range_options_are_named() {
        let message = |config: Config| plan(&config, 0, 0).unwrap_err().to_string();
        assert!(message(Config { buckets: 65, ..Config::robust(64) }).contains("buckets is 65"));
        assert!(message(Config { tile: 0, ..Config::robust(64) }).contains("tile is 0"));
        assert!(message(Config { resolution: 0, ..Config::robust(64) }).contains("resolution is 0"));
        let budget = Config { work_budget: Some(0), ..Config::robust(64) };
        assert!(message(budget).contains("work budget is 0"));
        assert!(plan(&Config::robust(64), 1 << 32, 0).unwrap_err().to_string().contains("entries"));
    }
}
