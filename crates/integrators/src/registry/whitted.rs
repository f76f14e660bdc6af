//! Whitted's ray tracing: direct light, and the trees of mirrored and refracted rays.

use rasray_ads::RayQueue;
use rasray_gpu::{Buffer, Device, Recorder};
use rasray_gpu_scene::{GpuScene, ShadingFeatures};
use rasray_options::Value;
use rasray_scene::needs::Workload;
use rasray_shaders_glsl::{
    INTEGRATORS_PRIMARY, INTEGRATORS_WHITTED_RESOLVE, INTEGRATORS_WHITTED_SHADE,
    INTEGRATORS_WHITTED_SHADE_PASSING, Shader,
    constant_ids::integrators::{WHITTED_MIRROR_ROUGHNESS, WHITTED_PASSES_PANES},
    constants::scene::BSDF_SMOOTH_ROUGHNESS,
    records::{WhittedRay, WhittedState},
};

use crate::{
    Film, Integrator, IntegratorDesc, IntegratorError, IntegratorRow, RayKind, Traced, Wave,
    integrator::{check_capacity, check_features},
    kernels::{Bindings, Bound, Kernel, WaveConstants, camera_constants, device_buffer, film, shadow_queue},
    rounds::Rounds,
};

mod options;

use options::{COMPACTION, RAY_DEPTH, SELECT, THRESHOLD};
pub(super) use options::{MIRROR_ROUGHNESS, SHADOWS};
pub use options::{RAY_DEPTH_LIMIT, Select, Shadows, WhittedOptions};

/// Row of the registry.
pub(super) const ROW: IntegratorRow = IntegratorRow {
    name: "whitted",
    doc: "Whitted's ray tracing: direct light, perfect reflections and refractions",
    options: &[&RAY_DEPTH, &SELECT, &THRESHOLD, &SHADOWS, &MIRROR_ROUGHNESS, &COMPACTION],
    rays: &[RayKind::Camera, RayKind::Scattered, RayKind::Shadow],
    workload: |_| Workload::ALL,
    make: |desc, spec| Ok(Box::new(Whitted::new(desc, WhittedOptions::of(spec))?)),
};

/// Bindings of the states and of the waiting rays, as `integrators/whitted_storage.glsl` declares them.
const WHITTED_STATES: u32 = 9;
const WHITTED_RAYS: u32 = 10;

/// Number of rays of a tree, and of surfaces passed in a straight line, that the rounds of a wave allow for
/// at first.
const USUAL_RAYS: u32 = 15;
const USUAL_LAYERS: u32 = 8;

/// Largest number of rounds in one recording of a wave if surfaces may be passed; more are recorded as its
/// rest.
const ROUND_LIMIT: u32 = 1 << 14;

/// Whitted's ray tracing: a tree of rays per sample. Each surface that a ray hits adds its emission and one
/// light sample, and sends on mirrored, refracted and passing rays. Every round traces one ray of each tree
/// that has one left, and its shadow ray. The other rays of a surface wait until the trees of those before
/// them are traced.
///
/// If surfaces let light pass in a straight line, shadow rays go through them and are traced in rounds of
/// their own, as with [`Path`](crate::Path).
#[derive(Debug)]
pub struct Whitted {
    options: WhittedOptions,
    /// True if trees may need more rounds than are recorded at first.
    has_rest: bool,
    /// Closest-hit rounds of a wave.
    rounds: Rounds,
    /// Features that the kernels were made for.
    features: ShadingFeatures,
    film: Film,
    queue: RayQueue,
    states: Buffer,
    waiting: Buffer,
    /// Queue and kernel of the tests of light samples, if any hit stops a shadow ray; otherwise shadow rays
    /// are in the queue of all others.
    shadows: Option<(RayQueue, Kernel)>,
    bindings: Bindings,
    first_rays: Kernel,
    shade: Kernel,
}

/// Kernels of trees of rays, and the buffers that they bind besides those of all trees.
pub(super) struct TreeKernels<'a> {
    /// Kernel of the first ray of every tree.
    pub first_rays: &'static Shader,
    /// Kernel that shades if surfaces stop light.
    pub shade: &'static Shader,
    /// Kernel that shades if surfaces let light pass.
    pub shade_passing: &'static Shader,
    pub bound: &'a [Bound<'a>],
    /// True if first rays go on behind the backs of smooth surfaces.
    pub passes_backs: bool,
}

const WHITTED: TreeKernels<'_> = TreeKernels {
    first_rays: &INTEGRATORS_PRIMARY,
    shade: &INTEGRATORS_WHITTED_SHADE,
    shade_passing: &INTEGRATORS_WHITTED_SHADE_PASSING,
    bound: &[],
    passes_backs: false,
};

/// Shape of the trees of rays, by the rays that surfaces of a scene send on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Trees {
    /// Surfaces mirror.
    Chains,
    /// Surfaces mirror and refract.
    Binary,
    /// Surfaces also let rays pass in a straight line.
    Passing { refracts: bool },
}

impl Trees {
    fn of(features: ShadingFeatures, passes_panes: bool) -> Self {
        match (features.blend || passes_panes, features.transmission) {
            (true, refracts) => Self::Passing { refracts },
            (false, true) => Self::Binary,
            (false, false) => Self::Chains,
        }
    }

    /// Returns the number of rounds that a wave has at first, and the largest.
    fn rounds(self, depth: u32, passes_backs: bool) -> [u32; 2] {
        let rays = (2 << depth) - 1;
        match self {
            Self::Chains | Self::Binary if passes_backs => [rays + USUAL_LAYERS, ROUND_LIMIT],
            Self::Chains => [depth + 1; 2],
            Self::Binary => [USUAL_RAYS.min(rays), rays],
            Self::Passing { .. } => [2 * USUAL_RAYS.min(rays) + USUAL_LAYERS, ROUND_LIMIT],
        }
    }

    /// Returns the largest number of rays of a tree that wait at a time. Each surface on the way to the
    /// shaded one has as many waiting rays as it sends on besides the first. If surfaces are passed, all rays
    /// of the shaded one wait as well.
    fn waiting(self, depth: u32) -> u32 {
        match self {
            Self::Chains => 0,
            Self::Binary => depth,
            Self::Passing { refracts } => depth * (1 + u32::from(refracts)) + 1,
        }
    }
}

impl Whitted {
    /// Makes queues, states and kernels.
    ///
    /// # Errors
    /// An error for an option out of its range, sizes that do not fit, out of memory, or if the device
    /// refuses a pipeline.
    pub fn new(desc: &IntegratorDesc<'_>, options: WhittedOptions) -> Result<Self, IntegratorError> {
        desc.check()?;
        Self::of_trees(desc, options, &WHITTED)
    }

    /// Makes the integrator with other kernels, and with a film of any size.
    pub(super) fn of_trees(
        desc: &IntegratorDesc<'_>,
        options: WhittedOptions,
        kernels: &TreeKernels<'_>,
    ) -> Result<Self, IntegratorError> {
        RAY_DEPTH.check(Value::Whole(options.ray_depth))?;
        THRESHOLD.check(Value::Number(options.threshold))?;
        MIRROR_ROUGHNESS.check(Value::Number(options.mirror_roughness))?;
        if options.select != Select::Expected && options.threshold > 0.0 {
            let expected = "select expected alone has a threshold".to_owned();
            return Err(THRESHOLD.refused(options.threshold, expected).into());
        }
        let features = desc.features;
        let smoothed = options.mirror_roughness > BSDF_SMOOTH_ROUGHNESS;
        let panes = features.panes || (features.transmission && smoothed);
        let trees = Trees::of(features, panes);
        let device = desc.device;
        let slot_bytes = u64::from(trees.waiting(options.ray_depth)) * size_of::<WhittedRay>() as u64;
        let capacity = check_capacity(desc.wave_capacity)?;
        let capacity = fitting(capacity, slot_bytes, device.limits().max_storage_buffer_range);
        let queue = RayQueue::new(device, "whitted rays", capacity, true)?;
        let slots = u64::from(capacity);
        let states = device_buffer(device, "whitted states", slots * size_of::<WhittedState>() as u64)?;
        let waiting = device_buffer(device, "waiting rays", (slots * slot_bytes).max(4))?;
        let states_bound = [(WHITTED_STATES, &states), (WHITTED_RAYS, &waiting)];
        let own = [&states_bound, kernels.bound].concat();
        let mut constants = Vec::from(features.constants());
        constants.push((WHITTED_MIRROR_ROUGHNESS, options.mirror_roughness.to_bits()));
        let (shader, shadows, bindings) = if let Trees::Passing { .. } = trees {
            constants.push((WHITTED_PASSES_PANES, panes.into()));
            (kernels.shade_passing, None, Bindings::new(device, desc.scene, &film(desc.film), &own)?)
        } else {
            let queue = RayQueue::new(device, "shadow rays", capacity, false)?;
            let bound = [&own[..], &shadow_queue(&queue)].concat();
            let bindings = Bindings::new(device, desc.scene, &film(desc.film), &bound)?;
            let resolve = bindings.kernel(device, &INTEGRATORS_WHITTED_RESOLVE, &[])?;
            (kernels.shade, Some((queue, resolve)), bindings)
        };
        let [first, most] = trees.rounds(options.ray_depth, kernels.passes_backs);
        Ok(Self {
            options,
            has_rest: first < most,
            rounds: Rounds::new(first, most).masked(options.masked),
            features,
            first_rays: bindings.kernel(device, kernels.first_rays, &camera_constants(false))?,
            shade: bindings.kernel(device, shader, &constants)?,
            film: desc.film.clone(),
            queue,
            states,
            waiting,
            shadows,
            bindings,
        })
    }

    /// Returns the sets that the kernels are bound to.
    pub(super) fn bindings(&self) -> &Bindings {
        &self.bindings
    }

    /// Returns the constants of a round as the kernels expect them.
    fn told(&self, round: WaveConstants) -> WaveConstants {
        let WhittedOptions { ray_depth, select, threshold, .. } = self.options;
        let number = if select == Select::Expected { threshold } else { 0.0 };
        WaveConstants { limit: ray_depth, number, marks: round.marks | self.options.marks(), ..round }
    }

    /// Records rounds of a new wave, or of the rest of one. Trees that end add to the film.
    fn record_rounds(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
        is_rest: bool,
    ) -> Result<(), IntegratorError> {
        let shadows = self.shadows.as_ref().filter(|_| self.options.shadows != Shadows::None);
        self.rounds.record(recorder, (traced, wave), &self.queue, is_rest, |recorder, live, constants| {
            let constants = self.told(constants);
            self.bindings.record(recorder, &self.shade, &self.queue, live, &constants);
            if let Some((shadows, resolve)) = shadows {
                shadows.record_take(recorder);
                traced.record_occluded(recorder, shadows, self.rounds.later(wave));
                self.bindings.record(recorder, resolve, shadows, self.rounds.later(wave), &constants);
            }
        })
    }
}

/// Returns the number of slots, of `slot_bytes` bytes each, that one binding can hold: at most `capacity`, at
/// least one.
fn fitting(capacity: u32, slot_bytes: u64, limit: u64) -> u32 {
    let fitting = limit.checked_div(slot_bytes).unwrap_or(u64::MAX).max(1);
    capacity.min(u32::try_from(fitting).unwrap_or(u32::MAX))
}

impl Integrator for Whitted {
    fn name(&self) -> &'static str {
        ROW.name
    }

    fn record_wave(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        self.bindings.record_camera_rays(recorder, &self.first_rays, &self.queue, wave)?;
        for queue in self.queues() {
            queue.record_select_none(recorder);
        }
        self.record_rounds(recorder, traced, wave, false)
    }

    fn record_rest(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        self.bindings.check(&self.queue, wave)?;
        self.record_rounds(recorder, traced, wave, true)
    }

    fn has_rest(&self, device: &Device) -> Result<bool, IntegratorError> {
        Ok(self.has_rest && self.film.read_faults(device)?.unended > 0)
    }

    fn allow_more_rounds(&self) -> bool {
        self.rounds.allow_more()
    }

    fn asks_occluder(&self) -> bool {
        self.shadows.is_some() && self.options.shadows != Shadows::None
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
        std::iter::once(&self.queue).chain(self.shadows.as_ref().map(|(queue, _)| queue)).collect()
    }

    fn traces_per_wave(&self) -> u32 {
        self.rounds.now() * self.queues().len() as u32
    }

    fn selects(&self) -> bool {
        true
    }

    fn state_bytes(&self) -> u64 {
        self.states.size() + self.waiting.size()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_have_a_round_a_ray_and_trees_what_is_usual() {
        assert_eq!(Trees::Chains.rounds(8, false), [9, 9]);
        assert_eq!(Trees::Chains.rounds(0, true), [1 + USUAL_LAYERS, ROUND_LIMIT]);
        assert_eq!(Trees::Binary.rounds(3, false), [15, 15]);
        assert_eq!(Trees::Binary.rounds(RAY_DEPTH_LIMIT, false), [15, 511]);
        let passing = Trees::Passing { refracts: true };
        assert_eq!(passing.rounds(0, false), [2 + USUAL_LAYERS, ROUND_LIMIT]);
        assert_eq!([Trees::Chains, Trees::Binary, passing].map(|trees| trees.waiting(3)), [0, 3, 7]);
    }

    #[test]
    fn waves_are_as_large_as_one_binding_lets_them() {
        assert_eq!(fitting(1000, 0, 100), 1000);
        assert_eq!(fitting(1000, 10, 5000), 500);
        assert_eq!(fitting(1000, 10, 5), 1);
        assert_eq!(fitting(1000, 10, u64::MAX), 1000);
    }
}
