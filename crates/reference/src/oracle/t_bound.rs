//! Upper bounds of the error of t in the device's test, and of the bound of that error which the test
//! computes itself.
//!
//! The device's test (`shaders-glsl/ads/triangle.glsl`) takes t from the plane of a triangle or from a mix of
//! its corners, whichever has the smaller error bound, and reports a hit only if t exceeds that bound, so
//! that a ray which starts on a surface does not hit the surface by rounding alone. This module bounds *the
//! bound that the test computes*: the same sums in double precision, each constant raised by the possible
//! effect of rounding. The result therefore also holds for the error of the device's t. A hit is certain only
//! if it lies above this bound by as much.

use super::exact::Point;

/// Unit roundoff of single precision.
const U: f64 = 1.0 / (1_u64 << 24) as f64;
/// Bound of the factor by which sums of positive products in single precision may exceed the sums computed
/// here.
const SUMS: f64 = 1.0 + 64.0 * U;
/// Largest divisor (`TRIANGLE_LARGEST_DIVISOR`); the device trusts no divisor above half of this.
const LARGEST_DIVISOR: f64 = 8.0e37;
/// Twice the smallest sum of products, per unit of the vector that they are taken with, that underflow cannot
/// have spoilt.
const TINY: f64 = 2.0e-30;

/// Corners of a triangle as a ray sees them, all relative to the ray's origin, with the axis of its longest
/// direction last.
pub(super) struct SeenTriangle {
    /// Corners, metres.
    pub corners: [Point; 3],
    /// Direction of the ray; its third component is the longest.
    pub direction: Point,
    /// Corners sheared along the ray: x and y, where the ray passes at (0, 0).
    pub sheared: [[f64; 2]; 3],
    /// Ray parameters t of the planes across the longest direction through the corners.
    pub depths: [f64; 3],
}

impl SeenTriangle {
    /// Returns the bound of the error of t, and of the bound that the device computes; infinite if rounding
    /// decides.
    pub fn t_bound(&self, t: f64) -> f64 {
        let (nearest, farthest) = (min(self.depths), max(self.depths));
        let max_depth = nearest.abs().max(farthest.abs());
        // The ends of the corners' range take three roundings each, and the device adds 12 u.
        let range = (farthest - nearest + 20.0 * U * max_depth) * SUMS;
        let bound = self.plane(t).min(self.mixing(t, max_depth)).min(range);
        if bound.is_nan() { f64::INFINITY } else { bound }
    }

    /// Bounds the error of a t that is taken from the plane, like `triangle_plane_t`. Its slope is off by up
    /// to 12 u of `facing_reach`, and is trusted less by as much; the quotient that the device bounds by may
    /// itself be off by the bound, which takes another 12 u.
    fn plane(&self, t: f64) -> f64 {
        let [a, b, c] = &self.corners;
        let difference = |p: &Point, q: &Point| -> Point { std::array::from_fn(|axis| p[axis] - q[axis]) };
        let (first, second) = (difference(b, a), difference(c, a));
        let (mut facing, mut facing_reach, mut height_reach) = (0.0, 0.0, 0.0);
        for (axis, (distance, along)) in a.iter().zip(&self.direction).enumerate() {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let (plus, minus) = (first[next] * second[last], first[last] * second[next]);
            let reach = plus.abs() + minus.abs();
            facing += (plus - minus) * along;
            facing_reach += reach * along.abs();
            height_reach += reach * distance.abs();
        }
        let sum = |p: &Point| p.iter().map(|x| x.abs()).sum::<f64>().max(1.0);
        let certain = facing.abs() - 40.0 * U * facing_reach;
        let holds = certain > 0.0
            && facing_reach < 0.5 * LARGEST_DIVISOR
            && height_reach > TINY * sum(a)
            && facing_reach > TINY * sum(&self.direction);
        if !holds {
            return f64::INFINITY;
        }
        (12.0 * U * (height_reach + t.abs() * facing_reach) / certain + 9.0 * U * t.abs()) * SUMS
    }

    /// Bounds the error of a t that is mixed from the corners, like `triangle_mixing_error`. Sheared corners
    /// are off by `dx` and `dy`, edges by `delta`: the device's own determinant is less than this one by up
    /// to the sum of them, the device subtracts that sum again, and the t with which it compares depths is
    /// off by the bound, which subtracts the sum a third time.
    fn mixing(&self, t: f64, max_depth: f64) -> f64 {
        let [dx, dy, dz] = self.direction;
        let slopes = [(dx / dz).abs(), (dy / dz).abs()];
        // Half-widths of the sheared corners by axis, as computed on the device, and the errors within them.
        let errors: [[f64; 2]; 3] = std::array::from_fn(|corner| {
            std::array::from_fn(|axis| {
                let moved = slopes[axis] * self.corners[corner][2].abs();
                (3.0 * U * self.sheared[corner][axis].abs() + 8.0 * U * moved) * SUMS
            })
        });
        let wide: [[f64; 2]; 3] = std::array::from_fn(|corner| {
            std::array::from_fn(|axis| self.sheared[corner][axis].abs() + 2.0 * errors[corner][axis])
        });
        let (mut det, mut lost, mut spread, mut reach) = (0.0, 0.0, 0.0, 0.0);
        for opposite in 0..3 {
            let (p, q) = ((opposite + 1) % 3, (opposite + 2) % 3);
            let edge = self.sheared[q][0] * self.sheared[p][1] - self.sheared[q][1] * self.sheared[p][0];
            let (first, second) = (wide[q][0] * wide[p][1], wide[q][1] * wide[p][0]);
            let delta = (2.0 * U * (first + second)
                + (wide[q][0] * errors[p][1] + wide[p][1] * errors[q][0])
                + (wide[p][0] * errors[q][1] + wide[q][1] * errors[p][0]))
                * SUMS;
            det += edge;
            lost += delta;
            spread += delta * (self.depths[opposite] - t).abs();
            reach += (edge * self.depths[opposite]).abs();
        }
        let certain = det.abs() - 3.1 * lost;
        if certain <= 0.0 || det.abs() + lost >= LARGEST_DIVISOR {
            return f64::INFINITY;
        }
        (spread + 24.0 * U * (reach + 3.0 * lost * max_depth)) / certain * SUMS
    }
}

fn min(values: [f64; 3]) -> f64 {
    values.into_iter().fold(f64::INFINITY, f64::min)
}

fn max(values: [f64; 3]) -> f64 {
    values.into_iter().fold(f64::NEG_INFINITY, f64::max)
}
