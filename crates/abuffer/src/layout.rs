//! Sizes of the pools: plain arithmetic, no device.

use rasray_ads::{AdsError, PoolSize, Sizes};

use crate::{Accept, Config, Header, Payload};

/// Names of the pools in the order of [`Sizes::pools`].
pub(crate) const POOLS: [&str; 6] = ["header", "bounds", "lists", "nodes", "data", "near"];

/// Bytes of an ID node: depth, next, previous (MMRT table 2).
pub(crate) const NODE_BYTES: u64 = 12;

/// Cells of all six faces, each with a border of one cell.
pub fn cell_count(resolution: u32) -> u64 {
    let side = u64::from(resolution) + 2;
    6 * side * side
}

/// Bytes of a fragment's payload.
pub(crate) fn data_bytes(payload: Payload) -> u64 {
    match payload {
        Payload::Index => 4,
        Payload::Attributes => 16,
    }
}

fn bounds_bytes(accept: Accept) -> u64 {
    match accept {
        Accept::Interval | Accept::Thickness => 8,
        Accept::Plane => 16,
    }
}

/// What an A-buffer of this configuration allocates to hold `fragments` fragments and
/// `near_triangles` triangles around the eye.
///
/// # Errors
/// An option is out of range, or a pool has more elements than 32-bit links can name.
pub fn plan(config: &Config, fragments: u64, near_triangles: u64) -> Result<Sizes, AdsError> {
    config.validate()?;
    let cells = cell_count(config.resolution);
    let sizes = [
        (1, size_of::<Header>() as u64),
        (cells, bounds_bytes(config.accept)),
        (cells * u64::from(config.buckets), 8),
        (fragments, NODE_BYTES),
        (fragments, data_bytes(config.payload)),
        (near_triangles, 4),
    ];
    let pools: Vec<PoolSize> = POOLS
        .iter()
        .zip(sizes)
        .map(|(&name, (elements, element_bytes))| PoolSize { name, elements, element_bytes })
        .collect();
    // Words of a pool are counted in 32 bits by the shaders, and one value is kept to mean "none".
    if let Some(pool) =
        pools.iter().find(|pool| pool.elements * pool.element_bytes.div_ceil(4) >= u64::from(u32::MAX))
    {
        return Err(AdsError::PoolTooLarge { structure: "mmrt", pool: pool.name, elements: pool.elements });
    }
    Ok(Sizes { pools })
}

/// The first guess where nothing has been counted: a fragment a cell.
pub(crate) fn first_plan(config: &Config) -> Result<Sizes, AdsError> {
    plan(config, config.fragments.unwrap_or_else(|| cell_count(config.resolution)), 64)
}

/// Bytes of table 2 of the paper for counted cells, buckets and fragments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Per cell: bounds 8, head and tail of each bucket 8.
    pub cells: u64,
    /// Per cell with plane acceptance: extent and scale 8.
    pub plane: u64,
    /// Per fragment: node 12 and payload 4 or 16.
    pub fragments: u64,
    /// Header, and 4 per triangle of the near list.
    pub rest: u64,
}

impl FormulaBytes {
    /// Sum of all parts.
    pub fn total(&self) -> u64 {
        self.cells + self.plane + self.fragments + self.rest
    }
}

/// The page's formula. It follows the paper's table and does not look at [`plan`], so that the two
/// check each other.
pub fn formula_bytes(config: &Config, fragments: u64, near_triangles: u64) -> FormulaBytes {
    let side = u64::from(config.resolution + 2);
    let cells = side * side * 6;
    FormulaBytes {
        cells: cells * (8 + 8 * u64::from(config.buckets)),
        plane: if config.accept == Accept::Plane { cells * 8 } else { 0 },
        fragments: fragments * if config.payload == Payload::Index { 12 + 4 } else { 12 + 16 },
        rest: 136 + 4 * near_triangles,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_equals_formula() {
        for (buckets, accept, payload) in [
            (1, Accept::Interval, Payload::Attributes),
            (4, Accept::Plane, Payload::Index),
            (32, Accept::Thickness, Payload::Index),
        ] {
            let config = Config { buckets, accept, payload, ..Config::robust(64) };
            let sizes = plan(&config, 12_345, 7).expect("options are in range");
            assert_eq!(sizes.bytes(), formula_bytes(&config, 12_345, 7).total());
        }
    }

    /// Table 1 of the paper: 720x480 and six faces of 480x480, four buckets, 2.4 M fragments with 16
    /// bytes of payload, is 128 MB. The formula per cell and fragment gives 130 MiB there.
    #[test]
    fn formula_agrees_with_the_papers_table() {
        let config = Config { payload: Payload::Attributes, accept: Accept::Interval, ..Config::robust(480) };
        let formula = formula_bytes(&config, 2_400_000, 0);
        let per_cell = formula.cells / cell_count(480);
        let total = (720 * 480 + 6 * 480 * 480) * per_cell + formula.fragments;
        let mebibytes = total as f64 / f64::from(1 << 20);
        assert!((mebibytes - 130.0).abs() < 0.5, "{mebibytes} MiB");
    }

    #[test]
    fn out_of_range_options_are_named() {
        let config = Config { buckets: 33, ..Config::robust(64) };
        assert!(plan(&config, 0, 0).unwrap_err().to_string().contains("buckets is 33"));
        let config = Config { resolution: 0, ..Config::robust(64) };
        assert!(plan(&config, 0, 0).is_err());
        assert!(plan(&Config::robust(64), 1 << 32, 0).unwrap_err().to_string().contains("nodes"));
    }
}
