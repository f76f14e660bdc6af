//! What columns of bricks are, how many there are, and where those of views along axes lie.

use rasray_shaders_glsl::constants::bricks as numbers;

use crate::config::{BRICK_SIDE, SIDE_LIMIT};

/// What is seen where. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Views {
    /// Six faces of a cube around a centre: cells grow with the distance.
    Cube,
    /// One box of cells of one size around the geometry, seen along an axis, which are the cells of views along the
    /// other two axes as well. Nothing depends on the eye but how far away rays may start.
    Axes,
}

impl Views {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Cube, Self::Axes];

    /// How many views there are.
    pub(crate) fn count(self) -> u32 {
        match self {
            Self::Cube => 6,
            Self::Axes => 1,
        }
    }

    /// The word of options.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cube => "cube",
            Self::Axes => "axes",
        }
    }
}

/// Most cells where their number is left to the rule: 256 a side of a cube.
const MOST_CELLS: f64 = 16_777_216.0;

/// Fewest cells along the longest side where their number is left to the rule.
const FEWEST_ALONG: f64 = 16.0;

/// Eyes nearer than this many times the geometry need no wider margins: a little less than `ORIGIN_LIMIT`.
const EYE_LIMIT: f32 = 3.5;

/// Margins of a distant eye are no wider than this share of a cell.
const WIDEST_MARGIN: f64 = 0.125;

/// The bounds (lower, upper) are wider than the geometry by this many margins below and twice as many above:
/// sides lie well within a cell then, and so does the middle.
const WIDENING: f64 = 4.0;

/// Half the longest side of what has no size: all that follows from it stays within the range of numbers.
const SMALLEST_REACH: f32 = 1.0e-30;

/// Columns along a side of a face for that many triangles: as many as make a column about as wide as a triangle is
/// seen from the middle, a power of two from 32 to 256.
pub(crate) fn columns_for(triangles: u32) -> u32 {
    let wanted = f64::from(triangles).sqrt() / 4.0;
    // Of two powers of two the nearer by ratio.
    2.0_f64.powf(wanted.max(1.0).log2().round()).clamp(32.0, 256.0) as u32
}

/// Cells along each axis, multiples of 4, for bounds (lower, upper) in metres and that many triangles:
/// `along` on the longest side, or as many as make a cell about as wide as a triangle is.
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
    // A third of the area of a box's sides: of a sheet its area, of a cube that of a side.
    let area = (extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0]) / 3.0;
    let wide = 2.0 * (area / f64::from(triangles.max(1))).sqrt();
    let mut side = wide.clamp(longest / f64::from(SIDE_LIMIT), longest / FEWEST_ALONG);
    while cells_of(side).map(f64::from).iter().product::<f64>() > MOST_CELLS {
        side *= 1.02;
    }
    cells_of(side)
}

/// Where the cells of views along axes are; metres from the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    /// Middle of the bounds, metres relative to the frame origin.
    pub(crate) centre: [f32; 3],
    /// Half the longest side of the bounds; more where the eye is far away.
    pub(crate) reach: f32,
    /// How far a ray may be from a triangle that it hits.
    pub(crate) rounding: f32,
    /// Corner of the first cell.
    pub(crate) lower: [f32; 3],
    /// Cells a metre, along each axis.
    pub(crate) per_metre: [f32; 3],
}

/// Places so many cells over bounds (lower, upper).
pub(crate) fn placed(eye: [f32; 3], [lower, upper]: [[f32; 3]; 2], cells: [u32; 3]) -> Placement {
    let centre: [f32; 3] = std::array::from_fn(|axis| 0.5 * lower[axis] + 0.5 * upper[axis]);
    let from_centre = |corner: [f32; 3]| std::array::from_fn::<f32, 3, _>(|axis| corner[axis] - centre[axis]);
    let (lower, upper) = (from_centre(lower), from_centre(upper));
    let farthest = |of: [f32; 3]| of.iter().fold(0.0_f32, |far, x| far.max(x.abs()));
    let own = farthest(lower).max(farthest(upper)).max(SMALLEST_REACH);
    let most = cells.into_iter().fold(BRICK_SIDE, u32::max);
    let widest = 2.0 * f64::from(own) / f64::from(most) * WIDEST_MARGIN;
    let limit = (widest / f64::from(numbers::BRICK_ROUNDING)) as f32;
    let reach = (farthest(from_centre(eye)) / EYE_LIMIT).min(limit).max(own);
    let rounding = numbers::BRICK_ROUNDING * reach;
    let wider = WIDENING * f64::from(rounding);
    Placement {
        centre,
        reach,
        rounding,
        lower: std::array::from_fn(|axis| (f64::from(lower[axis]) - wider) as f32),
        per_metre: std::array::from_fn(|axis| {
            let extent = f64::from(upper[axis]) - f64::from(lower[axis]) + 3.0 * wider;
            (f64::from(cells[axis]) / extent) as f32
        }),
    }
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
        // A multiple of 4 at least as many as asked for.
        assert_eq!(cells_along(ROOM, 12, Some(61)), [64, 32, 16]);
        assert_eq!(cells_along(ROOM, 12, Some(1)), [4, 4, 4]);
        assert_eq!(cells_along(ROOM, 12, Some(1024)), [1024, 512, 256]);
        let cube = [[-2.0; 3], [2.0; 3]];
        // Half the square root of the triangles.
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
        let point = placed([1.0; 3], [[1.0; 3]; 2], [4; 3]);
        assert!(point.per_metre.iter().all(|n| n.is_normal()) && point.rounding.is_normal());
    }

    /// Every corner lies within the first and the last cell by more than the margin of a cell, whatever the eye.
    #[test]
    fn cells_hold_the_geometry_with_its_margins() {
        for bounds in
            [ROOM, [[0.0; 3], [5.0, 0.0, 3.0]], [[1.0e6; 3], [1.0e6 + 1.0; 3]], [[1.0e-20; 3], [3.0e-20; 3]]]
        {
            for distance in [0.0, 10.0, 1.0e3, 1.0e9] {
                let cells = cells_along(bounds, 1000, None);
                let at = placed([distance; 3], bounds, cells);
                for axis in 0..3 {
                    let in_cells = |x: f32| {
                        f64::from(x - at.centre[axis] - at.lower[axis]) * f64::from(at.per_metre[axis])
                    };
                    let margin = f64::from(at.rounding * at.per_metre[axis]);
                    let (first, last) = (in_cells(bounds[0][axis]), in_cells(bounds[1][axis]));
                    assert!(first > 2.0 * margin, "{bounds:?}: {first} {margin}");
                    assert!(last < f64::from(cells[axis]) - 2.0 * margin, "{bounds:?}: {last} {margin}");
                }
                let most = cells.into_iter().max().expect("three axes") as usize;
                let axis = cells.iter().position(|n| *n as usize == most).expect("the largest");
                assert!(
                    at.rounding * at.per_metre[axis] <= 0.126,
                    "margins are wider than a share of a cell"
                );
            }
        }
    }
}
