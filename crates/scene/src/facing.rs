//! Areas of the surfaces of a scene along the axes, and the fragments that follow from them.

use glam::DVec3;

use crate::Scene;

/// Areas of a scene's triangles projected along the axes, in square metres. Seen along an axis, a triangle of
/// area A and unit normal n leaves fragments in proportion to A times the magnitude of n's component along
/// that axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Facing {
    /// Sum over triangles of the area seen along the axis each faces most: max|n| A.
    pub most: f64,
    /// Sum over triangles and axes: |n|_1 A.
    pub all: f64,
}

impl Facing {
    /// Computes the areas of the triangles as placed by the instances, at rest. Linear in triangles.
    pub fn of(scene: &Scene) -> Self {
        let mut facing = Self::default();
        for instance in &scene.instances {
            let Some(mesh) = scene.meshes.get(instance.mesh) else { continue };
            let corner = |index: u32| {
                let position = mesh.positions.get(index as usize)?;
                Some(instance.world_from_mesh.transform_point3(DVec3::from_array(position.map(f64::from))))
            };
            for triangle in mesh.indices.chunks_exact(3) {
                let (Some(a), Some(b), Some(c)) =
                    (corner(triangle[0]), corner(triangle[1]), corner(triangle[2]))
                else {
                    continue;
                };
                facing.add([a, b, c]);
            }
        }
        facing
    }

    /// Adds a triangle by its corners, metres. A triangle with corners that are not finite does not count.
    pub fn add(&mut self, [a, b, c]: [DVec3; 3]) {
        let areas = 0.5 * (b - a).cross(c - a).abs();
        if areas.is_finite() {
            self.most += areas.max_element();
            self.all += areas.element_sum();
        }
    }

    /// Returns the share of the fragments of three views along the axes that is saved if each triangle is
    /// kept only in the view that it faces most, in the limit of infinitely small cells: 1 - `most` / `all`,
    /// between 0 (walls along the axes) and 2/3. `None` without area.
    pub fn saved_by_one_view(self) -> Option<f64> {
        (self.all > 0.0).then(|| 1.0 - self.most / self.all)
    }
}
