//! Scenes at a moment.

use crate::deforming::{Deformation, Topology};
use crate::{Moment, Motion, Scene, SceneError};

impl Scene {
    /// Returns the way in which the scene changes with time. In every case the number of instances and
    /// materials stays; [`Self::at`] may add meshes where nodes share one that they deform differently.
    pub fn motion(&self) -> Motion {
        match self.animation.deformer.as_ref().map(|deformer| deformer.topology()) {
            Some(Topology::Changing) => Motion::Changing,
            Some(Topology::Fixed) => Motion::Deforming,
            None if self.animation.rig.clips.is_empty() => Motion::Still,
            None => Motion::Rig,
        }
    }

    /// True if the scene at any moment is the scene at rest with other positions, normals and transforms, so
    /// that a device can pose it. False where vertices and triangles may be others at every time, as in
    /// numbered files, and where a deformer changes a mesh that a rig deforms as well.
    pub fn is_posed_in_place(&self) -> bool {
        let Some(deformer) = &self.animation.deformer else { return true };
        let by_rig = |mesh: &usize| self.animation.rig.deformed.iter().any(|shape| shape.mesh == *mesh);
        deformer.topology() == Topology::Fixed && !deformer.meshes().iter().any(by_rig)
    }

    /// Returns the scene at a moment: instances, cameras and lights move with their nodes, and the rig or the
    /// [`Deformer`](crate::deforming::Deformer) deforms the meshes. With a rig, or a deformer of fixed
    /// topology, triangles keep their order and number, so that ids do not depend on the time. The result can
    /// be shown at another moment in the same way. A scene without motion is returned unchanged. All other
    /// data are copied, images included: take large images out before.
    ///
    /// Positions are rounded to f32 once, relative to the mesh's place. A position that overflows is not
    /// finite: the code that places the mesh drops its triangles and counts them, as for an instance that is
    /// scaled too far. A camera or a light whose node degenerates stays where it was at rest.
    ///
    /// # Errors
    /// Errors of the deformer: a file of a sequence that cannot be read or does not match the first.
    pub fn at(&self, moment: &Moment) -> Result<Self, SceneError> {
        let mut scene = self.posed(moment);
        let Some(deformer) = self.animation.deformer.clone() else { return Ok(scene) };
        let Deformation { shapes, warnings } = deformer.at(moment.seconds)?;
        for (index, shape) in shapes {
            shape.apply(&mut scene.meshes[index]);
        }
        let before = std::mem::replace(&mut scene.animation.deformer_warnings, warnings.clone());
        scene.warnings.retain(|warning| !before.contains(warning));
        scene.warnings.extend(warnings);
        Ok(scene)
    }
}
