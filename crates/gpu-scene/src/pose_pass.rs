//! Pass that poses the moving parts of a scene on the device, frame by frame.

mod emitters;
mod far_lights;
mod frame_pose;
mod moving;
mod moving_triangles;
mod pivot;
mod rigid;
mod shapes;
mod sources;

use std::mem::offset_of;

use bytemuck::{NoUninit, bytes_of, cast_slice};
use glam::DVec3;
use rasray_ads::kit::folded;
use rasray_ads::{BoundsPass, Geometry, GeometryParts, NO_MAP, Rest};
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferUsage, ComputePipeline, ComputePipelineDesc, Device,
    MemoryLocation, Recorder, Stage,
};
use rasray_scene::{Moment, Scene, pose::Pose};
use rasray_shaders_glsl::SCENE_POSE_VERTICES;
use rasray_shaders_glsl::records::{PoseMatrix, PosePlacement, PoseTarget};

pub use self::frame_pose::FramePose;

use self::emitters::Emitters;
use self::far_lights::FarLights;
use self::frame_pose::Placer;
use self::moving::Moving;
use self::moving_triangles::{DrawTriangles, MovingTriangles};
use self::rigid::RigidObject;
use self::shapes::Shapes;
use self::sources::{DrawPlace, SkinPlace, Sources};
use crate::layout::{EmissiveTriangle, Frame};
use crate::lights::pack_lights;
use crate::staging::Staging;
use crate::upload::PosedBuffers;
use crate::{GpuScene, GpuSceneError, SceneTables, kinds::kind_shares};

/// Largest number of bytes that one command writes.
const UPDATE_BYTES: usize = 65_536;

/// Moving part of a scene on the device: shapes at rest, and the pass that writes positions, normals,
/// tangents, lights and bounds of a [`GpuScene`] for a frame.
///
/// Draws that no clip can move and no deformer changes keep the values of the tables. `docs/motion.md` says
/// which parts the host and the device evaluate.
#[derive(Debug)]
pub struct PosePass {
    /// Flags, one per draw of the geometry: true for moving draws.
    moving_draws: Vec<bool>,
    draws: Vec<DrawTriangles>,
    places: Vec<DrawPlace>,
    skins: Vec<SkinPlace>,
    shapes: Shapes,
    instance_count: usize,
    /// True if the rig of the scene places its instances.
    is_placed: bool,
    joint_count: usize,
    group_count: u64,
    frame_origin: DVec3,
    emitters: Emitters,
    lights_move: bool,
    /// Power of lights without extent, W, if none of them shines from far away.
    punctual_power: Option<f64>,
    vertices: ComputePipeline,
    set: BindingSet,
    placements: Buffer,
    joints: Buffer,
    targets: Buffer,
    geometry: Geometry,
    staging: Staging,
    bounds: BoundsPass,
    /// Parts of the geometry, if only the bounds of the moving ones are measured.
    parts: Option<Division>,
    far_lights: Option<FarLights>,
    posed: PosedBuffers,
    bytes_by_part: Vec<(&'static str, u64)>,
}

impl PosePass {
    /// Uploads the shapes of moving parts and makes the pipelines, with memory for one frame at a time
    /// ([`PosePass::set_slots`]). `tables` were made from `scene`, `gpu` from `tables`; the images of the
    /// scene are not read. The call does not wait if `gpu` was [staged](GpuScene::staged).
    ///
    /// # Errors
    /// `Malformed` where the tables belong to a scene with other instances, [`GpuSceneError::DeformedTwice`],
    /// out of memory, more words than 32 bits can number, a table larger than one binding can hold (the error
    /// names it), or a lost device.
    pub fn new(
        device: &Device,
        scene: &Scene,
        tables: &SceneTables,
        gpu: &GpuScene,
    ) -> Result<Self, GpuSceneError> {
        let rig = &scene.animation.rig;
        if tables.posed.first_vertex.len() != scene.instances.len() {
            let what = format!("tables of {} instances are to be posed", tables.posed.first_vertex.len());
            return Err(GpuSceneError::Malformed { what, limit: scene.instances.len() });
        }
        let moving = Moving::of(rig);
        // The rule is that of `Scene::at`: a rig that does not fit its scene moves nothing.
        let is_placed = rig.placements.len() == scene.instances.len();
        let nothing = Moving::of(&Default::default());
        let sources = Sources::new(scene, tables, if is_placed { &moving } else { &nothing })?;
        let mut moving_draws = vec![false; tables.posed.draws.len()];
        sources.places.iter().for_each(|place| moving_draws[place.draw] = true);
        let draws = DrawTriangles::all(&tables.posed);
        let posed = gpu.posed_buffers().clone();
        let geometry = gpu.geometry().clone();
        let emitters = Emitters::new(tables, &sources.places);
        let lights_move = is_placed
            && !tables.lights.is_empty()
            && rig.lights.iter().take(scene.lights.len()).any(|&node| moving.node(node));
        let may_change = !sources.places.is_empty();
        let far_lights = if may_change { FarLights::new(device, scene, tables, gpu)? } else { None };
        let (punctual_power, _) = pack_lights(&scene.lights, tables.frame_origin, 0.0);

        let mut parts = Parts { device, staging: gpu.staging(), bytes_by_part: Vec::new() };
        let shaped = !sources.shapes.is_empty();
        let rest_positions =
            parts.shape_table("rest positions", &sources.rest_positions.into_vec(), shaped)?;
        let rest_attributes =
            parts.shape_table("rest attributes", &sources.rest_attributes.into_vec(), shaped)?;
        let rest = [rest_positions.clone(), rest_attributes.clone()];
        let shapes = Shapes::new(device, scene, sources.shapes, rest)?;
        let placements = parts.frame_buffer::<PosePlacement>("pose placements", sources.draws.len())?;
        let joints = parts.frame_buffer::<PoseMatrix>("pose joints", sources.joint_count)?;
        let targets = parts.frame_buffer::<PoseTarget>("pose targets", sources.target_count)?;
        let buffers = [
            parts.table("pose groups", &sources.groups)?,
            parts.table("pose draws", &sources.draws)?,
            placements.clone(),
            joints.clone(),
            targets.clone(),
            rest_positions,
            rest_attributes,
            parts.table("pose skins", &sources.skin_words)?,
            parts.table("pose displacements", &sources.displacements.into_vec())?,
            geometry.desc().positions.buffer.clone(),
            posed.attributes.clone(),
            posed.draw_shadings.clone(),
            geometry.desc().draws.buffer.clone(),
        ];
        let layout = device.create_set_layout("pose", buffers.len() as u32)?;
        let set = device.create_binding_set(&layout, "pose", &buffers.each_ref())?;
        let vertices = device.create_compute_pipeline(&ComputePipelineDesc {
            name: SCENE_POSE_VERTICES.name,
            module: &SCENE_POSE_VERTICES.module(),
            sets: &[&layout],
            push_constant_bytes: 0,
            constants: &[],
        })?;
        let mut bytes_by_part = parts.bytes_by_part;
        bytes_by_part.extend(far_lights.iter().map(FarLights::bytes));
        Ok(Self {
            moving_draws,
            draws,
            places: sources.places,
            skins: sources.skins,
            shapes,
            is_placed,
            instance_count: scene.instances.len(),
            joint_count: sources.joint_count,
            group_count: sources.groups.len() as u64,
            frame_origin: tables.frame_origin,
            emitters,
            lights_move,
            punctual_power: (!tables.lights.is_empty()).then_some(punctual_power),
            vertices,
            set,
            placements,
            joints,
            targets,
            geometry,
            staging: gpu.staging().clone(),
            bounds: BoundsPass::new(device)?,
            parts: None,
            far_lights,
            posed,
            bytes_by_part,
        })
    }

    /// Reserves memory for the shapes of that many frames in flight, at least 1: the shapes that a simulation
    /// or a file gives for a frame are written there. No recording made before may be pending.
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_slots(&mut self, device: &Device, slots: u32) -> Result<(), GpuSceneError> {
        Ok(self.shapes.set_slots(device, slots)?)
    }

    /// Computes the host's part of a frame, in f64. The time is linear in nodes, channels, joints and moving
    /// draws, in the triangles of emissive draws among them, and in the vertices that the scene's deformer
    /// changes; its simulation is run or its file read here. No device call is made. `scene` is the one that
    /// this pass was made from, or that scene at another moment.
    ///
    /// # Errors
    /// `Malformed` where the scene has fewer instances, [`GpuSceneError::OtherTriangles`] where a deformer
    /// changes more than positions and normals, or an error of the deformer.
    pub fn frame(&self, scene: &Scene, moment: &Moment) -> Result<FramePose, GpuSceneError> {
        let rig = &scene.animation.rig;
        let is_placed = rig.placements.len() == scene.instances.len();
        let is_same = scene.instances.len() == self.instance_count
            && (is_placed == self.is_placed || self.places.is_empty());
        if !is_same {
            let what = format!("a pose of {} instances was asked for", self.instance_count);
            return Err(GpuSceneError::Malformed { what, limit: scene.instances.len() });
        }
        let pose = Pose::new(rig, moment);
        let placer = Placer { scene, is_placed, rig, pose: &pose, frame_origin: self.frame_origin };
        let shapes = self.shapes.at(moment.seconds)?;
        let (mut joints, mut targets) = (Vec::with_capacity(self.joint_count), Vec::new());
        let anchors: Vec<DVec3> = self.skins.iter().map(|skin| placer.joints(skin, &mut joints)).collect();
        let placements = self
            .places
            .iter()
            .map(|place| placer.draw(place, (&anchors, &shapes.pivots), &mut targets))
            .collect();
        let lights = if self.lights_move {
            let disk = crate::kinds::disk_of(self.geometry.bounds()[0], self.geometry.bounds()[1]);
            pack_lights(&pose.lights(rig, &scene.lights), self.frame_origin, disk).1
        } else {
            Vec::new()
        };
        let (emissive_power, emissive) = match self.emitters.moves() {
            true => self.emitters.at(&pose, &placer, &shapes),
            false => (self.emitters.power_at_rest(), Vec::new()),
        };
        let (cameras, shapes) = (pose.cameras(rig, &scene.cameras), shapes.words);
        let map = |object: &Option<RigidObject>| {
            object.as_ref().map_or(NO_MAP, |object| object.map(&pose, self.frame_origin))
        };
        let maps = self.objects_in_spaces().iter().map(map).collect();
        Ok(FramePose { maps, placements, joints, targets, shapes, lights, emissive, emissive_power, cameras })
    }

    /// Records a frame. The contents of `pose` are stored in the command buffer, so that several recordings
    /// may be pending, and written to the device in order. Shapes are written to memory of `slot`, whose last
    /// recording has ended; if the host deforms nothing, any slot will do. One dispatch poses all moving
    /// vertices, and [`BoundsPass`] measures the bounds. All later commands see the results. The method
    /// records nothing if nothing moves.
    pub fn record(&self, recorder: &mut Recorder<'_>, slot: u32, pose: &FramePose) {
        let is_own = pose.placements.len() == self.places.len()
            && pose.joints.len() == self.joint_count
            && pose.shapes.len() == self.shapes.word_count()
            && pose.maps.len() == self.objects_in_spaces().len();
        if !is_own {
            return recorder
                .refuse("the pose of a frame was made for another scene, or for other objects in it");
        }
        if !self.moves() {
            return;
        }
        recorder.begin_pass(Stage::Pose, SCENE_POSE_VERTICES.name);
        recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
        update(recorder, &self.placements, 0, cast_slice(&pose.placements));
        update(recorder, &self.joints, 0, cast_slice(&pose.joints));
        update(recorder, &self.targets, 0, cast_slice(&pose.targets));
        self.shapes.record(recorder, slot, &pose.shapes);
        self.update_lights(recorder, pose);
        let moving = self.parts.iter().flat_map(|division| &division.parts.parts()[1..]);
        moving.zip(&pose.maps).for_each(|(part, map)| part.record_map(recorder, map));
        recorder.barrier(Access::TRANSFER_WRITE, Access::ALL);
        if let Some(groups) = folded(self.group_count) {
            recorder.bind_compute(&self.vertices);
            recorder.bind_sets(0, &[&self.set]);
            recorder.dispatch(groups);
            recorder.barrier(Access::COMPUTE, Access::ALL);
        }
        recorder.end_pass();
        if self.group_count > 0 {
            match &self.parts {
                Some(division) => self.bounds.record_parts(recorder, &division.parts),
                None => self.bounds.record(recorder, &self.geometry),
            }
        }
        if let Some(far_lights) = &self.far_lights {
            far_lights.record(recorder, &self.geometry, pose.emissive_power);
        }
    }

    /// Updates lights without extent, emissive triangles, and the fields of the frame that depend on them
    /// alone.
    fn update_lights(&self, recorder: &mut Recorder<'_>, pose: &FramePose) {
        let PosedBuffers { lights, emissive, frame, .. } = &self.posed;
        update(recorder, lights, 0, cast_slice(&pose.lights));
        if pose.emissive.is_empty() {
            return;
        }
        update(recorder, emissive, 0, cast_slice::<EmissiveTriangle, u8>(&pose.emissive));
        let is_lit = pose.emissive_power > 0.0;
        let count = if is_lit { pose.emissive.len() as u32 } else { 0 };
        update(recorder, frame, offset_of!(Frame, emissive_count), bytes_of(&count));
        if self.far_lights.is_none() {
            // Without light from far away no power depends on the bounds.
            let shares = kind_shares([self.punctual_power, is_lit.then_some(pose.emissive_power), None]);
            update(recorder, frame, offset_of!(Frame, kind_shares), bytes_of(&shares));
        }
    }

    /// True if any vertex or light moves.
    pub fn moves(&self) -> bool {
        self.lights_move || !self.places.is_empty()
    }

    /// True if any clip can move triangles or a deformer changes them.
    pub fn moves_triangles(&self) -> bool {
        !self.places.is_empty()
    }

    /// Divides the geometry of the scene into two parts, the moving triangles and the static ones, each with
    /// bounds of its own. From then on each frame measures the bounds of the moving part, and with them those
    /// of the whole, without reading the static triangles. Geometry that is in parts already keeps them.
    ///
    /// # Errors
    /// Out of memory, or a lost device.
    pub fn parts(&mut self, device: &Device) -> Result<GeometryParts, GpuSceneError> {
        self.divide(device, None, MovingTriangles::together)
    }

    /// Divides the geometry as [`PosePass::parts`] does, into a part for each object that its node alone
    /// moves, for at most `most` of them, the largest; one part for the other moving triangles, if there are
    /// any; and one for all static triangles. An object is all geometry under one node that a clip changes,
    /// with no other changed node between: without joints, morph targets and deformer. Objects of `scene`,
    /// the one that this pass was made from, also have positions in a space of their own, 12 bytes for each
    /// vertex of the scene, in which a structure may be built once
    /// ([`Description::follows`](rasray_ads::Description::follows)). Poses of frames are made after this.
    ///
    /// # Errors
    /// Out of memory, or a lost device.
    pub fn objects(
        &mut self,
        device: &Device,
        scene: Option<&Scene>,
        most: usize,
    ) -> Result<GeometryParts, GpuSceneError> {
        self.divide(device, scene, |draws, places| MovingTriangles::objects(draws, places, most))
    }

    fn divide(
        &mut self,
        device: &Device,
        scene: Option<&Scene>,
        divided: impl FnOnce(&[DrawTriangles], &[DrawPlace]) -> MovingTriangles,
    ) -> Result<GeometryParts, GpuSceneError> {
        if let Some(division) = &self.parts {
            return Ok(division.parts.clone());
        }
        let MovingTriangles { mut parts, static_bounds, part_of, carriers } =
            divided(&self.draws, &self.places);
        let mut objects = vec![None; parts.len()];
        if let Some(scene) = scene.filter(|_| !carriers.is_empty()) {
            let mut positions = vec![[0.0_f32; 3]; self.geometry.desc().vertex_count as usize];
            for (part, &carrier) in carriers.iter().enumerate() {
                let own = self.places.iter().zip(&part_of).filter(|(_, of)| **of == part);
                let own: Vec<&DrawPlace> = own.map(|(place, _)| place).collect();
                objects[part] = RigidObject::new(scene, carrier, &own, &mut positions);
            }
            let usage = BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC;
            let positions = self.staging.buffer(device, "positions of objects", usage, &positions)?;
            self.bytes_by_part.push(("positions of objects", positions.size()));
            for (part, object) in parts.iter_mut().zip(&objects) {
                let rest = |object: &RigidObject| Rest {
                    positions: positions.clone().into(),
                    bounds: object.bounds,
                };
                part.rest = object.as_ref().map(rest);
            }
        }
        let parts = self.geometry.in_parts(device, &parts, static_bounds)?;
        Ok(self.parts.insert(Division { parts, part_of, objects }).parts.clone())
    }

    /// Returns the parts that [`PosePass::parts`] or [`PosePass::objects`] made.
    pub fn divided(&self) -> Option<&GeometryParts> {
        self.parts.as_ref().map(|division| &division.parts)
    }

    /// Returns for each moving part true if its transform or shape differs between the two poses. There is
    /// one part if the geometry is not in parts. Both poses were made by [`PosePass::frame`].
    pub fn moved_parts(&self, before: &FramePose, after: &FramePose) -> Vec<bool> {
        let count = self.divided().map_or(1, |parts| parts.moving().len());
        let deformed =
            before.joints != after.joints || before.targets != after.targets || before.shapes != after.shapes;
        let mut moved = vec![false; count];
        for (number, place) in self.places.iter().enumerate() {
            let is_moved = before.placements.get(number) != after.placements.get(number)
                || (deformed && place.carrier.is_none());
            let part = self.parts.as_ref().and_then(|division| division.part_of.get(number).copied());
            moved[part.unwrap_or(0)] |= is_moved;
        }
        moved
    }

    /// Returns the objects with a space of their own, by moving part; empty if none has one, so that poses
    /// are those of geometry without parts.
    fn objects_in_spaces(&self) -> &[Option<RigidObject>] {
        let objects = self.parts.as_ref().map_or(&[][..], |division| &division.objects);
        if objects.iter().any(Option::is_some) { objects } else { &[] }
    }

    /// Returns for each draw of the geometry true if any clip can move it or a deformer changes it. All other
    /// draws keep the values of the tables.
    pub fn moving_draws(&self) -> &[bool] {
        &self.moving_draws
    }

    /// Returns the bytes of every buffer by its name.
    pub fn bytes_by_part(&self) -> Vec<(&'static str, u64)> {
        let shapes = Some(self.shapes.bytes()).filter(|(_, bytes)| *bytes > 0);
        self.bytes_by_part.iter().copied().chain(shapes).collect()
    }
}

/// Division of the geometry into parts.
#[derive(Debug)]
struct Division {
    parts: GeometryParts,
    /// Index of the moving part of each moving draw.
    part_of: Vec<usize>,
    /// Object of each moving part, if it has a space of its own.
    objects: Vec<Option<RigidObject>>,
}

/// Writes bytes into a buffer, in as many commands as needed.
fn update(recorder: &mut Recorder<'_>, buffer: &Buffer, offset: usize, bytes: &[u8]) {
    for (chunk, bytes) in bytes.chunks(UPDATE_BYTES).enumerate() {
        recorder.update(buffer, (offset + chunk * UPDATE_BYTES) as u64, bytes);
    }
}

/// Buffers under construction, with the bytes of each.
struct Parts<'a> {
    device: &'a Device,
    staging: &'a Staging,
    bytes_by_part: Vec<(&'static str, u64)>,
}

impl Parts<'_> {
    fn table<T: NoUninit>(&mut self, name: &'static str, records: &[T]) -> Result<Buffer, GpuSceneError> {
        self.filled(name, records, BufferUsage::STORAGE)
    }

    /// Makes a table into which shapes of frames are copied, if there are any.
    fn shape_table(
        &mut self,
        name: &'static str,
        words: &[f32],
        is_shaped: bool,
    ) -> Result<Buffer, GpuSceneError> {
        let more = if is_shaped { BufferUsage::TRANSFER_DST } else { BufferUsage::STORAGE };
        self.filled(name, words, BufferUsage::STORAGE | more)
    }

    fn filled<T: NoUninit>(
        &mut self,
        name: &'static str,
        records: &[T],
        usage: BufferUsage,
    ) -> Result<Buffer, GpuSceneError> {
        let buffer = self.staging.buffer(self.device, name, usage, records)?;
        self.bytes_by_part.push((name, buffer.size()));
        Ok(buffer)
    }

    /// Makes a buffer of records that each frame writes.
    fn frame_buffer<T>(&mut self, name: &'static str, count: usize) -> Result<Buffer, GpuSceneError> {
        let buffer = self.device.create_buffer(&BufferDesc {
            name,
            size: (count * size_of::<T>()) as u64,
            usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_DST,
            location: MemoryLocation::Device,
        })?;
        self.bytes_by_part.push((name, buffer.size()));
        Ok(buffer)
    }
}
