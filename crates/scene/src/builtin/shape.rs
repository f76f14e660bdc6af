//! Simple shapes added to meshes, all counter-clockwise seen from their front.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use crate::Mesh;

/// Mesh under construction, computed in f64 and rounded to f32 once.
#[derive(Clone, Default)]
pub(super) struct Shapes {
    mesh: Mesh,
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
}

impl Shapes {
    pub fn new(name: &str, material: usize) -> Self {
        let mesh = Mesh { name: name.to_owned(), material, ..Mesh::default() };
        Self { mesh, ..Self::default() }
    }

    /// Returns the index of the material with which the mesh was made.
    pub fn material(&self) -> usize {
        self.mesh.material
    }

    /// Adds all triangles of `other`; the material stays.
    pub fn append(&mut self, other: &Self) {
        let first = self.mesh.positions.len() as u32;
        self.mesh.positions.extend(&other.mesh.positions);
        self.normals.extend(&other.normals);
        self.uvs.extend(&other.uvs);
        self.mesh.indices.extend(other.mesh.indices.iter().map(|index| first + index));
    }

    /// Adds a vertex and returns its index.
    pub fn vertex(&mut self, position: DVec3, normal: DVec3, uv: DVec2) -> u32 {
        self.mesh.positions.push(position.as_vec3().to_array());
        self.normals.push(normal.as_vec3().to_array());
        self.uvs.push(uv.as_vec2().to_array());
        (self.mesh.positions.len() - 1) as u32
    }

    pub fn triangle(&mut self, corners: [u32; 3]) {
        self.mesh.indices.extend(corners);
    }

    /// Adds a flat quad; corners counter-clockwise. Texture coordinates run from (0, 1) at the first corner
    /// to `(repeat.x, 1 - repeat.y)` at the third, so the picture stands upright on a wall whose first corner
    /// is bottom left.
    pub fn quad(&mut self, corners: [DVec3; 4], repeat: DVec2) {
        let normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalize_or(DVec3::Y);
        let uvs = [
            DVec2::new(0.0, 1.0),
            DVec2::new(repeat.x, 1.0),
            DVec2::new(repeat.x, 1.0 - repeat.y),
            DVec2::new(0.0, 1.0 - repeat.y),
        ];
        let first = self.mesh.positions.len() as u32;
        for (corner, uv) in corners.into_iter().zip(uvs) {
            self.vertex(corner, normal, uv);
        }
        self.triangle([first, first + 1, first + 2]);
        self.triangle([first, first + 2, first + 3]);
    }

    /// Adds a block between two corners, front outwards; `faces` says in the order -x +x -y +y -z +z which
    /// faces it has. Texture coordinates grow by `repeat_per_metre` along each face.
    pub fn block(&mut self, low: DVec3, high: DVec3, faces: [bool; 6], repeat_per_metre: f64) {
        let corner = |bits: usize| {
            let pick = |axis: usize| if bits >> axis & 1 == 1 { high[axis] } else { low[axis] };
            DVec3::new(pick(0), pick(1), pick(2))
        };
        // Corner numbers: bit 0 is x, bit 1 is y, bit 2 is z.
        let sides = [[0, 4, 6, 2], [5, 1, 3, 7], [0, 1, 5, 4], [6, 7, 3, 2], [1, 0, 2, 3], [4, 5, 7, 6]];
        for (side, wanted) in sides.into_iter().zip(faces) {
            if wanted {
                let corners = side.map(corner);
                let repeat = DVec2::new(corners[0].distance(corners[1]), corners[0].distance(corners[3]))
                    * repeat_per_metre;
                self.quad(corners, repeat);
            }
        }
    }

    /// Adds a patch of `columns` by `rows` quads over a function of (u, v) in [0, 1]^2 that gives position
    /// and normal. The front is on the side of d/du x d/dv; v = 0 is texture row `repeat.y`.
    pub fn patch(
        &mut self,
        columns: usize,
        rows: usize,
        repeat: DVec2,
        at: impl Fn(f64, f64) -> (DVec3, DVec3),
    ) {
        let first = self.mesh.positions.len() as u32;
        for row in 0..=rows {
            for column in 0..=columns {
                let (u, v) = (column as f64 / columns as f64, row as f64 / rows as f64);
                let (position, normal) = at(u, v);
                self.vertex(position, normal, DVec2::new(u, 1.0 - v) * repeat);
            }
        }
        let stride = columns as u32 + 1;
        for row in 0..rows as u32 {
            for column in 0..columns as u32 {
                let corner = first + row * stride + column;
                self.triangle([corner, corner + 1, corner + stride + 1]);
                self.triangle([corner, corner + stride + 1, corner + stride]);
            }
        }
    }

    /// Adds a surface of revolution about the vertical axis through `centre`. `profile` lists (radius,
    /// height) from bottom to top; the front is outside. A step of the profile is shaded flat along its
    /// height and smooth around the axis.
    pub fn lathe(&mut self, centre: DVec3, segments: usize, profile: &[(f64, f64)], repeat: DVec2) {
        let total: f64 = profile.windows(2).map(|step| length(step[0], step[1])).sum();
        let mut travelled = 0.0;
        for step in profile.windows(2) {
            let ((r0, y0), (r1, y1)) = (step[0], step[1]);
            let long = length(step[0], step[1]);
            let (v0, v1) = (travelled / total, (travelled + long) / total);
            travelled += long;
            // The direction across the step, pointing away from the axis.
            let across = DVec2::new(y1 - y0, r0 - r1).normalize_or(DVec2::X);
            let first = self.mesh.positions.len() as u32;
            for segment in 0..=segments {
                // The last ring of vertices repeats the first bit for bit: the surface stays closed.
                let turn = (segment % segments) as f64 / segments as f64;
                let u = segment as f64 / segments as f64;
                let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
                let out = DVec3::new(cos, 0.0, -sin);
                let normal = out * across.x + DVec3::Y * across.y;
                for (radius, height, v) in [(r0, y0, v0), (r1, y1, v1)] {
                    let position = centre + out * radius + DVec3::Y * height;
                    self.vertex(position, normal, DVec2::new(u, 1.0 - v) * repeat);
                }
            }
            for segment in 0..segments as u32 {
                let corner = first + 2 * segment;
                // At the axis one of the two triangles has no area.
                if r0 > 0.0 {
                    self.triangle([corner, corner + 2, corner + 3]);
                }
                if r1 > 0.0 {
                    self.triangle([corner, corner + 3, corner + 1]);
                }
            }
        }
    }

    /// Adds a copy of a unit sphere, scaled and moved, front outwards (inwards if `inside_out`).
    pub fn sphere(&mut self, unit: &Icosphere, centre: DVec3, radius: f64, inside_out: bool) {
        let first = self.mesh.positions.len() as u32;
        let facing = if inside_out { -1.0 } else { 1.0 };
        for &direction in &unit.directions {
            let u = 0.5 + direction.z.atan2(direction.x) / std::f64::consts::TAU;
            let v = direction.y.clamp(-1.0, 1.0).acos() / std::f64::consts::PI;
            self.vertex(centre + direction * radius, direction * facing, DVec2::new(u, v));
        }
        for &[a, b, c] in &unit.triangles {
            let corners = if inside_out { [a, c, b] } else { [a, b, c] };
            self.triangle(corners.map(|corner| corner + first));
        }
    }

    pub fn finish(mut self) -> Mesh {
        self.mesh.normals = Some(self.normals);
        self.mesh.uvs[0] = Some(self.uvs);
        self.mesh
    }
}

fn length(a: (f64, f64), b: (f64, f64)) -> f64 {
    (b.0 - a.0).hypot(b.1 - a.1)
}

/// Unit sphere of 20 * 4^level triangles that share vertices.
pub(super) struct Icosphere {
    pub directions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

impl Icosphere {
    /// Splits an icosahedron `level` times, each triangle into four.
    pub fn new(level: u32) -> Self {
        let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
        let mut directions = Vec::new();
        // The corners are those of three golden rectangles, one in each axis plane.
        for axis in 0..3 {
            for (long, short) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let mut corner = DVec3::ZERO;
                corner[axis] = long * golden;
                corner[(axis + 1) % 3] = short;
                directions.push(corner.normalize());
            }
        }
        let mut triangles = icosahedron_faces(&directions);
        for _ in 0..level {
            let mut middles = HashMap::with_capacity(triangles.len() * 2);
            let mut finer = Vec::with_capacity(triangles.len() * 4);
            for [a, b, c] in triangles {
                let mut middle = |from: u32, to: u32| {
                    *middles.entry((from.min(to), from.max(to))).or_insert_with(|| {
                        let between = directions[from as usize] + directions[to as usize];
                        directions.push(between.normalize());
                        (directions.len() - 1) as u32
                    })
                };
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
            }
            triangles = finer;
        }
        Self { directions, triangles }
    }
}

/// Finds all triples of mutually nearest corners, counter-clockwise from outside.
fn icosahedron_faces(corners: &[DVec3]) -> Vec<[u32; 3]> {
    // Neighbours of a corner are seen at an angle of about 63 degrees, all other corners at 116 or 180.
    let near = |a: usize, b: usize| corners[a].dot(corners[b]) > 0.4;
    let mut faces = Vec::with_capacity(20);
    for a in 0..corners.len() {
        for b in a + 1..corners.len() {
            for c in b + 1..corners.len() {
                if near(a, b) && near(b, c) && near(c, a) {
                    let outward =
                        (corners[b] - corners[a]).cross(corners[c] - corners[a]).dot(corners[a]) > 0.0;
                    let face = if outward { [a, b, c] } else { [a, c, b] };
                    faces.push(face.map(|corner| corner as u32));
                }
            }
        }
    }
    faces
}
