//! An image: scene to device, structure, waves of samples, readback.

use std::ops::ControlFlow;
use std::time::Instant;

use rasray_gpu::{Device, Stage};
use rasray_gpu_scene::{SceneTables, View};
use rasray_integrators::{AovPass, PATH_LAYER_LIMIT, Traced, Wave, waves};
use rasray_scene::needs::Needs;

use crate::accumulation::{Accumulation, count_unfinished, visibility};
use crate::backend::{OnProgress, Progress};
use crate::built::Built;
use crate::device_scene::{DeviceScene, device_error, image_error};
use crate::error::ExperimentError;
use crate::jobs::{AovSelection, FilmSums, Frame, GlassShadows, Refresh, RenderJob, RenderOutput};
use crate::passes::Passes;
use crate::shard::Shard;
use crate::system_config::SystemConfig;
use rasray_report::{Counters, PassOf, Times};

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

impl Pixels {
    /// Sets the times of the image in a run.
    pub(super) fn write_times(&self, times: &mut Times) {
        times.timer = self.passes.timer();
        times.first_use_ms = Some(self.first_use_ms);
        times.trace_ms = self.passes.median_of(|stage| matches!(stage, Stage::Trace(_)));
        times.visible_ms = self.passes.median_of(|stage| stage == Stage::Visible);
        times.image_ms = self.passes.median_of(|_| true);
    }
}

/// Renders the samples of a frame through a built structure.
pub(super) fn render_pixels(
    device: &Device,
    stage: &DeviceScene,
    built: &Built,
    wanted: &Wanted<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<Pixels, ExperimentError> {
    let Wanted { frame, shard, needs, task } = *wanted;
    let mut accumulation = Accumulation::new(device, stage, frame, shard, needs)?;
    _ = progress(Progress { task, done: 0, total: 0, unit: "first use of the shaders" });
    let first_use_ms = accumulation.use_once(device, built)?;
    render_waves(device, &mut accumulation, built, wanted, progress)?;
    accumulation.log_visibility(device)?;
    let faults = accumulation.film.read_faults(device).map_err(device_error)?;
    if faults.non_finite > 0 {
        tracing::warn!("{} samples were not finite numbers and are left out", faults.non_finite);
    }
    if faults.cut > 0 {
        tracing::warn!(
            "{} rays would have passed more than {PATH_LAYER_LIMIT} transparent surfaces: what lies behind those is left out",
            faults.cut
        );
    }
    let mut counters = built.counters()?;
    counters.unfinished = Some(accumulation.unfinished());
    counters.cut = (faults.cut > 0).then(|| faults.cut.into());
    let film = accumulation.film.read_pixels(device).map_err(device_error)?;
    let beauty = film.iter().map(|pixel| pixel.mean()).collect();
    let sums = shard.map(|_| FilmSums {
        sums: film.iter().map(|pixel| pixel.sum).collect(),
        counts: film.iter().map(|pixel| pixel.samples).collect(),
    });
    let samples_done = accumulation.samples_done();
    Ok(Pixels { beauty, sums, samples_done, passes: accumulation.passes, counters, first_use_ms })
}

/// Renders the samples, or those up to an early end, which is taken between samples, so that all pixels have the same
/// number of them.
fn render_waves(
    device: &Device,
    accumulation: &mut Accumulation,
    built: &Built,
    wanted: &Wanted<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<(), ExperimentError> {
    let Wanted { frame, shard, task, .. } = *wanted;
    let samples = shard.unwrap_or_default().samples(frame.spp).len() as u32;
    let total = u64::from(accumulation.waves_per_sample()) * u64::from(samples);
    let mut done = 0;
    let mut stopping = false;
    while accumulation.samples_done() < samples && !(stopping && accumulation.is_between_samples()) {
        if !accumulation.advance(device, built)? {
            (done, stopping) = (0, false);
            continue;
        }
        done += 1;
        stopping |= progress(Progress { task, done, total, unit: "waves" }) == ControlFlow::Break(());
    }
    Ok(())
}

/// What the device has of a job, for one that is the next of it.
pub(super) struct Made {
    stage: DeviceScene,
    /// Of the pose; nothing where the host posed the scene.
    posing: Passes,
    built: Built,
    system: SystemConfig,
}

/// The scene of a job, and the structure over it: those of the job before at this moment, where it is the next of it and its eye
/// is not far from that.
fn made_for(
    device: &Device,
    job: &RenderJob<'_>,
    before: Option<Made>,
    progress: &mut OnProgress<'_>,
) -> Result<Made, ExperimentError> {
    let spec = job.system.spec()?;
    _ = progress(Progress { task: "scene", done: 0, total: 0, unit: "to the device" });
    let origin = SceneTables::default_frame_origin(job.scene, job.camera.world_from_camera.translation);
    let is_kept =
        |made: &Made| job.is_next && made.stage.is_moving() && made.stage.scene.frame_origin() == origin;
    let kept = job.moment.zip(before.filter(is_kept));
    let (mut stage, posing, kept) = match kept {
        Some((moment, Made { mut stage, built, system, .. })) => {
            let Frame { width, height, seed, .. } = job.frame;
            stage.look(&View { camera: job.camera.clone(), width, height, seed })?;
            let posing = stage.pose(device, job.scene, moment, device.best_timing())?;
            (stage, posing, Some(built).filter(|_| system == job.system))
        }
        None => {
            let (stage, posing) = DeviceScene::of_job(device, job)?;
            (stage, posing, None)
        }
    };
    stage.sample_as(&job.frame)?;
    let (posing, system) = (posing.times(), job.system.clone());
    if let Some(mut built) = kept {
        _ = progress(Progress { task: "build", done: 0, total: 0, unit: "of the frame" });
        match built.follow(device, &stage.scene, true) {
            Ok(()) => return Ok(Made { stage, posing, built, system }),
            // A pool that it cannot have may be reached by device address.
            Err(error) => tracing::info!("the structure is made anew: {error}"),
        }
    }
    _ = progress(Progress { task: "build", done: 0, total: 0, unit: "first build" });
    let built = Built::refreshed(device, &spec, &mut stage, job.refresh)?;
    Ok(Made { stage, posing, built, system })
}

/// Renders an image with all requested additional images. `kept` is what the device has of the job before, and then of this one.
pub(super) fn render(
    device: &Device,
    job: &RenderJob<'_>,
    kept: &mut Option<Made>,
    progress: &mut OnProgress<'_>,
) -> Result<RenderOutput, ExperimentError> {
    let started = Instant::now();
    let frame = job.frame;
    let mut made = made_for(device, job, kept.take(), progress)?;
    let Made { stage, posing, built, .. } = &mut made;
    for _ in 0..job.repetitions {
        if progress(Progress { task: "build", done: 0, total: 0, unit: "timed builds" }).is_break() {
            break;
        }
        built.build_again(device)?;
    }
    let wanted = Wanted { frame: &frame, shard: job.shard, needs: &job.needs, task: "render" };
    let pixels = render_pixels(device, stage, built, &wanted, progress)?;
    let (options, mut paths) = built.resolved()?;
    if job.refresh != Refresh::All {
        paths.insert("refresh".to_owned(), job.refresh.name().to_owned());
    }
    if let Some(shadows) =
        frame.integrator.glass_shadows().filter(|chosen| *chosen != GlassShadows::default())
    {
        paths.insert("glass-shadows".to_owned(), shadows.name().to_owned());
    }
    let mut memory = built.memory(device)?;
    for (name, bytes) in stage.scene.bytes_by_part() {
        memory.by_part.insert(format!("scene {name}"), *bytes);
    }
    let mut stages = posing.stages();
    stages.extend(built.stages());
    stages.extend(pixels.passes.stages());
    let mut passes = posing.report(Some(PassOf::Pose));
    passes.extend(built.pass_times());
    passes.extend(pixels.passes.report(Some(PassOf::Image)));
    let mut times = Times { pose_ms: posing.median_of(|_| true), ..Times::default() };
    pixels.write_times(&mut times);
    built.write_times(&mut times);
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
        stages,
        passes,
        times,
        spread: built.spread().collect(),
        memory: Some(memory),
        counters: Some(pixels.counters),
    };
    if job.aovs != AovSelection::default() {
        _ = progress(Progress { task: "render", done: 0, total: 0, unit: "additional images" });
        add_aovs(device, stage, built, job, &mut output)?;
    }
    output.times.frame_ms = Some(started.elapsed().as_secs_f64() * 1.0e3);
    *kept = Some(made).filter(|made| made.stage.is_moving());
    Ok(output)
}

/// Traces the rays through pixel centres and adds the images that are wanted.
fn add_aovs(
    device: &Device,
    stage: &DeviceScene,
    built: &Built,
    job: &RenderJob<'_>,
    output: &mut RenderOutput,
) -> Result<(), ExperimentError> {
    let pixels = job.frame.width * job.frame.height;
    let capacity = rasray_integrators::wave_capacity(device).min(pixels);
    let aov = AovPass::new(device, &stage.scene, capacity).map_err(image_error)?;
    let visibility = visibility(device, stage, &job.frame)?;
    let traced = Traced::from(built.structure()).with_primary(visibility.as_ref());
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
        if !built.structure().allow_more_rounds() {
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
