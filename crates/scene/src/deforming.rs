//! Scenes that change with time: kinds of motion, and deformers of meshes without a rig.

use std::fmt::Debug;
use std::path::Path;

use crate::SceneError;
use crate::mesh::Mesh;
use crate::warning::Warning;

/// Source of meshes that change with time without a rig: a simulation, or a file for each frame.
///
/// The number of meshes, instances and materials never changes, nor do transforms of instances.
pub trait Deformer: Debug + Send + Sync {
    /// Says whether the triangles may change.
    fn topology(&self) -> Topology;

    /// Returns the time from which on nothing changes any more, seconds.
    fn duration(&self) -> f64;

    /// Returns the meshes that the deformer changes, as indices into [`Scene::meshes`](crate::Scene::meshes).
    fn meshes(&self) -> &[usize];

    /// Returns these meshes at a time, seconds; before 0 as at 0, after the end as at the end. Times in
    /// ascending order may be far cheaper than others. Equal times give equal bits.
    ///
    /// # Errors
    /// An error for a file that cannot be read, or that does not match the others.
    fn at(&self, seconds: f64) -> Result<Deformation, SceneError>;

    /// Returns the file that is shown at a time; `None` where there are no files.
    fn file(&self, _seconds: f64) -> Option<&Path> {
        None
    }
}

/// Constancy of the triangles of a mesh over time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Topology {
    /// Only [`Shape::Vertices`] occur: vertices move, triangles keep their number, order and corners.
    Fixed,
    /// Meshes may have other vertices and triangles at every time.
    Changing,
}

/// Meshes at a time.
#[derive(Clone, Debug, Default)]
pub struct Deformation {
    /// Changed meshes, each with its index into [`Scene::meshes`](crate::Scene::meshes).
    pub shapes: Vec<(usize, Shape)>,
    /// Data that was dropped or replaced in the meshes.
    pub warnings: Vec<Warning>,
}

/// Mesh at a time.
#[derive(Clone, Debug)]
pub enum Shape {
    /// New vertices, as many as before; all other data of the mesh stay.
    Vertices {
        /// Positions, metres, mesh space.
        positions: Vec<[f32; 3]>,
        /// Unit shading normals; absent means flat.
        normals: Option<Vec<[f32; 3]>>,
    },
    /// New mesh that replaces the old one.
    Mesh(Mesh),
}

impl Shape {
    pub(crate) fn apply(self, mesh: &mut Mesh) {
        match self {
            Self::Vertices { positions, normals } => {
                mesh.positions = positions;
                mesh.normals = normals;
                // The old tangents lie in the surface as it was; integrators derive new ones.
                mesh.tangents = None;
            }
            Self::Mesh(other) => *mesh = other,
        }
    }
}

/// Way in which a scene changes with time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// No change.
    Still,
    /// Change by clips of the rig; triangles keep their corners.
    Rig,
    /// Change by a [`Deformer`]; triangles keep their corners.
    Deforming,
    /// Change by a [`Deformer`]; vertices and triangles may be others at every time.
    Changing,
}

impl Motion {
    /// Name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Still => "still",
            Self::Rig => "rig",
            Self::Deforming => "deforming",
            Self::Changing => "changing",
        }
    }

    /// Description in words.
    pub fn described(self) -> &'static str {
        match self {
            Self::Still => "nothing moves",
            Self::Rig => "moved by a rig",
            Self::Deforming => "deforming, the same triangles at every time",
            Self::Changing => "deforming, other triangles at every time",
        }
    }
}
