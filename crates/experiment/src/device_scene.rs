//! Scene on the device.

use glam::DVec3;
use rasray_gpu::Device;
use rasray_gpu_scene::{FramePose, GpuScene, Parts, PosePass, Sampling, SceneTables, View};
use rasray_scene::needs::Needs;
use rasray_scene::{Camera, Scene};

use crate::error::ExperimentError;
use crate::jobs::Frame;

/// Scene on the device.
#[derive(Debug)]
pub struct DeviceScene {
    /// Data of the scene on the device.
    pub scene: GpuScene,
    /// Number of triangles that were left out, because their coordinates are not finite or have no finite
    /// squares.
    pub dropped_triangles: u64,
    /// Pass that poses the moving parts, if the device poses them.
    pub(super) pose: Option<PosePass>,
    /// Poses of all moving parts, after the first pose.
    pub(super) posed: Option<FramePose>,
    /// Flags of the moving parts whose pose the last pose changed; empty if all changed.
    pub(super) moved: Vec<bool>,
}

impl DeviceScene {
    /// Uploads the needed data of a scene, around a frame origin that suits the camera. The size (pixels) and
    /// the seed are those of images.
    ///
    /// # Errors
    /// The scene refers to data that it does not have, or the device cannot hold it.
    pub fn new(
        device: &Device,
        scene: &Scene,
        camera: &Camera,
        [width, height]: [u32; 2],
        seed: u32,
        needs: &Needs,
    ) -> Result<Self, ExperimentError> {
        let eye = camera.world_from_camera.translation;
        let origin = SceneTables::default_frame_origin(scene, eye);
        Self::around(device, scene, origin, camera, [width, height], seed, needs)
    }

    /// Uploads as [`DeviceScene::new`], with positions relative to `origin` (world, metres).
    ///
    /// # Errors
    /// As for [`DeviceScene::new`].
    pub fn around(
        device: &Device,
        scene: &Scene,
        origin: DVec3,
        camera: &Camera,
        size: [u32; 2],
        seed: u32,
        needs: &Needs,
    ) -> Result<Self, ExperimentError> {
        Ok(Self::uploaded(device, scene, origin, camera, size, seed, needs)?.0)
    }

    /// Uploads the scene, and returns the tables that it was made from as well.
    pub(super) fn uploaded(
        device: &Device,
        scene: &Scene,
        origin: DVec3,
        camera: &Camera,
        [width, height]: [u32; 2],
        seed: u32,
        needs: &Needs,
    ) -> Result<(Self, SceneTables), ExperimentError> {
        let tables = SceneTables::new(scene, origin, &Parts::from(needs))?;
        let view = View { camera: camera.clone(), width, height, seed };
        let gpu_scene = GpuScene::upload(device, &tables, &view)?;
        let dropped_triangles = tables.posed.dropped_triangles;
        if dropped_triangles > 0 {
            tracing::warn!(
                "{dropped_triangles} triangles have coordinates that are not finite or beyond 1.8e18 m and are left out"
            );
        }
        Ok((Self { scene: gpu_scene, dropped_triangles, pose: None, posed: None, moved: Vec::new() }, tables))
    }

    /// Reads the positions (metres, relative to the frame origin) and indices back from the device.
    ///
    /// # Errors
    /// The device fails.
    pub fn triangles(&self, device: &Device) -> Result<(Vec<[f32; 3]>, Vec<u32>), ExperimentError> {
        Ok(self.scene.geometry().download(device)?)
    }

    /// True if positions have enough digits for a camera: the frame origin around which the scene was
    /// uploaded is the one that suits this camera.
    pub fn suits(&self, scene: &Scene, camera: &Camera) -> bool {
        let eye = camera.world_from_camera.translation;
        self.scene.frame_origin() == SceneTables::default_frame_origin(scene, eye)
    }

    /// Changes the camera or the size in pixels; the frame origin stays. Structures that depend on the camera
    /// are stale afterwards ([`Built::follow`](crate::Built::follow)).
    ///
    /// # Errors
    /// The device fails.
    pub fn look(&mut self, view: &View) -> Result<(), ExperimentError> {
        Ok(self.scene.update_camera(view)?)
    }

    /// Sets the sampling of an image's pixels, and the surfaces that their rays pass.
    ///
    /// # Errors
    /// The device fails.
    pub fn sample_as(&mut self, frame: &Frame) -> Result<(), ExperimentError> {
        let Frame { sampler, spp: samples, back_faces, .. } = *frame;
        let sampling = Sampling { sampler, samples, back_faces };
        Ok(self.scene.set_sampling(sampling)?)
    }
}
