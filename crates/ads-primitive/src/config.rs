//! Options of primitive lists and the presets.

use rasray_ads::{Addressing, AdsError, Counters};
use rasray_shaders_glsl::constants::primitive as numbers;

/// Cells a side of a brick.
const BRICK_SIDE: u32 = 4;
/// Most tiles a side of a face of bricks.
const SIDE_LIMIT: u32 = numbers::PRIMITIVE_BRICK_SIDE_LIMIT;
/// Most slices.
const SLICE_LIMIT: u32 = numbers::PRIMITIVE_BRICK_SLICE_LIMIT;

/// How the lists of a cell are kept. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Linked nodes of triangle and next, as in the paper: 8 bytes an entry, one geometry pass less.
    Linked,
    /// Triangles one behind the other, by counting first: 4 bytes an entry.
    Contiguous,
    /// Contiguous lists of cells that are tiles cut into depth slices, in bricks of 4x4x4 with a mask: empty space is
    /// crossed by many bricks at a time.
    Bricks,
}

/// Which cells list a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// Those whose centre the rasterizer covers: rays that pass a listed triangle's neighbour are lost.
    Hardware,
    /// All that the triangle reaches into, decided by a shared function; the rasterizer only proposes.
    Exact,
}

/// Everything that may be chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Pixels a side of each face, 1 to 8192. Changes no hit with [`Coverage::Exact`].
    pub resolution: u32,
    /// Pixels a side of a tile, 1 to 64: lists are kept per tile. Changes no hit with [`Coverage::Exact`].
    pub tile: u32,
    /// Depth buckets a tile, 1 to 64; bricks have slices instead. Changes no hit.
    pub buckets: u32,
    /// Bricks only: depth slices, the same for all tiles, at most 1024, made up to a multiple of 4; twice the tiles of
    /// a side where absent. Changes no hit.
    pub slices: Option<u32>,
    /// Bricks only: keep the corners of triangles once more, one behind the other, 36 bytes each. Changes no hit.
    pub corners: bool,
    /// How lists are kept.
    pub storage: Storage,
    /// Which tiles list a triangle.
    pub coverage: Coverage,
    /// Skip tiles and buckets that the ray's depths cannot meet, or empty bricks. Changes no hit.
    pub skip: bool,
    /// How pools are reached.
    pub addressing: Addressing,
    /// Entries to make room for before the first build; a guess from the cells where absent.
    pub entries: Option<u64>,
    /// How much of their work rays record. Changes no hit.
    pub counters: Counters,
    /// Work units a ray may spend in one dispatch; the shared default where absent. Changes no hit.
    pub work_budget: Option<u32>,
}

impl Config {
    /// The exact structure: every tile lists what reaches into it, and every hit is that of brute force.
    pub fn robust(resolution: u32) -> Self {
        Self {
            resolution,
            tile: 2,
            buckets: 16,
            slices: None,
            corners: true,
            storage: Storage::Bricks,
            coverage: Coverage::Exact,
            skip: true,
            addressing: Addressing::Descriptor,
            entries: None,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// The same with as many pixels a side as suit that many triangles: bricks whose tiles are about as wide as a
    /// triangle is seen, a power of two from 32 to 256.
    pub fn robust_for(triangles: u32) -> Self {
        let wanted = f64::from(triangles).sqrt() / 4.0;
        // Of two powers of two the nearer by ratio.
        let tiles = 2.0_f64.powf(wanted.max(1.0).log2().round()).clamp(32.0, 256.0) as u32;
        let unit = Self::robust(1);
        Self::robust(tiles * unit.tile)
    }

    /// Tiles a side of a face: the cells of the march. A last tile may reach beyond the face's pixels. Bricks have a
    /// multiple of 4.
    pub fn tiles(&self) -> u32 {
        let tiles = self.resolution.div_ceil(self.tile.max(1));
        if self.storage == Storage::Bricks { tiles.next_multiple_of(BRICK_SIDE) } else { tiles }
    }

    /// Depth slices of bricks; 0 for lists.
    pub fn slices(&self) -> u32 {
        let slices = || self.slices.unwrap_or_else(|| (2 * self.tiles()).min(SLICE_LIMIT));
        if self.storage == Storage::Bricks { slices().next_multiple_of(BRICK_SIDE) } else { 0 }
    }

    /// Whether triangles' corners are kept once more.
    pub(crate) fn keeps_corners(&self) -> bool {
        self.corners && self.storage == Storage::Bricks
    }

    /// Checks ranges.
    ///
    /// # Errors
    /// The first option out of range.
    pub fn validate(&self) -> Result<(), AdsError> {
        let range = |option, value: u32, lowest, highest, expected| {
            if (lowest..=highest).contains(&value) {
                Ok(())
            } else {
                Err(AdsError::Option { option, value: value.to_string(), expected })
            }
        };
        range("resolution", self.resolution, 1, 8192, "1 to 8192 pixels a side")?;
        range("tile", self.tile, 1, 64, "1 to 64 pixels a side")?;
        range("buckets", self.buckets, 1, 64, "1 to 64 buckets a tile")?;
        range("slices", self.slices.unwrap_or(1), 1, SLICE_LIMIT, "1 to 1024 depth slices")?;
        if self.storage == Storage::Bricks {
            let expected = "bricks have at most 1024 tiles a side: raise the tile or lower the resolution";
            range("tiles a side", self.tiles(), 1, SIDE_LIMIT, expected)?;
            if self.coverage == Coverage::Hardware {
                let expected = "bricks are filled by computing, which is exact: take storage sb or llb";
                return Err(AdsError::Option { option: "coverage", value: "hardware".to_owned(), expected });
            }
        }
        let budget = self.work_budget.unwrap_or(u32::MAX);
        range("work budget", budget, 1, u32::MAX, "1 unit or more a dispatch, or rays make no progress")
    }

    /// Specialisation constants: id and bits.
    pub(crate) fn constants(&self) -> Vec<(u32, u32)> {
        let storage = match self.storage {
            Storage::Linked => numbers::PRIMITIVE_STORAGE_LINKED,
            Storage::Contiguous => numbers::PRIMITIVE_STORAGE_CONTIGUOUS,
            Storage::Bricks => numbers::PRIMITIVE_STORAGE_BRICKS,
        };
        let coverage = match self.coverage {
            Coverage::Hardware => numbers::PRIMITIVE_COVERAGE_HARDWARE,
            Coverage::Exact => numbers::PRIMITIVE_COVERAGE_EXACT,
        };
        let corners = u32::from(self.keeps_corners());
        vec![(30, self.buckets), (31, storage), (32, coverage), (33, u32::from(self.skip)), (34, corners)]
    }

    /// Options as name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        let storage = match self.storage {
            Storage::Linked => "llb",
            Storage::Contiguous => "sb",
            Storage::Bricks => "bricks",
        };
        let switch = |on| if on { "on" } else { "off" }.to_owned();
        let mut options = vec![
            ("storage", storage.to_owned()),
            ("resolution", self.resolution.to_string()),
            ("tile", self.tile.to_string()),
        ];
        if self.storage == Storage::Bricks {
            options.push(("slices", self.slices().to_string()));
            options.push(("corners", switch(self.corners)));
        } else {
            options.push(("buckets", self.buckets.to_string()));
        }
        options.extend([("skip", switch(self.skip)), ("views", "cube".to_owned())]);
        options
    }

    /// Paths as name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        let lower = |value: &dyn std::fmt::Debug| format!("{value:?}").to_lowercase();
        vec![
            ("builder", if self.storage == Storage::Bricks { "binning" } else { "raster" }.to_owned()),
            ("coverage", lower(&self.coverage)),
            ("addressing", self.addressing.name().to_owned()),
        ]
    }
}
