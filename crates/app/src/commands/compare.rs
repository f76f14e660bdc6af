//! `rasray compare`.

use super::{check_whole, destination, keep_inputs, stop_if_requested, with_progress};
use crate::arguments::CompareArguments;
use crate::backend::{CompareJob, Comparison, OpenBackend, RaySet};
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::report::{Report, table};
use crate::{camera, scene_source, systems, terminal};

/// Traces the same rays through several systems and reports speed beside error.
///
/// # Errors
/// Everything that can be refused without a device is refused before a device is opened.
pub(crate) fn compare(
    given: &CompareArguments,
    open: &mut OpenBackend<'_>,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let frame = given.frame.frame()?;
    let systems = systems::several(&given.systems, &given.presets, &given.structure, &given.assignments)?;
    let report_target = destination(given.report.as_deref())?;
    keep_inputs(report_target.as_ref(), &given.scene)?;

    let loaded = scene_source::prepare(&given.scene, &given.reading)?;
    let camera = camera::choose(&loaded.scene, &given.view)?;
    terminal::warn_of_scene(&loaded.scene, loaded.triangles);

    let mut backend = open(&given.device.choice())?;
    stop_if_requested(interrupt)?;
    let ray_sets = distinct(&given.ray_set);
    let wanted = systems.len() * (ray_sets.len() + usize::from(given.image));
    let job = CompareJob {
        scene: &loaded.scene,
        camera,
        systems,
        ray_sets,
        rays: given.rays,
        frame,
        image: given.image,
        figures: false,
        needs: given.reading.needs(&loaded.scene, frame.workload()),
    };
    let Comparison { runs, .. } = with_progress(interrupt, |progress| backend.compare(&job, progress))?;
    let finished = runs.len();
    if finished == 0 && interrupt.requested() {
        return Err(AppError::interrupted("stopped before the first run was whole; nothing was written", ""));
    }

    let report = Report::new(backend.device(), &loaded, runs);
    if let Some(place) = &report_target {
        place.write(report.to_json().as_bytes(), interrupt)?;
    }
    terminal::print(&table(&report))?;
    report.runs.iter().try_for_each(check_whole)?;
    if finished < wanted && interrupt.requested() {
        let kept = if report_target.is_some() { "the report holds them" } else { "no report was asked for" };
        return Err(AppError::interrupted(
            format!("stopped after {finished} of {wanted} runs; {kept}"),
            "run again for all of them",
        ));
    }
    Ok(())
}

/// Each set once, in the order given.
fn distinct(sets: &[RaySet]) -> Vec<RaySet> {
    let mut kept = Vec::new();
    for set in sets {
        if !kept.contains(set) {
            kept.push(*set);
        }
    }
    kept
}
