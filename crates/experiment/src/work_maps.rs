//! What the ray through each pixel's centre costs.

use glam::Vec2;
use rasray_ads::{Counters, Ray, TraceMode};
use rasray_gpu::Device;
use rasray_tracer::BatchTracer;

use crate::contestant::Contestant;
use crate::error::ExperimentError;
use crate::rays::RaySource;
use crate::stage::{Built, Stage, tracer_error};
use rasray_report::Run;
use rasray_report::figures::WorkMap;

/// Most rays that are traced at a time.
const BATCH: usize = 131_072;

/// A map for each system, kept with the system's run of camera rays, or its first.
///
/// Rays that write down their own work are slower, so the maps have structures of their own.
pub(super) fn work_maps(
    device: &Device,
    stage: &Stage,
    contestants: &[Contestant<'_>],
    source: &RaySource<'_>,
    runs: &[Run],
) -> Result<Vec<WorkMap>, ExperimentError> {
    let (width, height) = (source.view.width, source.view.height);
    let rays = centres(source);
    let tracer = BatchTracer::new(device, rays.len().clamp(1, BATCH) as u32).map_err(|e| tracer_error(&e))?;
    let mut maps = Vec::new();
    for contestant in contestants {
        let Some(run) = run_of(contestant, runs) else { continue };
        let spec = contestant.spec.clone().with_counters(Counters::PerRay);
        let built = Built::new(device, &spec, &stage.scene, source.center)?;
        let outcome = tracer
            .trace(built.structure.as_ref(), &rays, TraceMode::Closest, device.best_timing())
            .map_err(|e| tracer_error(&e))?;
        if outcome.work.len() != rays.len() {
            continue;
        }
        maps.push(WorkMap {
            run,
            width,
            height,
            cells: outcome.work.iter().map(|work| work.cells).collect(),
            entries: outcome.work.iter().map(|work| work.entries).collect(),
            tests: outcome.work.iter().map(|work| work.tests).collect(),
        });
    }
    Ok(maps)
}

/// Rays through the centres of all pixels, rows from the top.
fn centres(source: &RaySource<'_>) -> Vec<Ray> {
    let (width, height) = (source.view.width, source.view.height);
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    pixels.map(|(x, y)| source.through(Vec2::new(x as f32 + 0.5, y as f32 + 0.5))).collect()
}

fn run_of(contestant: &Contestant<'_>, runs: &[Run]) -> Option<usize> {
    let (system, preset) = (contestant.config.system.name, contestant.config.preset.name());
    let own = |run: &&Run| run.system == system && run.preset == preset && run.ray_set.is_some();
    let of = |set: Option<&str>| {
        runs.iter()
            .enumerate()
            .filter(|(_, run)| own(run))
            .find(|(_, run)| set.is_none() || run.ray_set.as_deref() == set)
            .map(|(place, _)| place)
    };
    of(Some("camera")).or_else(|| of(None))
}
