//! Poses of scenes at a time: clips move nodes, morph targets and joints deform meshes, all in f64 and
//! rounded once.

use std::collections::HashMap;

use glam::{DAffine3, DMat3, DQuat, DVec3, DVec4};

use crate::animation::{
    Channel, ChannelValues, DeformedMesh, Interpolation, NodeTransform, Rig, Skin, SkinBinding,
};
use crate::remarks::Remarks;
use crate::{Camera, Light, Mesh, Scene, check, time};

/// Time at which a scene is shown, and the clips that move it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moment {
    /// Seconds from the beginning of every clip. Before the first and after the last key of a channel its
    /// value is that of the key. A time that differs from a key's only by the single precision in which files
    /// hold keys is at that key.
    pub seconds: f64,
    /// Indices into [`Rig::clips`]; of two clips that animate the same property of a node the later one
    /// counts.
    pub clips: Vec<usize>,
}

impl Rig {
    /// Returns the clips that can be played at once: all but those that animate a property of a node that an
    /// earlier clip of the list animates as well, such as the gaits of a figure.
    pub fn compatible_clips(&self) -> Vec<usize> {
        let mut taken = std::collections::HashSet::new();
        let property = |channel: &Channel| (channel.node, std::mem::discriminant(&channel.values));
        (0..self.clips.len())
            .filter(|&clip| {
                let channels = &self.clips[clip].channels;
                let competes = channels.iter().any(|channel| taken.contains(&property(channel)));
                if !competes {
                    taken.extend(channels.iter().map(property));
                }
                !competes
            })
            .collect()
    }
}

/// Transforms of all nodes of a rig, and their weights of morph targets.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    /// Map from each node's space to the world.
    pub world_from_node: Vec<DAffine3>,
    /// Weights of the morph targets of each node's mesh, where a clip animates them.
    pub weights: Vec<Option<Vec<f64>>>,
}

impl Pose {
    /// Evaluates the clips at a moment. Linear in nodes and channels.
    pub fn new(rig: &Rig, moment: &Moment) -> Self {
        let mut local: Vec<NodeTransform> = rig.nodes.iter().map(|node| node.transform).collect();
        let mut weights = vec![None; rig.nodes.len()];
        let clips = moment.clips.iter().filter_map(|&clip| rig.clips.get(clip));
        for channel in clips.flat_map(|clip| &clip.channels) {
            let Some(node) = local.get_mut(channel.node) else { continue };
            let at = Between::keys(&channel.times, moment.seconds);
            if let ChannelValues::Weights { values, targets } = &channel.values {
                weights[channel.node] = Some(at.of_slices(channel.interpolation, values, *targets));
                continue;
            }
            // The format forbids animated matrices.
            let NodeTransform::Parts { translation, rotation, scale } = node else { continue };
            match &channel.values {
                ChannelValues::Translation(values) => {
                    *translation = at.of_vectors(channel.interpolation, values)
                }
                ChannelValues::Scale(values) => *scale = at.of_vectors(channel.interpolation, values),
                ChannelValues::Rotation(values) => *rotation = at.of_rotations(channel.interpolation, values),
                ChannelValues::Weights { .. } => {}
            }
        }
        Self { world_from_node: multiply(rig, &local), weights }
    }

    /// Returns the map from a node's space to the world; the identity where there is no such node.
    pub fn world(&self, node: usize) -> DAffine3 {
        self.world_from_node.get(node).copied().unwrap_or(DAffine3::IDENTITY)
    }

    /// Returns the weights of the morph targets of a mesh at a node: the animated ones, else those at rest.
    pub fn weights_of(&self, node: usize, deformed: &DeformedMesh) -> Vec<f64> {
        let animated = self.weights.get(node).cloned().flatten();
        animated.unwrap_or_else(|| deformed.weights.iter().copied().map(f64::from).collect())
    }

    /// Returns the poses of the cameras of the scene of `rig`: world, metres, rigid. A camera without a node,
    /// or whose node degenerates, stays.
    pub fn cameras(&self, rig: &Rig, at_rest: &[Camera]) -> Vec<DAffine3> {
        let nodes = rig.cameras.iter().map(|&node| Some(node)).chain(std::iter::repeat(None));
        let placed = |node: Option<usize>| node.and_then(|node| rigid(self.world(node)));
        at_rest
            .iter()
            .zip(nodes)
            .map(|(camera, node)| placed(node).unwrap_or(camera.world_from_camera))
            .collect()
    }

    /// Returns the lights of the scene of `rig`, moved with their nodes. A light without a node, or whose
    /// node degenerates, stays.
    pub fn lights(&self, rig: &Rig, at_rest: &[Light]) -> Vec<Light> {
        let mut lights = at_rest.to_vec();
        for (light, &node) in lights.iter_mut().zip(&rig.lights) {
            move_light(light, self.world(node));
        }
        lights
    }
}

/// Multiplies transforms along the forest, whose parents may come after their children.
fn multiply(rig: &Rig, local: &[NodeTransform]) -> Vec<DAffine3> {
    let mut world: Vec<Option<DAffine3>> = vec![None; local.len()];
    for start in 0..local.len() {
        let mut chain = Vec::new();
        let mut next = Some(start);
        // A forest has no cycle; a chain longer than there are nodes would be one.
        while let Some(node) = next.filter(|&node| world[node].is_none() && chain.len() < local.len()) {
            chain.push(node);
            next = rig.nodes[node].parent;
        }
        let mut above = next.and_then(|node| world[node]).unwrap_or(DAffine3::IDENTITY);
        for node in chain.into_iter().rev() {
            above *= local[node].to_affine();
            world[node] = Some(above);
        }
    }
    world.into_iter().map(|world| world.unwrap_or(DAffine3::IDENTITY)).collect()
}

/// Keys before and after a time.
struct Between {
    first: usize,
    second: usize,
    /// Share of the way from the first key to the second, 0 to 1.
    share: f64,
    /// Time between the keys, seconds.
    seconds: f64,
}

impl Between {
    fn keys(times: &[f32], seconds: f64) -> Self {
        let after = times.partition_point(|&key| time::has_come(key.into(), seconds));
        if after == 0 || after == times.len() {
            let key = after.saturating_sub(1);
            return Self { first: key, second: key, share: 0.0, seconds: 0.0 };
        }
        let (begin, end) = (f64::from(times[after - 1]), f64::from(times[after]));
        // Values past the first key lie between both.
        let share = if time::is_at(begin, seconds) { 0.0 } else { (seconds - begin) / (end - begin) };
        Self { first: after - 1, second: after, share, seconds: end - begin }
    }

    /// Returns the terms of a value that is interpolated number by number: indices into the list of elements,
    /// with their weights.
    fn terms(&self, interpolation: Interpolation) -> [(usize, f64); 4] {
        let Self { first, second, share: s, seconds } = *self;
        match interpolation {
            Interpolation::Step => [(first, 1.0), (first, 0.0), (first, 0.0), (first, 0.0)],
            Interpolation::Linear => [(first, 1.0 - s), (second, s), (first, 0.0), (first, 0.0)],
            Interpolation::CubicSpline => {
                let (s2, s3) = (s * s, s * s * s);
                [
                    (3 * first + 1, 2.0 * s3 - 3.0 * s2 + 1.0),
                    (3 * first + 2, seconds * (s3 - 2.0 * s2 + s)),
                    (3 * second + 1, 3.0 * s2 - 2.0 * s3),
                    (3 * second, seconds * (s3 - s2)),
                ]
            }
        }
    }

    fn of_vectors(&self, interpolation: Interpolation, values: &[[f32; 3]]) -> DVec3 {
        let terms = self.terms(interpolation).into_iter().filter(|(_, share)| *share != 0.0);
        terms.fold(DVec3::ZERO, |sum, (at, share)| {
            let value = values.get(at).copied().unwrap_or_default();
            sum + DVec3::from(value.map(f64::from)) * share
        })
    }

    fn of_rotations(&self, interpolation: Interpolation, values: &[[f32; 4]]) -> DQuat {
        let value = |at: usize| DVec4::from(values.get(at).copied().unwrap_or_default().map(f64::from));
        let unit = |q: DVec4| q.try_normalize().map_or(DQuat::IDENTITY, DQuat::from_vec4);
        match interpolation {
            Interpolation::Step => unit(value(self.first)),
            Interpolation::Linear => {
                unit(value(self.first)).slerp(unit(value(self.second)), self.share).normalize()
            }
            Interpolation::CubicSpline => {
                let terms = self.terms(interpolation).into_iter().filter(|(_, share)| *share != 0.0);
                unit(terms.fold(DVec4::ZERO, |sum, (at, share)| sum + value(at) * share))
            }
        }
    }

    /// Interpolates elements of `length` numbers each.
    fn of_slices(&self, interpolation: Interpolation, values: &[f32], length: usize) -> Vec<f64> {
        let terms = self.terms(interpolation);
        let number =
            |at: usize, place: usize| values.get(at * length + place).copied().map_or(0.0, f64::from);
        (0..length)
            .map(|place| {
                let terms = terms.iter().filter(|(_, share)| *share != 0.0);
                terms.map(|&(at, share)| number(at, place) * share).sum()
            })
            .collect()
    }
}

/// Transforms of joints relative to the pose in which a mesh was bound to them.
pub struct Joints<'a> {
    binding: &'a SkinBinding,
    /// Transform of each joint: from mesh space to the world.
    moves: Vec<DAffine3>,
}

impl<'a> Joints<'a> {
    /// Computes the transforms of the joints of a mesh that was bound to a skin, at the nodes' current
    /// transforms.
    pub fn new(skin: &Skin, binding: &'a SkinBinding, world_from_node: &[DAffine3]) -> Self {
        let world = |joint: usize| world_from_node.get(joint).copied().unwrap_or(DAffine3::IDENTITY);
        let moves = skin.joints.iter().zip(&skin.joint_from_mesh);
        let moves = moves.map(|(&joint, &joint_from_mesh)| world(joint) * joint_from_mesh).collect();
        Self { binding, moves }
    }

    /// Returns the weighted mean of the joints of a vertex. Weights add up to 1 but for rounding, which would
    /// be multiplied by the distance to the world's origin: so the sum is divided by the sum of the weights.
    fn of_vertex(&self, vertex: usize) -> DAffine3 {
        let (mut matrix3, mut translation, mut total) = (DMat3::ZERO, DVec3::ZERO, 0.0);
        for (joint, weight) in self.binding.of_vertex(vertex).filter(|(_, weight)| *weight > 0.0) {
            let (step, weight) = (self.moves[joint as usize], f64::from(weight));
            matrix3 += step.matrix3 * weight;
            translation += step.translation * weight;
            total += weight;
        }
        let share = if total > 0.0 { total.recip() } else { 0.0 };
        DAffine3 { matrix3: matrix3 * share, translation: translation * share }
    }
}

/// Returns the origin relative to which positions are rounded to f32, so that each keeps its digits. It is
/// the world's origin where that lies among the positions or not far away, so that they are rounded once;
/// else a point among them, on a grid of at least their size, which stays while they move a little. With
/// either origin a position is rounded by at most a unit in the last place of half their size.
fn origin_for(positions: &[DVec3]) -> DVec3 {
    let finite = positions.iter().filter(|position| position.is_finite());
    let (lower, upper) = finite.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lower, upper), position| {
        (lower.min(*position), upper.max(*position))
    });
    let (centre, half) = (0.5 * lower + 0.5 * upper, (0.5 * upper - 0.5 * lower).max_element());
    if !centre.is_finite() {
        return DVec3::ZERO;
    }
    // The spacing is a power of two above their size: points of the grid, and differences to them, are exact.
    let spacing = ((2.0 * half).log2().floor() + 1.0).exp2();
    let origin =
        if half > 0.0 && spacing.is_finite() { (centre / spacing).round() * spacing } else { centre };
    // Adding zero removes the sign of a negative zero.
    origin + DVec3::ZERO
}

/// Moves the vertices of `mesh`, which is as the file has it, by weighted targets of `deformed` and by
/// joints. Returns the place of a mesh that joints move; as the format asks, the transform of the node that
/// holds the mesh plays no part.
pub fn deform(
    mesh: &mut Mesh,
    deformed: &DeformedMesh,
    weights: &[f64],
    joints: Option<&Joints<'_>>,
) -> Option<DAffine3> {
    type Displacements = Option<Vec<[f32; 3]>>;
    let shown: Vec<_> = deformed.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0).collect();
    let morphed =
        |of: fn(&crate::animation::MorphTarget) -> &Displacements, vertex: usize, from: [f32; 3]| {
            shown.iter().fold(DVec3::from(from.map(f64::from)), |sum, (target, weight)| {
                let displacement = of(target).as_ref().and_then(|list| list.get(vertex));
                displacement.map_or(sum, |by| sum + DVec3::from(by.map(f64::from)) * **weight)
            })
        };
    // A mesh without deformation keeps every bit.
    let is_still = shown.is_empty();
    if is_still && joints.is_none() {
        return None;
    }
    let mut positions = Vec::with_capacity(mesh.positions.len());
    for vertex in 0..mesh.positions.len() {
        let moved = joints.map(|joints| joints.of_vertex(vertex));
        let position = morphed(|target| &target.positions, vertex, mesh.positions[vertex]);
        positions.push(moved.map_or(position, |moved| moved.transform_point3(position)));
        if let Some(normal) = mesh.normals.as_mut().and_then(|normals| normals.get_mut(vertex)) {
            let turned = morphed(|target| &target.normals, vertex, *normal);
            let turned = moved.map_or(turned, |moved| cofactors(moved.matrix3) * turned);
            *normal = turned.normalize_or_zero().as_vec3().to_array();
        }
        if let Some([x, y, z, _]) = mesh.tangents.as_mut().and_then(|tangents| tangents.get_mut(vertex)) {
            let turned = morphed(|target| &target.tangents, vertex, [*x, *y, *z]);
            let turned = moved.map_or(turned, |moved| moved.matrix3 * turned);
            [*x, *y, *z] = turned.normalize_or_zero().as_vec3().to_array();
        }
    }
    let origin = joints.map(|_| origin_for(&positions));
    for (rounded, position) in mesh.positions.iter_mut().zip(positions) {
        *rounded = (position - origin.unwrap_or_default()).as_vec3().to_array();
    }
    keep_attributes(mesh, deformed);
    origin.map(DAffine3::from_translation)
}

/// Gives a mesh that is flattened to zero size the normals and tangents of its undeformed shape. Its own have
/// no direction and are not visible, and the mesh has its own again as soon as it has a size.
fn keep_attributes(mesh: &mut Mesh, deformed: &DeformedMesh) {
    if (deformed.normals.is_some() || deformed.tangents.is_some()) && check::is_flattened(mesh) {
        mesh.normals.clone_from(&deformed.normals);
        mesh.tangents.clone_from(&deformed.tangents);
    }
}

/// Returns the matrix that transforms normals, for any sign of the determinant; for a mirrored map it also
/// flips them back to the side that the winding has.
fn cofactors(matrix: DMat3) -> DMat3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let side = if matrix.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * side
}

/// Returns the rigid map with the position, view direction and up direction of a node: the pose of a camera
/// at it. `None` where the node is degenerate.
pub fn rigid(world: DAffine3) -> Option<DAffine3> {
    let back = world.matrix3.z_axis.try_normalize()?;
    let right = world.matrix3.y_axis.try_normalize()?.cross(back).try_normalize()?;
    let up = back.cross(right);
    let rigid = DAffine3 { matrix3: DMat3::from_cols(right, up, back), translation: world.translation };
    rigid.is_finite().then_some(rigid)
}

/// Returns the direction in which a light at a node shines.
pub fn light_direction(world: DAffine3) -> Option<DVec3> {
    world.transform_vector3(DVec3::NEG_Z).try_normalize()
}

impl Scene {
    /// Returns the scene with the elements of its rig at a moment; a scene without a rig is unchanged. See
    /// [`Self::at`].
    pub(crate) fn posed(&self, moment: &Moment) -> Self {
        let rig = &self.animation.rig;
        let mut scene = self.clone();
        if rig.placements.len() != self.instances.len() {
            return scene;
        }
        let pose = Pose::new(rig, moment);
        let mut deformed_of = vec![None; self.meshes.len()];
        for deformed in &rig.deformed {
            deformed_of[deformed.mesh] = Some(deformed);
        }
        // Nodes with other weights show other meshes; the first one takes the place of the mesh at rest.
        let mut made: HashMap<(usize, Vec<u64>), (usize, Option<DAffine3>)> = HashMap::new();
        let mut is_replaced = vec![false; self.meshes.len()];
        for (instance, placement) in scene.instances.iter_mut().zip(&rig.placements) {
            let mut placed = pose.world(placement.node) * placement.node_from_mesh;
            if let Some(deformed) = deformed_of[instance.mesh] {
                let weights = pose.weights_of(placement.node, deformed);
                let key = (instance.mesh, weights.iter().map(|weight| weight.to_bits()).collect());
                let (mesh, skinned) = *made.entry(key).or_insert_with(|| {
                    let (mesh, place) =
                        posed_mesh(&self.meshes[instance.mesh], deformed, &weights, rig, &pose);
                    let index = if std::mem::replace(&mut is_replaced[instance.mesh], true) {
                        // The node has a mesh of its own from now on, so that the result can be posed again.
                        let mesh_index = scene.meshes.len();
                        scene.meshes.push(mesh);
                        scene
                            .animation
                            .rig
                            .deformed
                            .push(DeformedMesh { mesh: mesh_index, ..deformed.clone() });
                        mesh_index
                    } else {
                        scene.meshes[instance.mesh] = mesh;
                        instance.mesh
                    };
                    (index, place)
                });
                instance.mesh = mesh;
                placed = skinned.unwrap_or(placed);
            }
            instance.world_from_mesh = placed;
        }
        for (camera, place) in scene.cameras.iter_mut().zip(pose.cameras(rig, &self.cameras)) {
            camera.world_from_camera = place;
        }
        scene.lights = pose.lights(rig, &self.lights);
        scene.warn_while_playing(&moment.clips);
        scene
    }
}

/// Deforms a mesh and brings its attributes into the state that [`Mesh`] promises; also returns its place if
/// joints move it.
pub fn posed_mesh(
    at_rest: &Mesh,
    deformed: &DeformedMesh,
    weights: &[f64],
    rig: &Rig,
    pose: &Pose,
) -> (Mesh, Option<DAffine3>) {
    let mut mesh = Mesh {
        positions: deformed.positions.clone(),
        normals: deformed.normals.clone(),
        tangents: deformed.tangents.clone(),
        ..at_rest.clone()
    };
    let joints = deformed
        .skin
        .as_ref()
        .and_then(|binding| Some(Joints::new(rig.skins.get(binding.skin)?, binding, &pose.world_from_node)));
    let placed = deform(&mut mesh, deformed, weights, joints.as_ref());
    // Faults of the file were reported when it was read.
    check::clean_attributes(&mut mesh, &mut Remarks::default());
    (mesh, placed)
}

/// Moves a light to its node; a light whose node degenerates stays.
fn move_light(light: &mut Light, world: DAffine3) {
    let (place, way) = (world.translation, light_direction(world));
    if !place.is_finite() {
        return;
    }
    match light {
        Light::Point { position, .. } => *position = place,
        Light::Directional { direction, .. } => *direction = way.unwrap_or(*direction),
        Light::Spot { position, direction, .. } => {
            *position = place;
            *direction = way.unwrap_or(*direction);
        }
    }
}
