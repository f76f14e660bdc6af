//! Primitive lists in a plain ash program with its own device: built, traced, compared with brute
//! force.

use rasray_ads::{BruteForce, Check, Domain, Hit, RayQueue, Structure, TraceMode};
use rasray_ads_primitive::{Config, PrimitiveLists};
use rasray_gpu::{Device, Recorder};

#[path = "../../ads/examples/host/mod.rs"]
mod host;

use host::{Host, Result, staircase};

/// Runs the program; an error where hits differ or the validation layer complains.
pub fn main() -> Result<()> {
    let config = Config::robust(128);
    let enabled = PrimitiveLists::requirements_of(&config).required;
    let host = Host::new(&enabled)?;
    // SAFETY: the device was made with these features, by the host, which goes last.
    let device = unsafe { Device::from_raw(host.raw_device(&enabled)) }?;
    let mesh = staircase(500);
    let geometry = host.geometry(&device, &mesh, host.buffer(&mesh.positions)?)?;
    let found = hits(&host, &device, &mut PrimitiveLists::new(&device, config, &geometry, None)?)?;
    let expected = hits(&host, &device, &mut BruteForce::new(&device, &geometry, None, false)?)?;
    host.compare(&found, &expected, 0.0)
}

/// Builds and traces in one command buffer of the host; once more where a build asks for more room.
fn hits(host: &Host, device: &Device, structure: &mut dyn Structure) -> Result<Vec<Hit>> {
    let rays = host::rays();
    let queue = RayQueue::new(device, "rays", rays.len() as u32, false)?;
    device.upload_slice(queue.rays(), 0, &rays)?;
    loop {
        structure.prepare_build(device)?;
        let recorded = host.submit(0, |commands| {
            // SAFETY: the command buffer is being recorded by nobody else, and `recorded` outlives the wait below.
            let mut recorder = unsafe { Recorder::from_raw(device, commands) };
            queue.record_reset(&mut recorder);
            structure.record_build(&mut recorder, 0, [0.5, 0.5, -0.5].into())?;
            structure.record_trace(
                &mut recorder,
                &queue,
                Domain::First(1000),
                TraceMode::Closest,
                structure.rounds(),
            );
            Ok(recorder.finish()?)
        })?;
        host.wait(0)?;
        drop(recorded);
        match structure.check(&structure.status(0)?, 0)? {
            Check::Complete => return Ok(device.download_as(queue.hits(), 0, rays.len())?),
            Check::Grow(sizes) => structure.resize(device, &sizes)?,
        }
    }
}
