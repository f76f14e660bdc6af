//! Ray casting: the first hits of camera rays, lit from the eye.

use rasray_ads::{Domain, RayQueue};
use rasray_gpu::Recorder;
use rasray_gpu_scene::GpuScene;
use rasray_scene::needs::Workload;
use rasray_shaders_glsl::{INTEGRATORS_PRIMARY, INTEGRATORS_RAYCAST_SHADE};

use crate::{
    Film, Integrator, IntegratorDesc, IntegratorError, IntegratorRow, RayKind, Traced, Wave,
    kernels::{Bindings, Kernel, camera_constants, film},
};

/// Row of the registry.
pub(super) const ROW: IntegratorRow = IntegratorRow {
    name: "raycast",
    doc: "Surfaces that the camera sees, unlit",
    options: &[],
    rays: &[RayKind::Camera],
    workload: |_| Workload {
        emission: true,
        shades: true,
        why: "ray casting shows colour and emission alone, lit from the eye",
        ..Workload::VISIBILITY
    },
    make: |desc, _| Ok(Box::new(Raycast::new(desc)?)),
};

/// Ray casting: emission plus base colour times the cosine between shading normal and ray; the environment
/// where nothing is hit. One trace per wave.
#[derive(Debug)]
pub struct Raycast {
    film: Film,
    queue: RayQueue,
    bindings: Bindings,
    primary: Kernel,
    shade: Kernel,
}

impl Raycast {
    /// Makes queue and kernels.
    ///
    /// # Errors
    /// An error for sizes that do not fit, out of memory, or if the device refuses a pipeline.
    pub fn new(desc: &IntegratorDesc<'_>) -> Result<Self, IntegratorError> {
        let capacity = desc.check()?;
        let device = desc.device;
        let queue = RayQueue::new(device, "camera rays", capacity, true)?;
        let bindings = Bindings::new(device, desc.scene, &film(desc.film), &[])?;
        Ok(Self {
            primary: bindings.kernel(device, &INTEGRATORS_PRIMARY, &camera_constants(false))?,
            shade: bindings.kernel(device, &INTEGRATORS_RAYCAST_SHADE, &[])?,
            film: desc.film.clone(),
            queue,
            bindings,
        })
    }
}

impl Integrator for Raycast {
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
        traced.record_primary(recorder, &self.queue, wave)?;
        let all = Domain::First(wave.pixel_count);
        self.bindings.record(recorder, &self.shade, &self.queue, all, &wave.into());
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
        vec![&self.queue]
    }

    fn traces_per_wave(&self) -> u32 {
        1
    }
}
