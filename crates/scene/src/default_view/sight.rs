//! First hits of rays inside a scene: a uniform grid over the placed triangles, in f64.
//!
//! The grid answers a few thousand rays, once, so it is cheap to build: it has about as many cells as
//! triangles, and is coarsened until the lists in the cells stay short in total. Triangles stay where the
//! meshes have them and are placed anew for each test.

use std::cell::Cell;

use glam::{DVec3, UVec3};

use crate::Scene;

/// Largest number of triangles, over all instances, of a scene that is examined.
const MAX_TRIANGLES: usize = 1 << 23;
/// Largest number of cells along the longest edge of the bounds.
const MAX_CELLS: u32 = 96;
/// Limits of the entries of all cell lists, per triangle and on top of that, beyond which the grid is
/// coarsened.
const ENTRIES_PER_TRIANGLE: usize = 6;
const ENTRIES_FREE: usize = 1 << 20;

/// Limit of ray-triangle tests, over all rays: about a second's worth.
const MAX_TESTS: usize = 50_000_000;

/// Hit of a ray on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// Distance in multiples of the direction's length.
    pub t: f64,
    /// True if the front side, the one seen counter-clockwise, faces the ray. Placements that mirror reverse
    /// the order of the corners, not the side.
    pub front: bool,
    /// Index into [`Scene::instances`].
    pub instance: u32,
}

/// Placed triangles of a scene, ready for rays.
pub(super) struct Sight<'a> {
    scene: &'a Scene,
    pub low: DVec3,
    pub high: DVec3,
    cells: UVec3,
    cell_size: DVec3,
    /// Triangles: instance, and triangle of its mesh.
    triangles: Vec<[u32; 2]>,
    /// Ranges of the lists: entries of cell `i` are `starts[i]..starts[i + 1]`.
    starts: Vec<u32>,
    entries: Vec<u32>,
    /// Number of tests that may still be made.
    tests_left: Cell<usize>,
}

impl<'a> Sight<'a> {
    /// Makes the grid; `None` for scenes of too many triangles or of none. `low` and `high` are the scene's
    /// bounds, with an extent on every axis.
    pub fn new(scene: &'a Scene, low: DVec3, high: DVec3) -> Option<Self> {
        let of = |mesh: usize| scene.meshes.get(mesh).map_or(0, |mesh| mesh.triangle_count());
        let count = scene.instances.iter().fold(0_usize, |sum, placed| sum.saturating_add(of(placed.mesh)));
        if count > MAX_TRIANGLES {
            tracing::debug!(count, "too many triangles to look for a room");
            return None;
        }
        let mut triangles = Vec::with_capacity(count);
        for (instance, placed) in scene.instances.iter().enumerate() {
            let triangle = |triangle: usize| [instance as u32, triangle as u32];
            triangles.extend((0..of(placed.mesh)).map(triangle));
        }
        triangles.retain(|&triangle| corners(scene, triangle).is_some());
        let extent = high - low;
        let longest = extent.max_element();
        let mut along = (triangles.len() as f64).cbrt().ceil().clamp(1.0, f64::from(MAX_CELLS)) as u32;
        let mut sight = Self {
            scene,
            low,
            high,
            cells: UVec3::ONE,
            cell_size: extent,
            triangles,
            starts: Vec::new(),
            entries: Vec::new(),
            tests_left: Cell::new(MAX_TESTS),
        };
        if sight.triangles.is_empty() {
            return None;
        }
        loop {
            let cells = (extent / longest * f64::from(along)).ceil().max(DVec3::ONE);
            sight.cells = cells.as_uvec3();
            sight.cell_size = extent / cells;
            let entries: usize = sight.triangles.iter().map(|&triangle| sight.cells_of(triangle).0).sum();
            if along == 1 || entries <= ENTRIES_PER_TRIANGLE * sight.triangles.len() + ENTRIES_FREE {
                break;
            }
            along /= 2;
        }
        sight.fill();
        Some(sight)
    }

    /// Returns the nearest hit of the ray, at distance 0 too. The origin lies in the bounds. After too many
    /// tests, as where many large triangles lie on each other, there are no more hits.
    pub fn first(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        self.first_beyond(origin, direction, 0.0)
    }

    /// Returns the nearest hit like [`Self::first`], at a distance of at least `least`.
    pub fn first_beyond(&self, origin: DVec3, direction: DVec3, least: f64) -> Option<Hit> {
        let mut cell = self.cell_at(origin);
        let mut best: Option<Hit> = None;
        loop {
            let index = self.index(cell);
            let entries = &self.entries[self.starts[index] as usize..self.starts[index + 1] as usize];
            let left = self.tests_left.get().checked_sub(entries.len());
            self.tests_left.set(left.unwrap_or(0));
            left.filter(|&left| left > 0)?;
            for &entry in entries {
                let hit = self.meet(self.triangles[entry as usize], origin, direction);
                if let Some(hit) = hit
                    && hit.t >= least
                    && best.is_none_or(|best| hit.t < best.t)
                {
                    best = Some(hit);
                }
            }
            // The next border of the cell, and the axis that it lies across.
            let mut leave = (f64::INFINITY, 0);
            for axis in 0..3 {
                let border = f64::from(cell[axis] + u32::from(direction[axis] > 0.0));
                let t = (self.low[axis] + border * self.cell_size[axis] - origin[axis]) / direction[axis];
                if direction[axis] != 0.0 && t < leave.0 {
                    leave = (t, axis);
                }
            }
            let (t, axis) = leave;
            let forward = direction[axis] > 0.0;
            let last = if forward { cell[axis] + 1 >= self.cells[axis] } else { cell[axis] == 0 };
            if t == f64::INFINITY || last || best.is_some_and(|best| best.t <= t) {
                return best;
            }
            cell[axis] = if forward { cell[axis] + 1 } else { cell[axis] - 1 };
        }
    }

    /// Returns `count` points spread evenly over the area of the surfaces, each with the unit normal of its
    /// front. There are fewer where triangles are too thin to have a normal, and none without area.
    pub fn places(&self, count: usize) -> Vec<(DVec3, DVec3)> {
        let placed = |triangle: &[u32; 2]| {
            let (points, mirrored) = corners(self.scene, *triangle).unwrap_or_default();
            let normal = (points[1] - points[0]).cross(points[2] - points[0]);
            (points, if mirrored { -normal } else { normal })
        };
        let doubled_area: f64 = self.triangles.iter().map(|triangle| placed(triangle).1.length()).sum();
        let step = doubled_area / count as f64;
        let mut places = Vec::with_capacity(count);
        let mut passed = 0.0;
        for triangle in &self.triangles {
            let ([a, b, c], normal) = placed(triangle);
            passed += normal.length();
            while places.len() < count && passed > step * (places.len() as f64 + 0.5) {
                let Some(normal) = normal.try_normalize() else { break };
                // The two numbers fill the square evenly (Roberts 2018) and are folded into the triangle.
                let [u, v] = [0.754_877_666, 0.569_840_291].map(|turn| (turn * places.len() as f64).fract());
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                let place = a + (b - a) * u + (c - a) * v;
                places.push((place.clamp(self.low, self.high), normal));
            }
        }
        places
    }

    fn fill(&mut self) {
        let cells = self.cells.as_usizevec3().element_product();
        let mut starts = vec![0_u32; cells + 1];
        for &triangle in &self.triangles {
            let (_, first, last) = self.cells_of(triangle);
            self.each_cell(first, last, |cell| starts[cell] += 1);
        }
        let mut total = 0;
        for start in &mut starts {
            total += std::mem::replace(start, total);
        }
        let mut entries = vec![0_u32; total as usize];
        let mut next = starts.clone();
        for (position, &triangle) in self.triangles.iter().enumerate() {
            let (_, first, last) = self.cells_of(triangle);
            self.each_cell(first, last, |cell| {
                entries[next[cell] as usize] = position as u32;
                next[cell] += 1;
            });
        }
        (self.starts, self.entries) = (starts, entries);
    }

    fn each_cell(&self, first: UVec3, last: UVec3, mut visit: impl FnMut(usize)) {
        for z in first.z..=last.z {
            for y in first.y..=last.y {
                for x in first.x..=last.x {
                    visit(self.index(UVec3::new(x, y, z)));
                }
            }
        }
    }

    /// Returns the number of cells that the triangle's box overlaps, and the first and the last of them.
    fn cells_of(&self, triangle: [u32; 2]) -> (usize, UVec3, UVec3) {
        let Some(([a, b, c], _)) = corners(self.scene, triangle) else { return (0, UVec3::ONE, UVec3::ZERO) };
        let (first, last) = (self.cell_at(a.min(b).min(c)), self.cell_at(a.max(b).max(c)));
        ((last - first + 1).as_usizevec3().element_product(), first, last)
    }

    fn cell_at(&self, point: DVec3) -> UVec3 {
        ((point - self.low) / self.cell_size).max(DVec3::ZERO).as_uvec3().min(self.cells - 1)
    }

    fn index(&self, cell: UVec3) -> usize {
        let (cell, cells) = (cell.as_usizevec3(), self.cells.as_usizevec3());
        (cell.z * cells.y + cell.y) * cells.x + cell.x
    }

    /// Intersects the ray with the triangle's plane within its three edges.
    fn meet(&self, triangle: [u32; 2], origin: DVec3, direction: DVec3) -> Option<Hit> {
        let ([a, b, c], mirrored) = corners(self.scene, triangle)?;
        let (to_b, to_c, from_a) = (b - a, c - a, origin - a);
        let normal = to_b.cross(to_c);
        let facing = -normal.dot(direction);
        let turn = from_a.cross(direction);
        let (u, v) = (to_c.dot(turn) / facing, -to_b.dot(turn) / facing);
        let t = normal.dot(from_a) / facing;
        // A ray in the plane divides by zero, and no comparison below holds for the result.
        let within = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t.is_finite();
        within.then_some(Hit { t, front: (facing > 0.0) != mirrored, instance: triangle[0] })
    }
}

/// Returns the placed corners, and true if the placement mirrors. `None` where an index has no vertex or a
/// coordinate is not finite.
fn corners(scene: &Scene, [instance, triangle]: [u32; 2]) -> Option<([DVec3; 3], bool)> {
    let placed = scene.instances.get(instance as usize)?;
    let mesh = scene.meshes.get(placed.mesh)?;
    let start = 3 * triangle as usize;
    let mut points = [DVec3::ZERO; 3];
    for (point, &index) in points.iter_mut().zip(mesh.indices.get(start..start + 3)?) {
        let position = mesh.positions.get(index as usize)?.map(f64::from);
        *point = placed.world_from_mesh.transform_point3(DVec3::from_array(position));
    }
    let mirrored = placed.world_from_mesh.matrix3.determinant() < 0.0;
    points.iter().all(|point| point.is_finite()).then_some((points, mirrored))
}
