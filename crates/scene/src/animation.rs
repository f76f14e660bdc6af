//! Everything needed to pose a scene at a time other than rest: nodes, clips, skins, morph targets.
//!
//! [`crate::Scene::meshes`] hold the pose at rest, [`crate::Scene::at`] makes another. What is here is as the
//! file has it, checked: indices are in range, arrays have the lengths that the fields promise, times ascend.

use glam::{DAffine3, DQuat, DVec3};

/// Nodes and what moves or deforms along them. Empty if nothing in the scene can move.
#[derive(Clone, Debug, Default)]
pub struct Rig {
    /// All nodes of the file; a parent may come after its children.
    pub nodes: Vec<RigNode>,
    /// The node of each instance, in the order of [`crate::Scene::instances`].
    pub placements: Vec<Placement>,
    /// Clips in the order of [`crate::Animation::clips`].
    pub clips: Vec<Clip>,
    /// Skins of the file.
    pub skins: Vec<Skin>,
    /// Meshes that skins or morph targets deform.
    pub deformed: Vec<DeformedMesh>,
    /// The node of each camera, in the order of [`crate::Scene::cameras`].
    pub cameras: Vec<usize>,
    /// The node of each light, in the order of [`crate::Scene::lights`].
    pub lights: Vec<usize>,
}

/// A node of the graph.
#[derive(Clone, Debug, PartialEq)]
pub struct RigNode {
    /// Name from the file.
    pub name: String,
    /// Index into [`Rig::nodes`].
    pub parent: Option<usize>,
    /// Transform at rest, relative to the parent.
    pub transform: NodeTransform,
}

/// The transform of a node relative to its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NodeTransform {
    /// Scale, then rotation, then translation; each can be animated.
    Parts {
        /// Metres.
        translation: DVec3,
        /// Unit.
        rotation: DQuat,
        /// Factors, zero and negative ones allowed.
        scale: DVec3,
    },
    /// Any affine map; cannot be animated.
    Matrix(DAffine3),
}

impl NodeTransform {
    /// The map from the node's space to its parent's.
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
    /// The instance's own transform, relative to the node. Identity unless the node has many copies.
    pub node_from_mesh: DAffine3,
}

/// A named animation.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Name from the file, or a made-up one.
    pub name: String,
    /// Time of the last key, seconds.
    pub duration: f32,
    /// One animated property of one node each.
    pub channels: Vec<Channel>,
}

/// Keys of one property of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Index into [`Rig::nodes`].
    pub node: usize,
    /// Interpolation between keys.
    pub interpolation: Interpolation,
    /// Seconds, finite, ascending, at least one.
    pub times: Vec<f32>,
    /// One element a key; with [`Interpolation::CubicSpline`] three: in-tangent, value, out-tangent.
    pub values: ChannelValues,
}

/// Property that a channel animates, with its keys.
#[derive(Clone, Debug, PartialEq)]
pub enum ChannelValues {
    /// Metres.
    Translation(Vec<[f32; 3]>),
    /// Quaternions x, y, z, w, as in the file.
    Rotation(Vec<[f32; 4]>),
    /// Factors.
    Scale(Vec<[f32; 3]>),
    /// Weights of the morph targets, `targets` of them an element.
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
    /// The earlier key.
    Step,
    /// A straight line, on the sphere for rotations.
    Linear,
    /// A cubic Hermite spline.
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

/// The shape of a mesh before anything deforms it. Arrays have the length of the mesh's positions
/// and hold finite numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeformedMesh {
    /// Index into [`crate::Scene::meshes`].
    pub mesh: usize,
    /// Metres, mesh space.
    pub positions: Vec<[f32; 3]>,
    /// Shading normals, not normalised.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Tangents, not normalised.
    pub tangents: Option<Vec<[f32; 4]>>,
    /// Displacements that are added, weighted, before skinning.
    pub targets: Vec<MorphTarget>,
    /// Weight of each target at rest; as many as targets.
    pub weights: Vec<f32>,
    /// Joints and weights that move the vertices.
    pub skin: Option<SkinBinding>,
}

/// Displacements of every vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MorphTarget {
    /// Metres, mesh space.
    pub positions: Option<Vec<[f32; 3]>>,
    /// Added to normals.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Added to the direction of tangents.
    pub tangents: Option<Vec<[f32; 3]>>,
}

/// Joints that move each vertex, and their weights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SkinBinding {
    /// Index into [`Rig::skins`].
    pub skin: usize,
    /// Joints per vertex: a multiple of 4.
    pub per_vertex: usize,
    /// Those of one vertex after the other, indices into [`Skin::joints`].
    pub joints: Vec<u32>,
    /// Their shares: not negative, the sum of a vertex is 1.
    pub weights: Vec<f32>,
}

impl SkinBinding {
    /// Joints of a vertex with their shares.
    pub fn of_vertex(&self, vertex: usize) -> impl Iterator<Item = (u32, f32)> {
        let range = vertex * self.per_vertex..(vertex + 1) * self.per_vertex;
        self.joints[range.clone()].iter().copied().zip(self.weights[range].iter().copied())
    }
}
