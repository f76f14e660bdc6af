//! Options of primitive lists and the presets.

use rasray_ads::{Addressing, AdsError, Builder, Counters, Geometry};
use rasray_shaders_glsl::constants::primitive as numbers;

use crate::views::cells_along;
use crate::{Accept, Coverage, Depths, March, Stop, Views};

/// Cells a side of a brick.
pub(crate) const BRICK_SIDE: u32 = 4;
/// Most tiles a side of a face of bricks, and most cells along an axis.
pub(crate) const SIDE_LIMIT: u32 = numbers::PRIMITIVE_BRICK_SIDE_LIMIT;
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

/// Where the faces of the cube meet. Changes no hit where [`Config::is_exact`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Centre {
    /// At the eye, as in the paper.
    Eye,
    /// At the eye within the geometry's bounds, or where those are flat; for an eye outside of them, at the
    /// nearest point well within.
    Scene,
}

/// Everything that may be chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Pixels a side of each face, 1 to 8192. Changes no hit where [`Config::is_exact`].
    pub resolution: u32,
    /// Pixels a side of a tile, 1 to 64: lists are kept per tile. Changes no hit where [`Config::is_exact`].
    pub tile: u32,
    /// Depth buckets a tile, 1 to 64; bricks have slices instead. Changes no hit where [`Config::is_exact`].
    pub buckets: u32,
    /// Bricks only: depth slices, the same for all tiles, at most 1024, made up to a multiple of 4; twice the tiles of
    /// a side where absent. Changes no hit.
    pub slices: Option<u32>,
    /// Bricks only: keep the corners of triangles once more, one behind the other, 36 bytes each. Changes no hit.
    pub corners: bool,
    /// How lists are kept.
    pub storage: Storage,
    /// What is seen where. Resolution, tile, slices and centre are those of [`Views::Cube`].
    pub views: Views,
    /// [`Views::Axes`] only: cells along the longest side of the geometry's bounds, 1 to 1024, made up to a
    /// multiple of 4; where absent, as many as make a cell about as wide as a triangle. Changes no hit.
    pub grid: Option<u32>,
    /// Where the faces meet.
    pub centre: Centre,
    /// Who puts triangles into cells; absent: the rasterizer for lists, a compute pass for bricks. Changes no hit.
    pub builder: Option<Builder>,
    /// Lists only, with [`Config::skip`]: depth bounds of blocks of tiles, over which a ray leaps. Changes no hit where
    /// [`Config::is_exact`].
    pub pyramid: bool,
    /// Which tiles list a triangle.
    pub coverage: Coverage,
    /// When a triangle that a ray meets is a hit.
    pub accept: Accept,
    /// Where the search of a tile ends.
    pub stop: Stop,
    /// What the depths of a triangle in a tile are.
    pub depths: Depths,
    /// How a ray goes on from a tile.
    pub march: March,
    /// Skip tiles and buckets that the ray's depths cannot meet, or empty bricks. Changes no hit where
    /// [`Config::is_exact`].
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
            views: Views::Cube,
            grid: None,
            centre: Centre::Scene,
            builder: None,
            pyramid: false,
            coverage: Coverage::Conservative,
            accept: Accept::T,
            stop: Stop::Best,
            depths: Depths::Clipped,
            march: March::Exact,
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

    /// The paper's structure: linked lists, 20 buckets, and its rules, by which hits are lost.
    pub fn published(resolution: u32) -> Self {
        Self {
            buckets: 20,
            storage: Storage::Linked,
            centre: Centre::Eye,
            pyramid: true,
            accept: Accept::Tile,
            stop: Stop::Bucket,
            depths: Depths::Corners,
            march: March::Jump,
            ..Self::robust(resolution)
        }
    }

    /// Whether every hit is that of brute force: no rule of the paper that loses some is chosen.
    pub fn is_exact(&self) -> bool {
        self.lossy_rule().is_none()
    }

    /// The first rule that loses hits, as option and value.
    fn lossy_rule(&self) -> Option<(&'static str, &'static str)> {
        let robust = Self::robust(1);
        [
            (self.accept == robust.accept, ("accept", "tile")),
            (self.stop == robust.stop, ("stop", "bucket")),
            (self.depths == robust.depths, ("depths", "corners")),
            (self.march == robust.march, ("march", "jump")),
            (self.coverage == robust.coverage, ("coverage", "hardware")),
        ]
        .into_iter()
        .find_map(|(kept, rule)| (!kept).then_some(rule))
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

    /// Columns, rows and slices of each view of bricks over a geometry.
    pub fn cells(&self, geometry: &Geometry) -> [u32; 3] {
        match self.views {
            Views::Cube => [self.tiles(), self.tiles(), self.slices()],
            Views::Axes => cells_along(geometry.bounds(), geometry.triangle_count(), self.grid),
        }
    }

    /// How many views there are.
    pub(crate) fn view_count(&self) -> u32 {
        match self.views {
            Views::Cube => 6,
            Views::Axes => 1,
        }
    }

    /// Who puts triangles into cells.
    pub fn builder(&self) -> Builder {
        let usual = if self.storage == Storage::Bricks { Builder::Binning } else { Builder::Raster };
        self.builder.unwrap_or(usual)
    }

    /// Whether there are blocks of cells.
    pub(crate) fn has_pyramid(&self) -> bool {
        self.pyramid && self.skip && self.storage != Storage::Bricks
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
            if let Some((option, value)) = self.lossy_rule() {
                let expected = "bricks lose no hit, so they follow no such rule: take storage sb or llb";
                return Err(AdsError::Option { option, value: value.to_owned(), expected });
            }
        }
        range("grid", self.grid.unwrap_or(1), 1, SIDE_LIMIT, "1 to 1024 cells along the longest side")?;
        let refused = |option, value: String, expected| Err(AdsError::Option { option, value, expected });
        match (self.views, self.storage, self.grid, self.slices) {
            (Views::Cube, _, Some(grid), _) => {
                return refused(
                    "grid",
                    grid.to_string(),
                    "the faces of a cube have a resolution: take views axes",
                );
            }
            (Views::Axes, Storage::Linked | Storage::Contiguous, ..) => {
                return refused(
                    "views",
                    "axes".to_owned(),
                    "lists are those of a cube's faces: take storage bricks",
                );
            }
            (Views::Axes, _, _, Some(slices)) => {
                return refused(
                    "slices",
                    slices.to_string(),
                    "views along axes have cells of one size: take grid",
                );
            }
            _ => {}
        }
        if self.coverage == Coverage::Hardware && self.builder() == Builder::Binning {
            let expected = "the binning builder does not draw: take builder raster";
            return Err(AdsError::Option { option: "coverage", value: "hardware".to_owned(), expected });
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
            Coverage::Conservative => numbers::PRIMITIVE_COVERAGE_CONSERVATIVE,
        };
        let accept = match self.accept {
            Accept::T => numbers::PRIMITIVE_ACCEPT_T,
            Accept::Tile => numbers::PRIMITIVE_ACCEPT_TILE,
        };
        let stop = match self.stop {
            Stop::Best => numbers::PRIMITIVE_STOP_BEST,
            Stop::Bucket => numbers::PRIMITIVE_STOP_BUCKET,
        };
        let depths = match self.depths {
            Depths::Clipped => numbers::PRIMITIVE_DEPTHS_CLIPPED,
            Depths::Corners => numbers::PRIMITIVE_DEPTHS_CORNERS,
        };
        let march = match self.march {
            March::Exact => numbers::PRIMITIVE_MARCH_EXACT,
            March::Jump => numbers::PRIMITIVE_MARCH_JUMP,
        };
        let corners = u32::from(self.keeps_corners());
        let skip = u32::from(self.skip);
        let pyramid = u32::from(self.has_pyramid());
        let views = match self.views {
            Views::Cube => numbers::PRIMITIVE_VIEWS_CUBE,
            Views::Axes => numbers::PRIMITIVE_VIEWS_AXES,
        };
        [self.buckets, storage, coverage, skip, corners, accept, stop, depths, march, pyramid, views]
            .into_iter()
            .zip(30..)
            .map(|(value, id)| (id, value))
            .collect()
    }

    /// Options as name and value, for reports; `cells` are those of a view of bricks.
    pub fn options(&self, cells: [u32; 3]) -> Vec<(&'static str, String)> {
        let storage = match self.storage {
            Storage::Linked => "llb",
            Storage::Contiguous => "sb",
            Storage::Bricks => "bricks",
        };
        let switch = |on| if on { "on" } else { "off" }.to_owned();
        let mut options = vec![("storage", storage.to_owned()), ("views", self.views.name().to_owned())];
        if self.views == Views::Axes {
            options.push(("grid", cells.map(|n| n.to_string()).join("x")));
            options.extend([("corners", switch(self.corners)), ("skip", switch(self.skip))]);
            return options;
        }
        options.extend([("resolution", self.resolution.to_string()), ("tile", self.tile.to_string())]);
        if self.storage == Storage::Bricks {
            options.push(("slices", self.slices().to_string()));
            options.push(("corners", switch(self.corners)));
        } else {
            let lower = |rule: &dyn std::fmt::Debug| format!("{rule:?}").to_lowercase();
            options.extend([
                ("buckets", self.buckets.to_string()),
                ("pyramid", switch(self.has_pyramid())),
                ("coverage", lower(&self.coverage)),
                ("accept", lower(&self.accept)),
                ("stop", lower(&self.stop)),
                ("depths", lower(&self.depths)),
                ("march", lower(&self.march)),
            ]);
        }
        let centre = format!("{:?}", self.centre).to_lowercase();
        options.extend([("skip", switch(self.skip)), ("centre", centre)]);
        options
    }

    /// Paths as name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        vec![("builder", self.builder().name().to_owned()), ("addressing", self.addressing.name().to_owned())]
    }
}
