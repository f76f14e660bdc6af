//! A scene on the device.

use glam::DVec3;
use rasray_gpu::Device;
use rasray_gpu_scene::{FramePose, GpuScene, Parts, PosePass, Sampling, SceneTables, View};
use rasray_scene::needs::Needs;
use rasray_scene::{Camera, Scene};

use crate::error::ExperimentError;
use crate::jobs::Frame;

/// A scene on the device.
#[derive(Debug)]
pub struct DeviceScene {
    /// As it is there.
    pub scene: GpuScene,
    /// Triangles that were left out: their coordinates are not finite, or beyond what can be squared.
    pub dropped_triangles: u64,
    /// The pass that poses what moves, where it is posed on the device.
    pub(super) pose: Option<PosePass>,
    /// Poses of everything that moves, once it was posed.
    pub(super) posed: Option<FramePose>,
    /// True for each moving part that is elsewhere than before the last pose; empty: all.
    pub(super) moved: Vec<bool>,
}

impl DeviceScene {
    /// Uploads what of a scene is needed, around a frame origin that suits the camera. The size (pixels) and
    /// the seed are those of images.
    ///
    /// # Errors
    /// The scene names what it does not have, or the device does not hold it.
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

    /// As [`DeviceScene::new`], with positions relative to `origin` (world, metres).
    ///
    /// # Errors
    /// As [`DeviceScene::new`].
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

    /// With the tables that it was made from.
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

    /// Positions (metres, relative to the frame origin) and indices as the device has them.
    ///
    /// # Errors
    /// The device fails.
    pub fn triangles(&self, device: &Device) -> Result<(Vec<[f32; 3]>, Vec<u32>), ExperimentError> {
        Ok(self.scene.geometry().download(device)?)
    }

    /// True if positions have digits enough for a camera: the frame origin, around which the scene was
    /// uploaded, is the one that suits it.
    pub fn suits(&self, scene: &Scene, camera: &Camera) -> bool {
        let eye = camera.world_from_camera.translation;
        self.scene.frame_origin() == SceneTables::default_frame_origin(scene, eye)
    }

    /// Looks from elsewhere, or at another size in pixels; the frame origin stays. Structures that depend on
    /// it are stale then ([`Built::follow`](crate::Built::follow)).
    ///
    /// # Errors
    /// The device fails.
    pub fn look(&mut self, view: &View) -> Result<(), ExperimentError> {
        Ok(self.scene.update_camera(view)?)
    }

    /// Sets how the pixels of an image are sampled, and what their rays pass.
    ///
    /// # Errors
    /// The device fails.
    pub fn sample_as(&mut self, frame: &Frame) -> Result<(), ExperimentError> {
        let Frame { sampler, spp: samples, back_faces, .. } = *frame;
        let sampling = Sampling { sampler, samples, back_faces };
        Ok(self.scene.set_sampling(sampling)?)
    }
}
