//! What is recorded of an image.

use rasray_ads::{QueueCounters, Structure};
use rasray_gpu::Recorder;
use rasray_gpu_scene::GpuScene;
use rasray_integrators::{Film, Integrator, Traced, Visibility, Wave, waves_of};
use rasray_tracer::TracerError;

use crate::{FrameError, Samples};

/// What makes an image of rays through a structure: an integrator with its film, and what answers camera rays. It records,
/// and neither submits nor waits.
pub struct ImagePasses {
    integrator: Box<dyn Integrator>,
    /// What answers camera rays in place of traces.
    visibility: Option<Visibility>,
}

impl From<Box<dyn Integrator>> for ImagePasses {
    fn from(integrator: Box<dyn Integrator>) -> Self {
        Self { integrator, visibility: None }
    }
}

impl<I: Integrator + 'static> From<Box<I>> for ImagePasses {
    fn from(integrator: Box<I>) -> Self {
        Self { integrator, visibility: None }
    }
}

impl ImagePasses {
    /// The same with camera rays answered by drawing, which was made for the same scene; traced where absent.
    #[must_use]
    pub fn with_visibility(self, visibility: Option<Visibility>) -> Self {
        Self { visibility, ..self }
    }

    /// The integrator, with the film.
    pub fn integrator(&self) -> &dyn Integrator {
        self.integrator.as_ref()
    }

    /// What answers camera rays in place of traces.
    pub fn visibility(&self) -> Option<&Visibility> {
        self.visibility.as_ref()
    }

    /// Where samples are added.
    pub fn film(&self) -> &Film {
        self.integrator.film()
    }

    /// Shows another scene from the next recording on, in a film of the same size. Kernels stay.
    ///
    /// # Errors
    /// The scene has what kernels have no code for.
    pub fn set_scene(&mut self, scene: &GpuScene) -> Result<(), FrameError> {
        self.integrator.set_scene(scene)?;
        if let Some(visibility) = &mut self.visibility {
            visibility.set_scene(scene)?;
        }
        Ok(())
    }

    /// Rays through a structure, but for those that are drawn.
    pub(crate) fn traced<'a>(&'a self, structure: &'a dyn Structure) -> Traced<'a> {
        Traced::from(structure).with_primary(self.visibility.as_ref())
    }

    /// Records that film and counters start at 0.
    pub fn record_reset(&self, recorder: &mut Recorder<'_>) {
        self.integrator.record_reset(recorder);
        if let Some(visibility) = &self.visibility {
            visibility.record_reset(recorder);
        }
    }

    /// The waves of samples, in their order.
    pub fn waves(&self, samples: Samples) -> impl Iterator<Item = Wave> {
        waves_of(self.film().pixel_count(), samples, self.integrator.wave_capacity())
    }

    /// Records samples of all pixels.
    ///
    /// # Errors
    /// The structure was made without a scene.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        structure: &dyn Structure,
        samples: Samples,
    ) -> Result<(), FrameError> {
        for wave in self.waves(samples) {
            self.integrator.record_wave(recorder, self.traced(structure), wave)?;
        }
        Ok(())
    }
}

impl std::fmt::Debug for ImagePasses {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("ImagePasses")
            .field("integrator", &self.integrator.name())
            .field("visibility", &self.visibility)
            .finish()
    }
}

/// Rays of queues that have no answer, those that met an unbuilt structure included: where there are any, nothing that was
/// made of them is right.
///
/// # Errors
/// Rays met list entries with an invalid index.
pub(crate) fn unanswered<'a>(
    structure: &dyn Structure,
    counters: impl IntoIterator<Item = &'a QueueCounters>,
) -> Result<u64, FrameError> {
    let (mut rays, mut entries) = (0, 0);
    for queue in counters {
        entries += u64::from(queue.corrupted);
        rays += u64::from(queue.unfinished) + u64::from(queue.not_ready);
    }
    if entries > 0 {
        return Err(TracerError::Corrupted { structure: structure.name(), entries }.into());
    }
    Ok(rays)
}
