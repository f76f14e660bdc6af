//! Comparison of all systems on a hard case with the oracle and with the target of the case.

use glam::DVec3;
use rasray_ads::{Hit, StructureKind};
use rasray_gpu::Device;
use rasray_hard_cases::{HardCase, Triangle};
use rasray_reference::oracle::Oracle;
use rasray_scene::needs::Needs;

use crate::backend::{OnProgress, Progress};
use crate::contestant::Contestant;
use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::evaluate::device_hits;
use crate::hard_verdict::hard_record;
use crate::jobs::{Comparison, HardJob};
use crate::measured::{Measured, Tolerance};
use crate::placed::{Placed, case_camera};
use crate::rays::triangles;
use crate::replay::replay_case;
use crate::traced_set::{RaysWithTruth, Taking, Wanted, compare_set};

/// Runs all systems on the rays of a case.
pub(super) fn hard(
    device: &Device,
    job: &HardJob<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<Comparison, ExperimentError> {
    let case = job.case;
    let placed = Placed::new(&case.triangles);
    let scene = placed.scene(case);
    let camera = case_camera(case.eye);
    // The frame origin is the world's own origin, so that positions are those of the case bit for bit.
    let stage = DeviceScene::around(device, &scene, DVec3::ZERO, &camera, [1, 1], job.seed, &Needs::all())?;
    check_positions(device, &stage, case, &placed)?;
    if let Some(index) = job.replay {
        let rays = case.rays.iter().map(|ray| placed.device_ray(ray)).collect();
        return replay_case(device, &stage, job.systems, (case.id, case.eye), rays, index);
    }
    let (positions, indices) = case.buffers();
    let oracle = Oracle::new(&positions, &indices, None)?;
    let set = RaysWithTruth {
        name: case.id.to_owned(),
        rays: case.rays.iter().map(|ray| placed.device_ray(ray)).collect(),
        verdicts: oracle.closest_batch(&case.rays),
    };
    let mut comparison = Comparison::default();
    // Progress names the case, so that a slow one is recognised in a run of many cases.
    let mut of_case = |step: Progress<'_>| {
        let task = format!("{}, {}", case.id, step.task);
        progress(Progress { task: &task, ..step })
    };
    let wants = |place: usize| job.only.as_ref().is_none_or(|only| only.contains(&place));
    let around = (case.eye, job.repetitions);
    let Some(mut contestants) = Contestant::some(device, &stage, job.systems, wants, around, &mut of_case)?
    else {
        return Ok(comparison);
    };
    let mut taking = Taking::of(0, (&mut contestants, job.systems.len()), job.hits_files, wants);
    if progress(Progress { task: case.id, done: 0, total: 0, unit: "rays" }).is_break() {
        return Ok(comparison);
    }
    if job.keep {
        comparison.kept.triangles = case.triangles.clone();
        comparison.kept.case = Some(case.id.to_owned());
    }
    let wanted =
        Wanted { repetitions: job.repetitions, seed: job.seed, figures: job.figures, keep: job.keep };
    let name = |hits: Vec<Hit>| hits.into_iter().map(|hit| placed.named(hit)).collect();
    let answers = compare_set(device, &mut taking, &set, wanted, name, &mut comparison)?;
    for ray in comparison.kept.sets.iter_mut().flat_map(|set| &mut set.rays) {
        ray.exclude_primitive = placed.id(ray.exclude_primitive);
    }
    for (run, answer) in comparison.runs.iter_mut().zip(&answers) {
        let hits = device_hits(answer.hits.iter().copied());
        let tolerance = Tolerance::of(answer.kind);
        let measured = Measured::of(case, &set.verdicts, &hits, tolerance, |_| false)?;
        let largest_dt = run.accuracy.as_ref().and_then(|accuracy| accuracy.dt_rel_max);
        let dt = largest_dt.zip(case.largest_dt.filter(|_| answer.kind == StructureKind::Primitive));
        run.hard = Some(hard_record(case, answer.kind, &measured, dt, run.options.get("resolution")));
    }
    let done = comparison.runs.len() as u64;
    // An early end is ignored here, because nothing follows that it could save.
    _ = progress(Progress { task: case.id, done, total: done, unit: "runs" });
    Ok(comparison)
}

/// Checks that the device has the case's triangles and no others, bit for bit.
fn check_positions(
    device: &Device,
    stage: &DeviceScene,
    case: &HardCase,
    placed: &Placed,
) -> Result<(), ExperimentError> {
    let (positions, indices) = stage.triangles(device)?;
    let bits = |triangle: &Triangle| triangle.map(|corner| corner.map(f32::to_bits));
    let expected = placed.triangles(&case.triangles);
    if triangles(&positions, &indices).iter().map(bits).eq(expected.iter().map(bits)) {
        return Ok(());
    }
    Err(ExperimentError::OtherTriangles { case: case.id.to_string() })
}
