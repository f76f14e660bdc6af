//! Sizes of the pools, and the cube that they divide, by plain arithmetic without a device.

use rasray_ads::kit::{Scan, Scratch};
use rasray_ads::{AdsError, Sizes};
use rasray_shaders_glsl::constants::voxel::VOXEL_NODE_LIMIT;

use crate::{Axes, Builder, Config, Leaves, Payload, Pool, Storage, Traversal};

/// Returns the number of lists of all three views: one per cell.
pub fn list_count(resolution: u32) -> u64 {
    3 * u64::from(resolution) * u64::from(resolution)
}

/// Demand of a build: the number of elements that it needs in each pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Demand {
    /// Number of fragments, or of pages of fragments.
    pub entries: u64,
    /// Number of lists that are too long for one dispatch to sort; zero if lists are not sorted.
    pub long_lists: u64,
    /// Number of triangles with many cells or columns of voxels, which the binning builder queues.
    pub large: u64,
    /// Number of nodes of the octree.
    pub nodes: u64,
}

/// Returns the sizes of the pools of a configuration for a demand.
///
/// # Errors
/// An option is out of range, or a pool has more elements than 32-bit indices can address.
pub fn plan(config: &Config, demand: Demand) -> Result<Sizes, AdsError> {
    config.validate()?;
    let voxels = u64::from(config.grid()).pow(3);
    // With voxels as the leaves, a word per voxel takes the place of lists, and there are no fragments.
    let (lists, entries) = match config.leaves {
        Leaves::Fragments => (list_count(config.resolution), demand.entries),
        Leaves::Voxels => (voxels, 0),
    };
    let normals = if config.axes == Axes::Triangle { 0 } else { voxels };
    let (nodes, octants) = match config.traversal {
        Traversal::Dda => (0, 0),
        Traversal::Octree => (demand.nodes, upper_nodes(config) + Scan::sums(upper_nodes(config))),
    };
    let limit = VOXEL_NODE_LIMIT.into();
    if nodes > limit {
        return Err(AdsError::PoolTooLarge { structure: "voxel", pool: "nodes", elements: nodes, limit });
    }
    let sizes = [
        (Pool::Voxels, voxels.div_ceil(8), 4),
        (Pool::Normals, normals, 12),
        (Pool::Lists, lists, 4),
        (Pool::Fragments, entries, 4 * entry_words(config)),
        (Pool::Scratch, scratch(config).words(demand.large, demand.long_lists), 4),
        (Pool::Nodes, nodes, 4),
        (Pool::Octants, octants, 4),
    ];
    let sizes = Sizes::of("voxel", sizes)?;
    if config.storage == Storage::Paged { sizes.of_pages("voxel", Pool::Fragments) } else { Ok(sizes) }
}

/// Returns the words of a fragment, with its link if it is linked, or of a page of fragments with its link to
/// the next page.
pub(crate) fn entry_words(config: &Config) -> u64 {
    let words = config.fragment_words();
    match config.storage {
        Storage::Contiguous => words,
        Storage::Linked => words + 1,
        Storage::Paged => 1 + u64::from(config.page) * words,
    }
}

/// Returns the contents of the scratch pool: the sums of the scan if lists are counted, and the words that
/// binning and sorting use.
pub(crate) fn scratch(config: &Config) -> Scratch<Pool> {
    let counted = config.storage == Storage::Contiguous && config.leaves == Leaves::Fragments;
    let sums = if counted { Scan::sums(list_count(config.resolution)) } else { 0 };
    Scratch { pool: Pool::Scratch, sums, builder: config.builder, sorts: config.sorts() }
}

/// Returns the number of iterations of the longest loop over a triangle: over the cells of a view, or over
/// the columns of voxels and, in each column, the few voxels that the triangle reaches into in the view it
/// faces most.
pub(crate) fn widest_view(config: &Config) -> u64 {
    let cells = |side: u32| (u64::from(side) + 2).pow(2);
    let columns = 8 * cells(config.grid());
    if config.leaves == Leaves::Voxels { columns } else { cells(config.resolution).max(columns) }
}

/// Returns the number of levels of the octree: 2^levels voxels along a side, in blocks of 2x2x2 voxels with
/// at least the root above them.
pub(crate) fn levels(config: &Config) -> u32 {
    config.grid().next_power_of_two().trailing_zeros().max(2)
}

/// Returns the number of nodes above the blocks if no node were empty.
pub(crate) fn upper_nodes(config: &Config) -> u64 {
    ((1 << (3 * (levels(config) - 1))) - 1) / 7
}

/// Returns the sizes for the first build, before anything has been counted: one entry per cell of one view,
/// and a node per voxel of a few slices.
pub(crate) fn first_plan(config: &Config) -> Result<Sizes, AdsError> {
    let entries = config.fragments.unwrap_or_else(|| list_count(config.resolution) / 3);
    let nodes = 4 * u64::from(config.grid()).pow(2);
    plan(config, Demand { entries, long_lists: 0, large: 1024, nodes })
}

/// Bytes of voxels with axis A-buffers, for counted voxels, cells, entries and long lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Bytes of voxels: a word of 4 per eight voxels, and 12 per voxel if normals are averaged.
    pub voxels: u64,
    /// Bytes of lists: 4 per cell of three views. If voxels are the leaves, 4 per voxel.
    pub lists: u64,
    /// Bytes of fragments: 8 each, or 16 with attributes, and 4 more if they are linked. A page takes 4, and
    /// the bytes of its fragments.
    pub fragments: u64,
    /// Bytes of triangles that are kept for diagnostics ([`Config::ids`]): 4 per fragment, or per slot of a
    /// page.
    pub ids: u64,
    /// Bytes of the octree: 4 per node, and the counts of its build.
    pub octree: u64,
    /// Bytes of all else: the header; with contiguous lists a sum of 4 per 1024 lists for the scan; and the
    /// larger of 8 per long list and, with the binning builder, 4 per triangle with many cells.
    pub rest: u64,
}

impl FormulaBytes {
    /// Returns the sum of all parts.
    pub fn total(&self) -> u64 {
        self.voxels + self.lists + self.fragments + self.ids + self.octree + self.rest
    }
}

/// Computes the bytes by the formula of the systems' pages in `docs/systems`. It shares no code with
/// [`plan`], so that the two check each other.
pub fn formula_bytes(config: &Config, demand: Demand) -> FormulaBytes {
    let grid = u64::from(config.grid());
    let cells = u64::from(config.resolution) * u64::from(config.resolution) * 3;
    let averaged = config.axes != Axes::Triangle;
    let per_fragment = if config.payload == Payload::Index { 8 } else { 16 };
    let (per_entry, sums) = match config.storage {
        Storage::Contiguous => (per_fragment, cells.div_ceil(1024) * 4),
        Storage::Linked => (per_fragment + 4, 0),
        Storage::Paged => (4 + u64::from(config.page) * per_fragment, 0),
    };
    let long = if config.sort && config.storage != Storage::Paged { 8 * demand.long_lists } else { 0 };
    let large = if config.builder == Builder::Binning { 4 * demand.large } else { 0 };
    let octree = match config.traversal {
        Traversal::Dda => 0,
        Traversal::Octree => {
            let blocks = grid.next_power_of_two().max(4) / 2;
            let above = (blocks * blocks * blocks - 1) / 7;
            4 * (demand.nodes + above + above.div_ceil(1024))
        }
    };
    if config.leaves == Leaves::Voxels {
        let voxels = grid * grid * grid;
        return FormulaBytes {
            voxels: voxels.div_ceil(8) * 4,
            lists: 4 * voxels,
            fragments: 0,
            ids: 0,
            octree,
            rest: 164 + large,
        };
    }
    FormulaBytes {
        voxels: (grid * grid * grid).div_ceil(8) * 4 + if averaged { grid * grid * grid * 12 } else { 0 },
        lists: cells * 4,
        fragments: demand.entries * per_entry,
        ids: match (config.ids, config.storage) {
            (false, _) => 0,
            (true, Storage::Paged) => 4 * demand.entries * u64::from(config.page),
            (true, _) => 4 * demand.entries,
        },
        octree,
        rest: 164 + sums + long.max(large),
    }
}

#[cfg(test)]
mod tests {
    use rasray_shaders_glsl::constants::ads::PAGE_LIMIT;

    use super::*;
    use crate::{Accept, Coverage};

    #[test]
    fn plan_equals_formula() {
        for (resolution, grid) in [(64, None), (512, Some(64)), (33, Some(7)), (1, None)] {
            for config in [
                Config { grid, ..Config::at_centres(resolution) },
                Config { grid, builder: Builder::Binning, ..Config::at_centres(resolution) },
                Config { grid, ..Config::published_hu(resolution) },
                Config { grid, payload: Payload::Index, ..Config::published_hu(resolution) },
                Config { grid, ids: true, ..Config::published_hu(resolution) },
                Config {
                    grid,
                    ids: true,
                    storage: Storage::Paged,
                    page: 3,
                    ..Config::published_hu(resolution)
                },
                Config { grid, ..Config::published_selective(resolution) },
                Config { grid, storage: Storage::Contiguous, ..Config::published_selective(resolution) },
                Config { grid, storage: Storage::Linked, ..Config::at_centres(resolution) },
                Config { grid, storage: Storage::Paged, page: 5, ..Config::at_centres(resolution) },
                Config { grid, leaves: Leaves::Voxels, ..Config::at_centres(resolution) },
                Config { grid, traversal: Traversal::Octree, ..Config::at_centres(resolution) },
                Config {
                    grid,
                    traversal: Traversal::Octree,
                    leaves: Leaves::Voxels,
                    ..Config::at_centres(resolution)
                },
                Config {
                    grid,
                    leaves: Leaves::Voxels,
                    builder: Builder::Binning,
                    ..Config::at_centres(resolution)
                },
            ] {
                let demand = Demand { entries: 12_345, long_lists: 3, large: 7, nodes: 99 };
                let sizes = plan(&config, demand).expect("options are in range");
                assert_eq!(sizes.bytes(), formula_bytes(&config, demand).total());
                let more = formula_bytes(&config, Demand { entries: 12_346, ..demand }).total();
                assert_eq!(sizes.bytes() != more, config.leaves == Leaves::Fragments);
                let grown = formula_bytes(&config, Demand { nodes: 100, ..demand }).total();
                assert_eq!(sizes.bytes() != grown, config.traversal == Traversal::Octree);
                let longer = formula_bytes(&config, Demand { long_lists: 4, ..demand }).total();
                assert_eq!(sizes.bytes() != longer, config.sorts());
            }
        }
    }

    #[test]
    fn out_of_range_options_are_named() {
        let message =
            |config: Config| plan(&config, Demand::default()).expect_err("it is refused").to_string();
        assert!(message(Config { resolution: 0, ..Config::at_centres(64) }).contains("resolution is 0"));
        assert!(message(Config { grid: Some(1025), ..Config::at_centres(64) }).contains("grid is 1025"));
        assert!(message(Config { samples: 0, ..Config::at_centres(64) }).contains("samples is 0"));
        assert!(message(Config { page: 9, ..Config::at_centres(64) }).contains("page is 9"));
        assert!(
            message(Config { work_budget: Some(0), ..Config::at_centres(64) }).contains("work budget is 0")
        );
        assert!(message(Config { accept: Accept::Plane, ..Config::published_hu(64) }).contains("march"));
        let bent = Config { coverage: Coverage::Conservative, ..Config::published_hu(64) };
        assert!(message(bent).contains("coverage is conservative"));
        let nameless = message(Config { payload: Payload::Material, ..Config::at_centres(64) });
        assert!(nameless.contains("accept") && nameless.contains("payload"), "{nameless}");
        let many = Demand { entries: 1 << 32, ..Demand::default() };
        assert!(
            plan(&Config::at_centres(64), many).expect_err("it is refused").to_string().contains("fragments")
        );
        let sparse = Config { traversal: Traversal::Octree, ..Config::at_centres(64) };
        let nodes = u64::from(VOXEL_NODE_LIMIT);
        assert!(plan(&sparse, Demand { nodes, ..Demand::default() }).is_ok());
        let many = Demand { nodes: nodes + 1, ..Demand::default() };
        assert!(plan(&sparse, many).expect_err("it is refused").to_string().contains("nodes"));
        // The word of a list has room for fewer pages than 32 bits could address.
        let paged = Config { storage: Storage::Paged, page: 1, ..Config::at_centres(64) };
        let many = Demand { entries: u64::from(PAGE_LIMIT) + 1, ..Demand::default() };
        assert!(plan(&paged, many).expect_err("it is refused").to_string().contains("fragments"));
        assert!(plan(&paged, Demand { entries: PAGE_LIMIT.into(), ..many }).is_ok());
    }
}
