//! Determinants of single-precision numbers without rounding.
//!
//! A product of two `f32` has at most 48 significant bits and an exponent far inside the range of `f64`, so
//! it is an `f64` exactly. A product of three is then a rounded product plus its error, and that error is an
//! `f64` too: its lowest bit is at least 2^-447. A determinant of three points is a sum of such pairs, and
//! differences of points are multiplied out instead of being rounded. The sum is kept as an expansion
//! (Shewchuk 1997): components that do not overlap, in ascending order, so the last nonzero one has the sign
//! of the whole.

/// Point or direction whose coordinates came from `f32`.
pub type Point = [f64; 3];

/// Number of terms of the largest determinant of this module: four of six products with two components each.
const CAPACITY: usize = 48;

/// Sum of `f64` numbers without rounding.
#[derive(Clone, Copy)]
struct Expansion {
    components: [f64; CAPACITY],
    length: usize,
}

impl Expansion {
    fn zero() -> Self {
        Self { components: [0.0; CAPACITY], length: 0 }
    }

    /// Adds one number. Zero components are left out, which keeps order and separation.
    fn add(&mut self, number: f64) {
        let mut carry = number;
        let mut kept = 0;
        for index in 0..self.length {
            let (sum, rest) = two_sum(carry, self.components[index]);
            carry = sum;
            if rest != 0.0 {
                self.components[kept] = rest;
                kept += 1;
            }
        }
        if carry != 0.0 {
            self.components[kept] = carry;
            kept += 1;
        }
        self.length = kept;
    }

    /// Adds the determinant with rows x, y, z; `sign` is 1 or -1.
    fn add_determinant(&mut self, sign: f64, x: Point, y: Point, z: Point) {
        for (axis, &first) in x.iter().enumerate() {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            self.add_product(sign * first, y[next], z[last]);
            self.add_product(-sign * first, y[last], z[next]);
        }
    }

    fn add_product(&mut self, a: f64, b: f64, c: f64) {
        let exact = a * b;
        let product = exact * c;
        self.add(exact.mul_add(c, -product));
        self.add(product);
    }

    /// Returns the value, rounded with a relative error of a few units in the last place.
    fn value(&self) -> f64 {
        self.components[..self.length].iter().sum()
    }
}

/// Returns `a + b` as its rounded sum and the exact rest.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}

/// Returns det(direction, a - origin, b - origin): positive, zero or negative like the exact value, and
/// within a few units in the last place of it. All numbers must be `f32` values.
pub fn edge_determinant(direction: Point, origin: Point, a: Point, b: Point) -> f64 {
    let mut sum = Expansion::zero();
    sum.add_determinant(1.0, direction, a, b);
    sum.add_determinant(-1.0, direction, a, origin);
    sum.add_determinant(-1.0, direction, origin, b);
    sum.value()
}

/// Returns the dot product of the direction with the triangle's normal (b - a) x (c - a), as exact as
/// [`edge_determinant`].
pub fn normal_along(direction: Point, [a, b, c]: [Point; 3]) -> f64 {
    let mut sum = Expansion::zero();
    sum.add_determinant(1.0, direction, a, b);
    sum.add_determinant(1.0, direction, b, c);
    sum.add_determinant(1.0, direction, c, a);
    sum.value()
}

/// Returns det(a - origin, b - origin, c - origin), as exact as [`edge_determinant`]: the dot product of a -
/// origin with the triangle's normal.
pub fn plane_offset(origin: Point, [a, b, c]: [Point; 3]) -> f64 {
    let mut sum = Expansion::zero();
    sum.add_determinant(1.0, a, b, c);
    sum.add_determinant(-1.0, origin, b, c);
    sum.add_determinant(-1.0, a, origin, c);
    sum.add_determinant(-1.0, a, b, origin);
    sum.value()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn widen(point: [f32; 3]) -> Point {
        point.map(f64::from)
    }

    #[test]
    fn the_sign_survives_where_double_precision_loses_it() {
        // The point is off the line through origin and a by one unit in the last place of a huge offset.
        let tiny = f32::from_bits(1);
        let direction = widen([1.0, 1.0, 0.0]);
        let origin = widen([1e18, 1e18, 0.0]);
        let a = widen([0.0, 0.0, 1.0]);
        for (shift, sign) in [(tiny, 1.0), (0.0, 0.0), (-tiny, -1.0)] {
            let b = widen([shift, 0.0, -1.0]);
            let value = edge_determinant(direction, origin, a, b);
            assert_eq!(if value == 0.0 { 0.0 } else { value.signum() }, sign, "shift {shift:e}");
        }
    }

    #[test]
    fn determinants_of_integers_are_exact() {
        let (o, a, b, c) = ([1.0, 2.0, 3.0], [4.0, 0.0, -1.0], [7.0, 7.0, 2.0], [-3.0, 5.0, 6.0]);
        let d = [2.0, -1.0, 5.0];
        // Rows (3,-2,-4) and (6,5,-1): cross product (22, -21, 27).
        assert_eq!(edge_determinant(d, o, a, b), 44.0 + 21.0 + 135.0);
        // (b-a) x (c-a) with (3,7,3) and (-7,5,7): (34, -42, 64).
        assert_eq!(normal_along(d, [a, b, c]), 68.0 + 42.0 + 320.0);
        assert_eq!(plane_offset(o, [a, b, c]), 3.0 * 34.0 + 2.0 * 42.0 - 4.0 * 64.0);
    }
}
