//! Ambient occlusion: cosine-weighted visibility of a white environment.

use rasray_ads::{Domain, RayQueue};
use rasray_gpu::Recorder;
use rasray_gpu_scene::GpuScene;
use rasray_options::{Least, OptionRow, Unit, Value, Values};
use rasray_scene::needs::Workload;
use rasray_shaders_glsl::{
    INTEGRATORS_AMBIENT_OCCLUSION_RESOLVE, INTEGRATORS_AMBIENT_OCCLUSION_SPAWN, INTEGRATORS_PRIMARY,
};

use crate::{
    Film, Integrator, IntegratorDesc, IntegratorError, IntegratorRow, RayKind, Traced, Wave,
    kernels::{self, Bindings, Kernel, WaveConstants, camera_constants, film},
};

/// Row of the registry.
pub(super) const ROW: IntegratorRow = IntegratorRow {
    name: "ao",
    doc: "Ambient occlusion: cosine-weighted visibility of a white environment",
    options: &[&DISTANCE],
    rays: &[RayKind::Camera, RayKind::Shadow],
    workload: |_| Workload { why: "ambient occlusion asks only what is visible", ..Workload::VISIBILITY },
    make: |desc, spec| {
        let range = spec.get(DISTANCE.name).and_then(Value::number).unwrap_or(f32::INFINITY);
        Ok(Box::new(AmbientOcclusion::new(desc, range)?))
    },
};

const DISTANCE: OptionRow = OptionRow::new(
    "ao-distance",
    Values::Number(Unit::Metres, Least::AboveZero),
    "Metres within which something occludes; any distance if not given",
)
.trying(&["0.5", "2"]);

/// Ambient occlusion: one occlusion ray per sample from the surface that the camera ray hits; the background
/// is 1. Two traces per wave.
#[derive(Debug)]
pub struct AmbientOcclusion {
    range: f32,
    film: Film,
    queue: RayQueue,
    shadow_queue: RayQueue,
    bindings: Bindings,
    primary: Kernel,
    spawn: Kernel,
    resolve: Kernel,
}

impl AmbientOcclusion {
    /// Makes queues and kernels. Only surfaces nearer than `range` metres occlude; with infinity all do.
    ///
    /// # Errors
    /// An error for a range that is not above 0, sizes that do not fit, out of memory, or if the device
    /// refuses a pipeline.
    pub fn new(desc: &IntegratorDesc<'_>, range: f32) -> Result<Self, IntegratorError> {
        if range != f32::INFINITY {
            DISTANCE.check(Value::Number(range))?;
        }
        let capacity = desc.check()?;
        let device = desc.device;
        let queue = RayQueue::new(device, "camera rays", capacity, true)?;
        let shadow_queue = RayQueue::new(device, "occlusion rays", capacity, false)?;
        let own = kernels::shadow_queue(&shadow_queue);
        let bindings = Bindings::new(device, desc.scene, &film(desc.film), &own)?;
        Ok(Self {
            range,
            primary: bindings.kernel(device, &INTEGRATORS_PRIMARY, &camera_constants(false))?,
            spawn: bindings.kernel(device, &INTEGRATORS_AMBIENT_OCCLUSION_SPAWN, &[])?,
            resolve: bindings.kernel(device, &INTEGRATORS_AMBIENT_OCCLUSION_RESOLVE, &[])?,
            film: desc.film.clone(),
            queue,
            shadow_queue,
            bindings,
        })
    }
}

impl Integrator for AmbientOcclusion {
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
        let all = Domain::First(wave.pixel_count);
        let constants = WaveConstants { number: self.range, ..WaveConstants::from(wave) };
        traced.record_primary(recorder, &self.queue, wave)?;
        self.shadow_queue.record_select_none(recorder);
        self.bindings.record(recorder, &self.spawn, &self.queue, all, &constants);
        self.shadow_queue.record_take(recorder);
        traced.record_occluded(recorder, &self.shadow_queue, Domain::Selected);
        self.bindings.record(recorder, &self.resolve, &self.shadow_queue, all, &constants);
        Ok(())
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
        vec![&self.queue, &self.shadow_queue]
    }

    fn traces_per_wave(&self) -> u32 {
        2
    }
}
