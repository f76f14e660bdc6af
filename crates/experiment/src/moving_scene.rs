//! Scenes that the device moves.

use std::time::Instant;

use rasray_ads::GeometryParts;
use rasray_gpu::{Device, PassTiming, Stage, Timing};
use rasray_gpu_scene::{FramePose, PosePass, SceneTables};
use rasray_report::Pass;
use rasray_scene::needs::Needs;
use rasray_scene::{Camera, Moment, Scene};

use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::jobs::{Frame, Refresh, RenderJob};
use crate::passes::Passes;

/// Largest number of objects that have parts of their own.
const OBJECTS_MOST: usize = 32;

impl DeviceScene {
    /// Uploads as [`DeviceScene::new`] a scene at rest that [`DeviceScene::pose`] can show at any moment.
    ///
    /// # Errors
    /// As for [`DeviceScene::new`]; also if the scene cannot be posed on the device
    /// ([`Scene::is_posed_in_place`]).
    pub fn moving(
        device: &Device,
        scene: &Scene,
        camera: &Camera,
        size: [u32; 2],
        seed: u32,
        needs: &Needs,
    ) -> Result<Self, ExperimentError> {
        let origin = SceneTables::default_frame_origin(scene, camera.world_from_camera.translation);
        let (mut stage, tables) = Self::uploaded(device, scene, origin, camera, size, seed, needs)?;
        stage.pose = Some(PosePass::new(device, scene, &tables, &stage.scene)?);
        Ok(stage)
    }

    /// Uploads the scene of a job as it is shown, and returns the times of posing.
    ///
    /// # Errors
    /// As for [`DeviceScene::moving`] and [`DeviceScene::pose`].
    pub(super) fn of_job(device: &Device, job: &RenderJob<'_>) -> Result<(Self, PoseTimes), ExperimentError> {
        let Frame { width, height, seed, .. } = job.frame;
        let Some(moment) = job.moment else {
            let stage = Self::new(device, job.scene, &job.camera, [width, height], seed, &job.needs)?;
            return Ok((stage, PoseTimes::default()));
        };
        let mut stage = Self::moving(device, job.scene, &job.camera, [width, height], seed, &job.needs)?;
        // The parts are set first, because the pose measures their bounds.
        stage.parts(device, job.scene, job.refresh)?;
        let shown = stage.pose(device, job.scene, moment, device.best_timing())?;
        Ok((stage, shown))
    }

    /// True if [`DeviceScene::pose`] can show the scene at any moment.
    pub fn is_moving(&self) -> bool {
        self.pose.is_some()
    }

    /// Splits the geometry of the scene that this was made from into the parts that are built separately, and
    /// returns it; `None` if it is built as a whole. Once there are parts, they stay.
    ///
    /// # Errors
    /// Nothing of the scene moves on the device, memory runs out, or the device is lost.
    pub fn parts(
        &mut self,
        device: &Device,
        scene: &Scene,
        refresh: Refresh,
    ) -> Result<Option<GeometryParts>, ExperimentError> {
        if refresh == Refresh::All {
            return Ok(None);
        }
        let Some(pass) = self.pose.as_mut() else {
            return Err(ExperimentError::NoStillPart);
        };
        let parts = match refresh {
            Refresh::Objects => pass.objects(device, Some(scene), OBJECTS_MOST),
            _ => pass.parts(device),
        };
        Ok(Some(parts?))
    }

    /// Returns the flags of the moving parts that the last [`DeviceScene::pose`] moved; empty if all moved.
    pub fn moved(&self) -> &[bool] {
        &self.moved
    }

    /// Shows the scene that this was made from ([`DeviceScene::moving`]) at a moment: the moving parts are
    /// posed on the device. Structures and pictures of the moment before are stale afterwards. The data on
    /// the device does not depend on the moments that were shown before.
    ///
    /// # Errors
    /// The deformer or the device fails, or nothing of the scene moves on the device.
    pub fn pose(
        &mut self,
        device: &Device,
        scene: &Scene,
        moment: &Moment,
        timing: Timing,
    ) -> Result<PoseTimes, ExperimentError> {
        let (pose, times) = self.place(device, scene, moment, timing)?;
        let before = self.posed.take().zip(self.pose.as_ref());
        self.moved = before.map_or_else(Vec::new, |(before, pass)| pass.moved_parts(&before, &pose));
        self.posed = Some(pose);
        Ok(times)
    }

    /// Returns the positions, metres relative to the frame origin, and the indices of the triangles at
    /// another moment. The device keeps this moment until [`DeviceScene::pose`] shows a moment, which must
    /// follow. The flags of [`DeviceScene::moved`] then compare with the moment shown before.
    ///
    /// # Errors
    /// As for [`DeviceScene::pose`].
    pub(super) fn triangles_at(
        &self,
        device: &Device,
        scene: &Scene,
        moment: &Moment,
    ) -> Result<(Vec<[f32; 3]>, Vec<u32>), ExperimentError> {
        self.place(device, scene, moment, Timing::None)?;
        self.triangles(device)
    }

    /// Poses the moving parts at a moment.
    fn place(
        &self,
        device: &Device,
        scene: &Scene,
        moment: &Moment,
        timing: Timing,
    ) -> Result<(FramePose, PoseTimes), ExperimentError> {
        let Some(pass) = &self.pose else {
            return Err(ExperimentError::NotPosed);
        };
        let started = Instant::now();
        let pose = pass.frame(scene, moment)?;
        let host_milliseconds = started.elapsed().as_secs_f64() * 1.0e3;
        let submitted = device.submit_passes(timing, |recorder| pass.record(recorder, 0, &pose))?;
        Ok((pose, PoseTimes { host_milliseconds, passes: submitted.passes }))
    }
}

/// Times of posing a scene at a moment.
#[derive(Clone, Debug, Default)]
pub struct PoseTimes {
    /// Time on the host, milliseconds: matrices of a rig, or the simulation or file of a deformer.
    pub host_milliseconds: f64,
    /// Times of the passes on the device.
    pub passes: Vec<PassTiming>,
}

impl PoseTimes {
    /// Returns the times of the stage; empty if the device posed nothing.
    pub(super) fn times(&self) -> Passes {
        let mut passes = Passes::default();
        if !self.passes.is_empty() {
            passes.add_one(Stage::Pose, Pass::HOST, self.host_milliseconds);
            passes.add(&self.passes);
        }
        passes
    }
}
