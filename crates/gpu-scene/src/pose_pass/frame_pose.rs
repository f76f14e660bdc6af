//! Host's part of a pose: the data that the device gets for a frame.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use rasray_ads::GeometryRigid;
use rasray_scene::Scene;
use rasray_scene::animation::Rig;
use rasray_scene::pose::Pose;
use rasray_shaders_glsl::constants::contract::DRAW_MIRRORED;
use rasray_shaders_glsl::records::{PoseMatrix, PosePlacement, PoseTarget};

use super::sources::{DrawPlace, JointPlace, SkinPlace};
use crate::attributes::normal_matrix;
use crate::layout::{EmissiveTriangle, Light};

/// Poses of all moving parts in one frame: plain data, rounded to f32 once, for
/// [`PosePass::record`](super::PosePass::record).
#[derive(Clone, Debug, PartialEq)]
pub struct FramePose {
    pub(super) placements: Vec<PosePlacement>,
    pub(super) joints: Vec<PoseMatrix>,
    pub(super) targets: Vec<PoseTarget>,
    /// Shapes that the host deformed; see `FrameShapes`.
    pub(super) shapes: Arc<[f32]>,
    pub(super) lights: Vec<Light>,
    pub(super) emissive: Vec<EmissiveTriangle>,
    /// Power of emissive triangles, W, by luminance.
    pub(super) emissive_power: f64,
    pub(super) cameras: Vec<DAffine3>,
    /// Map of each moving part, if there are parts.
    pub(super) maps: Vec<GeometryRigid>,
}

impl FramePose {
    /// Poses of the cameras of the scene, in their order: world, metres, rigid.
    pub fn cameras(&self) -> &[DAffine3] {
        &self.cameras
    }

    /// Bytes that [`PosePass::record`](super::PosePass::record) stores in the command buffer, but for fewer
    /// than 100. Shapes do not count: see [`FramePose::shape_bytes`].
    pub fn bytes(&self) -> u64 {
        let bytes = size_of_val(&self.placements[..])
            + size_of_val(&self.joints[..])
            + size_of_val(&self.targets[..])
            + size_of_val(&self.lights[..])
            + size_of_val(&self.emissive[..])
            + size_of_val(&self.maps[..]);
        bytes as u64
    }

    /// Bytes that [`PosePass::record`](super::PosePass::record) writes to memory of the slot: positions and
    /// normals from a simulation or a file.
    pub fn shape_bytes(&self) -> u64 {
        size_of_val(&self.shapes[..]) as u64
    }
}

/// Placement of draws in a frame.
pub(super) struct Placer<'a> {
    pub scene: &'a Scene,
    /// True if the scene's rig places its instances.
    pub is_placed: bool,
    pub rig: &'a Rig,
    pub pose: &'a Pose,
    /// Frame origin, world, metres.
    pub frame_origin: DVec3,
}

impl Placer<'_> {
    /// Appends the matrices of the joints of a mesh, and returns the point to which they are relative, world,
    /// metres: a point from which single precision reaches all vertices that they move. It is the frame
    /// origin if that is no farther away than the joints are from each other, and else the mean of all
    /// vertices.
    pub fn joints(&self, place: &SkinPlace, joints: &mut Vec<PoseMatrix>) -> DVec3 {
        let skin = &self.rig.skins[place.skin];
        let step = |of: &JointPlace| {
            let joint = of.joint as usize;
            self.pose.world(skin.joints[joint]) * skin.joint_from_mesh[joint]
        };
        let moves: Vec<DAffine3> = place.joints.iter().map(step).collect();
        let weighted = place.joints.iter().zip(&moves);
        let mean: DVec3 = weighted.map(|(of, step)| of.share * step.transform_point3(of.mean)).sum();
        let reach =
            moves.iter().map(|step| step.transform_point3(place.pivot).distance(mean)).fold(0.0, f64::max);
        let is_far = mean.is_finite() && mean.distance(self.frame_origin) > reach;
        let anchor = if is_far { mean } else { self.frame_origin };
        joints.extend(
            moves.iter().map(|step| matrix(step.matrix3, step.transform_point3(place.pivot) - anchor)),
        );
        anchor
    }

    /// Returns the placement of a draw; `anchors` are those of the joints, `pivots` those of the shapes.
    /// Targets with weight are appended.
    pub fn draw(
        &self,
        place: &DrawPlace,
        (anchors, pivots): (&[DVec3], &[DVec3]),
        targets: &mut Vec<PoseTarget>,
    ) -> PosePlacement {
        let first_target = targets.len() as u32;
        targets.extend(
            place.targets.iter().zip(self.weights(place)).filter(|(_, weight)| *weight != 0.0).map(
                |(&[positions, normals, tangents], weight)| PoseTarget {
                    positions,
                    normals,
                    tangents,
                    weight: weight as f32,
                },
            ),
        );
        let target_count = targets.len() as u32 - first_target;
        // Where no target has weight, placements do not depend on those of other draws.
        let first_target = if target_count > 0 { first_target } else { 0 };
        let placement = PosePlacement { first_target, target_count, ..PosePlacement::default() };
        if let Some(skin) = place.skin {
            let offset = anchors[skin] - self.frame_origin;
            return PosePlacement { place: matrix(DMat3::IDENTITY, offset), ..placement };
        }
        let world_from_mesh = self.world_from_mesh(place.instance);
        let linear = world_from_mesh.matrix3;
        let pivot = place.shape.map_or(place.pivot, |shape| pivots[shape]);
        let offset = world_from_mesh.transform_point3(pivot) - self.frame_origin;
        let normals = matrix(of_largest_one(normal_matrix(linear)), DVec3::ZERO);
        PosePlacement {
            place: matrix(linear, offset),
            normal_x: normals.x,
            normal_y: normals.y,
            normal_z: normals.z,
            flags: if linear.determinant() < 0.0 { DRAW_MIRRORED } else { 0 },
            ..placement
        }
    }

    /// Returns the placement of an instance without joints.
    pub fn world_from_mesh(&self, instance: usize) -> DAffine3 {
        if !self.is_placed {
            return self.scene.instances[instance].world_from_mesh;
        }
        let placement = self.rig.placements[instance];
        self.pose.world(placement.node) * placement.node_from_mesh
    }

    /// Returns the weights of the morph targets of a draw.
    pub fn weights(&self, place: &DrawPlace) -> Vec<f64> {
        let Some(deformed) = place.deformed else { return Vec::new() };
        let node = self.rig.placements[place.instance].node;
        self.pose.weights_of(node, &self.rig.deformed[deformed])
    }
}

fn matrix(linear: DMat3, translation: DVec3) -> PoseMatrix {
    let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis].map(|column| column.as_vec3().to_array());
    PoseMatrix { x, y, z, translation: translation.as_vec3().to_array() }
}

/// Scales a map of directions, which have no length: a very small one would leave the range of f32.
fn of_largest_one(linear: DMat3) -> DMat3 {
    let largest = linear.to_cols_array().iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
    if largest > 0.0 { linear * largest.recip() } else { linear }
}
