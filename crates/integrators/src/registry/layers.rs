//! Ray casting through all layers.

use rasray_ads::RayQueue;
use rasray_gpu::{Buffer, Device, Recorder};
use rasray_gpu_scene::GpuScene;
use rasray_options::{Least, OptionRow, Unit, Value, Values};
use rasray_scene::needs::Workload;
use rasray_shaders_glsl::{
    INTEGRATORS_LAYERS_SHADE, INTEGRATORS_PRIMARY, constants::scene::PATH_LAYER_LIMIT, records::LayersState,
};

use crate::{
    Film, Integrator, IntegratorDesc, IntegratorError, IntegratorRow, RayKind, Traced, Wave,
    kernels::{Bindings, Kernel, WaveConstants, camera_constants, device_buffer, film},
    rounds::Rounds,
};

/// Row of the registry.
pub(super) const ROW: IntegratorRow = IntegratorRow {
    name: "layers",
    doc: "Ray casting through one surface after the other, by their opacity",
    options: &[&LAYER_LIMIT, &LAYER_OPACITY],
    rays: &[RayKind::Camera],
    workload: |_| Workload {
        emission: true,
        shades: true,
        blends: true,
        why: "ray casting shows colour and emission alone, lit from the eye",
        ..Workload::VISIBILITY
    },
    make: |desc, spec| {
        let limit = spec.get(LAYER_LIMIT.name).and_then(Value::whole);
        let opacity = spec.get(LAYER_OPACITY.name).and_then(Value::number).unwrap_or(1.0);
        Ok(Box::new(Layers::new(desc, limit, opacity)?))
    },
};

const LAYER_LIMIT: OptionRow = OptionRow::new(
    "layer-limit",
    Values::Whole(1, PATH_LAYER_LIMIT),
    "Only so many surfaces are there for a ray; all if not given",
)
.trying(&["1", "3"]);

const LAYER_OPACITY: OptionRow = OptionRow::new(
    "layer-opacity",
    Values::Number(Unit::Share, Least::AboveZero),
    "Opacity of every surface, times its material's (1: only blended ones are seen through)",
)
.by_default(Value::Number(0.5))
.trying(&["0.2", "0.5", "1"]);

/// Binding of the states, as `integrators/layers_shade.comp` declares it.
const LAYERS_STATES: u32 = 9;

/// Number of rounds that a wave has at first.
const USUAL_LAYERS: u32 = 8;

/// Ray casting through layers: all surfaces along a ray in the colours of [`Raycast`](crate::Raycast), front
/// to back. Each adds its colour by its opacity and lets the rest of 1 pass. There is a round per surface, as
/// many as needed ([`Integrator::record_rest`], [`Integrator::allow_more_rounds`]).
#[derive(Debug)]
pub struct Layers {
    /// Number of surfaces of a ray that are shown; `u32::MAX` shows all.
    limit: u32,
    opacity: f32,
    rounds: Rounds,
    film: Film,
    queue: RayQueue,
    states: Buffer,
    bindings: Bindings,
    primary: Kernel,
    shade: Kernel,
}

impl Layers {
    /// Makes queue and kernels. The first `limit` surfaces of a ray are shown, or all without a limit; each
    /// has `opacity` times the opacity of its material.
    ///
    /// # Errors
    /// An error for a limit outside of 1 to [`PATH_LAYER_LIMIT`], an opacity that is not above 0 and at most
    /// 1, sizes that do not fit, out of memory, or if the device refuses a pipeline.
    pub fn new(desc: &IntegratorDesc<'_>, limit: Option<u32>, opacity: f32) -> Result<Self, IntegratorError> {
        limit.map(|limit| LAYER_LIMIT.check(Value::Whole(limit))).transpose()?;
        LAYER_OPACITY.check(Value::Number(opacity))?;
        let capacity = desc.check()?;
        let device = desc.device;
        let queue = RayQueue::new(device, "camera rays", capacity, true)?;
        let bytes = u64::from(capacity) * size_of::<LayersState>() as u64;
        let states = device_buffer(device, "layers", bytes)?;
        let own = [(LAYERS_STATES, &states)];
        let bindings = Bindings::new(device, desc.scene, &film(desc.film), &own)?;
        // There is one round more than surfaces: the light that the last one lets through comes from the
        // background.
        let most = limit.unwrap_or(PATH_LAYER_LIMIT + 1);
        Ok(Self {
            limit: limit.unwrap_or(u32::MAX),
            opacity,
            rounds: Rounds::new(USUAL_LAYERS, most),
            primary: bindings.kernel(device, &INTEGRATORS_PRIMARY, &camera_constants(false))?,
            shade: bindings.kernel(device, &INTEGRATORS_LAYERS_SHADE, &[])?,
            film: desc.film.clone(),
            queue,
            states,
            bindings,
        })
    }

    /// Records the rounds of a new wave or of the rest of one.
    fn record_rounds(
        &self,
        recorder: &mut Recorder<'_>,
        traced: (Traced<'_>, Wave),
        is_rest: bool,
    ) -> Result<(), IntegratorError> {
        let own = |constants| WaveConstants { limit: self.limit, number: self.opacity, ..constants };
        self.rounds.record(recorder, traced, &self.queue, is_rest, |recorder, live, constants| {
            self.bindings.record(recorder, &self.shade, &self.queue, live, &own(constants));
        })
    }
}

impl Integrator for Layers {
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
        self.record_rounds(recorder, (traced, wave), false)
    }

    fn record_rest(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        self.bindings.check(&self.queue, wave)?;
        self.record_rounds(recorder, (traced, wave), true)
    }

    fn has_rest(&self, device: &Device) -> Result<bool, IntegratorError> {
        Ok(self.film.read_faults(device)?.unended > 0)
    }

    fn allow_more_rounds(&self) -> bool {
        self.rounds.allow_more()
    }

    fn asks_occluder(&self) -> bool {
        false
    }

    fn set_scene(&mut self, scene: &GpuScene) -> Result<(), IntegratorError> {
        self.bindings.set_scene(scene);
        Ok(())
    }

    fn film(&self) -> &Film {
        &self.film
    }

    fn queues(&self) -> Vec<&RayQueue> {
        vec![&self.queue]
    }

    fn traces_per_wave(&self) -> u32 {
        self.rounds.now()
    }

    fn state_bytes(&self) -> u64 {
        self.states.size()
    }
}
