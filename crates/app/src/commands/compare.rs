//! Command `rasray compare`.

use super::hard;
use super::steps::{open_device, stop_if_requested, with_progress};
use super::subject::ComparisonRequest;
use super::targets::Targets;
use crate::arguments::CompareArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{self, Cells};
use crate::terminal::{self, Talk};
use crate::version::origin;
use rasray_experiment::{CompareJob, Comparison, FinishedRun, OpenBackend, check_run};
use rasray_report::table_within;
use std::ops::ControlFlow;

/// Traces equal rays through several systems and reports speed next to error; `line` is the command as it was
/// typed.
///
/// # Errors
/// Errors that can be found without a device are reported before a device is opened.
pub(crate) fn compare(
    given: &CompareArguments,
    line: &str,
    open: &mut OpenBackend<'_>,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    if let Some(id) = hard::asked_for(&given.scene) {
        return hard::compare(given, id, line, open, interrupt);
    }
    let asked = ComparisonRequest::of(given)?;
    let targets = Targets::check(given, &given.scene)?;
    let mut subject = asked.read()?;
    subject.warn();
    let mut backend = open_device(open, &given.work.device)?;
    stop_if_requested(interrupt)?;
    subject.fit(backend.as_ref())?;
    let list = subject.cells();
    let program = (origin(line), backend.device());
    let mut cells = Cells::open(list, program, targets.lines(), (given.resume, interrupt))?;
    let wanted = cells.missing(given.shard)?;
    let count = wanted.len();
    note_resumed(&cells, count);
    let job = CompareJob {
        figures: targets.has_page(),
        keep: targets.save().any(),
        only: Some(wanted),
        ..subject.job()
    };
    let mut failed = None;
    let mut finished = |FinishedRun { place, run, .. }: FinishedRun<'_>| {
        failed = cells.add(place, run.clone(), subject.records(), interrupt).err();
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
        &table_within(&report, Some(&subject.camera()), terminal::says(Talk::Verbose), terminal::width()),
        targets.take_stdout(),
    )?;
    report.runs.iter().try_for_each(check_run)?;
    stop_after(&targets, (places.len(), count), "runs", interrupt)
}

/// Notes that a command resumes.
pub(super) fn note_resumed(cells: &Cells, missing: usize) {
    if cells.count() > 0 {
        terminal::note(&format!(
            "{} of {} runs are there already, {missing} are made",
            cells.count(),
            cells.list().len()
        ));
    }
}

/// Returns the error of a command that a signal stopped before all was done.
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
