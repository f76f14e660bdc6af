//! Placement of every instance of a scene.

use glam::DVec3;
use rasray_scene::Scene;

use super::{
    ReferenceError,
    light_table::LightTable,
    posed::{PosedScene, check},
};

impl<'a> PosedScene<'a> {
    /// Transforms positions in f64, subtracts `frame_origin` (world, metres) and rounds once.
    ///
    /// # Errors
    /// An error if the scene refers to a mesh, material, texture, image or vertex that it does not have.
    pub fn new(scene: &'a Scene, frame_origin: DVec3) -> Result<Self, ReferenceError> {
        check(scene)?;
        let mut positions = Vec::new();
        for instance in &scene.instances {
            for position in &scene.meshes[instance.mesh].positions {
                let world = instance.world_from_mesh.transform_point3(DVec3::from(position.map(f64::from)));
                positions.push((world - frame_origin).as_vec3().to_array());
            }
        }
        Ok(Self::assemble(scene, frame_origin, positions)?.lit())
    }

    /// Makes a posed scene like [`PosedScene::new`], with positions that were posed elsewhere, such as those
    /// that a device holds: metres relative to `frame_origin`, one for each vertex of each instance in scene
    /// order.
    ///
    /// # Errors
    /// Errors of [`PosedScene::new`], and an error if the number of positions is not that of the scene.
    pub fn with_positions(
        scene: &'a Scene,
        frame_origin: DVec3,
        positions: Vec<[f32; 3]>,
    ) -> Result<Self, ReferenceError> {
        check(scene)?;
        let expected =
            scene.instances.iter().map(|instance| scene.meshes[instance.mesh].positions.len()).sum();
        if positions.len() != expected {
            return Err(ReferenceError::PositionCount { given: positions.len(), expected });
        }
        Ok(Self::assemble(scene, frame_origin, positions)?.lit())
    }

    fn lit(mut self) -> Self {
        self.lights = LightTable::new(&self);
        self
    }
}
