//! Scenes that change with time: what moves them, and what changes their meshes without a rig.

use std::fmt::Debug;
use std::path::Path;

use crate::SceneError;
use crate::mesh::Mesh;
use crate::warning::Warning;

/// Changes meshes with time where no rig does: a simulation, or a file for each frame.
///
/// The number of meshes, instances and materials never changes, nor do transforms of instances.
pub trait Deformer: Debug + Send + Sync {
    /// Says whether triangles may change.
    fn topology(&self) -> Topology;

    /// Seconds from which on nothing changes any more.
    fn duration(&self) -> f64;

    /// The meshes that it changes, indices into [`Scene::meshes`](crate::Scene::meshes).
    fn meshes(&self) -> &[usize];

    /// These meshes at a time, seconds; before 0 as at 0, after the end as at the end. Times in ascending
    /// order may be far cheaper than others. The same time gives the same bits.
    ///
    /// # Errors
    /// A file that cannot be read, or that does not go with the others.
    fn at(&self, seconds: f64) -> Result<Deformation, SceneError>;

    /// The file that is shown at a time; `None` where there are no files.
    fn file(&self, _seconds: f64) -> Option<&Path> {
        None
    }
}

/// Says whether the triangles of a mesh may change with time.
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
    /// Index into [`Scene::meshes`](crate::Scene::meshes), and the mesh then.
    pub shapes: Vec<(usize, Shape)>,
    /// Data that was dropped or replaced in them.
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
    pub(crate) fn apply(self, mesh: &mut Mesh) {
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

/// The way in which a scene changes with time.
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

    /// Its description, in words.
    pub fn described(self) -> &'static str {
        match self {
            Self::Still => "nothing moves",
            Self::Rig => "moved by a rig",
            Self::Deforming => "deforming, the same triangles at every time",
            Self::Changing => "deforming, other triangles at every time",
        }
    }
}
