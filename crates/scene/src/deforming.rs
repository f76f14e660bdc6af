//! Scenes that change with time: what moves them, and what changes their meshes without a rig.

use std::fmt::Debug;
use std::path::Path;

use crate::{Mesh, Moment, Scene, SceneError, Warning};

/// Changes meshes with time where no rig does: a simulation, or a file for each frame.
///
/// The number of meshes, instances and materials never changes, nor do transforms of instances.
pub trait Deformer: Debug + Send + Sync {
    /// Whether triangles stay what they are.
    fn topology(&self) -> Topology;

    /// Seconds from which on nothing changes any more.
    fn duration(&self) -> f64;

    /// The meshes that it changes, indices into [`Scene::meshes`].
    fn meshes(&self) -> &[usize];

    /// These meshes at a time, seconds; before 0 as at 0, after the end as at the end. Times in ascending order may be
    /// far cheaper than others. The same time gives the same bits.
    ///
    /// # Errors
    /// A file that cannot be read, or that does not go with the others.
    fn at(&self, seconds: f64) -> Result<Deformation, SceneError>;

    /// The file that is shown at a time; `None` where there are no files.
    fn file(&self, _seconds: f64) -> Option<&Path> {
        None
    }
}

/// Whether the triangles of a mesh stay what they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Topology {
    /// Only [`Shape::Vertices`] are given: vertices move, triangles keep their number, order and corners.
    Fixed,
    /// Meshes may have other vertices and triangles at every time.
    Changing,
}

/// Meshes at a time.
#[derive(Clone, Debug, Default)]
pub struct Deformation {
    /// Index into [`Scene::meshes`], and the mesh then.
    pub shapes: Vec<(usize, Shape)>,
    /// What was dropped or replaced in them.
    pub warnings: Vec<Warning>,
}

/// A mesh at a time.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Everything but these stays: as many positions as before.
    Vertices {
        /// Metres, mesh space.
        positions: Vec<[f32; 3]>,
        /// Unit; absent: flat.
        normals: Option<Vec<[f32; 3]>>,
    },
    /// The whole mesh.
    Mesh(Mesh),
}

impl Shape {
    fn apply(self, mesh: &mut Mesh) {
        match self {
            Self::Vertices { positions, normals } => {
                mesh.positions = positions;
                mesh.normals = normals;
                // They lie in the surface that was; integrators derive others.
                mesh.tangents = None;
            }
            Self::Mesh(other) => *mesh = other,
        }
    }
}

/// How a scene changes with time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Not at all.
    Still,
    /// By clips of its rig; triangles stay what they are.
    Rig,
    /// By a [`Deformer`], triangles stay what they are.
    Deforming,
    /// By a [`Deformer`], and vertices and triangles may be others at every time.
    Changing,
}

impl Motion {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Still => "still",
            Self::Rig => "rig",
            Self::Deforming => "deforming",
            Self::Changing => "changing",
        }
    }

    /// What changes, in words.
    pub fn described(self) -> &'static str {
        match self {
            Self::Still => "nothing moves",
            Self::Rig => "moved by a rig",
            Self::Deforming => "deforming, the same triangles at every time",
            Self::Changing => "deforming, other triangles at every time",
        }
    }
}

impl Scene {
    /// How the scene changes with time. In every case the number of instances and materials stays; meshes may be added by
    /// [`Self::at`] where nodes share one that they deform differently.
    pub fn motion(&self) -> Motion {
        match self.animation.deformer.as_ref().map(|deformer| deformer.topology()) {
            Some(Topology::Changing) => Motion::Changing,
            Some(Topology::Fixed) => Motion::Deforming,
            None if self.animation.rig.clips.is_empty() => Motion::Still,
            None => Motion::Rig,
        }
    }

    /// The scene at a moment: instances, cameras and lights where their nodes are then, meshes deformed by the rig or by the
    /// [`Deformer`]. With a rig, or a deformer of fixed topology, triangles keep their order and number, so that ids do not
    /// depend on the time. The result can be shown at another moment in the same way. A scene that nothing moves is as it
    /// was. Everything else is copied, images included: take those out before where they are large.
    ///
    /// Positions are rounded to f32 once, relative to the mesh's place. One that overflows is not finite:
    /// whoever places it drops its triangles and counts them, as for an instance that is scaled too far. A camera or a
    /// light whose node degenerates stays where it was at rest.
    ///
    /// # Errors
    /// Those of the deformer: a file of a sequence that cannot be read or does not go with the first.
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
