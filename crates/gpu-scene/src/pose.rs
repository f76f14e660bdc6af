//! Positions and indices of every instance, in the coordinates that structures build from.

use glam::{DAffine3, DVec3};
use rasray_scene::Scene;

use crate::{GpuSceneError, layout::Draw};

/// Largest magnitude of a posed coordinate, metres: cross products of edges are then finite in f32.
pub const LARGEST_COORDINATE: f32 = rasray_shaders_glsl::constants::scene::LARGEST_COORDINATE;

/// Posed geometry of a scene, flat over instances.
///
/// Global triangle ids are running indices over draws; vertex indices run over all instances, so that
/// `indices` and `positions` suffice for a triangle.
#[derive(Clone, Debug, Default)]
pub struct Posed {
    /// World positions minus the frame origin, metres. Finite, magnitude at most
    /// [`LARGEST_COORDINATE`].
    pub positions: Vec<[f32; 3]>,
    /// Indices into `positions`, three per triangle.
    pub indices: Vec<u32>,
    /// Draws, one per instance that has triangles, in scene order.
    pub draws: Vec<Draw>,
    /// Index of each triangle's draw.
    pub draw_of_triangle: Vec<u32>,
    /// First vertex of every instance of the scene.
    pub first_vertex: Vec<u32>,
    /// Number of triangles with a vertex that is not finite or too large after its transform. They keep their
    /// id, so that ids do not depend on the pose, and are collapsed to a point, which no ray hits.
    pub dropped_triangles: u64,
    /// Smallest corner over the vertices that triangles use, metres from the frame origin. Zero
    /// where there are no triangles.
    pub lower: [f32; 3],
    /// Largest corner over the same vertices.
    pub upper: [f32; 3],
}

impl Posed {
    /// Poses every instance of `scene` in f64, subtracts `frame_origin` (world, metres) and rounds once to
    /// f32; positions that are neither moved nor shifted keep every bit. `flags` gives the draw flags of an
    /// instance from its index.
    ///
    /// # Errors
    /// `TooManyVertices` where vertices or indices exceed the range of u32, `Malformed` where the scene
    /// refers to a mesh or an index that it does not have.
    pub fn new(
        scene: &Scene,
        frame_origin: DVec3,
        flags: impl Fn(usize) -> u32,
    ) -> Result<Self, GpuSceneError> {
        let mut posed = Self::default();
        for (number, instance) in scene.instances.iter().enumerate() {
            let mesh = scene.meshes.get(instance.mesh).ok_or_else(|| GpuSceneError::Malformed {
                what: format!("instance {} names mesh {}", instance.name, instance.mesh),
                limit: scene.meshes.len(),
            })?;
            let first_vertex = index_u32(posed.positions.len(), mesh.positions.len())?;
            index_u32(posed.indices.len(), mesh.indices.len())?;
            posed.first_vertex.push(first_vertex);
            posed.positions.extend(placed(&mesh.positions, instance.world_from_mesh, frame_origin));
            posed.append_triangles(first_vertex, mesh, number, flags(number))?;
        }
        posed.collapse_bad_vertices();
        posed.measure_bounds();
        Ok(posed)
    }

    /// Returns the number of triangles, collapsed ones included.
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    fn append_triangles(
        &mut self,
        first_vertex: u32,
        mesh: &rasray_scene::Mesh,
        instance: usize,
        flags: u32,
    ) -> Result<(), GpuSceneError> {
        let triangles = mesh.triangle_count();
        if triangles == 0 {
            return Ok(());
        }
        let first_triangle = self.triangle_count() as u32;
        let vertex_end = self.positions.len() as u32;
        for triangle in mesh.indices.chunks_exact(3) {
            let corners =
                [triangle[0], triangle[1], triangle[2]].map(|index| first_vertex.saturating_add(index));
            if let Some(&bad) = corners.iter().find(|&&corner| corner >= vertex_end) {
                return Err(GpuSceneError::Malformed {
                    what: format!("a triangle of mesh {} names vertex {}", mesh.name, bad - first_vertex),
                    limit: mesh.positions.len(),
                });
            }
            if corners.iter().any(|&corner| !is_usable(self.positions[corner as usize])) {
                self.dropped_triangles += 1;
                let point = corners.iter().find(|&&corner| is_usable(self.positions[corner as usize]));
                self.indices.extend([*point.unwrap_or(&corners[0]); 3]);
            } else {
                self.indices.extend(corners);
            }
        }
        let draw = self.draws.len() as u32;
        self.draw_of_triangle.resize(self.indices.len() / 3, draw);
        self.draws.push(Draw {
            first_triangle,
            triangle_count: triangles as u32,
            instance: instance as u32,
            flags,
            ..Draw::default()
        });
        Ok(())
    }

    /// Moves bad vertices onto a good one: only collapsed triangles refer to them, and a pass that reads all
    /// positions finds only finite values.
    fn collapse_bad_vertices(&mut self) {
        let stand_in = self.positions.iter().copied().find(|&p| is_usable(p)).unwrap_or([0.0; 3]);
        for position in &mut self.positions {
            if !is_usable(*position) {
                *position = stand_in;
            }
        }
    }

    fn measure_bounds(&mut self) {
        if self.indices.is_empty() {
            return;
        }
        let (mut lower, mut upper) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for &index in &self.indices {
            let position = self.positions[index as usize];
            for axis in 0..3 {
                lower[axis] = lower[axis].min(position[axis]);
                upper[axis] = upper[axis].max(position[axis]);
            }
        }
        (self.lower, self.upper) = (lower, upper);
    }
}

/// Returns the positions of a mesh in the world, metres relative to `frame_origin`, rounded once.
pub fn placed(
    positions: &[[f32; 3]],
    world_from_mesh: DAffine3,
    frame_origin: DVec3,
) -> impl Iterator<Item = [f32; 3]> {
    let stays = world_from_mesh == DAffine3::IDENTITY && frame_origin == DVec3::ZERO;
    positions.iter().map(move |&position| {
        if stays {
            // The position keeps every bit: arithmetic would turn -0 into +0.
            return position;
        }
        let world = world_from_mesh.transform_point3(DVec3::from(position.map(f64::from)));
        (world - frame_origin).as_vec3().to_array()
    })
}

/// True if triangles with a vertex there can be hit.
pub fn is_usable(position: [f32; 3]) -> bool {
    position.iter().all(|x| x.is_finite() && x.abs() <= LARGEST_COORDINATE)
}

/// Converts `start` to u32 if `count` more elements can still be numbered.
fn index_u32(start: usize, count: usize) -> Result<u32, GpuSceneError> {
    let end = start.saturating_add(count);
    if end >= u32::MAX as usize {
        return Err(GpuSceneError::TooManyVertices { count: end as u64, limit: u64::from(u32::MAX) });
    }
    Ok(start as u32)
}
