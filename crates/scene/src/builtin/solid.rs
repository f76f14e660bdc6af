//! Solids given by their distance functions, and triangle meshes of their surfaces.

use std::collections::HashMap;

use glam::{DVec3, IVec3};

/// Cone with rounded ends: the convex hull of two spheres.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoundCone {
    /// Centre and radius of each sphere, metres.
    pub ends: [(DVec3, f64); 2],
}

impl RoundCone {
    /// Returns the distance from a point to the surface, metres, negative inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        let [(from, r0), (to, r1)] = self.ends;
        let axis = to - from;
        let length2 = axis.length_squared();
        let fall = r0 - r1;
        // One sphere lies within the other, or both have the same centre.
        if length2 <= fall * fall {
            return (point.distance(from) - r0).min(point.distance(to) - r1);
        }
        let slant2 = length2 - fall * fall;
        let relative = point - from;
        let y = relative.dot(axis);
        let z = y - length2;
        let x2 = (relative * length2 - axis * y).length_squared();
        let (y2, z2) = (y * y * length2, z * z * length2);
        let k = fall.signum() * fall * fall * x2;
        if z.signum() * slant2 * z2 > k {
            return (x2 + z2).sqrt() / length2 - r1;
        }
        if y.signum() * slant2 * y2 < k {
            return (x2 + y2).sqrt() / length2 - r0;
        }
        ((x2 * slant2 / length2).sqrt() + y * fall) / length2 - r0
    }
}

/// Returns the smaller of two distances, with their seam rounded over `width` metres.
pub(super) fn smooth_min(a: f64, b: f64, width: f64) -> f64 {
    let overlap = (width - (a - b).abs()).max(0.0) / width;
    a.min(b) - 0.25 * width * overlap * overlap
}

/// Returns the larger of two distances, with their edge rounded over `width` metres.
pub(super) fn smooth_max(a: f64, b: f64, width: f64) -> f64 {
    -smooth_min(-a, -b, width)
}

/// Triangle mesh of a solid's surface, fronts outside.
#[derive(Default)]
pub(super) struct Surface {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

/// Number of cells along a side of a block; a block far from the surface is skipped as a whole.
const BLOCK: i32 = 8;

/// Meshes the surface of a solid between two corners, which must enclose all of it, with about two triangles
/// for each square of the surface with sides of `cell` metres.
///
/// The method is surface nets: each cell of a grid that the surface passes through has a vertex, which is
/// moved onto the surface. `distance` must have a slope of at most 1 everywhere.
pub(super) fn surface(distance: &impl Fn(DVec3) -> f64, low: DVec3, high: DVec3, cell: f64) -> Surface {
    let counts = ((high - low) / cell).ceil().as_ivec3() + IVec3::splat(2);
    let corner = |at: IVec3| low + (at.as_dvec3() - 0.5) * cell;
    let far = 0.5 * f64::from(BLOCK + 1) * cell * 3.0_f64.sqrt();
    let blocks = (counts + BLOCK - 1) / BLOCK;
    let mut net = Net::default();
    for z in 0..blocks.z {
        for y in 0..blocks.y {
            for x in 0..blocks.x {
                let first = IVec3::new(x, y, z) * BLOCK;
                let middle = corner(first) + 0.5 * f64::from(BLOCK) * cell;
                if distance(middle).abs() <= far {
                    net.add_block(first, &|at| distance(corner(at)), &corner, cell);
                }
            }
        }
    }
    net.connect();
    let Net { mut surface, .. } = net;
    // Central differences over less than a cell, so that sharp edges are shaded over about one cell.
    let gradient = |point: DVec3| {
        let step = 0.35 * cell;
        let along = |axis: DVec3| distance(point + axis * step) - distance(point - axis * step);
        DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)).normalize_or(DVec3::Y)
    };
    for position in &mut surface.positions {
        for _ in 0..3 {
            // The step is a quarter of a cell at most, so that no vertex passes its neighbours.
            let step = distance(*position).clamp(-0.25 * cell, 0.25 * cell);
            *position -= gradient(*position) * step;
        }
    }
    surface.normals = surface.positions.iter().map(|&position| gradient(position)).collect();
    surface
}

/// Surface under construction.
#[derive(Default)]
struct Net {
    surface: Surface,
    /// Vertex of each cell that has one.
    vertex_of: HashMap<IVec3, u32>,
    /// Edges of the grid that pass through the surface: first corner, axis, and true if the first corner is
    /// inside.
    crossings: Vec<(IVec3, usize, bool)>,
}

impl Net {
    /// Adds the vertices and crossings of the cells of a block.
    fn add_block(
        &mut self,
        first: IVec3,
        distance: &impl Fn(IVec3) -> f64,
        corner: &impl Fn(IVec3) -> DVec3,
        cell: f64,
    ) {
        let side = (BLOCK + 1) as usize;
        let mut values = Vec::with_capacity(side * side * side);
        for z in 0..=BLOCK {
            for y in 0..=BLOCK {
                values.extend((0..=BLOCK).map(|x| distance(first + IVec3::new(x, y, z))));
            }
        }
        let at =
            |place: IVec3| values[(place.x as usize) + side * (place.y as usize + side * place.z as usize)];
        for z in 0..BLOCK {
            for y in 0..BLOCK {
                for x in 0..BLOCK {
                    self.add_cell(first, IVec3::new(x, y, z), &at, corner, cell);
                }
            }
        }
    }

    fn add_cell(
        &mut self,
        first: IVec3,
        place: IVec3,
        at: &impl Fn(IVec3) -> f64,
        corner: &impl Fn(IVec3) -> DVec3,
        cell: f64,
    ) {
        let (mut sum, mut count) = (DVec3::ZERO, 0_u32);
        for axis in 0..3 {
            let (along, one, other) =
                (IVec3::AXES[axis], IVec3::AXES[(axis + 1) % 3], IVec3::AXES[(axis + 2) % 3]);
            for bits in 0..4 {
                let start = one * (bits & 1) + other * (bits >> 1);
                let (a, b) = (at(place + start), at(place + start + along));
                if (a < 0.0) == (b < 0.0) {
                    continue;
                }
                sum += start.as_dvec3() + along.as_dvec3() * (a / (a - b));
                count += 1;
                if bits == 0 {
                    self.crossings.push((first + place, axis, a < 0.0));
                }
            }
        }
        if count > 0 {
            self.vertex_of.insert(first + place, self.surface.positions.len() as u32);
            self.surface.positions.push(corner(first + place) + sum / f64::from(count) * cell);
        }
    }

    /// Adds a quad around each crossing, between the cells that share the edge, cut along its shorter
    /// diagonal.
    fn connect(&mut self) {
        for &(start, axis, begins_inside) in &self.crossings {
            let (one, other) = (IVec3::AXES[(axis + 1) % 3], IVec3::AXES[(axis + 2) % 3]);
            let cells = [start, start - one, start - one - other, start - other];
            // A missing vertex means that the solid reaches beyond the corners that were given.
            let found = cells.map(|cell| self.vertex_of.get(&cell).copied());
            let [Some(a), Some(b), Some(c), Some(d)] = found else {
                debug_assert!(false, "the solid reaches out of its bounds at {start}");
                continue;
            };
            let quad = if begins_inside { [a, b, c, d] } else { [a, d, c, b] };
            let [p, q, r, s] = quad.map(|vertex| self.surface.positions[vertex as usize]);
            let [a, b, c, d] = quad;
            let halves = if p.distance_squared(r) <= q.distance_squared(s) {
                [[a, b, c], [a, c, d]]
            } else {
                [[b, c, d], [b, d, a]]
            };
            self.surface.triangles.extend(halves);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_of_a_round_cone_is_that_of_its_hull() {
        let cone = RoundCone { ends: [(DVec3::ZERO, 2.0), (DVec3::new(0.0, 4.0, 0.0), 1.0)] };
        let on_axis = |y: f64| cone.distance(DVec3::new(0.0, y, 0.0));
        assert_eq!((on_axis(-3.0), on_axis(6.0)), (1.0, 1.0));
        // The side touches both spheres, so the nearest of many spheres between them is as near.
        for x in [0.5, 2.0, 3.0] {
            let point = DVec3::new(x, 1.7, 0.4);
            let spheres = (0..=10_000).map(|k| {
                let share = f64::from(k) / 10_000.0;
                point.distance(DVec3::Y * (4.0 * share)) - (2.0 - share)
            });
            let nearest = spheres.fold(f64::INFINITY, f64::min);
            assert!((cone.distance(point) - nearest).abs() < 1.0e-6, "{x}");
        }
    }

    #[test]
    fn a_sphere_is_closed_and_as_large_as_it_should_be() {
        let sphere = surface(&|point: DVec3| point.length() - 1.0, DVec3::splat(-1.0), DVec3::ONE, 0.1);
        let point = |corner: u32| sphere.positions[corner as usize];
        let volume = |&[a, b, c]: &[u32; 3]| point(a).dot(point(b).cross(point(c))) / 6.0;
        let whole: f64 = sphere.triangles.iter().map(volume).sum();
        assert!((whole / (4.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 0.01, "{whole}");
        assert!(sphere.positions.iter().all(|position| (position.length() - 1.0).abs() < 1.0e-6));
        // A closed surface of genus 0 has two more vertices than half the triangles.
        assert_eq!(sphere.positions.len(), sphere.triangles.len() / 2 + 2);
    }
}
