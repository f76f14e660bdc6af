//! Options of bricks.

use rasray_ads::{Addressing, AdsError, Builder, Counters, Geometry, check_range, check_work_budget};
use rasray_shaders_glsl::constant_ids::bricks as ids;
use rasray_shaders_glsl::constants::bricks as numbers;

use crate::Views;
use crate::grid::{cells_along, columns_for};

/// Cells along a side of a brick.
pub(crate) const BRICK_SIDE: u32 = 4;
/// Maximum cells along a side of a view.
pub(crate) const SIDE_LIMIT: u32 = numbers::BRICK_SIDE_LIMIT;
/// Maximum slices.
const SLICE_LIMIT: u32 = numbers::BRICK_SLICE_LIMIT;

/// All options. None of them changes a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Which views there are.
    pub views: Views,
    /// Columns along a side of a face, or cells along the longest side of the geometry's bounds; 1 to 1024, rounded up
    /// to a multiple of 4. Absent: as many as make a cell about as wide as a triangle.
    pub grid: Option<u32>,
    /// [`Views::Cube`] only: depth slices, the same for all columns, 1 to 1024, rounded up to a multiple of 4; twice
    /// the columns along a side where absent.
    pub slices: Option<u32>,
    /// Keep a contiguous copy of the corners of triangles: 36 bytes per triangle instead of 24.
    pub corners: bool,
    /// Find how far around each empty brick everything is empty, so that a ray crosses it in one step.
    pub skip: bool,
    /// How triangles are binned into cells.
    pub builder: Builder,
    /// How pools are reached.
    pub addressing: Addressing,
    /// Entries to allocate for the first build; 16 per triangle where absent.
    pub entries: Option<u64>,
    /// How much of their work rays record.
    pub counters: Counters,
    /// Work units a ray may spend in one dispatch; the shared default where absent.
    pub work_budget: Option<u32>,
}

rasray_ads::configured!(Config);

impl Config {
    /// Bricks of these views, with everything that makes them fast.
    pub fn new(views: Views) -> Self {
        Self {
            views,
            grid: None,
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

    /// Columns, rows and slices of each view over a geometry, multiples of 4.
    pub fn cells(&self, geometry: &Geometry) -> [u32; 3] {
        match self.views {
            Views::Cube => self.cells_of_faces(geometry.triangle_count()),
            Views::Axes => cells_along(geometry.bounds(), geometry.triangle_count(), self.grid),
        }
    }

    /// Those of the faces of a cube, which depend on the number of triangles alone.
    fn cells_of_faces(&self, triangles: u32) -> [u32; 3] {
        let columns = self.grid.unwrap_or_else(|| columns_for(triangles)).next_multiple_of(BRICK_SIDE);
        let slices = self.slices.unwrap_or_else(|| (2 * columns).min(SLICE_LIMIT));
        [columns, columns, slices.next_multiple_of(BRICK_SIDE)]
    }

    /// Checks ranges.
    ///
    /// # Errors
    /// The first option out of range.
    pub fn validate(&self) -> Result<(), AdsError> {
        check_range("grid", self.grid.unwrap_or(1), 1..=SIDE_LIMIT, "1 to 1024 cells along a side")?;
        check_range("slices", self.slices.unwrap_or(1), 1..=SLICE_LIMIT, "1 to 1024 depth slices")?;
        if let (Views::Axes, Some(slices)) = (self.views, self.slices) {
            let expected = "views along axes have cells of one size: use `grid`, or views `cube`";
            return Err(AdsError::Option { option: "slices", value: slices.to_string(), expected });
        }
        check_work_budget(self.work_budget, false)
    }

    /// Specialisation constants: id and bits.
    pub(crate) fn constants(&self) -> Vec<(u32, u32)> {
        let views = match self.views {
            Views::Cube => numbers::BRICK_VIEWS_CUBE,
            Views::Axes => numbers::BRICK_VIEWS_AXES,
        };
        vec![
            (ids::BRICK_VIEWS, views),
            (ids::BRICK_SKIP, u32::from(self.skip)),
            (ids::BRICK_CORNERS_KEPT, u32::from(self.corners)),
        ]
    }

    /// Options as name and value, for reports; `cells` are those of a view.
    pub fn options(&self, cells: [u32; 3]) -> Vec<(&'static str, String)> {
        let switch = |on| if on { "on" } else { "off" }.to_owned();
        vec![
            ("views", self.views.name().to_owned()),
            ("grid", cells.map(|n| n.to_string()).join("x")),
            ("corners", switch(self.corners)),
            ("skip", switch(self.skip)),
        ]
    }

    /// Paths as name and value, for reports.
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
