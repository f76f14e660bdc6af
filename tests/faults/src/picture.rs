//! A picture of 16 x 16 pixels: everything that a render does, once.

use rasray_gpu::Device;
use rasray_gpu_scene::GpuScene;
use rasray_integrators::{Film, Integrator, IntegratorDesc, Path};
use rasray_systems::Spec;
use rasray_tracer::build_until_complete;

use crate::{Failure, stage};

/// Uploads a scene, builds a structure, traces a path of one bounce in each of 16 x 16 pixels, and returns
/// the bits of the radiance: equal pictures are equal bit for bit.
///
/// # Errors
/// The device or the structure fails.
pub fn picture(device: &Device, spec: &Spec) -> Result<Vec<[u32; 3]>, Failure> {
    picture_of(device, spec, &stage(device)?)
}

/// [`picture`] of a scene that is on the device.
///
/// # Errors
/// The device or the structure fails.
pub fn picture_of(device: &Device, spec: &Spec, scene: &GpuScene) -> Result<Vec<[u32; 3]>, Failure> {
    let timing = device.best_timing();
    let mut structure = spec.create(device, scene.geometry(), Some(scene.binding()))?;
    build_until_complete(device, structure.as_mut(), scene.eye(), timing)?;
    let [width, height] = scene.image_size();
    let film = Film::new(device, width, height)?;
    let integrator = Path::new(&IntegratorDesc::new(device, scene, &film), 1)?;
    device.submit(|recorder| integrator.record_reset(recorder))?;
    for wave in film.bands().waves(0..1, integrator.wave_capacity()) {
        let submitted = device.submit_passes(timing, |recorder| {
            integrator.record_wave(recorder, structure.as_ref().into(), wave)
        })?;
        submitted.value?;
    }
    Ok(film.read(device)?.into_iter().map(|pixel| pixel.map(f32::to_bits)).collect())
}
