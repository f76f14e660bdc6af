//! Options of bricks.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::{Addressing, AdsError, Builder, Counters, GeometryExtent};
use rasray_shaders_glsl::constant_ids::bricks as ids;
use rasray_shaders_glsl::constants::bricks as numbers;

use crate::grid::{BRICK_SIDE, SIDE_LIMIT, Views, cells_along, columns_for};

/// Maximum number of times that a cell can be divided.
const DEPTH_LIMIT: u32 = numbers::BRICKS_DEPTH_MOST;
/// Maximum number of depth slices.
const SLICE_LIMIT: u32 = numbers::BRICKS_SLICE_LIMIT;

/// Options of bricks. None of them changes a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Projections in which cells are made.
    pub views: Views,
    /// Number of columns along a side of a face, or of cells along the longest side of the geometry's bounds;
    /// 1 to 1024, rounded up to a multiple of 4. If absent, the number follows from the number of triangles
    /// and, along the axes, from the bounds.
    pub grid: Option<u32>,
    /// Maximum number of times that a cell with many small triangles is divided into 4x4x4 smaller cells; 0
    /// to 3. If absent, 3 for [`Views::Axes`], and 0 for [`Views::Cube`], which cannot divide cells.
    pub divisions: Option<u32>,
    /// Number of depth slices, equal for all columns, 1 to 1024, rounded up to a multiple of 4;
    /// [`Views::Cube`] only. If absent, twice the columns along a side.
    pub slices: Option<u32>,
    /// Switch for a contiguous copy of the corners of triangles: 36 bytes per triangle instead of 24.
    pub corners: bool,
    /// Switch for distances: the build finds how far around each empty brick everything is empty, so that a
    /// ray crosses this space in one step.
    pub skip: bool,
    /// Builder that bins triangles into cells.
    pub builder: Builder,
    /// Addressing of pools: descriptors or device addresses.
    pub addressing: Addressing,
    /// Number of entries to allocate for the first build; if absent, 16 per triangle.
    pub entries: Option<u64>,
    /// Counters that rays record of their work.
    pub counters: Counters,
    /// Work units that a ray may spend in one dispatch. If absent, the default that all structures share.
    pub work_budget: Option<u32>,
}

rasray_ads::configured!(Config);

impl Config {
    /// Returns the options of bricks in these views, with everything that makes them fast.
    pub fn new(views: Views) -> Self {
        Self {
            views,
            grid: None,
            divisions: None,
            slices: None,
            corners: true,
            skip: true,
            builder: Builder::Binning,
            addressing: Addressing::Descriptor,
            entries: None,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// Returns the columns, rows and slices of each view over a geometry, multiples of 4.
    pub fn cells(&self, extent: &GeometryExtent) -> [u32; 3] {
        match self.views {
            Views::Cube => self.cells_of_faces(extent.triangle_count),
            Views::Axes => cells_along(extent.bounds, extent.triangle_count, self.grid),
        }
    }

    /// Returns the columns, rows and slices of the faces of a cube, which depend only on the number of
    /// triangles.
    fn cells_of_faces(&self, triangles: u32) -> [u32; 3] {
        let columns = self.grid.unwrap_or_else(|| columns_for(triangles)).next_multiple_of(BRICK_SIDE);
        let slices = self.slices.unwrap_or_else(|| (2 * columns).min(SLICE_LIMIT));
        [columns, columns, slices.next_multiple_of(BRICK_SIDE)]
    }

    /// Returns the maximum number of times that a cell is divided.
    pub(crate) fn most_divisions(&self) -> u32 {
        self.divisions.unwrap_or(if self.views == Views::Axes { DEPTH_LIMIT } else { 0 })
    }

    /// Returns true if any cell may be divided.
    pub(crate) fn divides(&self) -> bool {
        self.most_divisions() > 0
    }

    /// Returns the words of a brick: its own word and two of the mask. If cells are divided, also two words
    /// for the mask of divided cells, one for the first brick of these cells, and two for the brick's
    /// position among divided cells or for distances.
    pub fn brick_words(&self) -> u32 {
        if self.divides() { 8 } else { 3 }
    }

    /// Returns the maximum number of times that cells are divided if views have `cells` cells: the number of
    /// the options, or a smaller one if positions would not fit into their words.
    pub(crate) fn depth_for(&self, cells: [u32; 3]) -> u32 {
        let most = cells.into_iter().max().unwrap_or(0);
        (0..=self.most_divisions())
            .rev()
            .find(|depth| most << (2 * depth) <= numbers::BRICKS_FINEST_LIMIT)
            .unwrap_or(0)
    }

    /// Checks the ranges of all options and their combinations.
    ///
    /// # Errors
    /// The first option that is out of range, or the first combination that is not possible.
    pub fn validate(&self) -> Result<(), AdsError> {
        check_range("grid", self.grid.unwrap_or(1), 1..=SIDE_LIMIT, "1 to 1024 cells along a side")?;
        check_range("divisions", self.most_divisions(), 0..=DEPTH_LIMIT, "0 to 3")?;
        check_range("slices", self.slices.unwrap_or(1), 1..=SLICE_LIMIT, "1 to 1024 depth slices")?;
        if self.views == Views::Cube && self.divides() {
            let (value, expected) =
                (self.most_divisions().to_string(), "0 for the faces of a cube, or views `axes`");
            return Err(AdsError::Option { option: "divisions", value, expected });
        }
        if let (Views::Axes, Some(slices)) = (self.views, self.slices) {
            let expected = "views along axes have cells of one size: use `grid`, or views `cube`";
            return Err(AdsError::Option { option: "slices", value: slices.to_string(), expected });
        }
        check_work_budget(self.work_budget, false)
    }

    /// Returns the specialisation constants, as pairs of id and bits.
    pub(crate) fn constants(&self) -> Vec<(u32, u32)> {
        let views = match self.views {
            Views::Cube => numbers::BRICKS_VIEWS_CUBE,
            Views::Axes => numbers::BRICKS_VIEWS_AXES,
        };
        vec![
            (ids::BRICKS_VIEWS, views),
            (ids::BRICKS_SKIP, u32::from(self.skip)),
            (ids::BRICKS_CORNERS_KEPT, u32::from(self.corners)),
            (ids::BRICKS_DEPTH, self.most_divisions()),
        ]
    }

    /// Returns the options as pairs of name and value, for reports; `cells` are the columns, rows and slices
    /// of a view.
    pub fn options(&self, cells: [u32; 3]) -> Vec<(&'static str, String)> {
        let switch = |on| if on { "on" } else { "off" }.to_owned();
        vec![
            ("views", self.views.name().to_owned()),
            ("grid", cells.map(|n| n.to_string()).join("x")),
            ("divisions", self.most_divisions().to_string()),
            ("corners", switch(self.corners)),
            ("skip", switch(self.skip)),
        ]
    }

    /// Returns the chosen code paths as pairs of name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        vec![("builder", self.builder.name().to_owned()), ("addressing", self.addressing.name().to_owned())]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_have_whole_bricks() {
        let cells =
            |grid, slices| Config { grid, slices, ..Config::new(Views::Cube) }.cells_of_faces(100_000);
        assert_eq!(cells(None, None), [64, 64, 128]);
        assert_eq!(cells(Some(1), None), [4, 4, 8]);
        assert_eq!(cells(Some(33), Some(13)), [36, 36, 16]);
        assert_eq!(cells(Some(1024), None), [1024, 1024, 1024]);
    }
}
