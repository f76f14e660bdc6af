//! Command `rasray compare hard:<id>`: scenes and rays that break ray tracers.

use super::compare::{note_resumed, stop_after};
use super::steps::{open_device, stop_if_requested, with_progress};
use super::targets::Targets;
use crate::arguments::CompareArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{self, Cells};
use crate::terminal::{self, Talk};
use crate::version::{origin, version_text};
use rasray_experiment::{
    Backend, Comparison, HardJob, HardSubject, OpenBackend, SystemConfig, check_run, compare_file,
    hard_cells, integrator_options,
};
use rasray_hard_cases::Scale;
use rasray_ray_files::{HitsFile, load_hits};
use rasray_report::figures::Figures;
use rasray_report::{Run, SceneRecord, columns, table_within};
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::ops::Range;

/// Default number of rays of generated cases.
const DEFAULT_RAYS: u32 = 2000;

/// Word for all cases.
const ALL: &str = "all";

/// Returns the id of a hard case, if a scene's name asks for one.
pub(super) fn asked_for(scene: &OsStr) -> Option<&str> {
    scene.to_str()?.strip_prefix("hard:")
}

/// Traces the rays of a hard case, or of all, through several systems and tells whether each met the demand
/// of the case; `line` is the command as it was typed.
///
/// # Errors
/// As for `rasray compare`; with `--check` also a target that was not met.
pub(super) fn compare(
    given: &CompareArguments,
    id: &str,
    line: &str,
    open: &mut OpenBackend<'_>,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let ids = ids(id)?;
    refuse_options_of_scenes(given)?;
    if let [id] = ids[..]
        && given.replay.is_some()
        && rasray_hard_cases::file_ids().contains(&id)
    {
        return Err(AppError::usage(format!("hard:{id} is a file and has no rays"), "leave --replay out"));
    }
    let systems = given.systems()?;
    let targets = Targets::check(given, &given.scene)?;
    let hits_files = hits_files(given, &ids)?;
    let mut backend = open_device(open, &given.work.device)?;
    stop_if_requested(interrupt)?;

    let subject = Subject { systems: &systems, hits_files: &hits_files, targets: &targets };
    if given.replay.is_some() {
        return replay(given, &ids, subject, backend.as_mut(), interrupt);
    }
    let files: Vec<_> = rasray_hard_cases::files().collect();
    let file = |id: &str| files.iter().find(|file| file.id == id);
    let cases = ids.iter().map(|id| file(id).map_or(HardSubject::Rays(id), HardSubject::File));
    let list = hard_cells(version_text(), cases, &systems, &hits_files, scale(given), given.repetitions);
    let groups = list.groups().to_vec();
    let program = (origin(line), backend.device());
    let mut cells = Cells::open(list, program, targets.lines(), (given.resume, interrupt))?;
    let missing = cells.missing(given.shard)?;
    note_resumed(&cells, missing.len());
    let of_case = |places: &Range<usize>| -> BTreeSet<usize> {
        missing.range(places.clone()).map(|place| place - places.start).collect()
    };
    let wanted: Vec<_> = ids.iter().zip(&groups).filter(|(_, places)| !of_case(places).is_empty()).collect();
    let mut figures = Figures::default();
    let mut finished = 0;
    let mut failed = None;
    for (case, places) in &wanted {
        if interrupt.requested() {
            break;
        }
        let traced = match file(case) {
            Some(file) => Ok((
                Comparison { runs: vec![compare_file(file)?], places: vec![0], ..Comparison::default() },
                0,
            )),
            None => trace(given, case, subject, Some(of_case(places)), backend.as_mut(), interrupt),
        };
        let (one, triangles) = match traced {
            Ok(traced) => traced,
            // The results of cases that were complete before are kept.
            Err(error) if finished > 0 => {
                failed = Some(error);
                break;
            }
            Err(error) => return Err(error),
        };
        if one.runs.is_empty() {
            // A signal ended the case before it was complete.
            break;
        }
        output::save(targets.save(), &one.kept, interrupt)?;
        let place = |run: usize| places.start + one.places[run];
        let scene = SceneRecord { name: format!("hard:{id}"), triangles, ..SceneRecord::default() };
        for (number, run) in one.runs.into_iter().enumerate() {
            cells.add(place(number), run, (scene.clone(), None), interrupt)?;
        }
        figures.depth_errors.extend(one.figures.moved(place).depth_errors);
        finished += 1;
    }
    let Some(report) = cells.report() else {
        return Err(AppError::interrupted(
            "stopped before the first case was whole; nothing was written",
            "",
        ));
    };
    cells.note();
    targets.write(&report, &figures.moved(|place| cells.run(place)), interrupt)?;
    terminal::summarize(
        &table_within(&report, None, terminal::says(Talk::Verbose), terminal::width()),
        targets.take_stdout(),
    )?;
    if let Some(error) = failed {
        terminal::warn(&format!(
            "{finished} of {} cases were whole before the error, and only they are reported",
            wanted.len()
        ));
        return Err(error);
    }
    report.runs.iter().try_for_each(check_run)?;
    stop_after(&targets, (finished, wanted.len()), "cases", interrupt)?;
    if given.check { check_targets(&report.runs) } else { Ok(()) }
}

/// Shows the steps of one ray of each case.
fn replay(
    given: &CompareArguments,
    ids: &[&str],
    subject: Subject<'_>,
    backend: &mut dyn Backend,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let files = rasray_hard_cases::file_ids();
    for id in ids.iter().filter(|id| !files.contains(id)) {
        stop_if_requested(interrupt)?;
        let (one, _) = trace(given, id, subject, None, backend, interrupt)?;
        one.replay.iter().try_for_each(|text| terminal::print(text))?;
    }
    Ok(())
}

/// Returns the ids that a name stands for.
fn ids(id: &str) -> Result<Vec<&'static str>, AppError> {
    let known: Vec<_> = rasray_hard_cases::ids().into_iter().chain(rasray_hard_cases::file_ids()).collect();
    if id == ALL {
        return Ok(known);
    }
    if let Some(found) = known.iter().find(|known| **known == id) {
        return Ok(vec![*found]);
    }
    let titles = rasray_hard_cases::titles();
    let rows: Vec<_> = titles.iter().map(|(id, title)| vec![(*id).to_owned(), (*title).to_owned()]).collect();
    terminal::print(&format!("hard cases\n{}", columns(&rows, 2)))?;
    let message = if id.is_empty() {
        "hard: names no case".to_owned()
    } else {
        format!("there is no hard case '{id}'")
    };
    let meant = known
        .iter()
        .find(|known| known.eq_ignore_ascii_case(id))
        .map_or(String::new(), |meant| format!("did you mean hard:{meant}? "));
    Err(AppError::usage(
        message,
        format!("{meant}the {} cases are listed above; hard:{ALL} runs all", known.len()),
    ))
}

/// Refuses options about scenes, images and generated rays.
fn refuse_options_of_scenes(given: &CompareArguments) -> Result<(), AppError> {
    const UNFIT: [&str; 24] = [
        "time",
        "clip",
        "fps",
        "primary",
        "occluder",
        "shadow-resolution",
        "shadow-points",
        "sampler",
        "image",
        "ray-set",
        "rays-file",
        "camera",
        "eye",
        "target",
        "fov",
        "aperture",
        "focus",
        "environment",
        "alpha",
        "needs",
        "integrator",
        "size",
        "spp",
        "back-faces",
    ];
    let of_images = |option: &str| integrator_options().iter().any(|row| row.name == option);
    match given.typed.iter().find(|typed| UNFIT.contains(&typed.as_str()) || of_images(typed)) {
        Some(option) => Err(AppError::usage(
            format!("--{option} does not go with a hard case, which has its own triangles, rays and eye"),
            "leave it out; --rays and --seed choose the rays of generated cases",
        )),
        None => Ok(()),
    }
}

fn hits_files(given: &CompareArguments, ids: &[&str]) -> Result<Vec<HitsFile>, AppError> {
    if ids.len() > 1 && !given.files.hits_file.is_empty() {
        return Err(AppError::usage(
            "--hits-file has the hits of one case, and all are run",
            "name the case",
        ));
    }
    given.files.hits_file.iter().map(|file| Ok(load_hits(&file.name, &file.path)?)).collect()
}

/// Systems and files of hits for the cases.
#[derive(Clone, Copy)]
struct Subject<'a> {
    systems: &'a [SystemConfig],
    hits_files: &'a [HitsFile],
    targets: &'a Targets,
}

/// Returns the scale of the cases.
fn scale(given: &CompareArguments) -> Scale {
    // A ray does not depend on the number of rays.
    let fewest = given.replay.map_or(0, |index| index.saturating_add(1));
    let rays = given.rays.unwrap_or(DEFAULT_RAYS.max(fewest)) as usize;
    Scale { rays, seed: given.work.frame.seed.into(), full: given.full }
}

/// Traces one case; returns its triangles as well.
fn trace(
    given: &CompareArguments,
    id: &str,
    subject: Subject<'_>,
    only: Option<BTreeSet<usize>>,
    backend: &mut dyn Backend,
    interrupt: &Interrupt,
) -> Result<(Comparison, u64), AppError> {
    let case = rasray_hard_cases::case(id, scale(given)).ok_or_else(|| {
        AppError::usage(format!("there is no hard case '{id}'"), "'rasray compare hard:' lists them")
    })?;
    let job = HardJob {
        case: &case,
        systems: subject.systems,
        repetitions: given.repetitions,
        seed: given.work.frame.seed,
        figures: subject.targets.has_page(),
        hits_files: subject.hits_files,
        keep: subject.targets.save().any(),
        replay: given.replay,
        only,
    };
    let comparison =
        with_progress(interrupt, |progress| progress.done > 0, |progress| backend.hard(&job, progress))?;
    Ok((comparison, case.triangles.len() as u64))
}

/// Reports the targets that were not met.
fn check_targets(runs: &[Run]) -> Result<(), AppError> {
    let missed: Vec<_> = runs
        .iter()
        .filter_map(|run| Some((run, run.hard.as_ref().filter(|hard| hard.met == Some(false))?)))
        .map(|(run, hard)| format!("{} by {} {}", hard.id, run.system, run.preset))
        .collect();
    match missed.as_slice() {
        [] => Ok(()),
        missed => Err(AppError::Target {
            message: format!("{} targets were not met: {}", missed.len(), missed.join(", ")),
            help: "the table above says why; --replay INDEX shows what became of a ray".to_owned(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_report::HardRecord;

    fn run(met: Option<bool>) -> Run {
        let hard = HardRecord { id: "E5".to_owned(), met, ..Default::default() };
        Run { system: "mmrt".to_owned(), hard: Some(hard), ..Default::default() }
    }

    #[test]
    fn only_a_target_that_was_not_met_fails_the_check() {
        assert!(check_targets(&[run(Some(true)), run(None), Run::default()]).is_ok());
        let error = check_targets(&[run(Some(true)), run(Some(false))]).expect_err("one was not met");
        assert_eq!(error.exit_code(), 1);
        assert!(
            error.to_string().contains("1 targets") && error.to_string().contains("E5 by mmrt"),
            "{error}"
        );
    }
}
