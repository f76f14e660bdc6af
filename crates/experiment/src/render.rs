//! An image: scene to device, structure, waves of samples, readback.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::time::Instant;

use rasray_ads::RayQueue;
use rasray_gpu::Device;
use rasray_integrators::{
    AmbientOcclusion, AovPass, Film, IntegratorDesc, IntegratorError, Path, Raycast, Traced, Visibility,
    Wave, waves, waves_of,
};
use rasray_scene::needs::Needs;
use rasray_tracer::TracerError;

use crate::backend::{OnProgress, Progress};
use crate::error::ExperimentError;
use crate::jobs::{AovSelection, FilmSums, Frame, Integrator, Primary, RenderJob, RenderOutput};
use crate::passes::Passes;
use crate::shard::Shard;
use crate::stage::{Built, Stage, device_error, tracer_error};
use rasray_report::{Counters, Times};

/// Makes the integrator of a frame.
pub(super) fn integrator(
    frame: &Frame,
    desc: &IntegratorDesc<'_>,
) -> Result<Box<dyn rasray_integrators::Integrator>, ExperimentError> {
    let made: Result<Box<dyn rasray_integrators::Integrator>, _> = match frame.integrator {
        Integrator::Path { bounces } => Path::new(desc, bounces).map(|i| Box::new(i) as _),
        Integrator::AmbientOcclusion { distance } => {
            AmbientOcclusion::new(desc, distance.unwrap_or(f32::INFINITY)).map(|i| Box::new(i) as _)
        }
        Integrator::Raycast => Raycast::new(desc).map(|i| Box::new(i) as _),
    };
    made.map_err(|error| match error {
        IntegratorError::Option { .. } => ExperimentError::usage(error.to_string(), ""),
        other => device_error(other),
    })
}

/// What answers the camera rays of a frame in place of traces; nothing where they are traced.
fn visibility(device: &Device, stage: &Stage, frame: &Frame) -> Result<Option<Visibility>, ExperimentError> {
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

/// Which pixels are made.
pub(super) struct Wanted<'a> {
    pub(super) frame: &'a Frame,
    /// Which samples; absent: all.
    pub(super) shard: Option<Shard>,
    pub(super) needs: &'a Needs,
    /// For progress.
    pub(super) task: &'a str,
}

/// Pixels and what they cost.
pub(super) struct Pixels {
    pub(super) beauty: Vec<[f32; 3]>,
    /// Of a share of the samples.
    pub(super) sums: Option<FilmSums>,
    pub(super) samples_done: u32,
    pub(super) passes: Passes,
    pub(super) counters: Counters,
    /// Of the first dispatch of every kernel, milliseconds.
    pub(super) first_use_ms: f64,
}

/// Renders the samples of a frame through a built structure.
pub(super) fn render_pixels(
    device: &Device,
    stage: &Stage,
    built: &Built,
    wanted: &Wanted<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<Pixels, ExperimentError> {
    let Wanted { frame, shard, needs, task } = *wanted;
    let film = Film::new(device, frame.width, frame.height).map_err(device_error)?;
    let mut desc = IntegratorDesc::new(device, &stage.scene, &film);
    if *needs == Needs::all() {
        desc.features = rasray_gpu_scene::ShadingFeatures::ALL;
    }
    let integrator = integrator(frame, &desc)?;
    let visibility = visibility(device, stage, frame)?;
    if let Some(visibility) = &visibility {
        device.submit(|recorder| visibility.record_reset(recorder)).map_err(device_error)?;
    }
    let traced = Traced::from(built.structure.as_ref()).with_primary(visibility.as_ref());
    _ = progress(Progress { task, done: 0, total: 0, unit: "first use of the shaders" });
    let first_use_ms = use_once(device, integrator.as_ref(), traced)?;
    let Waves { samples_done, unfinished, passes } = loop {
        if let Some(rendered) = render_waves(device, integrator.as_ref(), built, traced, wanted, progress)? {
            break rendered;
        }
    };
    if let Some(visibility) = &visibility {
        let covering = visibility.read_counts(device).map_err(device_error)?.covering;
        tracing::info!(covering, "triangles drawn over all pixels, of all waves: they reach behind the eye");
    }
    let faults = film.read_faults(device).map_err(device_error)?;
    if faults.non_finite > 0 {
        tracing::warn!("{} samples were not finite numbers and are left out", faults.non_finite);
    }
    let mut counters = built.counters()?;
    counters.unfinished = Some(unfinished);
    let film = film.read_pixels(device).map_err(device_error)?;
    let beauty = film.iter().map(|pixel| pixel.mean()).collect();
    let sums = shard.map(|_| FilmSums {
        sums: film.iter().map(|pixel| pixel.sum).collect(),
        counts: film.iter().map(|pixel| pixel.samples).collect(),
    });
    Ok(Pixels { beauty, sums, samples_done, passes, counters, first_use_ms })
}

/// Waves of samples that are on the film.
struct Waves {
    samples_done: u32,
    /// Rays without an answer.
    unfinished: u64,
    passes: Passes,
}

/// Renders the samples. Nothing where rays need more rounds than they had: then film and counters start at 0 again, and
/// the structure allows more from now on.
fn render_waves(
    device: &Device,
    integrator: &dyn rasray_integrators::Integrator,
    built: &Built,
    traced: Traced<'_>,
    wanted: &Wanted<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<Option<Waves>, ExperimentError> {
    let Wanted { frame, shard, task, .. } = *wanted;
    let samples = shard.unwrap_or_default().samples(frame.spp);
    let timing = device.best_timing();
    let pixels = frame.width * frame.height;
    let waves_a_sample = u64::from(pixels.div_ceil(integrator.wave_capacity()));
    let total = waves_a_sample * samples.len() as u64;
    let mut passes = Passes::default();
    let mut samples_done = 0;
    let mut unfinished = 0;
    let mut stopping = false;
    for (done, wave) in (1..).zip(waves_of(pixels, samples, integrator.wave_capacity())) {
        // An early end is taken between samples, so that all pixels have the same number of them.
        if stopping && wave.first_pixel == 0 {
            break;
        }
        let submitted = device
            .submit_passes(timing, |recorder| integrator.record_wave(recorder, traced, wave))
            .map_err(device_error)?;
        submitted.value.map_err(device_error)?;
        // What is on the film lacks light where a ray had no answer, so it is found now and not after the last wave.
        // Queues count on from wave to wave.
        unfinished = count_unfinished(device, built, &integrator.queues())?;
        if unfinished > 0 && built.structure.allow_more_rounds() {
            device.submit(|recorder| integrator.record_reset(recorder)).map_err(device_error)?;
            return Ok(None);
        }
        passes.add(&submitted.passes);
        if wave.first_pixel + wave.pixel_count == pixels {
            samples_done += 1;
        }
        let now = Progress { task, done, total, unit: "waves" };
        stopping |= progress(now) == ControlFlow::Break(());
    }
    Ok(Some(Waves { samples_done, unfinished, passes }))
}

/// Renders one pixel and forgets it: software drivers compile a kernel at its first dispatch, which is no trace.
/// Returns milliseconds. Film and counters start at 0 after it.
fn use_once(
    device: &Device,
    integrator: &dyn rasray_integrators::Integrator,
    traced: Traced<'_>,
) -> Result<f64, ExperimentError> {
    let started = Instant::now();
    let one = Wave { first_pixel: 0, pixel_count: 1, sample: 0 };
    device.submit(|recorder| integrator.record_reset(recorder)).map_err(device_error)?;
    let submitted =
        device.submit(|recorder| integrator.record_wave(recorder, traced, one)).map_err(device_error)?;
    submitted.value.map_err(device_error)?;
    device.submit(|recorder| integrator.record_reset(recorder)).map_err(device_error)?;
    Ok(started.elapsed().as_secs_f64() * 1.0e3)
}

/// Downloads the counters of all queues and returns how many rays have no answer; rays that met an unbuilt structure
/// count as well. Refuses rays that met list entries that name nothing.
fn count_unfinished(device: &Device, built: &Built, queues: &[&RayQueue]) -> Result<u64, ExperimentError> {
    let mut unfinished = 0;
    for queue in queues {
        let counters = queue.download_counters(device).map_err(device_error)?;
        if counters.corrupted > 0 {
            let (structure, entries) = (built.structure.name(), counters.corrupted.into());
            return Err(tracer_error(&TracerError::Corrupted { structure, entries }));
        }
        unfinished += u64::from(counters.unfinished) + u64::from(counters.not_ready);
    }
    Ok(unfinished)
}

/// Milliseconds that traces took; absent where none was recorded.
pub(super) fn trace_ms(passes: &Passes) -> Option<f64> {
    Some(passes.total(|label| label.contains("/trace_"))).filter(|ms| *ms > 0.0)
}

/// Milliseconds that drawing what the camera sees took; absent where camera rays are traced.
pub(super) fn visible_ms(passes: &Passes, frame: &Frame) -> Option<f64> {
    (frame.primary == Primary::Raster).then(|| passes.total(|label| label.contains("/visibility")))
}

/// Renders an image with all requested additional images.
pub(super) fn render(
    device: &Device,
    job: &RenderJob<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<RenderOutput, ExperimentError> {
    let started = Instant::now();
    let frame = job.frame;
    let spec = job.system.spec()?;
    _ = progress(Progress { task: "scene", done: 0, total: 0, unit: "to the device" });
    let mut stage =
        Stage::new(device, job.scene, &job.camera, [frame.width, frame.height], frame.seed, &job.needs)?;
    stage.sample_as(&frame)?;
    _ = progress(Progress { task: "build", done: 0, total: 0, unit: "first build" });
    let mut built = Built::new(device, &spec, &stage.scene, stage.scene.eye())?;
    for _ in 0..job.repetitions {
        if progress(Progress { task: "build", done: 0, total: 0, unit: "timed builds" }).is_break() {
            break;
        }
        built.build_again(device)?;
    }
    let wanted = Wanted { frame: &frame, shard: job.shard, needs: &job.needs, task: "render" };
    let pixels = render_pixels(device, &stage, &built, &wanted, progress)?;
    let (options, paths) = built.resolved()?;
    let mut memory = built.memory(device)?;
    for (name, bytes) in stage.scene.bytes_by_part() {
        memory.by_part.insert(format!("scene {name}"), *bytes);
    }
    let mut passes = built.passes.report();
    passes.extend(pixels.passes.report());
    let mut output = RenderOutput {
        width: frame.width,
        height: frame.height,
        beauty: pixels.beauty,
        sums: pixels.sums,
        depth: None,
        normal: None,
        primitive: None,
        samples_done: pixels.samples_done,
        options,
        paths,
        passes,
        times: Times {
            timer: pixels.passes.timer(),
            first_use_ms: Some(pixels.first_use_ms),
            trace_ms: trace_ms(&pixels.passes),
            visible_ms: visible_ms(&pixels.passes, &frame),
            ..Times::default()
        },
        spread: BTreeMap::new(),
        memory: Some(memory),
        counters: Some(pixels.counters),
    };
    built.write_times(&mut output.times);
    output.spread = built.spread().collect();
    if job.aovs != AovSelection::default() {
        _ = progress(Progress { task: "render", done: 0, total: 0, unit: "additional images" });
        add_aovs(device, &stage, &built, job, &mut output)?;
    }
    output.times.frame_ms = Some(started.elapsed().as_secs_f64() * 1.0e3);
    Ok(output)
}

/// Traces the rays through pixel centres and adds the images that are wanted.
fn add_aovs(
    device: &Device,
    stage: &Stage,
    built: &Built,
    job: &RenderJob<'_>,
    output: &mut RenderOutput,
) -> Result<(), ExperimentError> {
    let pixels = job.frame.width * job.frame.height;
    let capacity = rasray_integrators::wave_capacity(device).min(pixels);
    let aov = AovPass::new(device, &stage.scene, capacity).map_err(device_error)?;
    let visibility = visibility(device, stage, &job.frame)?;
    let traced = Traced::from(built.structure.as_ref()).with_primary(visibility.as_ref());
    loop {
        device.submit(|recorder| aov.record_reset(recorder)).map_err(device_error)?;
        for wave in waves(pixels, 1, capacity) {
            let wave = Wave { sample: 0, ..wave };
            let submitted =
                device.submit(|recorder| aov.record_wave(recorder, traced, wave)).map_err(device_error)?;
            submitted.value.map_err(device_error)?;
        }
        if count_unfinished(device, built, &[aov.queue()])? == 0 {
            break;
        }
        if !built.structure.allow_more_rounds() {
            return Err(ExperimentError::refused(
                "rays through pixel centres did not finish",
                "its results are not kept; where very many triangles lie in one place --system bvh has shorter work, \
                 else please report it with the command line",
            ));
        }
    }
    let found = aov.read(device).map_err(device_error)?;
    output.depth = job.aovs.depth.then(|| found.iter().map(|pixel| pixel.distance).collect());
    output.normal = job.aovs.normal.then(|| found.iter().map(|pixel| pixel.normal).collect());
    output.primitive = job.aovs.primitive.then(|| found.iter().map(|pixel| pixel.primitive).collect());
    Ok(())
}
