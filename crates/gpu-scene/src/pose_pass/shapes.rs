//! Shapes that a deformer computes on the host for each frame, and their upload to the device.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use bytemuck::cast_slice;
use glam::DVec3;
use rasray_gpu::{Buffer, BufferDesc, BufferUsage, Device, GpuError, MemoryLocation, Recorder};
use rasray_scene::deforming::{Deformer, Shape};
use rasray_scene::{Mesh, Scene};
use rasray_shaders_glsl::constants::scene::ATTRIBUTE_NONE;

use super::pivot::{centre, relative};
use crate::GpuSceneError;

const WORD: u64 = size_of::<f32>() as u64;

/// Mesh that a deformer changes, and the place of its shape at rest on the device.
#[derive(Clone, Debug)]
pub struct ShapePlace {
    /// Index into the meshes of the scene.
    pub mesh: usize,
    /// First words of rest positions and rest normals; absent if no draw shows the mesh, or no pass reads
    /// normals.
    words: [Option<u32>; 2],
    vertex_count: usize,
    has_normals: bool,
    /// Hash of all data but positions and normals.
    triangles: u64,
}

/// Meshes that a deformer changes, with host memory for each frame in flight.
#[derive(Debug)]
pub struct Shapes {
    deformer: Option<Arc<dyn Deformer>>,
    scene: String,
    places: Vec<ShapePlace>,
    /// Number of words of a frame.
    word_count: usize,
    rest: [Buffer; 2],
    /// Upload buffers, one per slot; none if no mesh is deformed.
    uploads: Vec<Buffer>,
}

/// Shapes of one frame.
#[derive(Clone, Debug, Default)]
pub struct FrameShapes {
    /// Words of each place: positions relative to its pivot, then normals.
    pub words: Arc<[f32]>,
    /// Pivot of each place, mesh space, metres.
    pub pivots: Vec<DVec3>,
    /// Positions of each place, with its mesh: mesh space, metres.
    pub positions: Vec<(usize, Vec<[f32; 3]>)>,
}

impl ShapePlace {
    /// Describes a mesh at rest; `words` are those of its positions and normals, or `ATTRIBUTE_NONE`.
    pub fn new(scene: &Scene, mesh: usize, words: [u32; 2]) -> Self {
        let rest = &scene.meshes[mesh];
        Self {
            mesh,
            words: words.map(|word| (word != ATTRIBUTE_NONE).then_some(word)),
            vertex_count: rest.positions.len(),
            has_normals: rest.normals.is_some(),
            triangles: triangles(rest),
        }
    }

    fn word_count(&self) -> usize {
        3 * self.vertex_count * self.words.iter().flatten().count()
    }

    /// Returns positions and normals of a shape; `None` if it has other triangles.
    fn vertices(&self, shape: Shape) -> Option<Vertices> {
        let (positions, normals) = match shape {
            Shape::Vertices { positions, normals } => (positions, normals),
            Shape::Mesh(mesh) if mesh.tangents.is_none() && triangles(&mesh) == self.triangles => {
                (mesh.positions, mesh.normals)
            }
            Shape::Mesh(_) => return None,
        };
        let is_same = positions.len() == self.vertex_count && (normals.is_none() || self.has_normals);
        is_same.then_some((positions, normals))
    }
}

/// Positions, and normals if a shape has them.
type Vertices = (Vec<[f32; 3]>, Option<Vec<[f32; 3]>>);

/// Hashes the data that a shape may not change.
fn triangles(mesh: &Mesh) -> u64 {
    let mut hash = DefaultHasher::new();
    (mesh.positions.len(), mesh.material, &mesh.indices).hash(&mut hash);
    for uvs in &mesh.uvs {
        uvs.as_ref().map(|uvs| cast_slice::<_, u32>(uvs)).hash(&mut hash);
    }
    mesh.colors.as_ref().map(|colors| cast_slice::<_, u32>(colors)).hash(&mut hash);
    hash.finish()
}

impl Shapes {
    /// Prepares the shapes of a scene's deformer, with one slot; `rest` are the tables of positions and
    /// attributes at rest.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(
        device: &Device,
        scene: &Scene,
        places: Vec<ShapePlace>,
        rest: [Buffer; 2],
    ) -> Result<Self, GpuError> {
        let word_count = places.iter().map(ShapePlace::word_count).sum();
        let (deformer, scene) = (scene.animation.deformer.clone(), scene.name.clone());
        let mut shapes = Self { deformer, scene, places, word_count, rest, uploads: Vec::new() };
        shapes.set_slots(device, 1)?;
        Ok(shapes)
    }

    /// Reserves memory for that many frames in flight.
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_slots(&mut self, device: &Device, slots: u32) -> Result<(), GpuError> {
        let size = self.word_count as u64 * WORD;
        let upload = |_| {
            device.create_buffer(&BufferDesc {
                name: "pose shapes",
                size,
                usage: BufferUsage::TRANSFER_SRC,
                location: MemoryLocation::Upload,
            })
        };
        let slots = if size == 0 { 0 } else { slots.max(1) };
        self.uploads = (0..slots).map(upload).collect::<Result<_, _>>()?;
        Ok(())
    }

    /// Returns the name and bytes of the memory of all slots.
    pub fn bytes(&self) -> (&'static str, u64) {
        ("pose shapes", self.uploads.iter().map(Buffer::size).sum())
    }

    /// Returns the number of words of a frame.
    pub fn word_count(&self) -> usize {
        self.word_count
    }

    /// Returns the shapes at a time, seconds.
    ///
    /// # Errors
    /// An error for a file that cannot be read, or [`GpuSceneError::OtherTriangles`].
    pub fn at(&self, seconds: f64) -> Result<FrameShapes, GpuSceneError> {
        let Some(deformer) = &self.deformer else { return Ok(FrameShapes::default()) };
        let mut given = deformer.at(seconds)?.shapes;
        let mut words = Vec::with_capacity(self.word_count);
        let (mut pivots, mut all) = (Vec::new(), Vec::new());
        for place in &self.places {
            let found = given.iter().position(|(mesh, _)| *mesh == place.mesh);
            let shape = found.map(|found| given.swap_remove(found).1);
            let Some((positions, normals)) = shape.and_then(|shape| place.vertices(shape)) else {
                let (scene, mesh) = (self.scene.clone(), place.mesh);
                return Err(GpuSceneError::OtherTriangles { scene, mesh, seconds });
            };
            let pivot = centre([&positions[..]]);
            if place.words[0].is_some() {
                words.extend(positions.iter().flat_map(|position| relative(position, pivot)));
            }
            if place.words[1].is_some() {
                // Normals without a direction let shading take that of the triangle: flat.
                let normals = normals.unwrap_or_else(|| vec![[0.0; 3]; positions.len()]);
                words.extend_from_slice(normals.as_flattened());
            }
            pivots.push(pivot);
            all.push((place.mesh, positions));
        }
        Ok(FrameShapes { words: words.into(), pivots, positions: all })
    }

    /// Writes the shapes of a frame to the memory of its slot and records their copies into the tables at
    /// rest.
    pub fn record(&self, recorder: &mut Recorder<'_>, slot: u32, words: &[f32]) {
        if words.is_empty() {
            return;
        }
        let Some(upload) = self.uploads.get(slot as usize) else {
            return recorder.refuse("the pose pass has no such slot");
        };
        if upload.write(0, cast_slice(words)).is_err() {
            return recorder.refuse("shapes of a frame could not be written");
        }
        let mut from = 0;
        for place in &self.places {
            let size = 3 * place.vertex_count as u64 * WORD;
            for (table, word) in self.rest.iter().zip(place.words) {
                let Some(word) = word else { continue };
                recorder.copy(upload, from, table, u64::from(word) * WORD, size);
                from += size;
            }
        }
    }
}
