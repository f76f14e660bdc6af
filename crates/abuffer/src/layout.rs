//! Sizes of the pools, by plain arithmetic without a device.

use rasray_ads::kit::{Pyramid, Scan, Scratch, ViewDraw};
use rasray_ads::{AdsError, ListCounts, Sizes};
use rasray_shaders_glsl::constants::abuffer::{ABUFFER_BOX_WORDS, ABUFFER_BOXES, ABUFFER_CAMERA};
use rasray_shaders_glsl::constants::contract::VIEW_CAMERA;

use crate::{Accept, Bounds, Builder, Config, Coverage, March, Payload, Pool, Storage, Views};

// Logged steps name a view by its number here.
const _: () = assert!(ABUFFER_CAMERA == VIEW_CAMERA);

/// Returns the number of cells of all views, each view with a border of one cell.
pub fn cell_count(config: &Config) -> u64 {
    view_cells(config).iter().map(|(_, cells)| cells).sum()
}

/// Returns the name and the number of cells of each view, in the order in which cells are stored.
pub(crate) fn view_cells(config: &Config) -> Vec<(&'static str, u64)> {
    let mut views = Vec::new();
    if config.views.has_cube() {
        let cells = (u64::from(config.resolution) + 2).pow(2);
        views.extend(ListCounts::FACES.map(|face| (face, cells)));
    }
    if config.views.has_camera() {
        let [columns, rows] = config.camera_cells().map(|side| u64::from(side) + 2);
        views.push(("camera", columns * rows));
    }
    views
}

/// Returns the draws of all views: one for the faces of the cube, and one for the camera.
pub(crate) fn draws(config: &Config) -> Vec<ViewDraw> {
    let mut draws = Vec::new();
    if config.views.has_cube() {
        draws.push(ViewDraw { side: config.resolution + 2, views: 6, first: 0 });
    }
    if config.views.has_camera() {
        let [columns, rows] = config.camera_cells();
        draws.push(ViewDraw { side: columns.max(rows) + 2, views: 1, first: ABUFFER_CAMERA });
    }
    draws
}

/// Returns the number of cells of the largest view, with its border.
pub(crate) fn widest_view(config: &Config) -> u64 {
    draws(config).iter().map(|draw| u64::from(draw.side).pow(2)).max().unwrap_or(0)
}

/// Demand of a build: the number of elements that it needs in each pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Demand {
    /// Number of nodes: one per fragment, or one per page of fragments.
    pub nodes: u64,
    /// Number of triangles in the near region, around the eye.
    pub near_triangles: u64,
    /// Number of lists that are too long for one dispatch to sort.
    pub long_lists: u64,
    /// Number of triangles of the geometry.
    pub triangles: u64,
    /// Number of nodes of conservative lists: the triangles they keep, and the slices of long lists.
    pub conservative: u64,
    /// Number of triangles with many cells of a view, which the binning builder queues.
    pub large: u64,
}

/// Returns the words of a fragment's payload, plus the triangle that is kept for diagnostics.
pub(crate) fn data_words(config: &Config) -> u64 {
    let payload = match config.payload {
        Payload::Index | Payload::Normal => 1,
        Payload::Attributes | Payload::Plane => 4,
    };
    payload + u64::from(config.ids)
}

/// Returns the words of a fragment's node: the depth, the links, and the payload if it is inline. A
/// contiguous node refers to its payload if that is not inline.
pub(crate) fn fragment_words(config: &Config) -> u64 {
    let links = match config.storage {
        Storage::Paged => 0,
        Storage::Ll | Storage::Llb => 1,
        Storage::Dll | Storage::Dllb => 2,
        Storage::Sb => u64::from(!config.inline),
    };
    1 + links + if config.inline { data_words(config) } else { 0 }
}

/// Returns the words of a node: those of one fragment, or those of a page of several fragments with a word
/// that leads to the next page.
pub(crate) fn node_words(config: &Config) -> u64 {
    match config.storage {
        Storage::Paged => 1 + u64::from(config.page) * fragment_words(config),
        _ => fragment_words(config),
    }
}

/// Returns the capacity of a node, in fragments.
pub(crate) fn node_slots(config: &Config) -> u64 {
    if config.storage == Storage::Paged { config.page.into() } else { 1 }
}

/// Returns the bytes of a fragment with its payload and without links; in a page, the bytes of a slot.
pub(crate) fn slot_bytes(config: &Config) -> u64 {
    4 * (1 + data_words(config))
}

/// Returns the words of a list: one end, both ends, or first place and count.
pub(crate) fn list_words(storage: Storage) -> u64 {
    match storage {
        Storage::Ll | Storage::Llb | Storage::Paged => 1,
        Storage::Dll | Storage::Dllb | Storage::Sb => 2,
    }
}

/// Returns the words of a cell's bounds: the ends if there are buckets or blocks of cells; the extent if hits
/// depend on triangles, and its scale if there are also buckets; the head of the conservative list with
/// conservative coverage.
pub(crate) fn bounds_words(config: &Config) -> u64 {
    let extent = match (config.accept.needs_triangles(), config.has_buckets()) {
        (true, true) => 2,
        (true, false) => 1,
        (false, _) => 0,
    };
    extent + if config.has_ends() { 2 } else { 0 } + u64::from(config.has_conservative_lists())
}

/// Returns the words of the bounds of all blocks of cells.
fn pyramid_words(config: &Config) -> u64 {
    if config.march == March::Pyramid { Pyramid::words(&draws(config)) } else { 0 }
}

/// Returns the words of the boxes around objects.
fn box_words(config: &Config) -> u64 {
    if config.bounds == Bounds::Boxes { (ABUFFER_BOXES * ABUFFER_BOX_WORDS).into() } else { 0 }
}

/// Returns the number of boxes around `draws` draws: one each, or, if there is not room for so many, one for
/// several draws in a row.
pub(crate) fn box_count(draws: u32) -> u32 {
    draws.div_ceil(draws.div_ceil(ABUFFER_BOXES).max(1)).max(1)
}

/// Returns the words of the bounds of all cells and blocks, and of the boxes around objects.
pub(crate) fn bounds_and_blocks(config: &Config) -> u64 {
    cell_count(config) * bounds_words(config) + pyramid_words(config) + box_words(config)
}

/// Returns the contents of the scratch pool: the sums of the scan of contiguous lists, and the words that
/// binning and sorting use.
pub(crate) fn scratch(config: &Config) -> Scratch<Pool> {
    let lists = cell_count(config) * u64::from(config.lists());
    let sums = if config.storage == Storage::Sb { Scan::sums(lists) } else { 0 };
    Scratch { pool: Pool::Scratch, sums, builder: config.builder, sorts: true }
}

/// Returns the sizes of the pools of an A-buffer of this configuration for a demand.
///
/// # Errors
/// An option is out of range, or a pool has more elements than 32-bit links can address.
pub fn plan(config: &Config, demand: Demand) -> Result<Sizes, AdsError> {
    config.validate()?;
    let cells = cell_count(config);
    let lists = cells * u64::from(config.lists());
    let sizes = [
        (Pool::Bounds, bounds_and_blocks(config) + config.mark_sets() * demand.triangles.div_ceil(32), 4),
        (Pool::Lists, lists, 4 * list_words(config.storage)),
        (Pool::Nodes, demand.nodes, 4 * node_words(config)),
        (
            Pool::Data,
            demand.nodes,
            if config.inline { 0 } else { 4 * data_words(config) * node_slots(config) },
        ),
        (Pool::Near, demand.near_triangles, 4),
        (Pool::Scratch, scratch(config).words(demand.large, demand.long_lists), 4),
        (Pool::Conservative, if config.has_conservative_lists() { demand.conservative } else { 0 }, 12),
    ];
    let sizes = Sizes::of("abuffer", sizes)?;
    if config.storage == Storage::Paged { sizes.of_pages("abuffer", Pool::Nodes) } else { Ok(sizes) }
}

/// Returns the sizes for the first build, before anything has been counted: one fragment per cell, and one
/// triangle of a conservative list per four cells.
pub(crate) fn first_plan(config: &Config, triangles: u32) -> Result<Sizes, AdsError> {
    let cells = cell_count(config);
    let fragments = config.fragments.unwrap_or(cells);
    plan(
        config,
        Demand {
            nodes: fragments,
            near_triangles: 64,
            long_lists: 0,
            triangles: triangles.into(),
            conservative: cells / 4,
            large: 1024,
        },
    )
}

/// Bytes of an A-buffer by table 2 of the paper, for counted cells, buckets and fragments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaBytes {
    /// Bytes of cells: per cell `m_p` of the table. A single layer counts as one bucket; if the storage has
    /// no buckets, it adds 8 bytes per cell.
    pub cells: u64,
    /// Bytes of extents, with plane or slope acceptance: per cell an extent of 4, and a scale of 4 if there
    /// are buckets.
    pub plane: u64,
    /// Bytes of the pyramid, with [`March::Pyramid`]: 8 per block of cells, and 8 per cell if there are
    /// neither buckets nor a single layer.
    pub pyramid: u64,
    /// Bytes of fragments: per fragment `m_f` of the table, without the reference to the payload if it is
    /// inline, and a payload of 4 or 16. With paged storage: per page 4, and per slot 4 and the payload.
    pub fragments: u64,
    /// Bytes of conservative lists, with conservative and edge-on coverage: per cell 4, and per node
    /// 12; with edge-on coverage also 4 per 32 triangles.
    pub conservative: u64,
    /// Bytes of triangles that are kept for diagnostics ([`Config::ids`]): 4 per fragment, or per slot of a
    /// page.
    pub ids: u64,
    /// Bytes of all else: the header; 4 per triangle of the near-region list; the larger of 8 per long list
    /// and, with the binning builder, 4 per triangle with many cells of a view; 4 per 1024 cells for the scan
    /// of SB; 4 per 32 triangles for their marks; and 98,304 for boxes around objects.
    pub rest: u64,
}

impl FormulaBytes {
    /// Returns the sum of all parts.
    pub fn total(&self) -> u64 {
        self.cells + self.plane + self.pyramid + self.fragments + self.conservative + self.ids + self.rest
    }
}

/// Computes the bytes by the formula of `docs/systems/mmrt.md`. It follows the paper's table and shares no
/// code with [`plan`], so that the two check each other.
pub fn formula_bytes(config: &Config, demand: Demand) -> FormulaBytes {
    let side = u64::from(config.resolution + 2);
    let [columns, rows] = config.camera_cells().map(|side| u64::from(side) + 2);
    let cells = match config.views {
        Views::Cube => 6 * side * side,
        Views::CubeCamera => 6 * side * side + columns * rows,
        Views::Camera => columns * rows,
    };
    let buckets = if config.single_layer { 1 } else { u64::from(config.buckets) };
    let unbounded = matches!(config.storage, Storage::Sb | Storage::Ll | Storage::Dll);
    // Columns of table 2: bytes per cell, bytes per fragment, and bytes for the scale of buckets.
    let (per_cell, per_fragment, scale) = match config.storage {
        Storage::Sb => (8, if config.inline { 4 } else { 8 }, 0),
        Storage::Ll => (4, 8, 0),
        Storage::Dll => (8, 12, 0),
        Storage::Llb => (8 + 4 * buckets, 8, 4),
        Storage::Dllb => (8 + 8 * buckets, 12, 4),
        Storage::Paged => (8 + 4 * buckets, 4, 4),
    };
    let payload = if matches!(config.payload, Payload::Index | Payload::Normal) { 4 } else { 16 };
    let per_node = match config.storage {
        Storage::Paged => 4 + u64::from(config.page) * (per_fragment + payload),
        _ => per_fragment + payload,
    };
    let sums = if config.storage == Storage::Sb { cells.div_ceil(1024) } else { 0 };
    let blocks = |views: u64, mut side: u64| {
        let mut blocks = 0;
        while side > 1 {
            side = side.div_ceil(2);
            blocks += views * side * side;
        }
        blocks
    };
    let cube_blocks = if config.views == Views::Camera { 0 } else { blocks(6, side) };
    let camera_blocks = if config.views == Views::Cube { 0 } else { blocks(1, columns.max(rows)) };
    let bounded = if unbounded && !config.single_layer { cells } else { 0 };
    let single = if unbounded && config.single_layer { 8 * cells } else { 0 };
    let scale = if config.single_layer { 0 } else { scale };
    FormulaBytes {
        cells: cells * per_cell + single,
        pyramid: if config.march == March::Pyramid { 8 * (cube_blocks + camera_blocks + bounded) } else { 0 },
        plane: if matches!(config.accept, Accept::Slope | Accept::Plane) { cells * (4 + scale) } else { 0 },
        fragments: demand.nodes * per_node,
        conservative: match config.coverage {
            Coverage::Hardware | Coverage::Exact => 0,
            Coverage::Conservative => 4 * cells + 12 * demand.conservative,
            Coverage::EdgeOn => 4 * cells + 12 * demand.conservative + 4 * demand.triangles.div_ceil(32),
        },
        ids: if config.ids { 4 * demand.nodes * node_slots(config) } else { 0 },
        rest: 252
            + 4 * demand.near_triangles
            + (8 * demand.long_lists).max(if config.builder == Builder::Binning {
                4 * demand.large
            } else {
                0
            })
            + 4 * sums
            + 4 * demand.triangles.div_ceil(32)
            + if config.bounds == Bounds::Boxes { 98_304 } else { 0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEMAND: Demand =
        Demand { nodes: 12_345, near_triangles: 7, long_lists: 3, triangles: 0, conservative: 77, large: 55 };

    #[test]
    fn plan_equals_formula() {
        for storage in Storage::ALL {
            for (inline, buckets, accept, payload, march, single_layer) in [
                (false, 1, Accept::Interval, Payload::Attributes, March::Samples, false),
                (false, 2, Accept::Slope, Payload::Index, March::Pyramid, false),
                (false, 4, Accept::Plane, Payload::Index, March::Exact, false),
                (true, 4, Accept::Plane, Payload::Index, March::Pyramid, false),
                (true, 8, Accept::Interval, Payload::Attributes, March::Dda, false),
                (false, 32, Accept::Thickness, Payload::Index, March::Pyramid, false),
                (false, 3, Accept::Plane, Payload::Index, March::Pyramid, false),
                (false, 4, Accept::Interval, Payload::Normal, March::Samples, true),
                (true, 4, Accept::Plane, Payload::Plane, March::Exact, false),
                (false, 5, Accept::Plane, Payload::Plane, March::Pyramid, true),
            ] {
                let page = if inline { 8 } else { 2 };
                let views = Views::ALL[buckets as usize % 3];
                let kept = accept == Accept::Plane && march == March::Pyramid && !single_layer;
                let coverage = match (kept, buckets) {
                    (false, _) => Coverage::Exact,
                    (true, 3) => Coverage::EdgeOn,
                    (true, _) => Coverage::Conservative,
                };
                let builder = Builder::ALL[buckets as usize % 2];
                let config = Config {
                    storage,
                    inline,
                    page,
                    buckets,
                    accept,
                    payload,
                    ids: payload != Payload::Index && buckets > 4,
                    march,
                    single_layer,
                    views,
                    coverage,
                    builder,
                    camera_resolution: [24, 15],
                    ..Config::at_centres(64)
                };
                let bytes = plan(&config, DEMAND).expect("options are in range").bytes();
                assert_eq!(bytes, formula_bytes(&config, DEMAND).total(), "{config:?}");
                let more = Demand { nodes: DEMAND.nodes + 1, ..DEMAND };
                assert_ne!(bytes, formula_bytes(&config, more).total(), "{config:?}");
                let more = Demand { conservative: DEMAND.conservative + 1, ..DEMAND };
                assert_eq!(kept, bytes != formula_bytes(&config, more).total(), "{config:?}");
                let boxes = Config { bounds: Bounds::Boxes, ..config };
                if let Ok(sizes) = plan(&boxes, DEMAND) {
                    assert_eq!(sizes.bytes(), bytes + 98_304, "{boxes:?}");
                    assert_eq!(sizes.bytes(), formula_bytes(&boxes, DEMAND).total(), "{boxes:?}");
                }
                let marked = Demand { triangles: 33, ..DEMAND };
                let bytes = plan(&config, marked).expect("options are in range").bytes();
                assert_eq!(bytes, formula_bytes(&config, marked).total(), "{config:?}");
            }
        }
    }

    /// Checks the bytes per cell with four buckets, and the bytes per fragment without the payload, both
    /// decoupled as in table 2 of the paper and inline. Only the S-buffer saves a word inline: the index of
    /// the payload.
    #[test]
    fn storages_have_the_papers_bytes() {
        let table = [
            (Storage::Sb, 8, 8, 4),
            (Storage::Ll, 4, 8, 8),
            (Storage::Dll, 8, 12, 12),
            (Storage::Llb, 8 + 4 * 4, 8, 8),
            (Storage::Dllb, 8 + 8 * 4, 12, 12),
        ];
        for (storage, per_cell, decoupled, inline) in table {
            for (per_fragment, inline) in [(decoupled, false), (inline, true)] {
                let config = Config { storage, inline, ..Config::published(64) };
                let sizes = plan(&config, DEMAND).expect("options are in range");
                let bytes = |names: [&str; 2]| {
                    let named = sizes.pools.iter().filter(|pool| names.contains(&pool.name));
                    named.map(|pool| pool.elements * pool.element_bytes).sum::<u64>()
                };
                let what = format!("{storage:?}, inline: {inline}");
                assert_eq!(bytes(["bounds", "lists"]), cell_count(&config) * per_cell, "{what}");
                assert_eq!(bytes(["nodes", "data"]), DEMAND.nodes * (per_fragment + 16), "{what}");
            }
        }
    }

    /// Checks the formula against table 1 of the paper: 720x480 and six faces of 480x480, four buckets and
    /// 2.4 M fragments with 16 bytes of payload take 128 MB. The formula per cell and fragment gives 130 MiB.
    #[test]
    fn formula_agrees_with_the_papers_table() {
        let config =
            Config { payload: Payload::Attributes, accept: Accept::Interval, ..Config::at_centres(480) };
        let formula = formula_bytes(&config, Demand { nodes: 2_400_000, ..Demand::default() });
        let per_cell = formula.cells / cell_count(&config);
        let total = (720 * 480 + 6 * 480 * 480) * per_cell + formula.fragments;
        let mebibytes = total as f64 / f64::from(1 << 20);
        assert!((mebibytes - 130.0).abs() < 0.5, "{mebibytes} MiB");
    }

    /// Checks that no draw is left without a box, and that there are no more boxes than there is room for.
    #[test]
    fn draws_share_boxes() {
        for (draws, boxes) in [(0, 1), (1, 1), (17, 17), (4096, 4096), (4097, 2049), (10_000, 3334)] {
            assert_eq!(box_count(draws), boxes, "{draws} draws");
        }
        assert!(box_count(u32::MAX) <= ABUFFER_BOXES);
    }

    #[test]
    fn boxes_that_give_no_bounds_are_refused() {
        let dllb = Config { bounds: Bounds::Boxes, ..Config::at_centres(64) };
        assert!(dllb.validate().is_ok());
        let refused = [
            (Config { storage: Storage::Ll, ..dllb }, "storage `llb`"),
            (Config { storage: Storage::Sb, ..dllb }, "storage `llb`"),
            (Config { single_layer: true, ..dllb }, "all layers"),
            (Config { builder: Builder::Binning, ..dllb }, "builder `raster`"),
            (Config { coverage: Coverage::Hardware, ..dllb }, "coverage `exact`"),
        ];
        for (config, fix) in refused {
            let message = config.validate().expect_err("refused").to_string();
            assert!(message.contains("bounds is boxes") && message.contains(fix), "{message}");
        }
    }

    #[test]
    fn out_of_range_options_are_named() {
        let message = |config: &Config, demand| plan(config, demand).expect_err("it is refused").to_string();
        let config = Config { buckets: 33, ..Config::at_centres(64) };
        assert!(message(&config, Demand::default()).contains("buckets is 33"));
        let config = Config { resolution: 0, ..Config::at_centres(64) };
        assert!(message(&config, Demand::default()).contains("resolution is 0"));
        let many = Demand { nodes: 1 << 32, ..Demand::default() };
        assert!(message(&Config::at_centres(64), many).contains("nodes"));
        let config = Config { storage: Storage::Paged, page: 3, ..Config::at_centres(64) };
        assert!(message(&config, Demand::default()).contains("page is 3"));
        let config = Config { page: 1, ..config };
        let many = Demand { nodes: 1 << 28, ..Demand::default() };
        assert!(message(&config, many).contains("nodes"));
    }
}
