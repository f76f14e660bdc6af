//! Interface of all integrators.

use rasray_ads::RayQueue;
use rasray_gpu::{Device, PassTiming, Recorder, Timing};
use rasray_gpu_scene::{GpuScene, ShadingFeatures};
use rasray_shaders_glsl::{constants::integrators::PHOTON_GATHER_LIMIT, records::FilmFaults};

use crate::{Film, IntegratorError, Traced, WAVE_LIMIT, Wave, wave_capacity};

/// Inputs that an integrator is made from.
#[derive(Clone, Copy, Debug)]
pub struct IntegratorDesc<'a> {
    /// Device that holds pipelines and buffers.
    pub device: &'a Device,
    /// Scene that is shaded.
    pub scene: &'a GpuScene,
    /// Film that samples are added to; as large as the scene's view.
    pub film: &'a Film,
    /// Number of slots of the queues, from 1 to [`WAVE_LIMIT`]. Fewer slots than the image has pixels mean
    /// several waves per sample.
    pub wave_capacity: u32,
    /// Shading code that is compiled in: [`GpuScene::features`], or [`ShadingFeatures::ALL`].
    pub features: ShadingFeatures,
    /// True if shading kernels look up the surfaces of hits themselves, which saves storing and reading them,
    /// for integrators that can ([`Path`](crate::Path)). Traced structures must then have [surfaces of
    /// triangles](rasray_ads::Description::surfaces_of_triangles). Pictures do not depend on it.
    pub surfaces_of_hits: bool,
}

impl<'a> IntegratorDesc<'a> {
    /// Makes inputs with the features that the scene can use, and waves as large as useful.
    pub fn new(device: &'a Device, scene: &'a GpuScene, film: &'a Film) -> Self {
        Self {
            device,
            scene,
            film,
            wave_capacity: wave_capacity(device).min(film.pixel_count()),
            features: scene.features(),
            surfaces_of_hits: false,
        }
    }

    pub(crate) fn check(&self) -> Result<u32, IntegratorError> {
        let (film, view) = ([self.film.width(), self.film.height()], self.scene.image_size());
        if film != view {
            return Err(IntegratorError::SizesDiffer { film, view });
        }
        check_capacity(self.wave_capacity)
    }
}

pub(crate) fn check_capacity(wave_capacity: u32) -> Result<u32, IntegratorError> {
    if (1..=WAVE_LIMIT).contains(&wave_capacity) {
        Ok(wave_capacity)
    } else {
        Err(IntegratorError::WaveCapacity { capacity: wave_capacity })
    }
}

/// Submits the recorded passes, and then the rest of the wave as long as there is any; `record` is told if it
/// records the rest. Returns the times of all passes.
pub(crate) fn submit_with_rest(
    (device, timing): (&Device, Timing),
    record: impl Fn(&mut Recorder<'_>, bool) -> Result<(), IntegratorError>,
    has_rest: impl Fn() -> Result<bool, IntegratorError>,
) -> Result<Vec<PassTiming>, IntegratorError> {
    let mut timings = Vec::new();
    let mut is_rest = false;
    while !is_rest || has_rest()? {
        let submitted = device.submit_passes(timing, |recorder| record(recorder, is_rest))?;
        submitted.value?;
        timings.extend(submitted.passes);
        is_rest = true;
    }
    Ok(timings)
}

/// Integrator: it turns rays through any structure into radiance on a film, wave by wave.
///
/// Functions that record never submit, wait or allocate. The traced structure must be complete and built from
/// the scene's geometry; film and queues must have been reset once with [`Integrator::record_reset`]. The
/// results of a wave are visible to compute shaders and transfers recorded after it. The labels of passes are
/// the paths of their shaders.
pub trait Integrator {
    /// Name in commands and reports.
    fn name(&self) -> &'static str;

    /// Records one sample of every pixel of a wave. If surfaces let rays pass ([`Path`](crate::Path)), a ray
    /// may pass more of them than there are recorded rounds: [`Integrator::record_rest`] adds its sample,
    /// which counts in [`FilmFaults::unended`](crate::FilmFaults) until then. [`Integrator::render_wave`]
    /// does all these steps.
    ///
    /// # Errors
    /// An error if the wave does not fit the queues or the image, or the structure was made without a scene.
    fn record_wave(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError>;

    /// Records further rounds of the wave recorded last, which continue where it stopped. They are needed as
    /// long as [`Integrator::has_rest`] returns true. The traced structure must be the same.
    ///
    /// # Errors
    /// Errors of [`Integrator::record_wave`].
    fn record_rest(
        &self,
        _recorder: &mut Recorder<'_>,
        _traced: Traced<'_>,
        _wave: Wave,
    ) -> Result<(), IntegratorError> {
        Ok(())
    }

    /// True if paths of a wave still have surfaces to pass: submits and waits, if paths can have any.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    fn has_rest(&self, _device: &Device) -> Result<bool, IntegratorError> {
        Ok(false)
    }

    /// Renders a wave with all of its rest and returns the times of its passes. Submits and waits, once
    /// unless rays pass many surfaces.
    ///
    /// # Errors
    /// Errors of [`Integrator::record_wave`], or of the device.
    fn render_wave(
        &self,
        device: &Device,
        timing: Timing,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<Vec<PassTiming>, IntegratorError> {
        submit_with_rest(
            (device, timing),
            |recorder, is_rest| match is_rest {
                false => self.record_wave(recorder, traced, wave),
                true => self.record_rest(recorder, traced, wave),
            },
            || self.has_rest(device),
        )
    }

    /// Records more rounds from the next wave on, for callers that record whole frames and repeat a frame
    /// with paths left. Returns false if there cannot be more.
    fn allow_more_rounds(&self) -> bool {
        false
    }

    /// True if [`Traced::occluder`] answers shadow rays towards lights. False if there are no shadow rays, or
    /// if surfaces let them pass.
    fn asks_occluder(&self) -> bool {
        true
    }

    /// Shades another scene from the next recording on, into the same film. Kernels stay. An error changes
    /// nothing.
    ///
    /// # Errors
    /// [`IntegratorError::LeftOut`] if the scene has features that the kernels were not made for.
    fn set_scene(&mut self, scene: &GpuScene) -> Result<(), IntegratorError>;

    /// Returns the film to which samples are added.
    fn film(&self) -> &Film;

    /// Returns all queues that are traced, for their counters: any unfinished or not-ready ray means that the
    /// picture is incomplete.
    fn queues(&self) -> Vec<&RayQueue>;

    /// Returns the largest number of rays in a wave: the slots of the smallest queue.
    fn wave_capacity(&self) -> u32 {
        self.queues().iter().map(|queue| queue.capacity()).min().unwrap_or(0)
    }

    /// Returns the largest number of traces that a wave records, without its rest.
    fn traces_per_wave(&self) -> u32;

    /// True if the integrator traces secondary rays from some surfaces only and counts the samples from whose
    /// surfaces it does ([`FilmFaults`](crate::FilmFaults)).
    fn selects(&self) -> bool {
        false
    }

    /// Returns the bytes in addition to the queues and to [`Integrator::fetch_bytes`].
    fn state_bytes(&self) -> u64 {
        0
    }

    /// Returns the bytes of the fetch of surfaces by drawing.
    fn fetch_bytes(&self) -> u64 {
        0
    }

    /// Returns the bytes of queues, states and fetch, without the film.
    fn bytes(&self) -> u64 {
        let queues = self.queues().iter().map(|queue| queue.bytes()).sum::<u64>();
        queues + self.state_bytes() + self.fetch_bytes()
    }

    /// Records that film and counters start at 0.
    fn record_reset(&self, recorder: &mut Recorder<'_>) {
        self.film().record_clear(recorder);
        for queue in self.queues() {
            queue.record_reset(recorder);
        }
    }
}

/// Checks that kernels with these features can shade the scene.
///
/// # Errors
/// [`IntegratorError::LeftOut`] if they leave out features of the scene.
pub fn check_features(made_for: ShadingFeatures, scene: &GpuScene) -> Result<(), IntegratorError> {
    let missing = made_for.lacks(scene.features());
    if missing.is_empty() { Ok(()) } else { Err(IntegratorError::LeftOut { missing: missing.join(", ") }) }
}

/// Checks that a picture has all light of the samples that were added.
///
/// # Errors
/// [`IntegratorError::Crowded`] if surfaces lack the light of photons.
pub fn check_faults(faults: &FilmFaults) -> Result<(), IntegratorError> {
    match faults.crowded {
        0 => Ok(()),
        surfaces => Err(IntegratorError::Crowded { surfaces, limit: PHOTON_GATHER_LIMIT }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn queues_that_cannot_be_are_refused() {
        assert!(check_capacity(1).is_ok() && check_capacity(WAVE_LIMIT).is_ok());
        assert!(check_capacity(0).is_err() && check_capacity(WAVE_LIMIT + 1).is_err());
    }
}
