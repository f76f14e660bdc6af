//! Photon maps: photons carry light by mirrors and glass, or by any surface; paths carry the rest.

use rasray_ads::RayQueue;
use rasray_gpu::{Device, PassTiming, Recorder, Timing};
use rasray_gpu_scene::GpuScene;
use rasray_scene::needs::Workload;

use super::path::{BOUNCES, Gathered, SHADOW_TERMINATOR, SPECULAR};
use super::sample_map::SampleMap;
use crate::{
    Film, Integrator, IntegratorDesc, IntegratorError, IntegratorRow, Path, RayKind, Traced, Wave,
    check_faults, integrator::submit_with_rest,
};

mod map;
mod options;

use map::MapPasses;
pub use map::PhotonMap;
use options::{PHOTON_PATHS, PHOTONS, RADIUS};
pub use options::{PhotonKind, PhotonOptions};

/// Row of the registry.
pub(super) const ROW: IntegratorRow = IntegratorRow {
    name: "photons",
    doc: "Photon maps: caustics, or all indirect light, by photons from the lights; the rest as path",
    options: &[&BOUNCES, &SHADOW_TERMINATOR, &SPECULAR, &PHOTONS, &PHOTON_PATHS, &RADIUS],
    rays: &[RayKind::Camera, RayKind::Scattered, RayKind::Shadow],
    workload: |_| Workload::ALL,
    make: |desc, spec| Ok(Box::new(Photons::new(desc, PhotonOptions::of(spec))?)),
};

/// Photon mapping: paths that gather photons at rough surfaces. Each sample has a map of its own with a
/// smaller radius than the one before, so that the mean over samples has no bias in the limit. The map is
/// traced through the structure, once per sample, in waves of its own; it does not depend on the division of
/// the picture into waves.
///
/// If surfaces blend, photons may need more rounds than are recorded, and the camera's surfaces can gather
/// only after them: [`Integrator::render_wave`] waits for them, and frames are repeated with more rounds
/// ([`Integrator::allow_more_rounds`]).
#[derive(Debug)]
pub struct Photons {
    map: MapPasses,
    /// Paths from the camera.
    seen: Path,
    of_sample: SampleMap,
}

impl Photons {
    /// Makes queues, states, kernels and the map.
    ///
    /// # Errors
    /// An error for an option out of its range, sizes that do not fit, out of memory, or if the device
    /// refuses a pipeline.
    pub fn new(desc: &IntegratorDesc<'_>, options: PhotonOptions) -> Result<Self, IntegratorError> {
        options.check()?;
        desc.check()?;
        BOUNCES.check(rasray_options::Value::Whole(options.paths.bounces))?;
        let map = MapPasses::new(desc, options)?;
        let gathered = Gathered { bound: &map.bound(), all: options.kind == PhotonKind::All };
        let seen = Path::gathering(desc, options.paths, Some(gathered))?;
        Ok(Self { map, seen, of_sample: SampleMap::default() })
    }

    /// Downloads the photons of the sample that was recorded last: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read_map(&self, device: &Device) -> Result<PhotonMap, IntegratorError> {
        self.map.read(device)
    }
}

impl Integrator for Photons {
    fn name(&self) -> &'static str {
        ROW.name
    }

    fn record_wave(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        if self.of_sample.is_needed(wave) {
            self.map.record(recorder, traced, wave.sample, false)?;
            self.of_sample.was_made(wave);
        }
        self.seen.record_wave(recorder, traced, wave)
    }

    fn record_rest(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        self.seen.record_rest(recorder, traced, wave)
    }

    fn has_rest(&self, device: &Device) -> Result<bool, IntegratorError> {
        self.seen.has_rest(device)
    }

    fn render_wave(
        &self,
        device: &Device,
        timing: Timing,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<Vec<PassTiming>, IntegratorError> {
        let mut timings = Vec::new();
        if self.of_sample.is_needed(wave) {
            timings = submit_with_rest(
                (device, timing),
                |recorder, is_rest| self.map.record(recorder, traced, wave.sample, is_rest),
                || self.seen.has_rest(device),
            )?;
            self.of_sample.was_made(wave);
        }
        timings.extend(self.seen.render_wave(device, timing, traced, wave)?);
        check_faults(&self.film().read_faults(device)?)?;
        Ok(timings)
    }

    fn allow_more_rounds(&self) -> bool {
        // Both get more rounds: the faults do not tell whose rays have not ended.
        let map = self.map.rounds().allow_more();
        self.seen.allow_more_rounds() | map
    }

    fn asks_occluder(&self) -> bool {
        self.seen.asks_occluder()
    }

    fn set_scene(&mut self, scene: &GpuScene) -> Result<(), IntegratorError> {
        self.seen.set_scene(scene)?;
        self.map.set_scene(scene);
        self.of_sample.forget();
        Ok(())
    }

    fn film(&self) -> &Film {
        self.seen.film()
    }

    fn queues(&self) -> Vec<&RayQueue> {
        self.seen.queues().into_iter().chain([self.map.queue()]).collect()
    }

    fn wave_capacity(&self) -> u32 {
        self.seen.wave_capacity()
    }

    fn traces_per_wave(&self) -> u32 {
        self.seen.traces_per_wave() + self.map.rounds().now()
    }

    fn state_bytes(&self) -> u64 {
        self.seen.state_bytes() + self.map.bytes()
    }
}
