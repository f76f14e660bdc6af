//! Views of bricks, and their numbers of columns, rows and slices.

use rasray_ads::words;
use rasray_shaders_glsl::constants::bricks::BRICKS_SIDE_LIMIT;

/// Number of cells along a side of a brick.
pub(crate) const BRICK_SIDE: u32 = 4;

/// Maximum number of cells along a side of a view.
pub(crate) const SIDE_LIMIT: u32 = BRICKS_SIDE_LIMIT;

/// Projections in which cells are made. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Views {
    /// Six faces of a cube around a centre. Cells grow with the distance from the centre.
    Cube,
    /// Box around the geometry, divided into cells of one size and seen along an axis. Views along the other
    /// two axes have the same cells. Only the distance at which rays may start depends on the eye.
    Axes,
}

words! { Views { Cube "cube", Axes "axes" } }

impl Views {
    /// Returns the number of views.
    pub(crate) fn count(self) -> u32 {
        match self {
            Self::Cube => 6,
            Self::Axes => 1,
        }
    }
}

/// Maximum number of cells that the rule chooses: 256 along a side of a cube.
const MOST_CELLS: f64 = 16_777_216.0;

/// Minimum number of cells along the longest side that the rule chooses.
const FEWEST_ALONG: f64 = 16.0;

/// Returns the number of columns along a side of a face for this many triangles, a power of two from 32 to
/// 256. A column is then about as wide as a triangle seen from the middle.
pub(crate) fn columns_for(triangles: u32) -> u32 {
    let wanted = f64::from(triangles).sqrt() / 4.0;
    // Rounds to the nearer of two powers of two, by ratio.
    2.0_f64.powf(wanted.max(1.0).log2().round()).clamp(32.0, 256.0) as u32
}

/// Returns the number of cells along each axis, multiples of 4, for bounds (lower, upper) in metres and this
/// many triangles: `along` on the longest side or, if absent, as many as make a cell about as wide as a
/// triangle.
pub(crate) fn cells_along([lower, upper]: [[f32; 3]; 2], triangles: u32, along: Option<u32>) -> [u32; 3] {
    let extent: [f64; 3] = std::array::from_fn(|axis| f64::from(upper[axis]) - f64::from(lower[axis]));
    let longest = extent.into_iter().fold(0.0_f64, f64::max);
    if !(longest > 0.0 && longest.is_finite()) {
        return [BRICK_SIDE; 3];
    }
    let cells_of = |side: f64| {
        extent.map(|extent| {
            let wanted = (extent / side).ceil().clamp(1.0, f64::from(SIDE_LIMIT)) as u32;
            wanted.next_multiple_of(BRICK_SIDE)
        })
    };
    if let Some(along) = along {
        return cells_of(longest / f64::from(along));
    }
    // A third of the area of a box's sides is the area of a sheet, or of one side of a cube.
    let area = (extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0]) / 3.0;
    let wide = 2.0 * (area / f64::from(triangles.max(1))).sqrt();
    let mut side = wide.clamp(longest / f64::from(SIDE_LIMIT), longest / FEWEST_ALONG);
    while cells_of(side).map(f64::from).iter().product::<f64>() > MOST_CELLS {
        side *= 1.02;
    }
    cells_of(side)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: [[f32; 3]; 2] = [[-1.0, 0.0, 2.0], [3.0, 2.0, 3.0]];

    #[test]
    fn columns_are_as_wide_as_a_triangle_is_seen() {
        let columns = [0, 12, 10_000, 100_000, 300_000, u32::MAX].map(columns_for);
        assert_eq!(columns, [32, 32, 32, 64, 128, 256]);
    }

    #[test]
    fn cells_are_as_long_as_wide() {
        assert_eq!(cells_along(ROOM, 12, Some(64)), [64, 32, 16]);
        // Numbers of cells are rounded up to a multiple of 4.
        assert_eq!(cells_along(ROOM, 12, Some(61)), [64, 32, 16]);
        assert_eq!(cells_along(ROOM, 12, Some(1)), [4, 4, 4]);
        assert_eq!(cells_along(ROOM, 12, Some(1024)), [1024, 512, 256]);
        let cube = [[-2.0; 3], [2.0; 3]];
        // The number is half the square root of the number of triangles.
        assert_eq!(cells_along(cube, 10_000, None), [52; 3]);
        assert_eq!(cells_along(cube, 12, None), [16; 3]);
    }

    #[test]
    fn the_rule_stays_within_its_limits() {
        for (bounds, triangles) in [
            (ROOM, 300_000),
            ([[-2.0; 3], [2.0; 3]], u32::MAX),
            ([[0.0; 3], [1.0e6, 1.0, 1.0]], 1_000_000),
            ([[0.0; 3], [1.0, 0.0, 0.0]], 7),
            ([[0.0; 3], [5.0, 0.0, 3.0]], 20_000),
            ([[-3.0e38; 3], [3.0e38; 3]], 300_000),
        ] {
            let cells = cells_along(bounds, triangles, None);
            assert!(cells.iter().all(|n| n % 4 == 0 && (4..=1024).contains(n)), "{bounds:?}: {cells:?}");
            let all = cells.map(f64::from).iter().product::<f64>();
            assert!(all <= MOST_CELLS, "{bounds:?}: {cells:?}");
        }
        // A sheet has one layer of bricks.
        assert_eq!(cells_along([[0.0; 3], [5.0, 0.0, 5.0]], 20_000, None)[1], 4);
    }

    #[test]
    fn what_has_no_size_has_a_brick() {
        for bounds in [
            [[1.0; 3]; 2],
            [[f32::NAN; 3]; 2],
            [[f32::MAX; 3], [f32::MIN; 3]],
            [[f32::NEG_INFINITY; 3], [f32::INFINITY; 3]],
        ] {
            assert_eq!(cells_along(bounds, 9, None), [4; 3], "{bounds:?}");
        }
    }
}
