//! Shapes at rest of all moving draws, packed as the device reads them.

use std::collections::{BTreeMap, HashMap};

use glam::DVec3;
use rasray_scene::animation::{DeformedMesh, Rig, SkinBinding};
use rasray_scene::{Mesh, Scene};
use rasray_shaders_glsl::constants::scene::ATTRIBUTE_NONE;
use rasray_shaders_glsl::records::{PoseDraw, PoseGroup};

use super::moving::Moving;
use super::pivot::{centre, relative};
use super::shapes::ShapePlace;
use crate::{GpuSceneError, SceneTables, words::Words};

/// Number of threads of a workgroup of `scene/pose_vertices`.
const VERTICES_PER_GROUP: u32 = 64;

/// Moving draws, and the tables that hold their shapes.
pub struct Sources {
    /// Record of each draw that the device reads.
    pub draws: Vec<PoseDraw>,
    /// Record of each draw that the host reads.
    pub places: Vec<DrawPlace>,
    /// Vertices that each workgroup poses.
    pub groups: Vec<PoseGroup>,
    /// Meshes with moving joints.
    pub skins: Vec<SkinPlace>,
    /// Meshes that a deformer changes.
    pub shapes: Vec<ShapePlace>,
    /// Number of joint matrices of a frame.
    pub joint_count: usize,
    /// Largest number of morph targets that a frame can show.
    pub target_count: usize,
    pub rest_positions: Words,
    pub rest_attributes: Words,
    pub skin_words: Vec<u32>,
    pub displacements: Words,
}

/// Placement of a draw.
#[derive(Clone, Debug)]
pub struct DrawPlace {
    /// Index into the draws of the geometry.
    pub draw: usize,
    pub instance: usize,
    /// Index of the first vertex, in the geometry.
    pub first_vertex: u32,
    /// Pivot of the positions at rest, mesh space, metres.
    pub pivot: DVec3,
    /// Index into the skins of the sources.
    pub skin: Option<usize>,
    /// Index into the deformed meshes of the rig.
    pub deformed: Option<usize>,
    /// Index into the shapes of the sources, if any; the pivot is then that of the frame's shape.
    pub shape: Option<usize>,
    /// Words of the displacements of each morph target: positions, normals, tangents.
    pub targets: Vec<[u32; 3]>,
    /// Node of the rig that alone moves the draw; absent if the draw deforms.
    pub carrier: Option<usize>,
}

/// Joints of a mesh and their place among the joint matrices. Each mesh has its own, so that the bindings of
/// other meshes of a skin cost it no digits.
#[derive(Clone, Debug)]
pub struct SkinPlace {
    /// Index into the skins of the rig.
    pub skin: usize,
    /// Index into the deformed meshes of the rig.
    deformed: usize,
    /// Joints with weight, in ascending order.
    pub joints: Vec<JointPlace>,
    /// Pivot of the positions, mesh space, metres.
    pub pivot: DVec3,
    /// Index of the matrix of the first of `joints`.
    pub first_joint: u32,
}

/// Joint with its share of the weights of a mesh, and the mean position of its vertices.
#[derive(Clone, Copy, Debug)]
pub struct JointPlace {
    /// Index into the joints of the skin.
    pub joint: u32,
    /// Share of the sum of the weights of all vertices; the shares of all joints add up to 1.
    pub share: f64,
    /// Mean of the positions, weighted by the joint's weights: mesh space, metres.
    pub mean: DVec3,
}

impl JointPlace {
    /// Returns the joints with weight, in ascending order.
    fn all(shape: &DeformedMesh, binding: &SkinBinding) -> Vec<Self> {
        let mut sums: BTreeMap<u32, (f64, DVec3)> = BTreeMap::new();
        for (vertex, position) in shape.positions.iter().enumerate() {
            let position = DVec3::from(position.map(f64::from));
            for (joint, weight) in binding.of_vertex(vertex).filter(|(_, weight)| *weight > 0.0) {
                let (sum, places) = sums.entry(joint).or_default();
                *sum += f64::from(weight);
                *places += f64::from(weight) * position;
            }
        }
        let total: f64 = sums.values().map(|(sum, _)| sum).sum();
        let of = |(joint, (sum, places))| Self { joint, share: sum / total, mean: places / sum };
        sums.into_iter().map(of).collect()
    }
}

/// Words of a mesh that several instances may show.
#[derive(Clone)]
struct MeshWords {
    rest_positions: u32,
    rest_normals: u32,
    rest_tangents: u32,
    skin: u32,
    targets: Vec<[u32; 3]>,
}

impl Sources {
    /// Packs the movable parts of the draws of `tables`, which were made from `scene`.
    ///
    /// # Errors
    /// `TooManyVertices` where 32-bit word offsets do not reach, `DeformedTwice`.
    pub fn new(scene: &Scene, tables: &SceneTables, moving: &Moving) -> Result<Self, GpuSceneError> {
        let rig = &scene.animation.rig;
        let mut sources = Self {
            draws: Vec::new(),
            places: Vec::new(),
            groups: Vec::new(),
            skins: Vec::new(),
            shapes: Vec::new(),
            joint_count: 0,
            target_count: 0,
            rest_positions: Words::stored(),
            rest_attributes: Words::stored(),
            skin_words: Vec::new(),
            displacements: Words::stored(),
        };
        let mut deformed_of = vec![None; scene.meshes.len()];
        for (index, deformed) in rig.deformed.iter().enumerate() {
            deformed_of[deformed.mesh] = Some(index);
        }
        let mut packed: HashMap<usize, MeshWords> = HashMap::new();
        let given = scene.animation.deformer.iter().flat_map(|deformer| deformer.meshes());
        let shape_meshes: Vec<usize> = given.copied().filter(|&mesh| mesh < scene.meshes.len()).collect();
        if let Some(mesh) = shape_meshes.iter().find(|&&mesh| deformed_of[mesh].is_some()) {
            let mesh = scene.meshes[*mesh].name.clone();
            return Err(GpuSceneError::DeformedTwice { scene: scene.name.clone(), mesh });
        }
        let mut shape_words = vec![[ATTRIBUTE_NONE; 2]; shape_meshes.len()];
        for (draw, record) in tables.posed.draws.iter().enumerate() {
            let instance = record.instance as usize;
            let mesh_index = scene.instances[instance].mesh;
            let own_shape = shape_meshes.iter().position(|&mesh| mesh == mesh_index);
            let (mesh, deformed) = (&scene.meshes[mesh_index], deformed_of[mesh_index]);
            let shape = deformed.map(|deformed| &rig.deformed[deformed]);
            let placement = rig.placements.get(instance);
            let is_moved = placement.is_some_and(|placement| moving.instance(rig, placement.node, shape));
            if !is_moved && own_shape.is_none() {
                continue;
            }
            let binding = shape.and_then(|shape| shape.skin.as_ref());
            let skin = binding.filter(|binding| binding.skin < rig.skins.len());
            let skin_index =
                skin.zip(deformed).map(|(binding, deformed)| sources.skin(rig, deformed, binding));
            let pivot = match skin_index {
                Some(skin) => sources.skins[skin].pivot,
                None => centre([shape.map_or(&mesh.positions[..], |shape| &shape.positions)]),
            };
            let shading = &tables.draw_shadings[draw];
            let is_shaded = [shading.normals, shading.tangents].map(|word| word != ATTRIBUTE_NONE);
            let words = match packed.get(&mesh_index) {
                Some(words) => words.clone(),
                None => {
                    let skin = skin.zip(skin_index);
                    let words = sources.mesh(mesh, shape, skin, pivot, (is_shaded, own_shape.is_some()))?;
                    if let Some(own) = own_shape {
                        shape_words[own] = [words.rest_positions, words.rest_normals];
                    }
                    packed.insert(mesh_index, words.clone());
                    words
                }
            };
            let vertex_count = mesh.positions.len() as u32;
            let pose_draw = sources.draws.len() as u32;
            let firsts = (0..vertex_count).step_by(VERTICES_PER_GROUP as usize);
            sources.groups.extend(firsts.map(|first_vertex| PoseGroup { draw: pose_draw, first_vertex }));
            let posed = |rest: u32, posed: u32| if rest == ATTRIBUTE_NONE { ATTRIBUTE_NONE } else { posed };
            sources.draws.push(PoseDraw {
                draw: draw as u32,
                first_vertex: shading.first_vertex,
                vertex_count,
                rest_positions: words.rest_positions,
                rest_normals: words.rest_normals,
                rest_tangents: words.rest_tangents,
                normals: posed(words.rest_normals, shading.normals),
                tangents: posed(words.rest_tangents, shading.tangents),
                skin: words.skin,
                joints_per_vertex: skin.map_or(0, |binding| binding.per_vertex as u32),
                first_joint: skin_index.map_or(0, |skin| sources.skins[skin].first_joint),
            });
            sources.target_count += words.targets.len();
            sources.places.push(DrawPlace {
                draw,
                instance,
                first_vertex: shading.first_vertex,
                pivot,
                skin: skin_index,
                deformed,
                shape: own_shape,
                targets: words.targets,
                carrier: placement
                    .filter(|_| deformed.is_none() && own_shape.is_none())
                    .and_then(|placement| moving.carrier(placement.node)),
            });
        }
        let shapes = shape_meshes.into_iter().zip(shape_words);
        sources.shapes = shapes.map(|(mesh, words)| ShapePlace::new(scene, mesh, words)).collect();
        Ok(sources)
    }

    /// Returns the place of the joints of a mesh, which is assigned at the first call.
    fn skin(&mut self, rig: &Rig, deformed: usize, binding: &SkinBinding) -> usize {
        if let Some(known) = self.skins.iter().position(|place| place.deformed == deformed) {
            return known;
        }
        let shape = &rig.deformed[deformed];
        let joints = JointPlace::all(shape, binding);
        let first_joint = self.joint_count as u32;
        self.joint_count += joints.len();
        let pivot = centre([&shape.positions[..]]);
        self.skins.push(SkinPlace { skin: binding.skin, deformed, joints, pivot, first_joint });
        self.skins.len() - 1
    }

    /// Packs a mesh, with normals and tangents if `is_shaded` asks for them. Tangents of a mesh that a
    /// deformer changes would lie in the old surface: without a direction, shading derives one.
    fn mesh(
        &mut self,
        mesh: &Mesh,
        shape: Option<&DeformedMesh>,
        skin: Option<(&SkinBinding, usize)>,
        pivot: DVec3,
        (is_shaded, is_deforming): ([bool; 2], bool),
    ) -> Result<MeshWords, GpuSceneError> {
        let (positions, normals, tangents) = match shape {
            Some(shape) => (&shape.positions, &shape.normals, &shape.tangents),
            None => (&mesh.positions, &mesh.normals, &mesh.tangents),
        };
        let from_pivot = positions.iter().map(|position| relative(position, pivot));
        let rest_positions = append(&mut self.rest_positions, Some(from_pivot))?;
        let rest = &mut self.rest_attributes;
        let normals = normals.as_ref().filter(|_| is_shaded[0]);
        let rest_normals = append(rest, normals.map(|list| list.iter().copied()))?;
        let tangents = tangents.as_ref().filter(|_| is_shaded[1]);
        let signed = |&[x, y, z, w]: &[f32; 4]| {
            let [x, y, z] = if is_deforming { [0.0; 3] } else { [x, y, z] };
            [x, y, z, if w < 0.0 { -1.0 } else { 1.0 }]
        };
        let rest_tangents = append(rest, tangents.map(|list| list.iter().map(signed)))?;
        let mut targets = Vec::new();
        for target in shape.iter().flat_map(|shape| &shape.targets) {
            let of = |list: &Option<Vec<[f32; 3]>>, is_used: bool, table: &mut Words| {
                append(table, list.as_ref().filter(|_| is_used).map(|list| list.iter().copied()))
            };
            targets.push([
                of(&target.positions, true, &mut self.displacements)?,
                of(&target.normals, rest_normals != ATTRIBUTE_NONE, &mut self.displacements)?,
                of(&target.tangents, rest_tangents != ATTRIBUTE_NONE, &mut self.displacements)?,
            ]);
        }
        let skin = match skin {
            Some((binding, place)) => self.append_skin(binding, place)?,
            None => ATTRIBUTE_NONE,
        };
        Ok(MeshWords { rest_positions, rest_normals, rest_tangents, skin, targets })
    }

    /// Appends for each vertex its joints, by their index among those with weight, then their weights, whose
    /// sum is 1 but for the rounding of each.
    fn append_skin(&mut self, binding: &SkinBinding, place: usize) -> Result<u32, GpuSceneError> {
        let first = self.skin_words.len();
        let (count, limit) = (first as u64 + 2 * binding.joints.len() as u64, u64::from(ATTRIBUTE_NONE));
        if count >= limit {
            return Err(GpuSceneError::TooManyVertices { count, limit });
        }
        let joints = &self.skins[place].joints;
        let position = |joint: &u32| joints.binary_search_by_key(joint, |own| own.joint).unwrap_or(0) as u32;
        let width = binding.per_vertex.max(1);
        for (joints, weights) in binding.joints.chunks(width).zip(binding.weights.chunks(width)) {
            let sum: f64 = weights.iter().copied().map(f64::from).sum();
            let share = |weight: &f32| if sum > 0.0 { (f64::from(*weight) / sum) as f32 } else { 0.0 };
            self.skin_words.extend(joints.iter().map(position));
            self.skin_words.extend(weights.iter().map(|weight| share(weight).to_bits()));
        }
        Ok(first as u32)
    }
}

fn append<const N: usize>(
    table: &mut Words,
    values: Option<impl ExactSizeIterator<Item = [f32; N]>>,
) -> Result<u32, GpuSceneError> {
    let Some(values) = values else { return Ok(ATTRIBUTE_NONE) };
    table.append(values.len() * N, || values.flatten())
}
