//! Scenes that frames show.

use std::sync::Arc;

use rasray_gpu::Device;
use rasray_gpu_scene::{GpuScene, PosePass};

use crate::FrameError;

/// A scene on the device with the pass that moves it. Clones are cheap handles to the same scene.
#[derive(Clone, Debug)]
pub struct FrameScene(Arc<(GpuScene, Option<PosePass>)>);

impl FrameScene {
    /// Makes a scene for renderers with the given number of frames in flight
    /// ([`FrameRenderer::slots`](crate::FrameRenderer::slots)). If the structure is in parts,
    /// [`PosePass::parts`] must have been called before. A scene that is [staged](GpuScene::staged) is not
    /// waited for; the first frame that shows it copies its tables to the device.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(
        device: &Device,
        scene: GpuScene,
        mut pose: Option<PosePass>,
        slots: u32,
    ) -> Result<Self, FrameError> {
        if let Some(pose) = &mut pose {
            pose.set_slots(device, slots)?;
        }
        Ok(Self(Arc::new((scene, pose))))
    }

    /// Returns the scene on the device.
    pub fn gpu(&self) -> &GpuScene {
        &self.0.0
    }

    /// Returns the pass that moves the scene.
    pub fn pose(&self) -> Option<&PosePass> {
        self.0.1.as_ref()
    }

    /// Returns true if both are handles to one scene.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
