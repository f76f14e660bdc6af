//! Options of a grid.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::{Addressing, AdsError, Counters, GeometryExtent};
use rasray_shaders_glsl::constants::grid::GRID_SIDE_LIMIT;

/// Number of cells per triangle that the rule aims at.
const DENSITY: f64 = 5.0;

/// Minimum number of cells along the longest side that the rule chooses.
const FEWEST_ALONG: f64 = 4.0;

/// Options of a grid. None of them changes a hit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Config {
    /// Number of cells along the longest side of the geometry's bounds, 1 to 1024. If absent, a rule chooses
    /// about five cells per triangle.
    pub cells: Option<u32>,
    /// Addressing of pools: descriptors or device addresses.
    pub addressing: Addressing,
    /// Number of entries to allocate for the first build; if absent, 8 per triangle.
    pub entries: Option<u64>,
    /// Counters that rays record of their work.
    pub counters: Counters,
    /// Work units that a ray may spend in one dispatch. If absent, the default that all structures share.
    pub work_budget: Option<u32>,
}

rasray_ads::configured!(Config);

impl Config {
    /// Returns the default options: five cells per triangle.
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the number of cells along each axis over a geometry.
    pub fn cells_over(&self, extent: &GeometryExtent) -> [u32; 3] {
        cells_along(extent.bounds, extent.triangle_count, self.cells)
    }

    /// Checks the ranges of all options.
    ///
    /// # Errors
    /// The first option that is out of range.
    pub fn validate(&self) -> Result<(), AdsError> {
        let expected = "1 to 1024 cells along the longest side";
        check_range("grid", self.cells.unwrap_or(1), 1..=GRID_SIDE_LIMIT, expected)?;
        check_work_budget(self.work_budget, false)
    }

    /// Returns the options as pairs of name and value, for reports; `cells` are the cells along each axis.
    pub fn options(&self, cells: [u32; 3]) -> Vec<(&'static str, String)> {
        vec![("grid", cells.map(|n| n.to_string()).join("x"))]
    }

    /// Returns the chosen code paths as pairs of name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        vec![("addressing", self.addressing.name().to_owned())]
    }
}

/// Returns the number of cells along each axis for bounds (lower, upper) in metres: `along` on the longest
/// side or, if absent, at most [`DENSITY`] per triangle. Cells are cubes, unless the length of a side is not
/// a multiple of the cell's.
fn cells_along([lower, upper]: [[f32; 3]; 2], triangles: u32, along: Option<u32>) -> [u32; 3] {
    let extent: [f64; 3] = std::array::from_fn(|axis| f64::from(upper[axis]) - f64::from(lower[axis]));
    let longest = extent.into_iter().fold(0.0_f64, f64::max);
    if !(longest > 0.0 && longest.is_finite()) {
        return [1; 3];
    }
    let limit = f64::from(GRID_SIDE_LIMIT);
    let cells_of = |side: f64| extent.map(|extent| (extent / side).ceil().clamp(1.0, limit) as u32);
    if let Some(along) = along {
        return cells_of(longest / f64::from(along));
    }
    // The search goes by steps, not by the root of a volume, since flat bounds have no volume.
    let most = DENSITY * f64::from(triangles);
    let mut side = longest / limit;
    while side < longest / FEWEST_ALONG && cells_of(side).map(f64::from).iter().product::<f64>() > most {
        side *= 1.01;
    }
    cells_of(side)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: [[f32; 3]; 2] = [[-1.0, 0.0, 2.0], [3.0, 2.0, 3.0]];

    #[test]
    fn cells_are_as_long_as_wide() {
        assert_eq!(cells_along(ROOM, 12, Some(64)), [64, 32, 16]);
        assert_eq!(cells_along(ROOM, 12, Some(1)), [1, 1, 1]);
        assert_eq!(cells_along(ROOM, 12, Some(1024)), [1024, 512, 256]);
    }

    #[test]
    fn the_rule_gives_five_cells_per_triangle() {
        for (bounds, triangles) in [
            ([[-2.0; 3], [2.0; 3]], 10_000),
            (ROOM, 300_000),
            ([[0.0; 3], [5.0, 0.0, 3.0]], 20_000),
            ([[1.0e-20; 3], [3.0e-20; 3]], 1_000_000),
        ] {
            let cells = cells_along(bounds, triangles, None).map(f64::from);
            let density = cells.iter().product::<f64>() / f64::from(triangles);
            assert!((4.0..=5.0).contains(&density), "{bounds:?}: {cells:?} are {density} per triangle");
        }
        // A sheet has one layer.
        assert_eq!(cells_along([[0.0; 3], [5.0, 0.0, 5.0]], 20_000, None)[1], 1);
    }

    #[test]
    fn the_rule_stays_within_its_limits() {
        let cube = [[-2.0; 3], [2.0; 3]];
        assert_eq!(cells_along(cube, 0, None), [4; 3]);
        assert_eq!(cells_along(cube, 12, None), [4; 3]);
        assert_eq!(cells_along(cube, u32::MAX, None), [1024; 3]);
        let long = cells_along([[0.0; 3], [1.0e6, 1.0, 1.0]], 1_000_000, None);
        assert_eq!(long, [1024, 1, 1]);
        for bounds in [
            [[1.0; 3]; 2],
            [[f32::NAN; 3]; 2],
            [[f32::MAX; 3], [f32::MIN; 3]],
            [[f32::NEG_INFINITY; 3], [f32::INFINITY; 3]],
        ] {
            assert_eq!(cells_along(bounds, 9, None), [1; 3], "{bounds:?}");
        }
    }
}
