//! What the benchmarks of rasray share: a scene on a device and rays through it.
//!
//! `cargo bench` prints, for every registered system and preset, the median build time and the median
//! trace time of random rays, alternated between systems in one process. Times of software devices are
//! for ratios on that device. For errors beside speed use `rasray compare`.

use rasray_ads::{AdsError, Ray};
use rasray_gpu::{Device, DeviceDesc, Feature, GpuError, Requirements};
use rasray_gpu_scene::{GpuScene, GpuSceneError, Parts, SceneTables, View};
use rasray_reference::shading::random::RandomStream;
use rasray_scene::{Scene, SceneError, default_view};
use rasray_systems::SystemsError;
use rasray_tracer::TracerError;

/// Why a benchmark could not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BenchError {
    /// The device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A structure.
    #[error(transparent)]
    Ads(#[from] AdsError),
    /// A build or a trace.
    #[error(transparent)]
    Tracer(#[from] TracerError),
    /// A system.
    #[error(transparent)]
    Systems(#[from] SystemsError),
    /// The scene's tables.
    #[error(transparent)]
    GpuScene(#[from] GpuSceneError),
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// No built-in scene of that name.
    #[error("there is no built-in scene `{0}`")]
    UnknownScene(String),
}

/// A scene on a device.
#[derive(Debug)]
pub struct Stage {
    /// The device.
    pub device: Device,
    /// The scene on it.
    pub scene: GpuScene,
}

impl Stage {
    /// Opens the preferred device and uploads a built-in scene.
    ///
    /// # Errors
    /// No device, no such scene, or it does not fit.
    pub fn new(spec: &str) -> Result<Self, BenchError> {
        let mut requirements = Requirements::floor();
        requirements.required.push(Feature::FragmentStoresAndAtomics);
        let device = Device::create(&DeviceDesc { requirements, ..DeviceDesc::default() })?;
        let scene: Scene = rasray_scene::builtin::builtin(spec)
            .ok_or_else(|| BenchError::UnknownScene(spec.to_owned()))??;
        let camera = scene.cameras.first().cloned().unwrap_or_else(|| default_view::default_camera(&scene));
        let origin = SceneTables::default_frame_origin(&scene, camera.world_from_camera.translation);
        let tables = SceneTables::new(&scene, origin, &Parts::VISIBILITY)?;
        let scene = GpuScene::upload(&device, &tables, &View { camera, width: 64, height: 64, seed: 1 })?;
        Ok(Self { device, scene })
    }

    /// Rays with origins uniform in the scene's box and uniform directions.
    pub fn incoherent_rays(&self, count: u32) -> Vec<Ray> {
        let [lower, upper] = self.scene.geometry().bounds();
        (0..count)
            .map(|pixel| {
                let random = RandomStream { seed: 1, pixel, sample: 0 };
                let origin = std::array::from_fn(|axis| {
                    lower[axis] + (upper[axis] - lower[axis]) * random.float(axis as u32)
                });
                let z = 1.0 - 2.0 * random.float(3);
                let azimuth = std::f32::consts::TAU * random.float(4);
                let ring = (1.0 - z * z).max(0.0).sqrt();
                Ray::new(origin, [ring * azimuth.cos(), ring * azimuth.sin(), z])
            })
            .collect()
    }
}
