//! A scene on the device.

use glam::DVec3;
use rasray_ads::AdsError;
use rasray_frame::FrameError;
use rasray_gpu::{Device, GpuError};
use rasray_gpu_scene::{FramePose, GpuScene, GpuSceneError, Parts, PosePass, Sampling, SceneTables, View};
use rasray_integrators::IntegratorError;
use rasray_scene::needs::Needs;
use rasray_scene::{Camera, Scene};
use rasray_scene_source::LoadError;
use rasray_tracer::TracerError;

use crate::error::ExperimentError;
use crate::jobs::{Frame, Sampler};

/// What a device error is about.
pub(super) fn device_error(error: impl std::fmt::Display) -> ExperimentError {
    ExperimentError::device(error, "try a smaller --resolution or --size, or another --device")
}

/// What an error about what holds an image, a film or its rays, is about: no option of structures makes it smaller.
pub(super) fn image_error(error: impl std::fmt::Display) -> ExperimentError {
    ExperimentError::device(error, "try a smaller --size, or another --device")
}

/// What an error about the scene's own tables is about: no option of structures or images makes them smaller.
pub(super) fn scene_error(error: GpuSceneError) -> ExperimentError {
    let error = match error {
        GpuSceneError::Scene(error) => return LoadError::from(error).into(),
        other => other,
    };
    let message = match &error {
        GpuSceneError::Gpu(GpuError::TooLarge { name, size, limit })
        | GpuSceneError::Ads(AdsError::Gpu(GpuError::TooLarge { name, size, limit })) => {
            format!("the scene's {name} have {size} bytes, and this device binds {limit} at most")
        }
        GpuSceneError::TooManyVertices { .. }
        | GpuSceneError::TooManyTexels { .. }
        | GpuSceneError::OtherTriangles { .. }
        | GpuSceneError::DeformedTwice { .. }
        | GpuSceneError::Gpu(GpuError::OutOfDeviceMemory { .. })
        | GpuSceneError::Ads(AdsError::Gpu(GpuError::OutOfDeviceMemory { .. })) => error.to_string(),
        _ => return device_error(error),
    };
    ExperimentError::device(
        message,
        "try a scene with fewer triangles and images, a smaller map for --environment, or another --device",
    )
}

/// A failed build or trace: lost rays are refused, everything else is the device's.
pub(super) fn tracer_error(error: &TracerError) -> ExperimentError {
    match error {
        TracerError::Unfinished { .. }
        | TracerError::NotReady { .. }
        | TracerError::Corrupted { .. }
        | TracerError::Unstable { .. } => ExperimentError::refused(
            error.to_string(),
            "its results are not kept; please report it with the command line",
        ),
        _ => device_error(error),
    }
}

/// An image that failed: lost rays are refused.
pub(super) fn frame_error(error: FrameError) -> ExperimentError {
    match error {
        FrameError::Tracer(error) => tracer_error(&error),
        FrameError::Integrator(IntegratorError::Ads(error @ AdsError::Option { option: "fetch", .. })) => {
            ExperimentError::usage(error.to_string(), "leave out --fetch raster, or choose another --system")
        }
        FrameError::Unfinished { .. } => ExperimentError::refused(
            error.to_string(),
            "its results are not kept; where very many triangles lie in one place --system bvh has shorter work, \
             else please report it with the command line",
        ),
        other => device_error(other),
    }
}

/// A scene on the device.
#[derive(Debug)]
pub struct DeviceScene {
    /// As it is there.
    pub scene: GpuScene,
    /// Triangles that were left out: their coordinates are not finite, or beyond what can be squared.
    pub dropped_triangles: u64,
    /// What moves, where it is posed on the device.
    pub(super) pose: Option<PosePass>,
    /// Where everything is that moves, once it was posed.
    pub(super) posed: Option<FramePose>,
    /// Which of the parts that move are elsewhere than before the last pose; empty: all.
    pub(super) moved: Vec<bool>,
}

impl DeviceScene {
    /// Uploads what of a scene is needed, around a frame origin that suits the camera. The size (pixels) and the seed
    /// are those of images.
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
        let tables = SceneTables::new(scene, origin, &Parts::from(needs)).map_err(scene_error)?;
        let view = View { camera: camera.clone(), width, height, seed };
        let gpu_scene = GpuScene::upload(device, &tables, &view).map_err(scene_error)?;
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
        self.scene.geometry().download(device).map_err(device_error)
    }

    /// Whether positions have digits enough for a camera: the frame origin, around which the scene was uploaded, is the one
    /// that suits it.
    pub fn suits(&self, scene: &Scene, camera: &Camera) -> bool {
        let eye = camera.world_from_camera.translation;
        self.scene.frame_origin() == SceneTables::default_frame_origin(scene, eye)
    }

    /// Looks from elsewhere, or at another size in pixels; the frame origin stays. Structures that depend on it are
    /// stale then ([`Built::follow`](crate::Built::follow)).
    ///
    /// # Errors
    /// The device fails.
    pub fn look(&mut self, view: &View) -> Result<(), ExperimentError> {
        self.scene.update_camera(view).map_err(device_error)
    }

    /// Sets how the pixels of an image are sampled, and what their rays pass.
    ///
    /// # Errors
    /// The device fails.
    pub fn sample_as(&mut self, frame: &Frame) -> Result<(), ExperimentError> {
        let sampler = match frame.sampler {
            Sampler::Sobol => rasray_gpu_scene::Sampler::Sobol,
            Sampler::Pcg => rasray_gpu_scene::Sampler::Pcg,
        };
        let sampling = Sampling { sampler, samples: frame.spp, back_faces: frame.back_faces };
        self.scene.set_sampling(sampling).map_err(device_error)
    }
}
