//! List of the passes of a structure on a scene: the commands of a build, a trace and a surface lookup.

use rasray_ads::{Domain, RayQueue, Trace, TracedPart};
use rasray_gpu::{Device, PassCommands};

use crate::built::Built;
use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::jobs::RenderJob;

/// Number of rays of the traces that are listed: the smallest possible, since it is not a property of the
/// structure.
const RAYS: u32 = 1;

/// Builds until complete, so that sizes are those of the scene, and lists the commands of one more build, of
/// traces of both kinds and of the lookup of surfaces.
pub(super) fn pass_list(device: &Device, job: &RenderJob<'_>) -> Result<Vec<PassCommands>, ExperimentError> {
    let spec = job.system.spec()?;
    let (mut stage, _) = DeviceScene::of_job(device, job)?;
    let mut built = Built::refreshed(device, &spec, &mut stage, (job.scene, job.refresh))?;
    let queue = RayQueue::new(device, "listed", RAYS, true)?;
    let viewpoint = stage.scene.viewpoint().at(stage.scene.eye());
    let frames = &mut built.frames;
    frames.geometry_moved();
    frames.prepare(device, viewpoint)?;
    let submitted = device.submit(|recorder| {
        queue.record_reset(recorder);
        frames.record(recorder, 0, viewpoint)?;
        let (structure, all) = (frames.structure(), Domain::First(RAYS));
        structure.record_trace(recorder, &queue, Trace::closest(all));
        structure.record_trace(recorder, &queue, Trace::occluded(all));
        structure.record_surfaces(recorder, &queue, all, TracedPart::Whole)?;
        Ok::<_, rasray_ads::AdsError>(recorder.passes().to_vec())
    })?;
    Ok(submitted.value?)
}
