//! Path tracing with light sampling.

use rasray_ads::{Domain, RayQueue};
use rasray_gpu::{Buffer, Recorder};
use rasray_gpu_scene::{GpuScene, ShadingFeatures};
use rasray_shaders_glsl::{
    INTEGRATORS_FILM_ACCUMULATE, INTEGRATORS_PATH_RESOLVE, INTEGRATORS_PATH_SHADE, INTEGRATORS_PRIMARY,
    constants::scene::PATH_LAYER_LIMIT, records::PathState,
};

use crate::{
    Film, Integrator, IntegratorDesc, IntegratorError, Traced, Wave,
    integrator::{check_features, check_wave},
    kernels::{Bindings, Kernel, Storage, WaveConstants, camera_constants, device_buffer},
};

/// Maximum number of scatterings of a path. A wave records up to this number of rounds.
pub const BOUNCE_LIMIT: u32 = 1024;

/// Paths of at most `bounces` scatterings. In every round each path that goes on traces one
/// closest-hit ray and at most one shadow ray; paths that have ended take part in no pass.
#[derive(Debug)]
pub struct Path {
    bounces: u32,
    /// Closest-hit rounds of a wave.
    rounds: u32,
    /// What the kernels were made for.
    features: ShadingFeatures,
    film: Film,
    queue: RayQueue,
    shadow_queue: RayQueue,
    states: Buffer,
    pending: Buffer,
    bindings: Bindings,
    primary: Kernel,
    shade: Kernel,
    resolve: Kernel,
    accumulate: Kernel,
}

impl Path {
    /// Makes queues, states and kernels. `bounces` 1 is direct light only, 0 emission only.
    ///
    /// # Errors
    /// More than [`BOUNCE_LIMIT`] bounces, sizes that do not fit, out of memory, or the device
    /// refuses a pipeline.
    pub fn new(desc: &IntegratorDesc<'_>, bounces: u32) -> Result<Self, IntegratorError> {
        if bounces > BOUNCE_LIMIT {
            return Err(IntegratorError::Option {
                option: "bounces",
                value: bounces.to_string(),
                expected: "at most 1024",
            });
        }
        let capacity = desc.check()?;
        let device = desc.device;
        let queue = RayQueue::new(device, "path rays", capacity, true)?;
        let shadow_queue = RayQueue::new(device, "shadow rays", capacity, false)?;
        let slots = u64::from(capacity);
        let states = device_buffer(device, "path states", slots * size_of::<PathState>() as u64)?;
        let pending = device_buffer(device, "pending radiance", slots * size_of::<[f32; 3]>() as u64)?;
        let storage = Storage {
            film: Some(desc.film.pixels()),
            film_faults: Some(desc.film.faults()),
            path_states: Some(&states),
            pending: Some(&pending),
            shadow: Some(&shadow_queue),
            ..Storage::default()
        };
        let bindings = Bindings::new(device, desc.scene, &storage)?;
        Ok(Self {
            bounces,
            rounds: rounds(bounces, desc.features.blend),
            features: desc.features,
            primary: bindings.kernel(device, &INTEGRATORS_PRIMARY, &camera_constants(false))?,
            shade: bindings.kernel(device, &INTEGRATORS_PATH_SHADE, &desc.features.constants())?,
            resolve: bindings.kernel(device, &INTEGRATORS_PATH_RESOLVE, &[])?,
            accumulate: bindings.kernel(device, &INTEGRATORS_FILM_ACCUMULATE, &[])?,
            film: desc.film.clone(),
            queue,
            shadow_queue,
            states,
            pending,
            bindings,
        })
    }
}

/// Closest-hit rounds that a path can need: one per scattering, one for what the last scattered ray hits, and one for
/// every blended surface that it passes.
fn rounds(bounces: u32, blend: bool) -> u32 {
    bounces + 1 + if blend { PATH_LAYER_LIMIT } else { 0 }
}

impl Integrator for Path {
    fn name(&self) -> &'static str {
        "path"
    }

    fn record_wave(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        check_wave(wave, self.queue.capacity(), self.film.pixel_count())?;
        let (paths, shadows) = (&self.queue, &self.shadow_queue);
        let all = Domain::First(wave.pixel_count);
        // In the first round these are all slots, later those whose paths continue.
        let mut live = all;
        let mut constants = WaveConstants { bounces: self.bounces, ..WaveConstants::from(wave) };
        self.bindings.record(recorder, &self.primary, paths, all, &constants);
        paths.record_select_none(recorder);
        shadows.record_select_none(recorder);
        for round in 0..self.rounds {
            constants.round = round;
            if round == 0 {
                traced.record_primary(recorder, paths, wave)?;
            } else {
                traced.record_closest(recorder, paths, live)?;
            }
            self.bindings.record(recorder, &self.shade, paths, live, &constants);
            // In the last round every path has reached the maximum number of scatterings and samples no light.
            if round + 1 < self.rounds {
                paths.record_take(recorder);
                shadows.record_take(recorder);
                live = Domain::Selected;
                traced.record_occluded(recorder, shadows, Domain::Selected);
                self.bindings.record(recorder, &self.resolve, shadows, Domain::Selected, &constants);
            }
        }
        self.bindings.record(recorder, &self.accumulate, paths, all, &constants);
        Ok(())
    }

    fn set_scene(&mut self, scene: &GpuScene) -> Result<(), IntegratorError> {
        check_features(self.features, scene)?;
        self.bindings.set_scene(scene);
        Ok(())
    }

    fn film(&self) -> &Film {
        &self.film
    }

    fn queues(&self) -> Vec<&RayQueue> {
        vec![&self.queue, &self.shadow_queue]
    }

    fn traces_per_wave(&self) -> u32 {
        2 * self.rounds - 1
    }

    fn state_bytes(&self) -> u64 {
        self.states.size() + self.pending.size()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_round_a_scattering_and_one_for_what_is_met_last() {
        assert_eq!(rounds(0, false), 1);
        assert_eq!(rounds(4, false), 5);
        assert_eq!(rounds(4, true), 5 + PATH_LAYER_LIMIT);
    }
}
