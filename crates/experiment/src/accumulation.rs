//! A film that is filled wave by wave.

use std::time::Instant;

use rasray_ads::RayQueue;
use rasray_gpu::Device;
use rasray_integrators::{
    AmbientOcclusion, Film, IntegratorDesc, IntegratorError, Path, PathOptions, Raycast, Traced, Visibility,
    Wave,
};
use rasray_scene::needs::Needs;
use rasray_tracer::TracerError;

use crate::built::Built;
use crate::device_scene::{DeviceScene, device_error, image_error, tracer_error};
use crate::error::ExperimentError;
use crate::jobs::{Frame, Integrator, Primary};
use crate::passes::Passes;
use crate::shard::Shard;
use rasray_report::{Pass, PassOf};

/// Makes the integrator of a frame.
pub(super) fn integrator(
    frame: &Frame,
    desc: &IntegratorDesc<'_>,
) -> Result<Box<dyn rasray_integrators::Integrator>, ExperimentError> {
    let made: Result<Box<dyn rasray_integrators::Integrator>, _> = match frame.integrator {
        Integrator::Path { bounces, glass_shadows } => {
            let options = PathOptions { bounces, glass_shadows, shadow_terminator: frame.shadow_terminator };
            Path::new(desc, options).map(|i| Box::new(i) as _)
        }
        Integrator::AmbientOcclusion { distance } => {
            AmbientOcclusion::new(desc, distance.unwrap_or(f32::INFINITY)).map(|i| Box::new(i) as _)
        }
        Integrator::Raycast => Raycast::new(desc).map(|i| Box::new(i) as _),
    };
    made.map_err(|error| match error {
        IntegratorError::Option { .. } => ExperimentError::usage(error.to_string(), ""),
        other => image_error(other),
    })
}

/// What answers the camera rays of a frame in place of traces; nothing where they are traced.
pub(super) fn visibility(
    device: &Device,
    stage: &DeviceScene,
    frame: &Frame,
) -> Result<Option<Visibility>, ExperimentError> {
    match frame.primary {
        Primary::Trace => Ok(None),
        Primary::Raster => {
            Visibility::new(device, &stage.scene, false).map(Some).map_err(|error| match error {
                IntegratorError::CannotDraw { .. } => {
                    ExperimentError::device(error, "choose --primary trace, or another --device")
                }
                other => device_error(other),
            })
        }
    }
}

/// Downloads the counters of all queues and returns how many rays have no answer; rays that met an unbuilt structure
/// count as well. Refuses rays that met list entries that name nothing.
pub(super) fn count_unfinished(
    device: &Device,
    built: &Built,
    queues: &[&RayQueue],
) -> Result<u64, ExperimentError> {
    let mut unfinished = 0;
    for queue in queues {
        let counters = queue.download_counters(device).map_err(device_error)?;
        if counters.corrupted > 0 {
            let (structure, entries) = (built.structure().name(), counters.corrupted.into());
            return Err(tracer_error(&TracerError::Corrupted { structure, entries }));
        }
        unfinished += u64::from(counters.unfinished) + u64::from(counters.not_ready);
    }
    Ok(unfinished)
}

/// A picture in the making: sample after sample, and wave after wave within a sample. Every call submits and waits.
pub struct Accumulation {
    pub(super) film: Film,
    integrator: Box<dyn rasray_integrators::Integrator>,
    /// What answers camera rays in place of traces.
    visibility: Option<Visibility>,
    /// Which of the samples are made.
    shard: Shard,
    /// The first pixel of the next wave.
    next_pixel: u32,
    samples_done: u32,
    unfinished: u64,
    pub(super) passes: Passes,
}

impl Accumulation {
    /// Allocates the film of a frame and makes its integrator; nothing is rendered. The stage's view has the size of the
    /// frame. With a shard only its samples are made.
    ///
    /// # Errors
    /// The device fails, or the frame asks for more than the integrator does.
    pub fn new(
        device: &Device,
        stage: &DeviceScene,
        frame: &Frame,
        shard: Option<Shard>,
        needs: &Needs,
    ) -> Result<Self, ExperimentError> {
        let film = Film::new(device, frame.width, frame.height).map_err(image_error)?;
        let mut desc = IntegratorDesc::new(device, &stage.scene, &film);
        if *needs == Needs::all() {
            desc.features = rasray_gpu_scene::ShadingFeatures::ALL;
        }
        let integrator = integrator(frame, &desc)?;
        let mut made = Self {
            film,
            integrator,
            visibility: visibility(device, stage, frame)?,
            shard: shard.unwrap_or_default(),
            next_pixel: 0,
            samples_done: 0,
            unfinished: 0,
            passes: Passes::default(),
        };
        made.clear(device)?;
        Ok(made)
    }

    /// Film, counters and times start at 0 again.
    ///
    /// # Errors
    /// The device fails.
    pub fn clear(&mut self, device: &Device) -> Result<(), ExperimentError> {
        let reset = device.submit(|recorder| {
            self.integrator.record_reset(recorder);
            if let Some(visibility) = &self.visibility {
                visibility.record_reset(recorder);
            }
        });
        reset.map_err(device_error)?;
        (self.next_pixel, self.samples_done, self.unfinished) = (0, 0, 0);
        self.passes = Passes::default();
        Ok(())
    }

    /// Renders one pixel and forgets it: software drivers compile a kernel at its first dispatch, which is no trace.
    /// Returns milliseconds. All starts at 0 after it.
    ///
    /// # Errors
    /// The device fails.
    pub fn use_once(&mut self, device: &Device, built: &Built) -> Result<f64, ExperimentError> {
        let started = Instant::now();
        let one = Wave { first_pixel: 0, pixel_count: 1, sample: 0 };
        let submitted = device
            .submit(|recorder| self.integrator.record_wave(recorder, self.traced(built), one))
            .map_err(device_error)?;
        submitted.value.map_err(device_error)?;
        self.clear(device)?;
        Ok(started.elapsed().as_secs_f64() * 1.0e3)
    }

    /// Renders the next wave. False where rays need more rounds than they had: then all starts at 0 again, and the
    /// structure allows more from now on.
    ///
    /// # Errors
    /// The device fails, or rays met list entries that name nothing.
    pub fn advance(&mut self, device: &Device, built: &Built) -> Result<bool, ExperimentError> {
        let pixels = self.film.pixel_count();
        let wave = Wave {
            first_pixel: self.next_pixel,
            pixel_count: self.integrator.wave_capacity().min(pixels - self.next_pixel),
            sample: self.shard.sample(self.samples_done),
        };
        let (timing, traced) = (device.best_timing(), self.traced(built));
        let timings = self.integrator.render_wave(device, timing, traced, wave).map_err(device_error)?;
        // What is on the film lacks light where a ray had no answer, so it is found now and not after the last wave.
        // Queues count on from wave to wave.
        self.unfinished = count_unfinished(device, built, &self.integrator.queues())?;
        if self.unfinished > 0 && built.structure().allow_more_rounds() {
            self.clear(device)?;
            return Ok(false);
        }
        self.passes.add(&timings);
        self.next_pixel += wave.pixel_count;
        if self.next_pixel == pixels {
            self.next_pixel = 0;
            self.samples_done += 1;
        }
        Ok(true)
    }

    fn traced<'a>(&'a self, built: &'a Built) -> Traced<'a> {
        Traced::from(built.structure()).with_primary(self.visibility.as_ref())
    }

    /// Says how many triangles were drawn over all pixels, where camera rays are drawn.
    pub(super) fn log_visibility(&self, device: &Device) -> Result<(), ExperimentError> {
        if let Some(visibility) = &self.visibility {
            let covering = visibility.read_counts(device).map_err(device_error)?.covering;
            tracing::info!(
                covering,
                "triangles drawn over all pixels, of all waves: they reach behind the eye"
            );
        }
        Ok(())
    }

    /// Waves of one sample.
    pub fn waves_per_sample(&self) -> u32 {
        self.film.pixel_count().div_ceil(self.integrator.wave_capacity())
    }

    /// Samples that all pixels have.
    pub fn samples_done(&self) -> u32 {
        self.samples_done
    }

    /// Whether no pixel has more samples than another.
    pub fn is_between_samples(&self) -> bool {
        self.next_pixel == 0
    }

    /// Rays without an answer: where there are any, the picture is not what was asked for.
    pub fn unfinished(&self) -> u64 {
        self.unfinished
    }

    /// Means of all pixels, row by row from the top left; linear Rec. 709, W/(sr m^2).
    ///
    /// # Errors
    /// The device fails.
    pub fn read(&self, device: &Device) -> Result<Vec<[f32; 3]>, ExperimentError> {
        self.film.read(device).map_err(device_error)
    }

    /// Times of the passes since the film was clear, all waves together.
    pub fn pass_times(&self) -> Vec<Pass> {
        self.passes.report(Some(PassOf::Image))
    }
}
