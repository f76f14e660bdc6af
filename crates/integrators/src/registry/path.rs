//! Path tracing with light sampling.

use rasray_ads::{Domain, RayQueue};
use rasray_gpu::{Buffer, Device, Recorder};
use rasray_gpu_scene::{GpuScene, ShadingFeatures};
use rasray_options::Value;
use rasray_scene::ShadowTerminator;
use rasray_scene::needs::Workload;
use rasray_shaders_glsl::{
    INTEGRATORS_FILM_ACCUMULATE, INTEGRATORS_PATH_RESOLVE, INTEGRATORS_PATH_SHADE,
    INTEGRATORS_PATH_SHADE_HITS, INTEGRATORS_PATH_SHADE_PASSING, INTEGRATORS_PATH_SHADE_PASSING_HITS,
    INTEGRATORS_PATH_SHADE_PASSING_PHOTONS, INTEGRATORS_PATH_SHADE_PHOTONS, INTEGRATORS_PRIMARY,
    constant_ids::integrators::{PATHS_PASS_PANES, PHOTONS_ARE_ALL},
    constant_ids::scene::{SPECULAR_IS_WARD, TERMINATOR_IS_SMOOTH},
    constants::scene::PATH_LAYER_LIMIT,
    records::{PathState, PathWaiting},
};

use crate::{
    Fetch, Film, Integrator, IntegratorDesc, IntegratorError, IntegratorRow, RayKind, Traced, Wave,
    integrator::check_features,
    kernels::{
        Bindings, Bound, Kernel, WaveConstants, binding, camera_constants, device_buffer, film, shadow_queue,
    },
    rounds::Rounds,
};

mod options;

pub use options::{BOUNCE_LIMIT, Fetching, GlassShadows, PathOptions, SpecularLobe};
pub(super) use options::{BOUNCES, SHADOW_TERMINATOR, SPECULAR};
use options::{FETCH, GLASS_SHADOWS};

/// Row of the registry.
pub(super) const ROW: IntegratorRow = IntegratorRow {
    name: "path",
    doc: "Path tracing with light sampling",
    options: &[&BOUNCES, &GLASS_SHADOWS, &SHADOW_TERMINATOR, &SPECULAR, &FETCH],
    rays: &[RayKind::Camera, RayKind::Scattered, RayKind::Shadow],
    workload: |spec| match PathOptions::of(spec).bounces {
        0 => Workload {
            emission: true,
            blends: true,
            why: "with 0 bounces no light is scattered",
            ..Workload::VISIBILITY
        },
        _ => Workload::ALL,
    },
    make: |desc, spec| Ok(Box::new(Path::new(desc, PathOptions::of(spec))?)),
};

/// Number of surfaces passed in a straight line that the rounds of a wave allow for at first.
pub(super) const USUAL_LAYERS: u32 = 8;

/// Largest number of rounds in one recording of a wave; more are recorded as its rest.
pub(super) const ROUND_LIMIT: u32 = 2 * BOUNCE_LIMIT + 1 + 2 * PATH_LAYER_LIMIT;

/// Path tracing with a limited number of scatterings. In every round each path that continues traces one
/// closest-hit ray and at most one shadow ray; paths that have ended take part in no pass.
///
/// If surfaces let light pass in a straight line, blended ones and smooth thin panes, shadow rays go through
/// them as paths do. Each round then traces one of the two rays for each path, and there are as many rounds
/// as needed ([`Integrator::record_rest`], [`Integrator::allow_more_rounds`]).
#[derive(Debug)]
pub struct Path {
    bounces: u32,
    /// Closest-hit rounds of a wave.
    rounds: Rounds,
    /// Features that the kernels were made for.
    features: ShadingFeatures,
    film: Film,
    queue: RayQueue,
    states: Buffer,
    shadows: Shadows,
    bindings: Bindings,
    primary: Kernel,
    shade: Kernel,
    /// True if the kernels look up surfaces by the hits in the queue.
    of_hits: bool,
    /// Fetch that finds surfaces in place of the structure.
    fetch: Option<Fetch>,
}

/// Buffers and kernels that test light samples.
#[derive(Debug)]
enum Shadows {
    /// Any hit stops a shadow ray: shadow rays have a queue of their own, traced for occlusion.
    Occluded { queue: RayQueue, pending: Buffer, resolve: Kernel, accumulate: Kernel },
    /// Surfaces may let a ray pass: shadow rays use the queue of the paths, which wait.
    Passing { waiting: Buffer },
}

/// Photon map that paths gather.
#[derive(Clone, Copy)]
pub(super) struct Gathered<'a> {
    /// Buffers of the map that kernels bind.
    pub bound: &'a [Bound<'a>],
    /// True if the map has all indirect light, and not caustics alone.
    pub all: bool,
}

impl Path {
    /// Makes queues, states and kernels. A number of bounces converts into options.
    ///
    /// # Errors
    /// An error for more than [`BOUNCE_LIMIT`] bounces, sizes that do not fit, out of memory, or if the
    /// device refuses a pipeline.
    pub fn new(desc: &IntegratorDesc<'_>, options: impl Into<PathOptions>) -> Result<Self, IntegratorError> {
        Self::gathering(desc, options.into(), None)
    }

    /// Makes paths that gather the given photons. With photons, light goes through panes by scattering alone,
    /// and surfaces are in the queue.
    pub(super) fn gathering(
        desc: &IntegratorDesc<'_>,
        options: PathOptions,
        gathered: Option<Gathered<'_>>,
    ) -> Result<Self, IntegratorError> {
        let PathOptions { bounces, glass_shadows, shadow_terminator, specular, fetch } = options;
        BOUNCES.check(Value::Whole(bounces))?;
        let tints = glass_shadows == GlassShadows::Tint && gathered.is_none();
        let panes = desc.features.panes && bounces > 0 && tints;
        let passing = desc.features.blend || panes;
        let capacity = desc.check()?;
        let device = desc.device;
        let queue = RayQueue::new(device, "path rays", capacity, true)?;
        let slots = u64::from(capacity);
        let buffer = |name, bytes: usize| device_buffer(device, name, slots * bytes as u64);
        let states = buffer("path states", size_of::<PathState>())?;
        let bind = |more: &[Bound<'_>]| {
            let photons = gathered.map_or(&[][..], |gathered| gathered.bound);
            let own = [&[(binding::PATH_STATES, &states)], more, photons].concat();
            Bindings::new(device, desc.scene, &film(desc.film), &own)
        };
        let (shadows, bindings) = if passing {
            let waiting = buffer("waiting paths", size_of::<PathWaiting>())?;
            let bindings = bind(&[(binding::WAITING, &waiting)])?;
            (Shadows::Passing { waiting }, bindings)
        } else {
            let queue = RayQueue::new(device, "shadow rays", capacity, false)?;
            let pending = buffer("pending radiance", size_of::<[f32; 3]>())?;
            let [rays, header, list] = shadow_queue(&queue);
            let bindings = bind(&[(binding::PENDING, &pending), rays, header, list])?;
            let resolve = bindings.kernel(device, &INTEGRATORS_PATH_RESOLVE, &[])?;
            let accumulate = bindings.kernel(device, &INTEGRATORS_FILM_ACCUMULATE, &[])?.of_film();
            (Shadows::Occluded { queue, pending, resolve, accumulate }, bindings)
        };
        let of_hits = desc.surfaces_of_hits && fetch == Fetching::Direct && gathered.is_none();
        let shader = match (passing, of_hits) {
            (false, _) if gathered.is_some() => &INTEGRATORS_PATH_SHADE_PHOTONS,
            (true, _) if gathered.is_some() => &INTEGRATORS_PATH_SHADE_PASSING_PHOTONS,
            (false, false) => &INTEGRATORS_PATH_SHADE,
            (false, true) => &INTEGRATORS_PATH_SHADE_HITS,
            (true, false) => &INTEGRATORS_PATH_SHADE_PASSING,
            (true, true) => &INTEGRATORS_PATH_SHADE_PASSING_HITS,
        };
        let mut constants = Vec::from(desc.features.constants());
        constants.push((PATHS_PASS_PANES, panes.into()));
        constants.push((TERMINATOR_IS_SMOOTH, (shadow_terminator == ShadowTerminator::Offset).into()));
        constants.push((SPECULAR_IS_WARD, (specular == SpecularLobe::Ward).into()));
        constants.extend(gathered.map(|gathered| (PHOTONS_ARE_ALL, gathered.all.into())));
        Ok(Self {
            bounces,
            rounds: Rounds::new(rounds(bounces, passing), ROUND_LIMIT),
            features: desc.features,
            primary: bindings.kernel(device, &INTEGRATORS_PRIMARY, &camera_constants(false))?,
            shade: bindings.kernel(device, shader, &constants)?,
            of_hits,
            fetch: (fetch == Fetching::Raster)
                .then(|| Fetch::new(device, desc.scene, capacity))
                .transpose()?,
            film: desc.film.clone(),
            queue,
            states,
            shadows,
            bindings,
        })
    }
}

/// Returns the number of rounds that a wave has at first. A path needs one closest-hit round per scattering
/// and one for the hit of the last scattered ray. With passing shadow rays it also needs one per scattering
/// for them, and one for every surface that a ray passes, of which there may be more: these are the rest of
/// the wave.
fn rounds(bounces: u32, passing: bool) -> u32 {
    if passing { 2 * bounces + 1 + USUAL_LAYERS } else { bounces + 1 }
}

impl Path {
    /// Returns the fetch of surfaces by drawing, if the options ask for it.
    pub fn fetch(&self) -> Option<&Fetch> {
        self.fetch.as_ref()
    }

    /// Returns `traced` with surfaces found as the kernel expects them.
    fn finding<'a>(&'a self, traced: Traced<'a>) -> Result<Traced<'a>, IntegratorError> {
        let traced = traced.with_fetch(self.fetch.as_ref());
        if self.of_hits { traced.with_surfaces_of_hits() } else { Ok(traced) }
    }

    /// Records the rounds of paths whose shadow rays end at any hit, and all additions to the film.
    fn record_occluded(
        &self,
        recorder: &mut Recorder<'_>,
        (traced, wave): (Traced<'_>, Wave),
        (shadows, resolve, accumulate): (&RayQueue, &Kernel, &Kernel),
    ) -> Result<(), IntegratorError> {
        let (paths, all) = (&self.queue, Domain::First(wave.pixel_count));
        let mut constants = WaveConstants { limit: self.bounces, ..WaveConstants::from(wave) };
        shadows.record_select_none(recorder);
        // In the first round these are all slots, later those whose paths continue.
        let mut live = all;
        let rounds = self.rounds.now();
        for round in 0..rounds {
            constants.round = round;
            if round == 0 {
                traced.record_primary(recorder, paths, wave)?;
            } else {
                traced.record_closest(recorder, paths, live)?;
            }
            self.bindings.record(recorder, &self.shade, paths, live, &constants);
            // In the last round every path has reached the maximum number of scatterings and samples no
            // light.
            if round + 1 < rounds {
                paths.record_take(recorder);
                shadows.record_take(recorder);
                live = Domain::Selected;
                traced.record_occluded(recorder, shadows, Domain::Selected);
                self.bindings.record(recorder, resolve, shadows, Domain::Selected, &constants);
            }
        }
        self.bindings.record(recorder, accumulate, paths, all, &constants);
        Ok(())
    }

    /// Records rounds in which rays may pass surfaces, of a new wave or of the rest of one. Paths that end
    /// add to the film.
    fn record_passing(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
        is_rest: bool,
    ) -> Result<(), IntegratorError> {
        self.rounds.record(recorder, (traced, wave), &self.queue, is_rest, |recorder, live, constants| {
            let constants = WaveConstants { limit: self.bounces, ..constants };
            self.bindings.record(recorder, &self.shade, &self.queue, live, &constants);
        })
    }
}

impl Integrator for Path {
    fn name(&self) -> &'static str {
        ROW.name
    }

    fn record_wave(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        self.bindings.record_camera_rays(recorder, &self.primary, &self.queue, wave)?;
        self.queue.record_select_none(recorder);
        let traced = self.finding(traced)?;
        match &self.shadows {
            Shadows::Occluded { queue, resolve, accumulate, .. } => {
                self.record_occluded(recorder, (traced, wave), (queue, resolve, accumulate))
            }
            Shadows::Passing { .. } => self.record_passing(recorder, traced, wave, false),
        }
    }

    fn record_rest(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        self.bindings.check(&self.queue, wave)?;
        match &self.shadows {
            Shadows::Occluded { .. } => Ok(()),
            Shadows::Passing { .. } => self.record_passing(recorder, self.finding(traced)?, wave, true),
        }
    }

    fn has_rest(&self, device: &Device) -> Result<bool, IntegratorError> {
        match &self.shadows {
            Shadows::Occluded { .. } => Ok(false),
            Shadows::Passing { .. } => Ok(self.film.read_faults(device)?.unended > 0),
        }
    }

    fn allow_more_rounds(&self) -> bool {
        match &self.shadows {
            Shadows::Occluded { .. } => false,
            Shadows::Passing { .. } => self.rounds.allow_more(),
        }
    }

    fn asks_occluder(&self) -> bool {
        self.bounces > 0 && matches!(self.shadows, Shadows::Occluded { .. })
    }

    fn set_scene(&mut self, scene: &GpuScene) -> Result<(), IntegratorError> {
        check_features(self.features, scene)?;
        if let Some(fetch) = &mut self.fetch {
            fetch.set_scene(scene)?;
        }
        self.bindings.set_scene(scene);
        Ok(())
    }

    fn film(&self) -> &Film {
        &self.film
    }

    fn queues(&self) -> Vec<&RayQueue> {
        match &self.shadows {
            Shadows::Occluded { queue, .. } => vec![&self.queue, queue],
            Shadows::Passing { .. } => vec![&self.queue],
        }
    }

    fn traces_per_wave(&self) -> u32 {
        match &self.shadows {
            Shadows::Occluded { .. } => 2 * self.rounds.now() - 1,
            Shadows::Passing { .. } => self.rounds.now(),
        }
    }

    fn state_bytes(&self) -> u64 {
        let (Shadows::Occluded { pending: shadows, .. } | Shadows::Passing { waiting: shadows }) =
            &self.shadows;
        self.states.size() + shadows.size()
    }

    fn fetch_bytes(&self) -> u64 {
        self.fetch.as_ref().map_or(0, Fetch::bytes)
    }

    fn record_reset(&self, recorder: &mut Recorder<'_>) {
        self.film.record_clear(recorder);
        for queue in self.queues() {
            queue.record_reset(recorder);
        }
        if let Some(fetch) = &self.fetch {
            fetch.record_reset(recorder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_round_a_scattering_and_one_for_what_is_met_last() {
        assert_eq!(rounds(0, false), 1);
        assert_eq!(rounds(4, false), 5);
        assert_eq!(rounds(4, true), 9 + USUAL_LAYERS);
        assert!(rounds(BOUNCE_LIMIT, true) < ROUND_LIMIT);
    }
}
