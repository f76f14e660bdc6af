//! Systems side by side: the same rays and images, alternated in one process, against the truth.

use std::ops::ControlFlow;

use rasray_ads::{Hit, QueueCounters, Ray, TraceMode};
use rasray_gpu::Device;
use rasray_reference::oracle::{Accept, Oracle, Verdict};
use rasray_reference::shading::{PosedScene, View};
use rasray_systems::Spec;
use rasray_tracer::BatchTracer;

use super::images::compare_images;
use super::judge::{accuracy, depth_errors, device_hits};
use super::passes::{Passes, median};
use super::rays::{RaySource, oracle_ray};
use super::spec_of;
use super::stage::{Built, Stage, device_error, tracer_error};
use crate::backend::{CompareJob, Comparison, OnProgress, Progress, RaySet};
use crate::error::AppError;
use crate::report::{Run, Times};
use crate::systems::{SystemConfig, word};

/// Timed repetitions of each ray set, after one that warms up and is judged.
const REPETITIONS: usize = 3;

/// One system of the comparison.
pub(super) struct Contestant<'a> {
    pub(super) config: &'a SystemConfig,
    pub(super) spec: Spec,
    pub(super) built: Built,
}

/// What images are made from.
#[derive(Clone, Copy)]
pub(super) struct Setting<'a> {
    pub(super) device: &'a Device,
    pub(super) job: &'a CompareJob<'a>,
    pub(super) stage: &'a Stage,
    pub(super) posed: &'a PosedScene<'a>,
    pub(super) view: &'a View,
}

/// Runs all systems on all ray sets, then on the image where that is wanted.
pub(super) fn compare(
    device: &Device,
    job: &CompareJob<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<Comparison, AppError> {
    let frame = job.frame;
    let stage =
        Stage::new(device, job.scene, &job.camera, [frame.width, frame.height], frame.seed, &job.needs)?;
    let geometry = stage.scene.geometry().desc();
    let positions = device
        .download_as::<[f32; 3]>(&geometry.positions, 0, geometry.vertex_count as usize)
        .map_err(device_error)?;
    let indices = device
        .download_as::<u32>(&geometry.indices, 0, 3 * geometry.triangle_count as usize)
        .map_err(device_error)?;
    let origin = stage.scene.frame_origin();
    let posed = PosedScene::with_positions(job.scene, origin, positions.clone())
        .map_err(|error| AppError::usage(error.to_string(), ""))?;
    let accept = |primitive: u32, barycentrics: [f64; 2]| posed.alpha_accepts(primitive, barycentrics);
    let masked = posed.has_alpha_masks() && stage.dropped_triangles == 0;
    let accept: Option<Accept<'_>> = if masked { Some(&accept) } else { None };
    let oracle = Oracle::new(&positions, &indices, accept).map_err(device_error)?;
    let view = View {
        camera: job.camera.clone(),
        width: frame.width,
        height: frame.height,
        samples: frame.spp,
        seed: frame.seed,
    };
    let center = views_center(&stage, geometry.bounds);
    let source = RaySource {
        view: &view,
        frame_origin: origin,
        bounds: geometry.bounds,
        center,
        oracle: &oracle,
        positions: &positions,
        indices: &indices,
    };

    let mut contestants = Vec::new();
    for config in &job.systems {
        let spec = spec_of(config)?.with_counters(true);
        let built = Built::new(device, &spec, &stage.scene, center, device.best_timing())?;
        contestants.push(Contestant { config, spec, built });
    }
    let total = (contestants.len() * (job.ray_sets.len() + usize::from(job.image))) as u64;
    let mut comparison = Comparison::default();
    for set in &job.ray_sets {
        let rays = source.rays(*set, job.rays);
        let verdicts = oracle.closest_batch(&rays.iter().map(oracle_ray).collect::<Vec<_>>());
        trace_set(device, &contestants, *set, &rays, &verdicts, job, &mut comparison)?;
        let done = comparison.runs.len() as u64;
        if progress(Progress { task: &word(set), done, total, unit: "runs" }) == ControlFlow::Break(()) {
            return Ok(comparison);
        }
    }
    if job.image {
        let setting = Setting { device, job, stage: &stage, posed: &posed, view: &view };
        compare_images(&setting, &contestants, &mut comparison, progress)?;
    }
    Ok(comparison)
}

/// The views' centre of ray sets: a tenth of the way from the camera to the middle of the scene, so
/// that the camera's rays do not start where the views do.
fn views_center(stage: &Stage, [lower, upper]: [[f32; 3]; 2]) -> [f32; 3] {
    let eye = stage.scene.eye();
    std::array::from_fn(|axis| {
        let middle = 0.5 * (f64::from(lower[axis]) + f64::from(upper[axis]));
        (f64::from(eye[axis]) + 0.1 * (middle - f64::from(eye[axis]))) as f32
    })
}

/// Traces one set through all systems, alternating, and judges the hits.
fn trace_set(
    device: &Device,
    contestants: &[Contestant<'_>],
    set: RaySet,
    rays: &[Ray],
    verdicts: &[Verdict],
    job: &CompareJob<'_>,
    comparison: &mut Comparison,
) -> Result<(), AppError> {
    let tracer =
        BatchTracer::new(device, rays.len().clamp(1, 131_072) as u32).map_err(|e| tracer_error(&e))?;
    let timing = device.best_timing();
    let mut traces: Vec<Traced> = contestants.iter().map(|_| Traced::default()).collect();
    for repetition in 0..=REPETITIONS {
        for (contestant, traced) in contestants.iter().zip(&mut traces) {
            let outcome = tracer
                .trace(contestant.built.structure.as_ref(), rays, TraceMode::Closest, timing)
                .map_err(|e| tracer_error(&e))?;
            if repetition == 0 {
                traced.hits = outcome.hits;
                traced.counters = outcome.counters;
            } else {
                traced.milliseconds.push(outcome.milliseconds());
                traced.passes.add(&outcome.passes);
            }
        }
    }
    for (contestant, traced) in contestants.iter().zip(traces) {
        let hits = device_hits(&traced.hits);
        let mut run = run_of_rays(device, contestant, set, rays.len() as u64, traced, job)?;
        run.accuracy = Some(accuracy(contestant.built.structure.kind(), verdicts, &hits)?);
        if job.figures {
            comparison.figures.depth_errors.push(depth_errors(comparison.runs.len(), verdicts, &hits));
        }
        comparison.runs.push(run);
    }
    Ok(())
}

/// What one system answered to one set.
#[derive(Default)]
struct Traced {
    hits: Vec<Hit>,
    counters: QueueCounters,
    milliseconds: Vec<f64>,
    passes: Passes,
}

fn run_of_rays(
    device: &Device,
    contestant: &Contestant<'_>,
    set: RaySet,
    rays: u64,
    traced: Traced,
    job: &CompareJob<'_>,
) -> Result<Run, AppError> {
    let trace_ms = median(&traced.milliseconds);
    let mut counters = contestant.built.counters()?;
    let per_ray = |sum: u64| (rays > 0).then(|| sum as f64 / rays as f64);
    counters.nodes_per_ray = per_ray(traced.counters.entries);
    counters.cells_per_ray = per_ray(traced.counters.cells);
    counters.tests_per_ray = per_ray(traced.counters.tests);
    counters.unfinished = Some(traced.counters.unfinished.into());
    let mut run = base_run(device, contestant)?;
    run.ray_set = Some(word(&set));
    run.seed = Some(job.frame.seed);
    run.times = Times {
        timer: traced.passes.timer(),
        build_ms: Some(contestant.built.build_milliseconds),
        build_host_ms: Some(contestant.built.prepare_milliseconds),
        trace_ms: Some(trace_ms),
        rays: Some(rays),
        mrays_per_s: (trace_ms > 0.0).then(|| rays as f64 / trace_ms / 1.0e3),
        ..Times::default()
    };
    run.passes.extend(traced.passes.report());
    run.counters = Some(counters);
    Ok(run)
}

/// Names, options, build passes and bytes of a system.
pub(super) fn base_run(device: &Device, contestant: &Contestant<'_>) -> Result<Run, AppError> {
    let (options, paths) = contestant.built.resolved()?;
    Ok(Run {
        system: word(&contestant.config.name),
        structure: contestant.spec.system().structure.to_owned(),
        preset: word(&contestant.config.preset),
        options,
        paths,
        passes: contestant.built.passes.report(),
        memory: Some(contestant.built.memory(device)?),
        ..Run::default()
    })
}
