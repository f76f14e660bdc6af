//! Closed forms that objects in scenes are made of: turned, swept, cut from a block, folded.
//!
//! The arithmetic is additions, multiplications, divisions and square roots in f64 alone, so the bits are the
//! same on every machine.

use std::f64::consts::TAU;
use std::ops::{Add, Mul, Sub};

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::shape::Shapes;

/// Cosine of the angle between two steps of a profile beyond which their edge is sharp: 40 degrees.
const CREASE: f64 = 0.766;

/// Factor on the numbers of divisions of curved surfaces.
#[derive(Clone, Copy)]
pub(super) struct Fineness(pub f64);

impl Fineness {
    /// Returns the number of divisions that is `count` at detail 1, and never below `least`.
    pub fn of(self, count: f64, least: usize) -> usize {
        ((count * self.0).round() as usize).max(least)
    }
}

/// Returns sine and cosine of a share of a full turn, within 2^-51. The bits are the same everywhere, unlike
/// those of mathematics libraries.
pub(super) fn turn(share: f64) -> (f64, f64) {
    let quarter = (4.0 * share).round();
    let angle = (share - quarter / 4.0) * TAU;
    let square = angle * angle;
    // Taylor series over an eighth of a turn each way, from the last term.
    let series = |first: u32| {
        let terms = (0..9).map(|term| f64::from((2 * term + first) * (2 * term + first + 1)));
        terms.rev().fold(1.0, |sum, divisor| 1.0 - square / divisor * sum)
    };
    let (sin, cos) = (angle * series(2), series(1));
    match quarter.rem_euclid(4.0) as u32 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Makes a smooth curve (Catmull-Rom) through all `points`, with `steps` steps from each to the next.
pub(super) fn curve<P>(points: &[P], steps: usize) -> Vec<P>
where
    P: Copy + Add<Output = P> + Sub<Output = P> + Mul<f64, Output = P>,
{
    let Some(&last) = points.last() else { return Vec::new() };
    let mut along = Vec::with_capacity(points.len() * steps);
    for gap in 0..points.len() - 1 {
        let (a, b) = (points[gap], points[gap + 1]);
        // The curve continues straight beyond its ends.
        let before = if gap > 0 { points[gap - 1] } else { a + a - b };
        let after = points.get(gap + 2).copied().unwrap_or(b + b - a);
        let (leave, arrive) = ((b - before) * 0.5, (after - a) * 0.5);
        for step in 0..steps {
            let t = step as f64 / steps as f64;
            let (t2, t3) = (t * t, t * t * t);
            along.push(
                a * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + b * (3.0 * t2 - 2.0 * t3)
                    + leave * (t3 - 2.0 * t2 + t)
                    + arrive * (t3 - t2),
            );
        }
    }
    along.push(last);
    along
}

/// Makes an arc of a profile around `centre`, from one share of a turn to another; 0 points along +x, 0.25
/// along +y.
pub(super) fn arc(centre: DVec2, radius: f64, from: f64, to: f64, steps: usize) -> Vec<DVec2> {
    let at = |step: usize| {
        let (sin, cos) = turn(from + (to - from) * step as f64 / steps as f64);
        centre + DVec2::new(cos, sin) * radius
    };
    (0..=steps).map(at).collect()
}

/// Makes a rotation about the y axis by a share of a turn, from +z towards +x.
pub(super) fn about_y(share: f64) -> DMat3 {
    let (sin, cos) = turn(share);
    DMat3::from_cols(DVec3::new(cos, 0.0, -sin), DVec3::Y, DVec3::new(sin, 0.0, cos))
}

/// Makes the placement of a form that stands at `foot`, turned about the vertical by a share of a turn.
pub(super) fn standing(foot: DVec3, share: f64) -> DAffine3 {
    DAffine3::from_mat3_translation(about_y(share), foot)
}

/// Makes a rigid placement with the y axis of the form along `axis` (any length).
pub(super) fn along(axis: DVec3, origin: DVec3) -> DAffine3 {
    let y = axis.normalize_or(DVec3::Y);
    let x = if y.x.abs() < 0.7 { DVec3::X } else { DVec3::Z };
    let z = x.cross(y).normalize();
    DAffine3::from_mat3_translation(DMat3::from_cols(y.cross(z), y, z), origin)
}

impl Shapes {
    /// Adds a surface of revolution about the y axis of `place`. `profile` lists (radius, height) so that the
    /// front is to the right: a profile that runs upwards has its front outside. The surface is smooth but
    /// for edges of more than 40 degrees, and closed where the profile begins and ends on the axis, or ends
    /// where it began.
    pub fn revolve(&mut self, place: DAffine3, segments: usize, profile: &[DVec2], repeat: DVec2) {
        let steps = profile.len() - 1;
        let across: Vec<DVec2> = profile
            .windows(2)
            .map(|step| step[1] - step[0])
            .map(|step| DVec2::new(step.y, -step.x).normalize_or(DVec2::X))
            .collect();
        let ring = profile[0] == profile[steps];
        // Normal of the next step on the other side of a point of the profile.
        let beyond = |point: usize, own: usize| match point {
            _ if 0 < point && point < steps => across[if own == point { point - 1 } else { point }],
            _ if ring => across[if own == 0 { steps - 1 } else { 0 }],
            _ if profile[point].x == 0.0 => DVec2::new(-across[own].x, across[own].y),
            _ => across[own],
        };
        let normal_from_form = place.matrix3.inverse().transpose();
        let total: f64 = profile.windows(2).map(|step| step[0].distance(step[1])).sum();
        let mut travelled = 0.0;
        for own in 0..steps {
            let ends = [own, own + 1].map(|point| {
                let other = beyond(point, own);
                let smooth = other.dot(across[own]) > CREASE;
                let normal = if smooth { (other + across[own]).normalize() } else { across[own] };
                (profile[point], normal)
            });
            let (from, to) = (profile[own], profile[own + 1]);
            let v = [travelled, travelled + from.distance(to)].map(|length| 1.0 - length / total);
            travelled += from.distance(to);
            let mut first = None;
            for segment in 0..=segments {
                // The last ring of vertices repeats the first bit for bit: the surface stays closed.
                let (sin, cos) = turn((segment % segments) as f64 / segments as f64);
                let out = DVec3::new(cos, 0.0, -sin);
                for ((point, normal), v) in ends.into_iter().zip(v) {
                    let normal = normal_from_form * (out * normal.x + DVec3::Y * normal.y);
                    let uv = DVec2::new(segment as f64 / segments as f64, v) * repeat;
                    let position = place.transform_point3(out * point.x + DVec3::Y * point.y);
                    let index = self.vertex(position, normal.normalize(), uv);
                    first.get_or_insert(index);
                }
            }
            let first = first.unwrap_or_default();
            for segment in 0..segments as u32 {
                let corner = first + 2 * segment;
                // At the axis one of the two triangles has no area.
                if from.x > 0.0 {
                    self.triangle([corner, corner + 2, corner + 3]);
                }
                if to.x > 0.0 {
                    self.triangle([corner, corner + 3, corner + 1]);
                }
            }
        }
    }

    /// Adds a closed tube along `path`; `radius` gets the share of the points that lies behind. A radius of 0
    /// at an end makes a tip, any other is closed by a flat disc.
    pub fn tube(&mut self, path: &[DVec3], segments: usize, radius: impl Fn(f64) -> f64, repeat: DVec2) {
        let last = path.len() - 1;
        let tangent =
            |point: usize| (path[(point + 1).min(last)] - path[point.saturating_sub(1)]).normalize();
        let mut side = along(tangent(0), DVec3::ZERO).matrix3.x_axis;
        let mut rings = Vec::with_capacity(path.len());
        for (point, &middle) in path.iter().enumerate() {
            let ahead = tangent(point);
            // The frame is turned as little as possible.
            side = (side - ahead * side.dot(ahead)).normalize_or(along(ahead, DVec3::ZERO).matrix3.x_axis);
            rings.push((middle, side, ahead.cross(side), radius(point as f64 / last as f64)));
        }
        let at = |point: usize, segment: usize| {
            let (middle, x, y, reach) = rings[point];
            let (sin, cos) = turn((segment % segments) as f64 / segments as f64);
            let out = x * cos + y * sin;
            (middle + out * reach, out)
        };
        let grid: Vec<u32> = (0..=last)
            .flat_map(|point| (0..=segments).map(move |segment| (point, segment)))
            .map(|(point, segment)| {
                let (position, out) = at(point, segment);
                let uv = DVec2::new(segment as f64 / segments as f64, 1.0 - point as f64 / last as f64);
                self.vertex(position, out, uv * repeat)
            })
            .collect();
        for point in 0..last {
            for segment in 0..segments {
                let [a, b] = [0, 1].map(|ring| (point + ring) * (segments + 1) + segment);
                if rings[point].3 > 0.0 {
                    self.triangle([grid[a], grid[a + 1], grid[b + 1]]);
                }
                if rings[point + 1].3 > 0.0 {
                    self.triangle([grid[a], grid[b + 1], grid[b]]);
                }
            }
        }
        for (point, outward) in [(0, -1.0), (last, 1.0)] {
            let (middle, _, _, reach) = rings[point];
            if reach == 0.0 {
                continue;
            }
            let normal = tangent(point) * outward;
            let centre = self.vertex(middle, normal, DVec2::splat(0.5));
            let rim: Vec<u32> = (0..=segments)
                .map(|segment| self.vertex(at(point, segment).0, normal, DVec2::splat(0.5)))
                .collect();
            for pair in rim.windows(2) {
                self.triangle(if outward > 0.0 {
                    [centre, pair[0], pair[1]]
                } else {
                    [centre, pair[1], pair[0]]
                });
            }
        }
    }

    /// Adds a closed block around the origin of `place` with its edges cut off over `bevel` metres and shaded
    /// round. Texture coordinates grow by `repeat` per metre, u along the longer side of a face.
    pub fn block_with_bevel(&mut self, place: DAffine3, half: DVec3, bevel: f64, repeat: f64) {
        let normal_from_form = place.matrix3.inverse().transpose();
        let shift = place.translation.x + 0.7 * place.translation.y + 1.3 * place.translation.z;
        let sign = |corner: usize, axis: usize| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
        // Each corner has one vertex on each of its three faces.
        let vertices: Vec<[u32; 3]> = (0..8)
            .map(|corner| {
                [0, 1, 2].map(|face| {
                    let reach = DVec3::from([0, 1, 2].map(|axis| {
                        sign(corner, axis) * (half[axis] - if axis == face { 0.0 } else { bevel })
                    }));
                    let (one, other) = ((face + 1) % 3, (face + 2) % 3);
                    let (long, wide) = if half[one] > half[other] { (one, other) } else { (other, one) };
                    let uv = DVec2::new(reach[long] + shift, reach[wide] + shift) * repeat;
                    let normal = (normal_from_form * DVec3::AXES[face] * sign(corner, face)).normalize();
                    self.vertex(place.transform_point3(reach), normal, uv)
                })
            })
            .collect();
        for face in 0..3 {
            let (one, other) = (1 << ((face + 1) % 3), 1 << ((face + 2) % 3));
            for high in 0..2 {
                let first = high << face;
                let [a, b, c, d] = [first, first | one, first | one | other, first | other];
                self.flat(&[a, b, c, d].map(|corner| vertices[corner][face]), high == 1);
                // The cut edges towards the next axis, on its two sides.
                let next = (face + 1) % 3;
                for side in 0..2 {
                    let start = first | side << next;
                    let end = start | other;
                    let strip = [
                        vertices[start][face],
                        vertices[start][next],
                        vertices[end][next],
                        vertices[end][face],
                    ];
                    self.flat(&strip, (high == 1) == (side == 1));
                }
            }
        }
        for (corner, faces) in vertices.iter().enumerate() {
            self.flat(faces, (0..3).fold(1.0, |product, axis| product * sign(corner, axis)) > 0.0);
        }
    }

    /// Adds a convex polygon, in the order of the corners or the opposite one.
    fn flat(&mut self, corners: &[u32], in_order: bool) {
        for pair in corners[1..].windows(2) {
            self.triangle(if in_order {
                [corners[0], pair[0], pair[1]]
            } else {
                [corners[0], pair[1], pair[0]]
            });
        }
    }

    /// Adds a closed solid between two surfaces over (u, v) in [0, 1]^2, `columns` by `rows` quads each:
    /// cloth with its thickness, or water over its ground. The front of `top` is on the side of d/du x d/dv;
    /// where both surfaces meet on the border there is no wall between.
    pub fn between(
        &mut self,
        columns: usize,
        rows: usize,
        repeat: DVec2,
        top: impl Fn(f64, f64) -> DVec3,
        bottom: impl Fn(f64, f64) -> DVec3,
    ) {
        let sample = |of: &dyn Fn(f64, f64) -> DVec3| -> Vec<DVec3> {
            (0..=rows)
                .flat_map(|row| (0..=columns).map(move |column| (column, row)))
                .map(|(column, row)| of(column as f64 / columns as f64, row as f64 / rows as f64))
                .collect()
        };
        let sides = [sample(&top), sample(&bottom)];
        let at = |column: usize, row: usize| row * (columns + 1) + column;
        for (points, facing) in sides.iter().zip([1.0, -1.0]) {
            let normal = |column: usize, row: usize| {
                let right =
                    points[at((column + 1).min(columns), row)] - points[at(column.saturating_sub(1), row)];
                let up = points[at(column, (row + 1).min(rows))] - points[at(column, row.saturating_sub(1))];
                right.cross(up).normalize_or(DVec3::Y) * facing
            };
            let grid: Vec<u32> = (0..=rows)
                .flat_map(|row| (0..=columns).map(move |column| (column, row)))
                .map(|(column, row)| {
                    let uv = DVec2::new(column as f64 / columns as f64, 1.0 - row as f64 / rows as f64);
                    self.vertex(points[at(column, row)], normal(column, row), uv * repeat)
                })
                .collect();
            for (column, row) in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))) {
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| grid[at(column + x, row + y)]);
                self.flat(&corners, facing > 0.0);
            }
        }
        // The border once around, counter-clockwise seen from the front of the top.
        let border: Vec<usize> = (0..columns)
            .map(|column| at(column, 0))
            .chain((0..rows).map(|row| at(columns, row)))
            .chain((0..columns).map(|column| at(columns - column, rows)))
            .chain((0..rows).map(|row| at(0, rows - row)))
            .collect();
        for (place, &from) in border.iter().enumerate() {
            let to = border[(place + 1) % border.len()];
            let corners = [sides[1][from], sides[1][to], sides[0][to], sides[0][from]];
            let normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalize_or(DVec3::Y);
            let [a, b, c, d] = corners.map(|corner| self.vertex(corner, normal, DVec2::ZERO));
            if corners[1] != corners[2] {
                self.triangle([a, b, c]);
            }
            if corners[0] != corners[3] {
                self.triangle([a, c, d]);
            }
        }
    }

    /// Adds a closed surface as [`super::solid::surface`] makes it.
    pub fn solid(&mut self, solid: super::solid::Surface, repeat: f64) {
        let first: Vec<u32> = solid
            .positions
            .iter()
            .zip(&solid.normals)
            .map(|(&position, &normal)| {
                let uv = DVec2::new(position.x + position.y, position.z + position.y) * repeat;
                self.vertex(position, normal, uv)
            })
            .collect();
        for triangle in solid.triangles {
            self.triangle(triangle.map(|corner| first[corner as usize]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_those_of_the_mathematics_library() {
        for step in -4000..=4000 {
            let share = f64::from(step) / 1600.0;
            let (sin, cos) = turn(share);
            let (true_sin, true_cos) = (share * TAU).sin_cos();
            assert!((sin - true_sin).abs() < 1.0e-14 && (cos - true_cos).abs() < 1.0e-14, "{share}");
        }
        assert_eq!(turn(0.25), (1.0, -0.0));
        assert_eq!(turn(1.5), (-0.0, -1.0));
    }

    #[test]
    fn curves_pass_their_points() {
        let points = [DVec2::ZERO, DVec2::new(1.0, 2.0), DVec2::new(3.0, 1.0)];
        let curve = curve(&points, 4);
        assert_eq!(curve.len(), 9);
        assert_eq!([curve[0], curve[4], curve[8]], points);
    }
}
