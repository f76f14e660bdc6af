//! Builds and traces a structure in the command buffers of the host, and resizes it if a build needs more
//! capacity. The code is the same for every structure.

use rasray_ads::{Check, Domain, Hit, RayQueue, Structure, Trace};
use rasray_gpu::{Device, Recorder};

use super::{Host, Result, rays};

/// Maximum number of builds; a demand that takes more counts as not stable. Most structures need two. A
/// structure whose demand is known only once an earlier pool sufficed needs a few more.
const BUILDS: u32 = 9;

/// Builds and traces in one command buffer of the host; repeats both if a build needs more capacity, or a ray
/// more rounds.
pub fn hits(host: &Host, device: &Device, structure: &mut dyn Structure) -> Result<Vec<Hit>> {
    let rays = rays();
    let queue = RayQueue::new(device, "rays", rays.len() as u32, false)?;
    device.upload_slice(queue.rays(), 0, &rays)?;
    let mut lacking = None;
    for _ in 0..BUILDS {
        structure.prepare_build(device)?;
        let recorded = host.submit(0, |commands| {
            // SAFETY: the command buffer is being recorded by nobody else, and `recorded` outlives the wait
            // below.
            let mut recorder = unsafe { Recorder::from_raw(device, commands) };
            queue.record_reset(&mut recorder);
            structure.record_build(&mut recorder, 0, [0.5, 0.5, -0.5].into())?;
            structure.record_trace(&mut recorder, &queue, Trace::closest(Domain::First(1000)));
            Ok(recorder.finish()?)
        })?;
        host.wait(0)?;
        drop(recorded);
        let status = structure.status(0)?;
        match structure.check(&status, 0)? {
            Check::Complete if queue.download_counters(device)?.unfinished == 0 => {
                return Ok(device.download_as(queue.hits(), 0, rays.len())?);
            }
            Check::Complete if structure.allow_more_rounds() => continue,
            Check::Complete => return Err("rays do not finish in any number of rounds".into()),
            Check::Grow(sizes) => structure.resize(device, &sizes)?,
        }
        lacking = status.shortest_pool();
    }
    let name = structure.description().name;
    let lacking = lacking.map(|pool| format!(": {pool}")).unwrap_or_default();
    Err(format!(
        "{name} is still incomplete after {BUILDS} builds{lacking}; give `check` a headroom, such as 50 percent, or choose \
         options with fewer cells"
    )
    .into())
}
