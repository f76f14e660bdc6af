//! Systems side by side: the same rays and images, alternated in one process, against the truth.

use std::ops::ControlFlow;

use rasray_gpu::Device;
use rasray_reference::oracle::{Accept, Oracle, Side};
use rasray_reference::shading::{PosedScene, View};

use crate::backend::{OnProgress, Progress};
use crate::contestant::Contestant;
use crate::device_scene::{DeviceScene, device_error};
use crate::error::ExperimentError;
use crate::images::{Setting, compare_images};
use crate::jobs::{CompareJob, Comparison, FILE_SET, Sampler};
use crate::rays::{RayFlags, RaySource, oracle_ray, triangles};
use crate::replay::{ReplaySetting, replay_sets};
use crate::traced_set::{RaysWithTruth, Wanted, compare_set};
use crate::work_maps::work_maps;

/// Runs all systems on all ray sets, then on the image where that is wanted.
pub(super) fn compare(
    device: &Device,
    job: &CompareJob<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<Comparison, ExperimentError> {
    let frame = &job.frame;
    let mut says = |task: &str, unit: &str| _ = progress(Progress { task, done: 0, total: 0, unit });
    says("scene", "to the device");
    let mut stage = DeviceScene::new(
        device,
        job.scene,
        &job.camera,
        [frame.width, frame.height],
        frame.seed,
        &job.needs,
    )?;
    stage.sample_as(frame)?;
    let (positions, indices) = stage.triangles(device)?;
    let origin = stage.scene.frame_origin();
    let posed = PosedScene::with_positions(job.scene, origin, positions.clone())
        .map_err(|error| ExperimentError::usage(error.to_string(), ""))?
        .with_back_faces(frame.back_faces);
    let accept = |primitive: u32, barycentrics: [f64; 2]| posed.alpha_accepts(primitive, barycentrics);
    says("oracle", "building");
    let masked = posed.has_alpha_masks() && stage.dropped_triangles == 0;
    let accept: Option<Accept<'_>> = if masked { Some(&accept) } else { None };
    let oracle = Oracle::new(&positions, &indices, accept).map_err(device_error)?;
    let oracle = oracle.with_backs(|primitive| posed.back_of(primitive));
    let view = View {
        camera: job.camera.clone(),
        width: frame.width,
        height: frame.height,
        samples: frame.spp,
        seed: frame.seed,
        sampler: match frame.sampler {
            Sampler::Sobol => rasray_reference::shading::Sampler::Sobol,
            Sampler::Pcg => rasray_reference::shading::Sampler::Pcg,
        },
    };
    let bounds = stage.scene.geometry().bounds();
    let center = views_center(&stage, bounds);
    let source = RaySource {
        view: &view,
        frame_origin: origin,
        bounds,
        center,
        oracle: &oracle,
        positions: &positions,
        indices: &indices,
        flags: RayFlags::of(&stage.scene),
    };

    let generated = job.ray_sets.iter().map(|set| (set.name().to_owned(), source.rays(*set, job.rays)));
    let given = job.rays_file.as_ref().map(|file| (FILE_SET.to_owned(), file.relative_to(origin.to_array())));
    let sets = generated.chain(given);
    if let Some(index) = job.replay {
        let setting = ReplaySetting { device, stage: &stage, oracle: &oracle, center };
        return replay_sets(&setting, &job.systems, sets, index);
    }
    let Some(contestants) = Contestant::all(device, &stage, &job.systems, center, job.repetitions, progress)?
    else {
        return Ok(Comparison::default());
    };
    let count = job.ray_sets.len() + usize::from(job.rays_file.is_some());
    let total = (contestants.len() * (count + usize::from(job.image))) as u64;
    let mut comparison = Comparison::default();
    if job.keep {
        comparison.kept.frame_origin = origin.to_array();
        comparison.kept.triangles = triangles(&positions, &indices);
        let back = |primitive| match posed.back_of(primitive) {
            None => 0,
            Some(Side::Clockwise) => 1,
            Some(Side::CounterClockwise) => 2,
        };
        comparison.kept.backs = (0..posed.triangle_count()).map(back).collect();
    }
    let wanted = Wanted {
        repetitions: job.repetitions,
        seed: frame.seed,
        figures: job.figures,
        keep: job.keep,
        given_hits: &job.hits_files,
    };
    for (name, rays) in sets {
        let done = comparison.runs.len() as u64;
        if progress(Progress { task: &name, done, total, unit: "runs" }).is_break() {
            return Ok(comparison);
        }
        let verdicts = oracle.closest_batch(&rays.iter().map(oracle_ray).collect::<Vec<_>>());
        let set = RaysWithTruth { name, rays, verdicts };
        compare_set(device, &contestants, &set, wanted, |hits| hits, &mut comparison)?;
        let done = comparison.runs.len() as u64;
        if progress(Progress { task: &set.name, done, total, unit: "runs" }) == ControlFlow::Break(()) {
            return Ok(comparison);
        }
    }
    if job.figures {
        comparison.figures.work = work_maps(device, &stage, &contestants, &source, &comparison.runs)?;
    }
    if job.image {
        let setting = Setting { device, job, stage: &stage, posed: &posed, view: &view };
        compare_images(&setting, &contestants, &mut comparison, progress)?;
    }
    Ok(comparison)
}

/// The views' centre of ray sets: a tenth of the way from the camera to the middle of the scene, so
/// that the camera's rays do not start where the views do.
fn views_center(stage: &DeviceScene, [lower, upper]: [[f32; 3]; 2]) -> [f32; 3] {
    let eye = stage.scene.eye();
    std::array::from_fn(|axis| {
        let middle = 0.5 * (f64::from(lower[axis]) + f64::from(upper[axis]));
        (f64::from(eye[axis]) + 0.1 * (middle - f64::from(eye[axis]))) as f32
    })
}
