//! `rasray compare`.

use super::hard;
use super::steps::{Posing, Shown, fit_images, open_device, read_scene, stop_if_requested, with_progress};
use super::targets::Targets;
use crate::arguments::CompareArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{self, Cells};
use crate::terminal::{self, Talk};
use crate::version::{origin, version_text};
use rasray_experiment::{
    CompareJob, Comparison, FrameDefaults, OpenBackend, RaySet, check_run, compare_cells, count_not_uploaded,
};
use rasray_ray_files::{load_hits, load_rays};
use rasray_report::{Run, table_within};
use std::ops::ControlFlow;

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
    let frame = given.work.frame(FrameDefaults::default())?;
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
    let systems: Vec<_> = systems.into_iter().map(|system| system.seen_by(&chosen.camera, &frame)).collect();
    let shortcomings = systems.iter().filter_map(|system| system.shortcoming(frame.workload()));
    shortcomings.filter(|_| given.image).for_each(|text| terminal::warn(&text));

    let mut backend = open_device(open, &given.work.device)?;
    stop_if_requested(interrupt)?;
    let needs = given.work.reading.needs(&loaded.scene, frame.workload());
    fit_images(&mut loaded, &needs, backend.as_ref())?;
    count_not_uploaded(&mut loaded, &chosen.camera, &needs);
    let mut job = CompareJob {
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
        only: None,
    };
    let list = compare_cells(version_text(), &loaded, &job);
    let program = (origin(line), backend.device());
    let mut cells = Cells::open(list, program, targets.lines(), (given.resume, interrupt))?;
    let wanted = cells.missing(given.shard)?;
    let count = wanted.len();
    note_resumed(&cells, count);
    job.only = Some(wanted);
    let mut failed = None;
    let mut finished = |place: usize, run: &Run| {
        let about = (loaded.record(), Some(chosen.record()));
        failed = cells.add(place, run.clone(), about, interrupt).err();
        if failed.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let Comparison { places, figures, kept, replay, .. } = if count == 0 {
        Comparison::default()
    } else {
        with_progress(
            interrupt,
            |progress| progress.done > 0,
            |progress| backend.compare(&job, &mut finished, progress),
        )?
    };
    if let Some(error) = failed {
        return Err(error);
    }
    if let Some(text) = replay {
        return terminal::print(&text);
    }
    let Some(report) = cells.report() else {
        return Err(AppError::interrupted("stopped before the first run was whole; nothing was written", ""));
    };
    cells.note();
    output::save(targets.save(), &kept, interrupt)?;
    let figures = figures.moved(|run| cells.run(places[run]));
    targets.write(&report, &figures, interrupt)?;
    terminal::summarize(
        &table_within(&report, Some(&chosen.described()), terminal::says(Talk::Verbose), terminal::width()),
        targets.take_stdout(),
    )?;
    report.runs.iter().try_for_each(check_run)?;
    stop_after(&targets, (places.len(), count), "runs", interrupt)
}

/// Says that a command goes on.
pub(super) fn note_resumed(cells: &Cells, missing: usize) {
    if cells.count() > 0 {
        terminal::note(&format!(
            "{} of {} runs are there already, {missing} are made",
            cells.count(),
            cells.list().len()
        ));
    }
}

/// The end of a command that a signal stopped before all was done.
pub(super) fn stop_after(
    targets: &Targets,
    (finished, wanted): (usize, usize),
    what: &str,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    if finished >= wanted || !interrupt.requested() {
        return Ok(());
    }
    let kept = if targets.any() { "the report holds them" } else { "no report was asked for" };
    let again =
        if targets.lines().is_some() { "run again with --resume" } else { "run again for all of them" };
    Err(AppError::interrupted(format!("stopped after {finished} of {wanted} {what}; {kept}"), again))
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
