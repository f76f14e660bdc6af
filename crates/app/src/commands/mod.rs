//! What each word of the command does.

mod compare;
mod hard;
mod info;
mod render;

pub(crate) use compare::compare;
pub(crate) use info::info;
pub(crate) use render::render;

use crate::backend::{Frame, Integrator, Progress};
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::Destination;
use crate::progress::ProgressLine;
use crate::report::Run;
use std::ffi::OsStr;
use std::ops::ControlFlow;
use std::path::Path;

/// The name of an integrator in reports and images.
pub(crate) fn integrator_name(frame: &Frame) -> &'static str {
    match frame.integrator {
        Integrator::Path { .. } => "path",
        Integrator::AmbientOcclusion { .. } => "ao",
        Integrator::Raycast => "raycast",
    }
}

/// Bounces, where the integrator has them.
pub(crate) fn bounces(frame: &Frame) -> Option<u32> {
    match frame.integrator {
        Integrator::Path { bounces } => Some(bounces),
        _ => None,
    }
}

/// Checks the place of an output that was asked for.
fn destination(path: Option<&Path>) -> Result<Option<Destination>, AppError> {
    path.map(Destination::check).transpose()
}

/// Refuses to write what `option` asks for over the scene that it is about.
fn keep_inputs(option: &str, output: Option<&Destination>, scene: &OsStr) -> Result<(), AppError> {
    let scene = Path::new(scene);
    match output {
        Some(output) if scene.is_file() && output.is(scene) => Err(AppError::usage(
            format!("{option} names the scene file"),
            "name another file, such as report.json",
        )),
        _ => Ok(()),
    }
}

/// Does `work` with a progress line; a signal asks it to end early.
fn with_progress<T>(
    interrupt: &Interrupt,
    work: impl FnOnce(&mut dyn FnMut(Progress<'_>) -> ControlFlow<()>) -> Result<T, AppError>,
) -> Result<T, AppError> {
    let mut line = ProgressLine::new();
    let result = work(&mut |progress| {
        line.show(progress);
        if progress.done > 0 {
            interrupt.keep();
        }
        if interrupt.requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    interrupt.keep();
    line.finish();
    result
}

/// Stops before anything is begun, if a signal asked for it.
fn stop_if_requested(interrupt: &Interrupt) -> Result<(), AppError> {
    if interrupt.requested() {
        return Err(AppError::interrupted("stopped before the first sample; nothing was written", ""));
    }
    Ok(())
}

/// Refuses what was traced through a structure with holes, or with rays left unanswered.
fn check_whole(run: &Run) -> Result<(), AppError> {
    let Some(counters) = &run.counters else { return Ok(()) };
    let system = format!("{} {}", run.system, run.preset);
    if let Some(missing) = counters.overflow.filter(|count| *count > 0) {
        return Err(AppError::refused(
            format!("{system}: {missing} entries were missing from what was traced"),
            "its results are not kept; lower --resolution, or use a device with more memory",
        ));
    }
    if let Some(unfinished) = counters.unfinished.filter(|count| *count > 0) {
        return Err(AppError::refused(
            format!("{system}: {unfinished} rays had no answer after the last round"),
            "its results are not kept; this is a defect, please report it with the command line",
        ));
    }
    Ok(())
}
