//! One ray against one triangle.

use super::Side;
use super::exact::{self, Point};
use super::ray::Ray;
use super::t_bound::SeenTriangle;

/// Unit roundoff of single precision.
const U: f64 = 1.0 / (1_u64 << 24) as f64;
/// Unit roundoff of double precision.
const EPSILON: f64 = f64::EPSILON / 2.0;
/// Largest error of a careful single-precision test, in units of U times the sum of absolute values of its
/// terms. Shearing a vertex costs at most 4 (difference, slope, product, difference), the products of an edge
/// function 2 more; the rest is headroom for tests that shear in another order.
const SINGLE_ERROR: f64 = 8.0 * U;
/// Error of the same roundings in double precision, doubled.
const DOUBLE_ERROR: f64 = 16.0 * EPSILON;
/// Least ratio of a double-precision sum of products to its scale at which the sum is used for t:
/// cancellation then costs at most 12 bits.
const WELL_CONDITIONED: f64 = 1.0 / 4096.0;

/// Contact of a ray with a triangle that it hits, or passes so near that single precision may report a hit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// True if the ray is exactly inside the triangle and the range.
    pub hit: bool,
    /// True if single precision must report the contact as well.
    pub certain: bool,
    /// True if the whole interval lies inside the ray's range, and above the bound of its error.
    pub in_range: bool,
    pub t: f64,
    /// Interval of the t that single precision may report.
    pub t_low: f64,
    pub t_high: f64,
    /// Barycentric weights of vertices 1 and 2.
    pub barycentrics: [f64; 2],
    /// Marks of the edges (named by the vertex opposite) that the ray passes within rounding.
    pub touched: [bool; 3],
    /// Positions of the vertices in the plane across the ray, relative to the ray.
    pub seen: [[f64; 2]; 3],
    /// True if the triangle winds counter-clockwise as the ray sees it (in the sheared axes).
    pub facing: bool,
    /// Side that the ray meets, in exact arithmetic if the ray hits.
    pub side: Side,
    /// True if single precision sees the same side.
    pub side_is_certain: bool,
}

/// Ray prepared for many triangles: axes are permuted cyclically so that the direction is longest along
/// `axis_z`, and sheared so that it runs along that axis only.
pub(super) struct ContactTest {
    pub origin: Point,
    pub direction: Point,
    pub axis_z: usize,
    pub t_min: f64,
    pub t_max: f64,
    shear: [f64; 2],
}

/// Vertex relative to the ray.
#[derive(Clone, Copy)]
struct Sheared {
    x: f64,
    y: f64,
    /// Ray parameter t of the plane through the vertex across `axis_z`.
    z: f64,
    /// Sums of the absolute values of the terms of x and y.
    x_scale: f64,
    y_scale: f64,
}

/// Twice the signed area of an edge and the ray, and the scale of its rounding error.
#[derive(Clone, Copy)]
struct EdgeFunction {
    value: f64,
    scale: f64,
}

impl ContactTest {
    /// Prepares a ray; `None` if the ray is not valid or its range is empty.
    pub fn new(ray: &Ray) -> Option<Self> {
        if !ray.is_valid() || ray.t_min >= ray.t_max {
            return None;
        }
        let direction = ray.direction.map(f64::from);
        let longest = direction.map(f64::abs);
        let axis_z = if longest[0] >= longest[1] && longest[0] >= longest[2] {
            0
        } else if longest[1] >= longest[2] {
            1
        } else {
            2
        };
        let shear = [
            direction[(axis_z + 1) % 3] / direction[axis_z],
            direction[(axis_z + 2) % 3] / direction[axis_z],
        ];
        Some(Self {
            origin: ray.origin.map(f64::from),
            direction,
            axis_z,
            t_min: f64::from(ray.t_min),
            t_max: f64::from(ray.t_max),
            shear,
        })
    }

    /// Tests a triangle; `None` if neither exact arithmetic nor single precision sees a hit in range.
    pub fn contact(&self, triangle: &[[f32; 3]; 3]) -> Option<Contact> {
        let vertices = triangle.map(|vertex| self.shear(vertex));
        if !surrounds(vertices.map(|v| (v.x, v.x_scale))) || !surrounds(vertices.map(|v| (v.y, v.y_scale))) {
            return None;
        }
        let edges = [0, 1, 2].map(|opposite: usize| {
            EdgeFunction::new(vertices[(opposite + 1) % 3], vertices[(opposite + 2) % 3])
        });
        let near = edges.map(|edge| edge.value.abs() <= SINGLE_ERROR * edge.scale);
        let clear = |sign: f64| (0..3).any(|i| !near[i] && edges[i].value * sign > 0.0);
        if clear(1.0) && clear(-1.0) {
            return None;
        }
        let points = triangle.map(|vertex| vertex.map(f64::from));
        let signs = [0, 1, 2].map(|opposite| self.exact_sign(opposite, &points, edges[opposite]));
        let inside = !(signs.contains(&1) && signs.contains(&-1)) && signs != [0, 0, 0];
        let sum: f64 = edges.iter().map(|edge| edge.value).sum();
        let (t_first, t_last) = vertices
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v.z), high.max(v.z)));
        let t = if inside { self.plane_t(&points) } else { self.plane_t_rounded(&points) };
        let t = if t.is_nan() { 0.5 * (t_first + t_last) } else { t.clamp(t_first, t_last) };

        let seen = SeenTriangle {
            corners: std::array::from_fn(|vertex| self.along_axis(points[vertex], self.origin)),
            direction: self.along_axis(self.direction, [0.0; 3]),
            sheared: vertices.map(|v| [v.x, v.y]),
            depths: vertices.map(|v| v.z),
        };
        // The error of any test that mixes the vertices' t with weights that are off by the edges' errors.
        let mixing: f64 =
            (0..3).map(|i| SINGLE_ERROR * edges[i].scale * (vertices[i].z - t).abs()).sum::<f64>()
                / sum.abs();
        let weighted: f64 = (0..3).map(|i| (edges[i].value * vertices[i].z).abs()).sum::<f64>() / sum.abs();
        let margin = |z: f64| 2.0 * SINGLE_ERROR * z.abs();
        let bound = seen.t_bound(t);
        let error = (mixing + margin(t) + margin(weighted)).max(bound);
        let error = if error.is_nan() { f64::INFINITY } else { error };
        let t_low = (t - error).max(t_first - margin(t_first));
        let t_high = (t + error).min(t_last + margin(t_last));
        if t_high < self.t_min || t_low > self.t_max {
            return None;
        }
        let hit = inside && self.t_min < t && t < self.t_max;
        // The device reports no hit nearer than its own bound, since the hit could be the surface on which
        // the ray starts.
        let in_range = self.t_min.max(bound) < t_low && t_high < self.t_max;
        let facing = if inside { signs.contains(&1) } else { sum > 0.0 };
        let scale: f64 = edges.iter().map(|edge| edge.scale).sum();
        // Sheared axes see a triangle from behind if the ray runs towards positive values.
        let counter_clockwise = facing == (self.direction[self.axis_z] < 0.0);
        Some(Contact {
            hit,
            certain: hit && in_range && !near.contains(&true),
            in_range,
            t,
            t_low,
            t_high,
            barycentrics: self.barycentrics(&points, edges, sum, inside),
            touched: [0, 1, 2].map(|opposite: usize| {
                let ends = [vertices[(opposite + 1) % 3], vertices[(opposite + 2) % 3]];
                // The ray is near the edge's line, and not before or past its ends.
                near[opposite]
                    && surrounds(ends.map(|v| (v.x, v.x_scale)))
                    && surrounds(ends.map(|v| (v.y, v.y_scale)))
            }),
            seen: vertices.map(|v| [v.x, v.y]),
            facing,
            side: if counter_clockwise { Side::CounterClockwise } else { Side::Clockwise },
            side_is_certain: sum.abs() > SINGLE_ERROR * scale,
        })
    }

    /// Returns `point - from` with permuted axes, such that the direction's longest component comes last.
    fn along_axis(&self, point: Point, from: Point) -> Point {
        [1, 2, 3].map(|step| {
            let axis = (self.axis_z + step) % 3;
            point[axis] - from[axis]
        })
    }

    fn shear(&self, vertex: [f32; 3]) -> Sheared {
        let [x, y, z] = self.along_axis(vertex.map(f64::from), self.origin);
        let (x_shift, y_shift) = (self.shear[0] * z, self.shear[1] * z);
        Sheared {
            x: x - x_shift,
            y: y - y_shift,
            z: z / self.direction[self.axis_z],
            x_scale: x.abs() + x_shift.abs(),
            y_scale: y.abs() + y_shift.abs(),
        }
    }

    /// Returns the sign of the exact edge determinant over the direction's longest component, which is the
    /// exact value of the edge function of the sheared vertices.
    fn exact_sign(&self, opposite: usize, points: &[Point; 3], edge: EdgeFunction) -> i32 {
        let value = if edge.value.abs() > DOUBLE_ERROR * edge.scale {
            edge.value
        } else {
            self.exact_edge(opposite, points)
        };
        i32::from(value > 0.0) - i32::from(value < 0.0)
    }

    fn exact_edge(&self, opposite: usize, points: &[Point; 3]) -> f64 {
        let (a, b) = (points[(opposite + 1) % 3], points[(opposite + 2) % 3]);
        let determinant = exact::edge_determinant(self.direction, self.origin, a, b);
        determinant * self.direction[self.axis_z].signum()
    }

    /// Returns the t of the triangle's plane; relative error below 2^-38.
    fn plane_t(&self, points: &[Point; 3]) -> f64 {
        let [(offset, offset_scale), (along, along_scale)] = self.plane(points);
        // Each of these values rounds at most seven times: 7 * 2^-53 * 4096 < 2^-38.
        let offset = if offset.abs() >= WELL_CONDITIONED * offset_scale {
            offset
        } else {
            exact::plane_offset(self.origin, *points)
        };
        let along = if along.abs() >= WELL_CONDITIONED * along_scale {
            along
        } else {
            exact::normal_along(self.direction, *points)
        };
        offset / along
    }

    fn plane_t_rounded(&self, points: &[Point; 3]) -> f64 {
        let [(offset, _), (along, _)] = self.plane(points);
        offset / along
    }

    /// Returns the distance of the plane and the slope of the ray, both times the normal's length, each with
    /// the sum of the absolute values of its terms.
    fn plane(&self, [a, b, c]: &[Point; 3]) -> [(f64, f64); 2] {
        let difference = |p: &Point, q: &Point| -> Point { std::array::from_fn(|axis| p[axis] - q[axis]) };
        let (first, second, relative) = (difference(b, a), difference(c, a), difference(a, &self.origin));
        let mut result = [(0.0, 0.0); 2];
        for (axis, &distance) in relative.iter().enumerate() {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let (plus, minus) = (first[next] * second[last], first[last] * second[next]);
            for ((sum, scale), factor) in result.iter_mut().zip([distance, self.direction[axis]]) {
                *sum += factor * (plus - minus);
                *scale += factor.abs() * (plus.abs() + minus.abs());
            }
        }
        result
    }

    fn barycentrics(
        &self,
        points: &[Point; 3],
        edges: [EdgeFunction; 3],
        sum: f64,
        inside: bool,
    ) -> [f64; 2] {
        let scale: f64 = edges.iter().map(|edge| edge.scale).sum();
        let weights = if inside && sum.abs() < scale * 2.0_f64.powi(-20) {
            [0, 1, 2].map(|opposite| self.exact_edge(opposite, points))
        } else {
            edges.map(|edge| edge.value)
        };
        let total: f64 = weights.iter().sum();
        if total == 0.0 {
            return [1.0 / 3.0; 2];
        }
        let first = (weights[1] / total).clamp(0.0, 1.0);
        [first, (weights[2] / total).clamp(0.0, 1.0 - first)]
    }
}

impl EdgeFunction {
    fn new(a: Sheared, b: Sheared) -> Self {
        let scale = a.x_scale * b.y.abs()
            + b.y_scale * a.x.abs()
            + a.y_scale * b.x.abs()
            + b.x_scale * a.y.abs()
            // Products of two errors matter for triangles as small as the rounding of their vertices.
            + SINGLE_ERROR * (a.x_scale * b.y_scale + a.y_scale * b.x_scale);
        Self { value: a.x * b.y - a.y * b.x, scale }
    }
}

/// True if zero lies between the least and the greatest coordinate, within their rounding.
fn surrounds<const N: usize>(coordinates: [(f64, f64); N]) -> bool {
    coordinates.iter().any(|(x, scale)| *x <= SINGLE_ERROR * scale)
        && coordinates.iter().any(|(x, scale)| *x >= -SINGLE_ERROR * scale)
}
