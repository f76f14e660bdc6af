//! Options of the layered depth cube, and its two presets.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::words;
use rasray_ads::{Addressing, AdsError, Builder, Counters, Ends};
use rasray_shaders_glsl::constant_ids::ldc as ids;
use rasray_shaders_glsl::constants::ldc as numbers;

/// Condition under which a ray hits a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accept {
    /// The fragment's depth is within [`Config::tolerance`] of the depths that the ray has in its cell.
    Tolerance,
    /// The fragment's depth is within a tolerance that follows the slope of its triangle: half of the
    /// triangle's rise over the cell.
    Slope,
    /// The ray intersects the plane of the fragment's triangle within the cell.
    Plane,
    /// The ray intersects the fragment's triangle, at any point. Needs [`Coverage::Conservative`]: the list
    /// of every cell then holds all triangles that reach into the cell, and hits are those of brute force.
    Triangle,
}

words! { Accept { Tolerance "tolerance", Slope "slope", Plane "plane", Triangle "triangle" } }

/// Cells in which a triangle gets a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// Cells whose centre the rasterizer covers, with its sub-pixel grid.
    Hardware,
    /// Cells whose centre the triangle covers by a watertight test; the rasterizer only proposes cells.
    Exact,
    /// Cells of [`Coverage::Exact`]. Conservative lists keep the triangle in other cells that it reaches
    /// into, where no fragment represents it, and hits on the triangle itself count there. With
    /// [`Accept::Triangle`] the triangle has a fragment in all cells that it reaches into.
    Conservative,
}

words! { Coverage { Hardware "hardware", Exact "exact", Conservative "conservative" } }

/// Format of the depth of a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// Half-precision float, as a share of the cube's side: 2 bytes.
    Bits16,
    /// Single-precision float, in metres: 4 bytes.
    Bits32,
}

words! { Depth { Bits16 "16", Bits32 "32" } }

/// Summary of the depths in a block of cells. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occupancy {
    /// Smallest and largest depth: 8 bytes.
    Bounds,
    /// Smallest and largest depth, and a mask of the slices that hold something, of 64 over the cube's depth:
    /// 16 bytes.
    Slices,
}

words! { Occupancy { Bounds "bounds", Slices "slices" } }

/// Method of making layers. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Making {
    /// All layers in one pass, which are sorted afterwards.
    Single,
    /// One layer after the other by peeling, as in the paper, with two draws per layer.
    Peel,
}

words! { Making { Single "single", Peel "peel" } }

/// Data that a fragment carries in addition to its depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Payload {
    /// Triangle id, 4 bytes. Surfaces come from the posed triangle.
    Index,
    /// Colour and opacity 8:8:8:8 and normal 16:16, 8 bytes, read from a scene. Surfaces take these values,
    /// and defaults for all else. Needs [`Accept::Tolerance`], since the other conditions read the triangle.
    Attributes,
}

words! { Payload { Index "index", Attributes "attributes" } }

/// Options of a layered depth cube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Cells along a side of each view, 1 to 8192.
    pub resolution: u32,
    /// Columns and rows of cells in a block, powers of two up to 64. Changes no hit.
    pub block: [u32; 2],
    /// Levels of blocks, 1 or 2; a block of the second level holds 8 x 8 blocks of the first. Changes no hit.
    pub levels: u32,
    /// Summary of the depths in a block of cells. Changes no hit.
    pub occupancy: Occupancy,
    /// Method of making layers. Changes no hit.
    pub making: Making,
    /// Maximum number of peeled layers, 1 to 1024; used only by [`Making::Peel`]. A cell with more fragments
    /// is an error.
    pub layers: u32,
    /// Condition under which a ray hits a fragment.
    pub accept: Accept,
    /// Tolerance of depths, as a share of the cube's side, 0 to 1; used only by [`Accept::Tolerance`].
    pub tolerance: f32,
    /// Rule for hits at the ends of rays: whether rays hit the surfaces they leave and end on. Used only by
    /// [`Accept::Tolerance`] and [`Accept::Slope`].
    pub ends: Ends,
    /// Cells in which a triangle gets a fragment.
    pub coverage: Coverage,
    /// Builder that bins triangles into cells. [`Making::Peel`] draws its layers with any builder. Changes no
    /// hit.
    pub builder: Builder,
    /// Number of times that a pass of the build draws the scene, 1 or 3. With 1 the vertex stage chooses the
    /// view of each triangle. With 3 each view has a draw and keeps its own triangles; needs
    /// [`Builder::Raster`]. Changes no hit.
    pub passes: u32,
    /// Format of depths.
    pub depth: Depth,
    /// Data that a fragment carries. Hits that do not name their triangle have `PRIMITIVE_UNKNOWN`, and rays
    /// cannot exclude them.
    pub payload: Payload,
    /// Switch for diagnostics: keeps the triangle of each fragment behind [`Payload::Attributes`]. Hits then
    /// name the triangle, and nothing else follows: rays do not exclude it, and surfaces stay those of the
    /// payload. Changes no t.
    pub ids: bool,
    /// Switch for skipping blocks and parts of lists that the ray's depths cannot overlap. Changes no hit.
    pub skip: bool,
    /// Addressing of pools: descriptors or device addresses. Changes no hit.
    pub addressing: Addressing,
    /// Number of fragments to allocate for the first build. If absent, the resolution gives a guess.
    pub fragments: Option<u64>,
    /// Detail in which rays record their work. Changes no hit.
    pub counters: Counters,
    /// Work units that a ray may spend in one dispatch. If absent, the default that all structures share.
    /// Changes no hit.
    pub work_budget: Option<u32>,
}

rasray_ads::configured!(Config);

impl Config {
    /// Returns the options of the repaired structure: triangles are in every cell that they reach into, so
    /// that hits are those of brute force.
    pub fn robust(resolution: u32) -> Self {
        Self {
            resolution,
            block: [8; 2],
            levels: 2,
            occupancy: Occupancy::Slices,
            making: Making::Single,
            layers: 256,
            accept: Accept::Triangle,
            tolerance: 0.001,
            ends: Ends::Clear,
            coverage: Coverage::Conservative,
            builder: Builder::Raster,
            passes: 1,
            depth: Depth::Bits32,
            payload: Payload::Index,
            ids: false,
            skip: true,
            addressing: Addressing::Descriptor,
            fragments: None,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// Returns the paper's approximations: a tolerance of a thousandth, 16-bit depths, colour and normal in
    /// each fragment, the rasterizer's own coverage, and one level of blocks with their smallest and largest
    /// depth.
    pub fn published(resolution: u32) -> Self {
        Self {
            levels: 1,
            occupancy: Occupancy::Bounds,
            accept: Accept::Tolerance,
            coverage: Coverage::Hardware,
            depth: Depth::Bits16,
            payload: Payload::Attributes,
            ..Self::robust(resolution)
        }
    }

    /// Checks the ranges of all options and their combinations.
    ///
    /// # Errors
    /// The first option that is out of range, or the first combination that is not possible.
    pub fn validate(&self) -> Result<(), AdsError> {
        let refused = |option, value: String, expected| Err(AdsError::Option { option, value, expected });
        check_range("resolution", self.resolution, 1..=8192, "1 to 8192 cells along a side")?;
        if self.block.iter().any(|side| !(1..=64).contains(side) || !side.is_power_of_two()) {
            return refused("block", self.block_name(), "1, 2, 4, 8, 16, 32 or 64 columns and rows of cells");
        }
        check_range("levels", self.levels, 1..=2, "1 or 2 levels of blocks")?;
        check_range("layers", self.layers, 1..=1024, "1 to 1024 layers")?;
        if !(0.0..=1.0).contains(&self.tolerance) {
            return refused("tolerance", self.tolerance.to_string(), "a share of the cube's side, 0 to 1");
        }
        if self.payload == Payload::Attributes && self.accept != Accept::Tolerance {
            return refused(
                "accept",
                self.accept.name().to_owned(),
                "the acceptances triangle, plane and slope need the payload `index`, which identifies the triangle",
            );
        }
        if self.accept == Accept::Triangle && self.coverage != Coverage::Conservative {
            let expected = "triangles alone are hit only where cells keep all that reaches into them: use the coverage \
                            `conservative`, or accept `plane`";
            return refused("accept", "triangle".to_owned(), expected);
        }
        if self.ids && self.payload == Payload::Index {
            let expected = "the payload `index` identifies triangles already: leave it off";
            return refused("ids", "on".to_owned(), expected);
        }
        if self.builder == Builder::Binning
            && (self.coverage == Coverage::Hardware || self.making == Making::Peel)
        {
            let expected = "coverage `hardware` and peeled layers need builder `raster`: the binning builder does not draw";
            return refused("builder", self.builder.name().to_owned(), expected);
        }
        if ![1, 3].contains(&self.passes) {
            return refused("geometry-passes", self.passes.to_string(), "1, or 3 for one of each view");
        }
        if self.passes == 3 && self.builder == Builder::Binning {
            let expected = "the binning builder visits each triangle once and draws nothing: leave it at 1";
            return refused("geometry-passes", self.passes.to_string(), expected);
        }
        check_work_budget(self.work_budget, true)
    }

    /// Returns true if a hit may lie before or behind the surface, so that [`Config::ends`] matters.
    fn has_ends(&self) -> bool {
        matches!(self.accept, Accept::Tolerance | Accept::Slope)
    }

    /// Returns true if triangles are kept in conservative lists beside the lists of fragments. With
    /// [`Accept::Triangle`] the lists of fragments hold all triangles.
    pub(crate) fn has_conservative_lists(&self) -> bool {
        self.coverage == Coverage::Conservative && self.accept != Accept::Triangle
    }

    /// Returns the bytes of a fragment's payload, plus the triangle that is kept for diagnostics.
    pub(crate) fn payload_bytes(&self) -> u64 {
        let payload = match self.payload {
            Payload::Index => 4,
            Payload::Attributes => 8,
        };
        payload + if self.ids { 4 } else { 0 }
    }

    /// Returns the specialisation constants, as pairs of id and bits.
    pub(crate) fn constants(&self) -> Vec<(u32, u32)> {
        let accept = match self.accept {
            Accept::Tolerance => numbers::LDC_ACCEPT_TOLERANCE,
            Accept::Slope => numbers::LDC_ACCEPT_SLOPE,
            Accept::Plane => numbers::LDC_ACCEPT_PLANE,
            Accept::Triangle => numbers::LDC_ACCEPT_TRIANGLE,
        };
        let coverage = match self.coverage {
            Coverage::Hardware => numbers::LDC_COVERAGE_HARDWARE,
            Coverage::Exact => numbers::LDC_COVERAGE_EXACT,
            Coverage::Conservative => numbers::LDC_COVERAGE_CONSERVATIVE,
        };
        let occupancy = match self.occupancy {
            Occupancy::Bounds => numbers::LDC_OCCUPANCY_BOUNDS,
            Occupancy::Slices => numbers::LDC_OCCUPANCY_SLICES,
        };
        let making = match self.making {
            Making::Single => numbers::LDC_BUILD_SINGLE,
            Making::Peel => numbers::LDC_BUILD_PEEL,
        };
        let payload = match self.payload {
            Payload::Index => numbers::LDC_PAYLOAD_INDEX,
            Payload::Attributes => numbers::LDC_PAYLOAD_ATTRIBUTES,
        };
        let ends = if self.has_ends() { self.ends } else { Ends::Touching };
        vec![
            (ids::LDC_ACCEPT, accept),
            (ids::LDC_ENDS, ends.number()),
            (ids::LDC_COVERAGE, coverage),
            (ids::LDC_DEPTH_BITS, self.depth.bits()),
            (ids::LDC_SKIP, u32::from(self.skip)),
            (ids::LDC_BLOCK_COLUMNS, self.block[0]),
            (ids::LDC_BLOCK_ROWS, self.block[1]),
            (ids::LDC_OCCUPANCY, occupancy),
            (ids::LDC_LEVELS, self.levels),
            (ids::LDC_BUILD, making),
            (ids::LDC_PAYLOAD, payload),
            (ids::LDC_IDS, u32::from(self.ids)),
            (ids::LDC_PASSES, self.passes),
        ]
    }

    /// Returns the size of a block in cells, as one number if it has as many columns as rows.
    fn block_name(&self) -> String {
        let [columns, rows] = self.block;
        if columns == rows { columns.to_string() } else { format!("{columns}x{rows}") }
    }

    /// Returns the options as pairs of name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        let mut options = vec![
            ("storage", "sb".to_owned()),
            ("resolution", self.resolution.to_string()),
            ("block", self.block_name()),
            ("levels", self.levels.to_string()),
            ("occupancy", self.occupancy.name().to_owned()),
            ("build", self.making.name().to_owned()),
            ("accept", self.accept.name().to_owned()),
            ("depth", self.depth.bits().to_string()),
            ("payload", self.payload.name().to_owned()),
            ("views", "axes".to_owned()),
            ("skip", if self.skip { "on" } else { "off" }.to_owned()),
        ];
        if self.payload == Payload::Attributes {
            options.push(("ids", if self.ids { "on" } else { "off" }.to_owned()));
        }
        if self.accept == Accept::Tolerance {
            options.push(("tolerance", self.tolerance.to_string()));
        }
        if self.has_ends() {
            options.push(("ends", self.ends.name().to_owned()));
        }
        if self.making == Making::Peel {
            options.push(("layers", self.layers.to_string()));
        }
        options
    }

    /// Returns the chosen code paths as pairs of name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        vec![
            ("builder", self.builder.name().to_owned()),
            ("geometry-passes", self.passes.to_string()),
            ("coverage", self.coverage.name().to_owned()),
            ("addressing", self.addressing.name().to_owned()),
        ]
    }
}

impl Depth {
    /// Returns the number of bits of a depth.
    pub fn bits(self) -> u32 {
        match self {
            Self::Bits16 => 16,
            Self::Bits32 => 32,
        }
    }
}
