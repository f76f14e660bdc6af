//! A scene that moves, on the device.

use std::time::Instant;

use glam::DVec3;
use rasray_ads::BoundsPass;
use rasray_gpu::{Device, PassTiming, Timing};
use rasray_gpu_scene::{Parts, PosePass, Sampling, SceneTables, View};
use rasray_scene::needs::Needs;
use rasray_scene::{Camera, Moment, Motion, Scene};

use crate::Stage;
use crate::error::ExperimentError;
use crate::stage::{device_error, scene_error};

/// A [`Stage`] whose vertices are put where they are at a moment, in the buffers that there are.
#[derive(Debug)]
pub struct MovingStage<'a> {
    /// The scene on the device, as it was shown last; at rest at first.
    pub stage: Stage,
    scene: &'a Scene,
    view: View,
    origin: DVec3,
    parts: Parts,
    mover: Mover,
}

/// Who moves the vertices.
#[derive(Debug)]
enum Mover {
    /// The device, by a rig.
    Device(Box<PosePass>),
    /// The host, which uploads positions, normals and tangents; the device measures the bounds.
    Host(BoundsPass),
}

/// What showing a moment took.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    /// On the host, milliseconds: matrices of a rig, or the upload of what the host deformed. Without what the scene itself
    /// took to simulate or to read.
    pub host_milliseconds: f64,
    /// On the device.
    pub passes: Vec<PassTiming>,
}

impl<'a> MovingStage<'a> {
    /// As [`Stage::new`], for a scene at rest.
    ///
    /// # Errors
    /// As [`Stage::new`]; and where triangles are others at every time: such a scene is uploaded anew ([`Stage::new`]).
    pub fn new(
        device: &Device,
        scene: &'a Scene,
        camera: &Camera,
        [width, height]: [u32; 2],
        seed: u32,
        needs: &Needs,
    ) -> Result<Self, ExperimentError> {
        let motion = scene.motion();
        if motion == Motion::Changing {
            let message = format!("the scene {} has other triangles at every time", scene.name);
            return Err(ExperimentError::usage(message, "choose a scene whose triangles stay"));
        }
        let origin = SceneTables::default_frame_origin(scene, camera.world_from_camera.translation);
        let view = View { camera: camera.clone(), width, height, seed };
        let parts = Parts::from(needs);
        let (stage, tables) = Stage::with_tables(device, scene, origin, &view, &parts)?;
        let mover = if motion == Motion::Deforming {
            Mover::Host(BoundsPass::new(device).map_err(device_error)?)
        } else {
            let pass = PosePass::new(device, scene, &tables, &stage.scene).map_err(scene_error)?;
            Mover::Device(Box::new(pass))
        };
        Ok(Self { stage, scene, view, origin, parts, mover })
    }

    /// Shows the scene at a moment, and waits. Frame origin and camera stay.
    ///
    /// # Errors
    /// The device fails, or what is simulated has other vertices than at rest.
    pub fn show(
        &mut self,
        device: &Device,
        moment: &Moment,
        timing: Timing,
    ) -> Result<Shown, ExperimentError> {
        let Self { stage, scene, view, .. } = self;
        let (host_milliseconds, submitted) = match &self.mover {
            Mover::Device(pass) => {
                let started = Instant::now();
                let pose = pass.frame(scene, moment).map_err(scene_error)?;
                let host = milliseconds(started);
                let submitted = device.submit_passes(timing, |recorder| {
                    pass.record(recorder, &pose);
                    stage.scene.record_frame(recorder, view, Sampling::default());
                });
                (host, submitted)
            }
            Mover::Host(bounds) => {
                let posed = scene.at(moment).map_err(ExperimentError::from)?;
                let tables = SceneTables::new(&posed, self.origin, &self.parts).map_err(scene_error)?;
                let geometry = stage.scene.geometry();
                let buffers = stage.scene.posed_buffers();
                let attributes = size_of_val(&tables.posed_attributes[..]) as u64;
                let (vertices, triangles) = (tables.posed.positions.len(), tables.posed.indices.len() / 3);
                if vertices != geometry.desc().vertex_count as usize
                    || triangles != geometry.triangle_count() as usize
                    || attributes > buffers.attributes.size()
                {
                    let message = format!("the scene {} has other vertices than at rest", scene.name);
                    return Err(ExperimentError::refused(message, "upload it anew for each moment"));
                }
                let started = Instant::now();
                let positions = &geometry.desc().positions.buffer;
                device.upload_slice(positions, 0, &tables.posed.positions).map_err(device_error)?;
                device
                    .upload_slice(&buffers.attributes, 0, &tables.posed_attributes)
                    .map_err(device_error)?;
                let host = milliseconds(started);
                let submitted = device.submit_passes(timing, |recorder| {
                    bounds.record(recorder, geometry);
                    stage.scene.record_frame(recorder, view, Sampling::default());
                });
                (host, submitted)
            }
        };
        Ok(Shown { host_milliseconds, passes: submitted.map_err(device_error)?.passes })
    }
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1.0e3
}
