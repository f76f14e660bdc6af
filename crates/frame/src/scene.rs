//! Scenes that frames show.

use std::sync::Arc;

use rasray_gpu::Device;
use rasray_gpu_scene::{GpuScene, PosePass};

use crate::FrameError;

/// A scene on the device with what moves it. Cheap to clone: clones are handles to the same scene.
#[derive(Clone, Debug)]
pub struct FrameScene(Arc<(GpuScene, Option<PosePass>)>);

impl FrameScene {
    /// A scene for renderers with that many frames in flight
    /// ([`FrameRenderer::slots`](crate::FrameRenderer::slots)). Where the structure is in parts,
    /// [`PosePass::parts`] was called before. Nothing waits for a scene that is [staged](GpuScene::staged);
    /// the first frame that shows it takes its tables to the device.
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

    /// The scene on the device.
    pub fn gpu(&self) -> &GpuScene {
        &self.0.0
    }

    /// The pass that moves the scene.
    pub fn pose(&self) -> Option<&PosePass> {
        self.0.1.as_ref()
    }

    /// True if both are handles to one scene.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
