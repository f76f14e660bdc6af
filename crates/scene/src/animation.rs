//! Everything needed to pose a scene at a time other than rest: nodes, clips, skins, morph targets.
//!
//! [`crate::Scene::meshes`] hold the pose at rest, [`crate::Scene::at`] makes another. The types of this
//! module hold the data as the file has them, checked: indices are in range, arrays have the lengths that the
//! fields promise, times ascend.

use glam::{DAffine3, DQuat, DVec3};

/// Nodes of a scene and the clips, skins and morph targets that move or deform them. Empty if nothing in the
/// scene can move.
#[derive(Clone, Debug, Default)]
pub struct Rig {
    /// All nodes of the file; a parent may come after its children.
    pub nodes: Vec<RigNode>,
    /// Node of each instance, in the order of [`crate::Scene::instances`].
    pub placements: Vec<Placement>,
    /// Clips in the order of [`crate::Animation::clips`].
    pub clips: Vec<Clip>,
    /// Skins of the file.
    pub skins: Vec<Skin>,
    /// Meshes that skins or morph targets deform.
    pub deformed: Vec<DeformedMesh>,
    /// Node of each camera, in the order of [`crate::Scene::cameras`].
    pub cameras: Vec<usize>,
    /// Node of each light, in the order of [`crate::Scene::lights`].
    pub lights: Vec<usize>,
}

/// Node of the graph.
#[derive(Clone, Debug, PartialEq)]
pub struct RigNode {
    /// Name from the file.
    pub name: String,
    /// Index into [`Rig::nodes`].
    pub parent: Option<usize>,
    /// Transform at rest, relative to the parent.
    pub transform: NodeTransform,
}

/// Transform of a node relative to its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NodeTransform {
    /// Scale, then rotation, then translation; each can be animated.
    Parts {
        /// Translation, metres.
        translation: DVec3,
        /// Rotation, a unit quaternion.
        rotation: DQuat,
        /// Scale factors along the axes; zero and negative ones are allowed.
        scale: DVec3,
    },
    /// Any affine map; cannot be animated.
    Matrix(DAffine3),
}

impl NodeTransform {
    /// Returns the map from the node's space to its parent's.
    pub fn to_affine(self) -> DAffine3 {
        match self {
            Self::Parts { translation, rotation, scale } => {
                DAffine3::from_scale_rotation_translation(scale, rotation, translation)
            }
            Self::Matrix(matrix) => matrix,
        }
    }
}

/// Place of an instance below a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Index into [`Rig::nodes`].
    pub node: usize,
    /// Transform of the instance itself, relative to the node. Identity unless the node has many copies.
    pub node_from_mesh: DAffine3,
}

/// Named animation.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Name from the file, or a generated one.
    pub name: String,
    /// Time of the last key, seconds.
    pub duration: f32,
    /// Channels, each of one animated property of one node.
    pub channels: Vec<Channel>,
}

/// Keys of one property of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Index into [`Rig::nodes`].
    pub node: usize,
    /// Interpolation between keys.
    pub interpolation: Interpolation,
    /// Times of the keys, seconds: at least one, finite, ascending.
    pub times: Vec<f32>,
    /// Values at the keys, one element per key; with [`Interpolation::CubicSpline`] three per key:
    /// in-tangent, value, out-tangent.
    pub values: ChannelValues,
}

/// Property that a channel animates, with its keys.
#[derive(Clone, Debug, PartialEq)]
pub enum ChannelValues {
    /// Translations, metres.
    Translation(Vec<[f32; 3]>),
    /// Rotations, quaternions x, y, z, w, as in the file.
    Rotation(Vec<[f32; 4]>),
    /// Scale factors.
    Scale(Vec<[f32; 3]>),
    /// Weights of the morph targets; an element has `targets` of them.
    Weights {
        /// Weights, element by element.
        values: Vec<f32>,
        /// Number of morph targets.
        targets: usize,
    },
}

/// Value between two keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Value of the earlier key.
    Step,
    /// Linear interpolation, on the sphere for rotations.
    Linear,
    /// Cubic Hermite spline.
    CubicSpline,
}

/// Joints that move vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Skin {
    /// Name from the file.
    pub name: String,
    /// Indices into [`Rig::nodes`].
    pub joints: Vec<usize>,
    /// Map from mesh space to each joint's space when the mesh was bound; as many as joints.
    pub joint_from_mesh: Vec<DAffine3>,
}

/// Shape of a mesh before joints and morph targets deform it. Arrays have the length of the mesh's positions
/// and hold finite numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeformedMesh {
    /// Index into [`crate::Scene::meshes`].
    pub mesh: usize,
    /// Positions of the vertices, metres, mesh space.
    pub positions: Vec<[f32; 3]>,
    /// Shading normals, not normalised.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Tangents, not normalised.
    pub tangents: Option<Vec<[f32; 4]>>,
    /// Morph targets: displacements that are added, weighted, before skinning.
    pub targets: Vec<MorphTarget>,
    /// Weight of each target at rest; as many as targets.
    pub weights: Vec<f32>,
    /// Joints and weights that move the vertices.
    pub skin: Option<SkinBinding>,
}

/// Morph target: displacements of every vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MorphTarget {
    /// Displacements of positions, metres, mesh space.
    pub positions: Option<Vec<[f32; 3]>>,
    /// Displacements of normals.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Displacements of the directions of tangents.
    pub tangents: Option<Vec<[f32; 3]>>,
}

/// Joints that move each vertex, and their weights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SkinBinding {
    /// Index into [`Rig::skins`].
    pub skin: usize,
    /// Joints per vertex: a multiple of 4.
    pub per_vertex: usize,
    /// Joints of each vertex, one vertex after the other: indices into [`Skin::joints`].
    pub joints: Vec<u32>,
    /// Weights of the joints in `joints`: not negative, with the sum 1 at each vertex.
    pub weights: Vec<f32>,
}

impl SkinBinding {
    /// Iterates over the joints of a vertex with their weights.
    pub fn of_vertex(&self, vertex: usize) -> impl Iterator<Item = (u32, f32)> {
        let range = vertex * self.per_vertex..(vertex + 1) * self.per_vertex;
        self.joints[range.clone()].iter().copied().zip(self.weights[range].iter().copied())
    }
}
