//! Tables on the device.

use std::mem::offset_of;
use std::ops::Range;
use std::sync::Arc;

use bytemuck::NoUninit;
use rasray_ads::{Geometry, GeometryDesc, SceneBinding, Viewpoint};
use rasray_gpu::{Access, Buffer, BufferDesc, BufferUsage, Device, MemoryLocation, Recorder};
use rasray_shaders_glsl::constants::scene::{
    SCENE_BINDING_DRAW_SHADINGS, SCENE_BINDING_EMISSIVE_TRIANGLES, SCENE_BINDING_LIGHTS,
    SCENE_BINDING_POSED_ATTRIBUTES, SCENE_BINDING_TEXELS_3, SCENE_TEXEL_RUNS,
};

use crate::{
    GpuSceneError, Sampling, SceneTables, ShadingFeatures, TexelRuns, View,
    layout::{Frame, Light, viewpoint_of},
    staging::Staging,
};

/// Number of buffers in the scene's set.
const BINDINGS: u32 = SCENE_BINDING_TEXELS_3 + 1;

/// Byte range of the frame's fields that the view sets.
const VIEW_BYTES: Range<usize> = 0..offset_of!(Frame, triangle_count);

/// Byte range of the frame's fields that the sampling sets.
const SAMPLING_BYTES: Range<usize> = offset_of!(Frame, sampling)..offset_of!(Frame, kind_shares);

/// Buffers that change from frame to frame, in addition to positions. One record replaces an empty table.
#[derive(Clone, Debug)]
pub struct PosedBuffers {
    /// Buffer of one [`Frame`].
    pub frame: Buffer,
    /// Buffer of [`DrawShading`](crate::layout::DrawShading) records.
    pub draw_shadings: Buffer,
    /// Buffer of normals and tangents, words.
    pub attributes: Buffer,
    /// Buffer of [`Light`](crate::layout::Light) records.
    pub lights: Buffer,
    /// Buffer of [`EmissiveTriangle`](crate::layout::EmissiveTriangle) records.
    pub emissive: Buffer,
}

/// Scene on the device: the geometry that structures build from, and the binding set that shading reads.
///
/// Uploaded buffers stay until the value is dropped. [`GpuScene::update_camera`] or
/// [`GpuScene::record_frame`] changes the view, a [`PosePass`](crate::PosePass) the moving parts.
#[derive(Clone, Debug)]
pub struct GpuScene {
    geometry: Geometry,
    binding: SceneBinding,
    posed_buffers: PosedBuffers,
    lights: Arc<[Light]>,
    emitter_count: u32,
    frame: Frame,
    frame_origin: glam::DVec3,
    features: ShadingFeatures,
    has_single_sided: bool,
    bytes_by_part: Vec<(&'static str, u64)>,
    staging: Staging,
}

impl GpuScene {
    /// Uploads the tables and waits until they have arrived. Texels may exceed one binding: they lie in the
    /// longest runs that the device can bind.
    ///
    /// # Errors
    /// Out of memory, a table larger than one binding can hold (the error names it), more texels than
    /// [`TexelRuns::most_texels`], or a lost device.
    pub fn upload(device: &Device, tables: &SceneTables, view: &View) -> Result<Self, GpuSceneError> {
        Self::upload_in_runs(device, tables, view, TexelRuns::of(device.limits()))
    }

    /// Uploads the tables like [`GpuScene::upload`], without waiting: the tables lie in host memory until a
    /// recording with [`GpuScene::record_staged`] has run. Tables of a [`PosePass`](crate::PosePass) that is
    /// made for the scene before [`GpuScene::end_staging`] are staged as well. Until then all tables take
    /// twice their bytes.
    ///
    /// # Errors
    /// Errors of [`GpuScene::upload`].
    pub fn staged(device: &Device, tables: &SceneTables, view: &View) -> Result<Self, GpuSceneError> {
        Self::made(device, tables, view, TexelRuns::of(device.limits()), Staging::later())
    }

    /// Uploads the tables like [`GpuScene::upload`], with texels in runs of a given length, on which the
    /// values that shaders read do not depend.
    ///
    /// # Errors
    /// Errors of [`GpuScene::upload`].
    pub fn upload_in_runs(
        device: &Device,
        tables: &SceneTables,
        view: &View,
        runs: TexelRuns,
    ) -> Result<Self, GpuSceneError> {
        Self::made(device, tables, view, runs, Staging::default())
    }

    fn made(
        device: &Device,
        tables: &SceneTables,
        view: &View,
        runs: TexelRuns,
        staging: Staging,
    ) -> Result<Self, GpuSceneError> {
        let mut upload = Upload { device, staging: &staging, bytes_by_part: Vec::new() };
        let posed = &tables.posed;
        let geometry = Geometry::new(
            device,
            GeometryDesc {
                positions: upload.table("positions", &posed.positions)?.into(),
                indices: upload.table("indices", &posed.indices)?.into(),
                draws: upload.table("draws", &posed.draws)?.into(),
                vertex_count: posed.positions.len() as u32,
                triangle_count: posed.triangle_count() as u32,
                count: None,
                draw_count: posed.draws.len() as u32,
                bounds: [posed.lower, posed.upper],
                frame_origin: tables.frame_origin.to_array(),
            },
        )?;
        let mut frame = tables.frame(view);
        frame.texel_shift = runs.shift();
        // The host writes the frame in place, or commands do.
        let frame_buffer = device.create_buffer(&BufferDesc {
            name: "frame",
            size: size_of::<Frame>() as u64,
            usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST,
            location: MemoryLocation::Upload,
        })?;
        frame_buffer.write(0, bytemuck::bytes_of(&frame))?;
        let texels = upload.texels(&tables.texels, runs)?;
        let [first_texels, more_texels @ ..] = &texels;
        let buffers = [
            frame_buffer.clone(),
            upload.table("draw shadings", &tables.draw_shadings)?,
            upload.table("triangle draws", &posed.draw_of_triangle)?,
            upload.table("posed attributes", &tables.posed_attributes)?,
            upload.table("vertex attributes", &tables.vertex_attributes)?,
            upload.table("materials", &tables.materials)?,
            upload.table("textures", &tables.textures)?,
            first_texels.clone(),
            upload.table("lights", &tables.lights)?,
            upload.table("emissive triangles", &tables.emissive_triangles)?,
            upload.table("environment radiance", &tables.environment.radiance)?,
            upload.table("environment distribution", &tables.environment.distribution)?,
        ];
        let posed_buffers = PosedBuffers {
            frame: frame_buffer,
            draw_shadings: buffers[SCENE_BINDING_DRAW_SHADINGS as usize].clone(),
            attributes: buffers[SCENE_BINDING_POSED_ATTRIBUTES as usize].clone(),
            lights: buffers[SCENE_BINDING_LIGHTS as usize].clone(),
            emissive: buffers[SCENE_BINDING_EMISSIVE_TRIANGLES as usize].clone(),
        };
        let layout = device.create_set_layout("scene", BINDINGS)?;
        let bound: Vec<&Buffer> = buffers.iter().chain(more_texels).collect();
        let set = device.create_binding_set(&layout, "scene", &bound)?;
        let features = ShadingFeatures::of(tables, runs);
        let mut bytes_by_part = upload.bytes_by_part;
        bytes_by_part.push(("frame", posed_buffers.frame.size()));
        Ok(Self {
            geometry,
            binding: SceneBinding {
                layout,
                set,
                alpha_masked: features.alpha_masks,
                constants: features.constants().into(),
            },
            posed_buffers,
            lights: tables.lights.as_slice().into(),
            emitter_count: tables.emissive_triangles.len() as u32,
            frame,
            frame_origin: tables.frame_origin,
            features,
            has_single_sided: tables.has_single_sided(),
            bytes_by_part,
            staging,
        })
    }

    /// Adds code for features that this scene does not need: pipelines that are made for it then also read
    /// later scenes that have any of `features`. Pictures do not depend on it.
    #[must_use]
    pub fn allowing(mut self, features: ShadingFeatures) -> Self {
        self.features = self.features.with(features);
        self.binding.alpha_masked = self.features.alpha_masks;
        self.binding.constants = self.features.constants().into();
        self
    }

    /// Records the copies of the tables that [`GpuScene::staged`] left in host memory, before all commands
    /// that read them, visible to all later commands; records nothing if the tables are on the device.
    pub fn record_staged(&self, recorder: &mut Recorder<'_>) {
        self.staging.record(recorder);
    }

    /// Notes that the recording of [`GpuScene::record_staged`] was submitted: host memory is freed when the
    /// device is done with it.
    pub fn end_staging(&self) {
        self.staging.end();
    }

    pub(crate) fn staging(&self) -> &Staging {
        &self.staging
    }

    /// Changes camera, image size or seed: the host makes one small write, and no structure that is
    /// independent of the eye needs a rebuild. The device must not be using the scene.
    ///
    /// The frame origin stays; if the eye has moved far from it (see [`SceneTables::default_frame_origin`]),
    /// precision requires new tables.
    ///
    /// # Errors
    /// An error if the buffer cannot be written.
    pub fn update_camera(&mut self, view: &View) -> Result<(), GpuSceneError> {
        view.write(&mut self.frame, self.frame_origin);
        self.write_frame(VIEW_BYTES)
    }

    /// Changes the sampling of pixels and the surfaces that their rays pass; otherwise the same rules hold as
    /// for [`GpuScene::update_camera`], which does not change these values.
    ///
    /// # Errors
    /// An error if the buffer cannot be written.
    pub fn set_sampling(&mut self, sampling: Sampling) -> Result<(), GpuSceneError> {
        sampling.write(&mut self.frame, self.has_single_sided);
        self.write_frame(SAMPLING_BYTES)
    }

    fn write_frame(&self, bytes: Range<usize>) -> Result<(), GpuSceneError> {
        let frame = &bytemuck::bytes_of(&self.frame)[bytes.clone()];
        Ok(self.posed_buffers.frame.write(bytes.start as u64, frame)?)
    }

    /// Records the writes of [`GpuScene::update_camera`] and [`GpuScene::set_sampling`]: the values are
    /// stored in the command buffer, so that several recordings may be pending, each with a view of its own.
    /// Returns the frame as shaders will see it, for [`viewpoint_of`](crate::layout::viewpoint_of);
    /// [`GpuScene::frame`] and the values derived from it stay those of the view that was written last.
    /// Visible to all later commands.
    pub fn record_frame(&self, recorder: &mut Recorder<'_>, view: &View, sampling: Sampling) -> Frame {
        let mut frame = self.frame;
        view.write(&mut frame, self.frame_origin);
        sampling.write(&mut frame, self.has_single_sided);
        recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
        for bytes in [VIEW_BYTES, SAMPLING_BYTES] {
            let written = &bytemuck::bytes_of(&frame)[bytes.clone()];
            recorder.update(&self.posed_buffers.frame, bytes.start as u64, written);
        }
        recorder.barrier(Access::TRANSFER_WRITE, Access::ALL);
        frame
    }

    /// Returns the buffers that a [`PosePass`](crate::PosePass) writes in addition to positions, and
    /// [`GpuScene::record_frame`].
    pub fn posed_buffers(&self) -> &PosedBuffers {
        &self.posed_buffers
    }

    /// Returns the lights without extent as the tables have them; the current values of moving lights are
    /// only on the device ([`PosedBuffers::lights`]).
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// Returns the number of records in [`PosedBuffers::emissive`]: triangles that emit, now or at another
    /// time.
    pub fn emitter_count(&self) -> u32 {
        self.emitter_count
    }

    /// Returns the geometry that structures build from.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Returns the binding that surfaces, alpha masks and integrators read.
    pub fn binding(&self) -> &SceneBinding {
        &self.binding
    }

    /// Returns the eye, metres relative to the frame origin, as shaders see it.
    pub fn eye(&self) -> [f32; 3] {
        self.frame.camera_position
    }

    /// Returns the eye and the camera's view from it.
    pub fn viewpoint(&self) -> Viewpoint {
        viewpoint_of(&self.frame)
    }

    /// Returns the viewpoint like [`GpuScene::viewpoint`], of a view that [`GpuScene::record_frame`] writes.
    pub fn viewpoint_of(&self, view: &View) -> Viewpoint {
        let mut frame = self.frame;
        view.write(&mut frame, self.frame_origin);
        viewpoint_of(&frame)
    }

    /// Returns the frame origin, world, metres.
    pub fn frame_origin(&self) -> glam::DVec3 {
        self.frame_origin
    }

    /// Returns the pixels per row and the number of rows of the image.
    pub fn image_size(&self) -> [u32; 2] {
        [self.frame.width, self.frame.height]
    }

    /// Returns the frame record as uploaded last.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Returns the parts of the shading code that the scene can use.
    pub fn features(&self) -> ShadingFeatures {
        self.features
    }

    /// Returns the bytes of every buffer by its name.
    pub fn bytes_by_part(&self) -> &[(&'static str, u64)] {
        &self.bytes_by_part
    }

    /// Returns the bytes of all buffers.
    pub fn bytes(&self) -> u64 {
        self.bytes_by_part.iter().map(|(_, bytes)| bytes).sum()
    }
}

struct Upload<'a> {
    device: &'a Device,
    staging: &'a Staging,
    bytes_by_part: Vec<(&'static str, u64)>,
}

impl Upload<'_> {
    /// Uploads a table; one zero record replaces an empty one, because a binding may not be absent.
    fn table<T: NoUninit + bytemuck::Zeroable>(
        &mut self,
        name: &'static str,
        records: &[T],
    ) -> Result<Buffer, GpuSceneError> {
        let buffer = self.buffer(name, records)?;
        self.bytes_by_part.push((name, buffer.size()));
        Ok(buffer)
    }

    /// Uploads texels in runs, counted as one part of the bytes. If there are fewer runs than bindings, the
    /// first run is bound to the others, which shaders never read.
    fn texels(
        &mut self,
        texels: &[u32],
        runs: TexelRuns,
    ) -> Result<[Buffer; SCENE_TEXEL_RUNS as usize], GpuSceneError> {
        let (count, limit) = (texels.len() as u64, runs.most_texels());
        if count > limit {
            return Err(GpuSceneError::TooManyTexels { count, limit });
        }
        let mut rest = texels.chunks(runs.length() as usize);
        let first = self.buffer("texels", rest.next().unwrap_or_default())?;
        let mut bytes = first.size();
        let mut buffers = std::array::from_fn(|_| first.clone());
        for (buffer, run) in buffers[1..].iter_mut().zip(rest) {
            *buffer = self.buffer("texels", run)?;
            bytes += buffer.size();
        }
        self.bytes_by_part.push(("texels", bytes));
        Ok(buffers)
    }

    /// Uploads records; one zero record replaces an empty table.
    fn buffer<T: NoUninit + bytemuck::Zeroable>(
        &self,
        name: &'static str,
        records: &[T],
    ) -> Result<Buffer, GpuSceneError> {
        let zero = [T::zeroed()];
        let records = if records.is_empty() { &zero } else { records };
        let usage = BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC;
        Ok(self.staging.buffer(self.device, name, usage, records)?)
    }
}
