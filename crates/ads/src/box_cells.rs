//! Where the cells of one box along the axes of the world are: what `ads/box_cells.glsl` works on.

use rasray_shaders_glsl::constants::ads::CELL_ROUNDING;

/// Eyes nearer than this many times the geometry need no wider margins: a little less than `ORIGIN_LIMIT`.
const EYE_LIMIT: f32 = 3.5;

/// Margins of a distant eye are no wider than this share of a cell.
const WIDEST_MARGIN: f64 = 0.125;

/// The bounds (lower, upper) are wider than the geometry by this many margins below and twice as many above:
/// sides lie well within a cell then, and so does the middle.
const WIDENING: f64 = 4.0;

/// Half the longest side of bounds without size: values computed from it stay finite and not zero.
const SMALLEST_REACH: f32 = 1.0e-30;

/// A grid of equal cells over the bounds of a geometry, in metres relative to the middle of the bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxCells {
    /// Middle of the bounds, metres relative to the frame origin.
    pub centre: [f32; 3],
    /// Half the longest side of the bounds; more where the eye is far away.
    pub reach: f32,
    /// Maximum distance between a ray and a triangle that it hits, by rounding.
    pub rounding: f32,
    /// Corner of the first cell.
    pub lower: [f32; 3],
    /// Cells per metre, along each axis.
    pub per_metre: [f32; 3],
}

impl BoxCells {
    /// Places the given number of cells along each axis, 1 or more, over bounds (lower, upper), for rays from near the
    /// eye.
    pub fn over([lower, upper]: [[f32; 3]; 2], cells: [u32; 3], eye: [f32; 3]) -> Self {
        let centre: [f32; 3] = std::array::from_fn(|axis| 0.5 * lower[axis] + 0.5 * upper[axis]);
        let from_centre =
            |corner: [f32; 3]| std::array::from_fn::<f32, 3, _>(|axis| corner[axis] - centre[axis]);
        let (lower, upper) = (from_centre(lower), from_centre(upper));
        let farthest = |of: [f32; 3]| of.iter().fold(0.0_f32, |far, x| far.max(x.abs()));
        let own = farthest(lower).max(farthest(upper)).max(SMALLEST_REACH);
        let most = cells.into_iter().fold(1, u32::max);
        let widest = 2.0 * f64::from(own) / f64::from(most) * WIDEST_MARGIN;
        let limit = (widest / f64::from(CELL_ROUNDING)) as f32;
        let reach = (farthest(from_centre(eye)) / EYE_LIMIT).min(limit).max(own);
        let rounding = CELL_ROUNDING * reach;
        let wider = WIDENING * f64::from(rounding);
        Self {
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_size_has_cells() {
        let point = BoxCells::over([[1.0; 3]; 2], [4; 3], [1.0; 3]);
        assert!(point.per_metre.iter().all(|n| n.is_normal()) && point.rounding.is_normal());
    }

    /// Every corner lies within the first and the last cell by more than the margin of a cell, whatever the eye.
    #[test]
    fn cells_hold_the_geometry_with_its_margins() {
        for (bounds, cells) in [
            ([[-1.0, 0.0, 2.0], [3.0, 2.0, 3.0]], [20, 12, 8]),
            ([[-1.0, 0.0, 2.0], [3.0, 2.0, 3.0]], [1, 1, 1]),
            ([[0.0; 3], [5.0, 0.0, 3.0]], [28, 4, 16]),
            ([[1.0e6; 3], [1.0e6 + 1.0; 3]], [16; 3]),
            ([[1.0e-20; 3], [3.0e-20; 3]], [16; 3]),
        ] {
            for distance in [0.0, 10.0, 1.0e3, 1.0e9] {
                let at = BoxCells::over(bounds, cells, [distance; 3]);
                for axis in 0..3 {
                    let in_cells = |x: f32| {
                        f64::from(x - at.centre[axis] - at.lower[axis]) * f64::from(at.per_metre[axis])
                    };
                    let margin = f64::from(at.rounding * at.per_metre[axis]);
                    let (first, last) = (in_cells(bounds[0][axis]), in_cells(bounds[1][axis]));
                    assert!(first > 2.0 * margin, "{bounds:?}: {first} {margin}");
                    assert!(last < f64::from(cells[axis]) - 2.0 * margin, "{bounds:?}: {last} {margin}");
                }
                let most = cells.into_iter().max().expect("three axes");
                let axis = cells.iter().position(|n| *n == most).expect("the largest");
                assert!(
                    at.rounding * at.per_metre[axis] <= 0.126,
                    "margins are wider than a share of a cell"
                );
            }
        }
    }
}
