//! Work of the ray through each pixel's centre, and the hit of the ray through any place of a picture.

use glam::Vec2;
use rasray_ads::{Counters, Ray, RayWork, TraceMode};
use rasray_gpu::{Device, Timing};
use rasray_metrics::DeviceHit;
use rasray_reference::shading::{View, camera_ray};
use rasray_scene::{Camera, Sampler};
use rasray_systems::Spec;
use rasray_tracer::BatchTracer;

use crate::built::Built;
use crate::contestant::Contestant;
use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::evaluate::device_hits;
use crate::rays::{RayFlags, RaySource, from_shading};
use rasray_report::Run;
use rasray_report::figures::WorkMap;

/// Largest number of rays that are traced at a time.
const BATCH: usize = 131_072;

/// Makes a map for each system, which belongs to the system's run of camera rays, or else to its first run.
pub(super) fn work_maps(
    device: &Device,
    stage: &DeviceScene,
    contestants: &[(usize, Contestant<'_>)],
    source: &RaySource<'_>,
    runs: &[Run],
) -> Result<Vec<WorkMap>, ExperimentError> {
    let View { camera, width, height, .. } = source.view;
    let mut maps = Vec::new();
    for (_, contestant) in contestants {
        let Some(run) = run_of(contestant, runs) else { continue };
        let work = work_per_pixel(device, stage, &contestant.spec, source.center, camera, [*width, *height])?;
        if let Some(work) = work {
            maps.push(WorkMap { run, ..work });
        }
    }
    Ok(maps)
}

/// Measures the work of the ray through each pixel's centre in a structure of this spec, built as seen from
/// `eye` (metres, relative to the frame origin); the map's run is 0. Returns `None` if the structure counts
/// nothing per ray. The size is in pixels.
///
/// Rays that record their own work are slower, so the map has a structure of its own.
///
/// # Errors
/// The device lacks a feature or fails, or the structure or rays do not become complete.
pub fn work_per_pixel(
    device: &Device,
    stage: &DeviceScene,
    spec: &Spec,
    eye: [f32; 3],
    camera: &Camera,
    [width, height]: [u32; 2],
) -> Result<Option<WorkMap>, ExperimentError> {
    let rays = centres(&view_of(camera, [width, height]), stage);
    let tracer = BatchTracer::new(device, rays.len().clamp(1, BATCH) as u32)?;
    let built = Built::new(device, &spec.clone().with_counters(Counters::PerRay), &stage.scene, eye)?;
    let outcome = tracer.trace(built.structure(), &rays, TraceMode::Closest, device.best_timing())?;
    let of = |count: fn(&RayWork) -> u32| outcome.work.iter().map(count).collect();
    Ok((outcome.work.len() == rays.len()).then(|| WorkMap {
        run: 0,
        width,
        height,
        cells: of(|work| work.cells),
        entries: of(|work| work.entries),
        tests: of(|work| work.tests),
    }))
}

/// Finds the hit of the ray through a place of a picture (pixels from the left top corner; through the centre
/// of a lens) in a structure that is built: metres along the ray, and the triangle unless a fragment does not
/// keep it. Returns `None` if the ray leaves the scene. The size is in pixels.
///
/// # Errors
/// The device fails, or the ray does not become complete.
pub fn hit_at(
    device: &Device,
    stage: &DeviceScene,
    built: &Built,
    camera: &Camera,
    size: [u32; 2],
    place: [f32; 2],
) -> Result<Option<DeviceHit>, ExperimentError> {
    let ray = through(&view_of(camera, size), stage, Vec2::from(place));
    let tracer = BatchTracer::new(device, 1)?;
    let outcome = tracer.trace(built.structure(), &[ray], TraceMode::Closest, Timing::None)?;
    Ok(device_hits(outcome.hits).into_iter().next().flatten())
}

/// Makes a view of one sample, of a size in pixels.
fn view_of(camera: &Camera, [width, height]: [u32; 2]) -> View {
    View { camera: camera.clone(), width, height, samples: 1, seed: 0, sampler: Sampler::default() }
}

/// Makes the ray of a picture through a place, pixels.
fn through(view: &View, stage: &DeviceScene, place: Vec2) -> Ray {
    let flags = RayFlags::of(&stage.scene).camera;
    Ray { flags, ..from_shading(&camera_ray(view, stage.scene.frame_origin(), place)) }
}

/// Makes rays through the centres of all pixels, rows from the top.
fn centres(view: &View, stage: &DeviceScene) -> Vec<Ray> {
    let pixels = (0..view.height).flat_map(|y| (0..view.width).map(move |x| (x, y)));
    pixels.map(|(x, y)| through(view, stage, Vec2::new(x as f32 + 0.5, y as f32 + 0.5))).collect()
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
