//! Job of an image: scene to device, structure, waves of samples, readback.

use std::collections::BTreeMap;
use std::time::Instant;

use rasray_frame::Adaptive;
use rasray_gpu::{Device, Stage, Timing};
use rasray_gpu_scene::View;
use rasray_integrators::{Film, FilmPixel};
use rasray_scene::needs::Needs;

use crate::backend::{OnProgress, Progress};
use crate::built::Built;
use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::further_images::further_images;
use crate::image_memory;
use crate::jobs::{Aov, FilmSums, Frame, Refresh, RenderJob, RenderOutput};
use crate::motion::TrianglesBefore;
use crate::passes::Passes;
use crate::progressive_image::ProgressiveImage;
use crate::shard::Shard;
use crate::system_config::SystemConfig;
use rasray_report::{AdaptiveRecord, Counters, PassOf, Times};

/// Pixels of an image and their costs.
#[derive(Default)]
pub(super) struct Pixels {
    /// Means in linear Rec. 709, W/(sr m^2).
    pub(super) means: Vec<[f32; 3]>,
    /// Sums of samples, if they are kept.
    sums: Option<Vec<[f32; 3]>>,
    /// Number of samples in each pixel's sum, if they are kept.
    pub(super) counts: Option<Vec<u32>>,
    /// Number of samples of all pixels together.
    samples: u64,
    /// Number of samples of the pixel with the most.
    samples_most: u32,
    pub(super) samples_done: u32,
    pub(super) passes: Passes,
    pub(super) counters: Counters,
    /// Time of the first dispatch of every kernel, milliseconds; absent if the kernels had been used.
    pub(super) first_use_ms: Option<f64>,
}

impl Pixels {
    /// Reads the pixels of a film, without their costs.
    fn of(film: &Film, device: &Device, kept: Kept) -> Result<Self, ExperimentError> {
        let count = film.pixel_count() as usize;
        let mut means = Vec::with_capacity(count);
        let mut sums = kept.sums.then(|| Vec::with_capacity(count));
        let mut counts = kept.counts.then(|| Vec::with_capacity(count));
        let (mut samples, mut samples_most) = (0, 0);
        let take = |pixels: &[FilmPixel]| {
            means.extend(pixels.iter().map(FilmPixel::mean));
            sums.iter_mut().for_each(|sums| sums.extend(pixels.iter().map(|pixel| pixel.sum)));
            counts.iter_mut().for_each(|counts| counts.extend(pixels.iter().map(|pixel| pixel.samples)));
            samples += pixels.iter().map(|pixel| u64::from(pixel.samples)).sum::<u64>();
            samples_most = pixels.iter().map(|pixel| pixel.samples).fold(samples_most, u32::max);
        };
        film.read_bands(device, take)?;
        Ok(Self { means, sums, counts, samples, samples_most, ..Self::default() })
    }

    /// Describes the sharing of samples among the pixels by a rule.
    pub(super) fn adaptive(&self, rule: Adaptive) -> AdaptiveRecord {
        AdaptiveRecord {
            threshold: rule.threshold,
            least_samples: rule.least,
            samples_mean: self.samples as f64 / self.means.len().max(1) as f64,
            samples_most: self.samples_most,
        }
    }

    /// Sets the times of the image in a run.
    pub(super) fn write_times(&self, times: &mut Times) {
        times.timer = self.passes.timer();
        times.first_use_ms = self.first_use_ms;
        times.trace_ms = self.passes.median_of(|stage| matches!(stage, Stage::Trace(_)));
        times.visible_ms = self.passes.median_of(|stage| stage == Stage::Visible);
        times.image_ms = self.passes.median_of(|_| true);
    }
}

/// Values of a film that are kept in addition to the means.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Kept {
    sums: bool,
    counts: bool,
}

/// Renders the samples of an image through a built structure; kernels that are `new` are used once
/// beforehand.
pub(super) fn render_pixels(
    device: &Device,
    rendering: &mut ProgressiveImage,
    built: &Built,
    (new, task, kept): (bool, &str, Kept),
    progress: &mut OnProgress<'_>,
) -> Result<Pixels, ExperimentError> {
    let mut first_use_ms = None;
    if new {
        _ = progress(Progress { task, done: 0, total: 0, unit: "first use of the shaders" });
        first_use_ms = Some(rendering.warm_up(built)?);
    }
    rendering.render(device, built, task, progress)?;
    rendering.log_visibility(device)?;
    let faults = rendering.warn_of_faults(device)?;
    let image = rendering.image();
    let mut counters = built.counters()?;
    counters.unfinished = Some(image.unfinished());
    counters.cut = (faults.cut > 0).then(|| faults.cut.into());
    let mut pixels = Pixels::of(image.film(), device, kept)?;
    if image.passes().integrator().selects() {
        let selected = u64::from(faults.selected_low) | u64::from(faults.selected_high) << 32;
        let samples = pixels.samples + u64::from(faults.non_finite);
        counters.selected_share = (samples > 0).then(|| selected as f64 / samples as f64);
    }
    pixels.samples_done = image.samples_done();
    pixels.passes = std::mem::take(&mut rendering.passes);
    Ok(Pixels { counters, first_use_ms, ..pixels })
}

/// State on a device of a scene that is rendered at one moment after another: the scene, the structure and
/// the image. Another scene needs a new state.
#[derive(Default)]
pub struct KeptScene(Option<OnDevice>);

struct OnDevice {
    stage: DeviceScene,
    built: Built,
    rendering: ProgressiveImage,
    made_for: MadeFor,
    /// True if every kernel was used.
    is_warm: bool,
}

/// Inputs of a job that decide the data on the device.
struct MadeFor {
    /// Needs of the scene on the device.
    needs: Needs,
    refresh: Refresh,
    /// Configuration of the structure.
    system: SystemConfig,
    /// Frame of the image.
    frame: Frame,
    shard: Option<Shard>,
    measures: bool,
}

impl MadeFor {
    fn of(job: &RenderJob<'_>) -> Self {
        let (needs, system, frame) = (job.needs.clone(), job.system.clone(), job.frame.clone());
        let measures = job.aovs.contains(Aov::Variance);
        Self { needs, refresh: job.refresh, system, frame, shard: job.shard, measures }
    }

    /// True if the scene on the device also serves another job.
    fn has_scene_of(&self, other: &Self) -> bool {
        self.needs == other.needs && self.refresh == other.refresh
    }

    fn has_image_of(&self, other: &Self) -> bool {
        self.frame == other.frame && self.shard == other.shard && self.measures == other.measures
    }
}

/// Returns the triangles of the frame before, if the job has one; a pose must follow.
fn triangles_before(
    device: &Device,
    stage: &DeviceScene,
    job: &RenderJob<'_>,
) -> Result<Option<TrianglesBefore>, ExperimentError> {
    let Some(before) = &job.before else { return Ok(None) };
    let (positions, indices) = stage.triangles_at(device, job.scene, &before.moment)?;
    Ok(Some(TrianglesBefore { positions, indices }))
}

/// Brings a job to the device. The existing state is kept unless the eye is far from that of the job before.
/// Returns the times of the pose as well; none if the host posed the scene.
fn on_device(
    device: &Device,
    job: &RenderJob<'_>,
    kept: Option<OnDevice>,
    progress: &mut OnProgress<'_>,
) -> Result<(OnDevice, Passes, Option<TrianglesBefore>), ExperimentError> {
    let spec = job.system.spec()?;
    let mut says = |task, unit| _ = progress(Progress { task, done: 0, total: 0, unit });
    says("scene", "to the device");
    let made_for = MadeFor::of(job);
    let is_kept =
        |kept: &OnDevice| kept.made_for.has_scene_of(&made_for) && kept.stage.suits(job.scene, &job.camera);
    let kept = kept.filter(is_kept);
    let before;
    let (mut stage, shown, built, rendering) = match job.moment.zip(kept) {
        Some((moment, OnDevice { mut stage, built, rendering, made_for: kept_for, .. })) => {
            let Frame { width, height, seed, .. } = job.frame;
            stage.look(&View { camera: job.camera.clone(), width, height, seed })?;
            // Times in ascending order may be cheaper, so the frame before comes first.
            before = triangles_before(device, &stage, job)?;
            let shown = stage.pose(device, job.scene, moment, device.best_timing())?;
            let built = Some(built).filter(|_| kept_for.system == made_for.system);
            (stage, shown, built, Some(rendering).filter(|_| kept_for.has_image_of(&made_for)))
        }
        None => {
            let (mut stage, shown) = DeviceScene::of_job(device, job)?;
            before = triangles_before(device, &stage, job)?;
            if let Some(moment) = job.moment.filter(|_| before.is_some()) {
                stage.pose(device, job.scene, moment, Timing::None)?;
            }
            (stage, shown, None, None)
        }
    };
    stage.sample_as(&job.frame)?;
    let followed = built.and_then(|mut built| {
        says("build", "of the frame");
        // If a pool cannot be allocated, a structure that is made anew may reach it by device address.
        let failed = |error: &_| tracing::info!("the structure is made anew: {error}");
        built.follow(device, &stage.scene, stage.moved()).inspect_err(failed).ok().map(|()| built)
    });
    let is_warm = followed.is_some() && rendering.is_some();
    let built = match followed {
        Some(built) => built,
        None => {
            says("build", "first build");
            Built::refreshed(device, &spec, &mut stage, (job.scene, job.refresh))?
        }
    };
    let rendering = match rendering.filter(|rendering| rendering.serves(&built)) {
        Some(mut rendering) => {
            ProgressiveImage::check(&job.frame, &built)?;
            rendering.clear()?;
            rendering.scene_moved();
            rendering
        }
        None => {
            let rendering =
                ProgressiveImage::new(device, (&stage, &built), &job.frame, job.shard, &job.needs)?;
            if made_for.measures { rendering.measuring() } else { rendering }
        }
    };
    Ok((OnDevice { stage, built, rendering, made_for, is_warm }, shown.times(), before))
}

/// Renders an image with all requested additional images.
pub(super) fn render(
    device: &Device,
    job: &RenderJob<'_>,
    kept: &mut KeptScene,
    progress: &mut OnProgress<'_>,
) -> Result<RenderOutput, ExperimentError> {
    let started = Instant::now();
    let frame = &job.frame;
    // Images after the first of a sequence take the memory of the first again, so it is checked once.
    if kept.0.is_none() {
        image_memory::check(device, frame, job.aovs, job.shard.is_some())?;
    }
    let (mut on_device, posing, before) = on_device(device, job, kept.0.take(), progress)?;
    let OnDevice { stage, built, rendering, is_warm, .. } = &mut on_device;
    for _ in 0..job.repetitions {
        if progress(Progress { task: "build", done: 0, total: 0, unit: "timed builds" }).is_break() {
            break;
        }
        built.build_again(device)?;
    }
    let kept_of_film =
        Kept { sums: job.shard.is_some(), counts: job.shard.is_some() || job.aovs.contains(Aov::Samples) };
    let mut pixels = render_pixels(device, rendering, built, (!*is_warm, "render", kept_of_film), progress)?;
    let (options, mut paths) = built.resolved()?;
    if job.refresh != Refresh::All {
        paths.insert("refresh".to_owned(), job.refresh.name().to_owned());
    }
    let mut memory = built.memory(device)?;
    for (name, bytes) in stage.scene.bytes_by_part() {
        memory.by_part.insert(format!("scene {name}"), *bytes);
    }
    rendering.write_memory(&mut memory);
    rendering.write_memory_by_part(&mut memory);
    let mut stages = posing.stages();
    stages.extend(built.stages());
    stages.extend(pixels.passes.stages());
    let mut passes = posing.report(Some(PassOf::Pose));
    passes.extend(built.pass_times());
    passes.extend(pixels.passes.report(Some(PassOf::Image)));
    let mut times = Times { pose_ms: posing.median_of(|_| true), ..Times::default() };
    pixels.write_times(&mut times);
    built.write_times(&mut times);
    let adaptive = frame.adaptive.map(|rule| pixels.adaptive(rule));
    let mut aovs = BTreeMap::new();
    if !job.aovs.is_empty() {
        _ = progress(Progress { task: "render", done: 0, total: 0, unit: "additional images" });
        aovs = further_images(device, job, (stage, built, rendering), &mut pixels, before.as_ref())?;
    }
    let mut output = RenderOutput {
        width: frame.width,
        height: frame.height,
        beauty: std::mem::take(&mut pixels.means),
        sums: pixels.sums.zip(pixels.counts).map(|(sums, counts)| FilmSums { sums, counts }),
        aovs,
        samples_done: pixels.samples_done,
        adaptive,
        options,
        paths,
        stages,
        passes,
        times,
        spread: built.spread().collect(),
        memory: Some(memory),
        counters: Some(pixels.counters),
    };
    output.times.frame_ms = Some(started.elapsed().as_secs_f64() * 1.0e3);
    *kept = KeptScene(Some(on_device).filter(|on_device| on_device.stage.is_moving()));
    Ok(output)
}
