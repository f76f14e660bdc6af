//! `rasray compare`.

use super::hard;
use super::steps::{Posing, Shown, fit_images, open_device, read_scene, stop_if_requested, with_progress};
use super::targets::Targets;
use crate::arguments::CompareArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output;
use crate::terminal::{self, Talk};
use crate::version::origin;
use rasray_experiment::{CompareJob, Comparison, OpenBackend, RaySet, check_run, count_not_uploaded};
use rasray_ray_files::{load_hits, load_rays};
use rasray_report::{Report, table_within};

/// Rays per set unless told.
const DEFAULT_RAYS: u32 = 200_000;

/// Sets of rays unless told.
const DEFAULT_SETS: [RaySet; 2] = [RaySet::Incoherent, RaySet::Camera];

/// Traces the same rays through several systems and reports speed next to error; `line` is the command
/// as it was typed.
///
/// # Errors
/// Everything that can be refused without a device is refused before a device is opened.
pub(crate) fn compare(
    given: &CompareArguments,
    line: &str,
    open: &mut OpenBackend<'_>,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    if let Some(id) = hard::asked_for(&given.scene) {
        return hard::compare(given, id, line, open, interrupt);
    }
    if given.full || given.check {
        let option = if given.full { "--full" } else { "--check" };
        return Err(AppError::usage(
            format!("{option} is an option of hard cases"),
            "leave it out, or name a hard case such as hard:E5",
        ));
    }
    let frame = given.work.frame.frame()?;
    let systems = given.systems()?;
    let ray_sets = ray_sets(given)?;
    let targets = Targets::check(given, &given.scene)?;
    let rays_file = given.files.rays_file.as_deref().map(load_rays).transpose()?;
    let hits_files =
        given.files.hits_file.iter().map(|file| Ok::<_, AppError>(load_hits(&file.name, &file.path)?));
    let hits_files = hits_files.collect::<Result<Vec<_>, _>>()?;

    let shown =
        given.work.reading.time.map(|seconds| Shown { seconds, posing: Posing::Host, times: Vec::new() });
    let (mut loaded, chosen) =
        read_scene(&given.scene, &given.work.reading, shown.as_ref(), &given.work.view)?;
    let systems: Vec<_> =
        systems.into_iter().map(|system| system.seen_by(&chosen.camera, frame.width, frame.height)).collect();
    let shortcomings = systems.iter().filter_map(|system| system.shortcoming(frame.workload()));
    shortcomings.filter(|_| given.image).for_each(|text| terminal::warn(&text));

    let mut backend = open_device(open, &given.work.device)?;
    stop_if_requested(interrupt)?;
    let needs = given.work.reading.needs(&loaded.scene, frame.workload());
    fit_images(&mut loaded, &needs, backend.as_ref())?;
    count_not_uploaded(&mut loaded, &chosen.camera, &needs);
    let sets = ray_sets.len() + usize::from(rays_file.is_some());
    let wanted = systems.len() * (sets + usize::from(given.image)) + hits_files.len();
    let job = CompareJob {
        scene: &loaded.scene,
        camera: chosen.camera.clone(),
        systems,
        ray_sets,
        rays: given.rays.unwrap_or(DEFAULT_RAYS),
        frame,
        image: given.image,
        figures: targets.has_page(),
        repetitions: given.repetitions,
        rays_file,
        hits_files,
        keep: targets.save().any(),
        replay: given.replay,
        needs,
    };
    let Comparison { runs, figures, kept, replay } =
        with_progress(interrupt, |progress| progress.done > 0, |progress| backend.compare(&job, progress))?;
    if let Some(text) = replay {
        return terminal::print(&text);
    }
    let finished = runs.len();
    if finished == 0 && interrupt.requested() {
        return Err(AppError::interrupted("stopped before the first run was whole; nothing was written", ""));
    }

    let report =
        Report::new(origin(line), backend.device(), loaded.record(), runs).seen_from(chosen.record());
    output::save(targets.save(), &kept, interrupt)?;
    targets.write(&report, &figures, interrupt)?;
    terminal::summarize(
        &table_within(&report, Some(&chosen.described()), terminal::says(Talk::Verbose), terminal::width()),
        targets.take_stdout(),
    )?;
    report.runs.iter().try_for_each(check_run)?;
    if finished < wanted && interrupt.requested() {
        let kept = if targets.any() { "the report holds them" } else { "no report was asked for" };
        return Err(AppError::interrupted(
            format!("stopped after {finished} of {wanted} runs; {kept}"),
            "run again for all of them",
        ));
    }
    Ok(())
}

/// The generated sets that are wanted, each once, in the order given.
fn ray_sets(given: &CompareArguments) -> Result<Vec<RaySet>, AppError> {
    let mut kept = Vec::new();
    for set in &given.ray_set {
        if !kept.contains(set) {
            kept.push(*set);
        }
    }
    let from_file = given.files.rays_file.is_some();
    if kept.is_empty() && !from_file {
        kept.extend(DEFAULT_SETS);
    }
    if !given.files.hits_file.is_empty() && kept.len() + usize::from(from_file) != 1 {
        return Err(AppError::usage(
            "--hits-file has the hits of one set of rays, and several are traced",
            "say which with one --ray-set or with --rays-file",
        ));
    }
    Ok(kept)
}
